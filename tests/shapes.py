"""Materials files of a given size in the shapes that cost a TOML parser most: by name, as functions of the size."""

from collections.abc import Callable, Iterable
from itertools import count, product
from string import ascii_lowercase


def _names() -> Iterable[str]:
    for length in count(1):
        yield from map("".join, product(ascii_lowercase, repeat=length))


def _filled(size: int, piece: Callable[[str], str], start: str = "", end: str = "") -> bytes:
    """Pieces made from different names, as many as fit."""
    parts, length = [start], len(start) + len(end)
    for name in _names():
        part = piece(name)
        if length + len(part) > size:
            break
        parts.append(part)
        length += len(part)
    return ("".join(parts) + end).encode()


def ordinary(size: int) -> bytes:
    """Materials as people write them."""
    return _filled(
        size,
        lambda name: (
            f'[materials.m{name}]\naliases        = ["a_{name}", "B{name}"]\nsurface_energy = "0.37 J/m2"\n'
            f'youngs_modulus = "7 GPa"\npoisson_ratio  = 0.25\ndensity        = "1 g/cm3"\n'
            f'references     = ["r{name}"]\n\n[references.r{name}]\nauthor = "Someone, A. and Other, B."\n'
            f'title = "A title of a usual length for a title"\njournal = "Journal of Things"\nyear = "1990"\n\n'
        ),
    )


SHAPES: dict[str, Callable[[int], bytes]] = {
    "keys": lambda size: _filled(size, lambda name: f"{name}=1\n"),
    "quoted keys": lambda size: _filled(size, lambda name: f'"{name}\\u0041"=1\n'),
    "dotted keys": lambda size: _filled(size, lambda name: f"{name}.a=1\n"),
    "long dotted keys": lambda size: _filled(size, lambda name: name + ".a" * 19 + "=1\n"),
    "a dotted key": lambda size: ("a" + ".a" * ((size - 5) // 2) + " = 1").encode(),
    "very long dotted keys": lambda size: _filled(size, lambda name: name + ".a" * 98 + "=1\n"),
    "dotted keys as long as a line": lambda size: _filled(size, lambda name: name + ".a" * 990 + "=1\n"),
    "tables": lambda size: _filled(size, lambda name: f"[{name}]\n"),
    "very deep tables": lambda size: _filled(size, lambda name: f"[{name}" + ".a" * 97 + "]\n"),
    "deep tables": lambda size: _filled(size, lambda name: f"[{name}" + ".a" * 19 + "]\n"),
    "arrays of tables": lambda size: _filled(size, lambda _: "[[a]]\n"),
    "tables in an array": lambda size: _filled(size, lambda name: f"[a.{name}]\n", "[[a]]\n"),
    "inline tables": lambda size: _filled(size, lambda _: "{a.a.a.a=1},\n", "a=[\n", "]"),
    "nested inline tables": lambda size: _filled(size, lambda _: "{a=" * 50 + "1" + "}" * 50 + ",\n", "a=[\n", "]"),
    "arrays": lambda size: _filled(size, lambda _: "[],\n", "a=[\n", "]"),
    "nested arrays": lambda size: _filled(size, lambda _: "[" * 300 + "]" * 300 + ",\n", "a=[\n", "]"),
    "open brackets": lambda size: b"a = " + b"[\n" * ((size - 4) // 2),
    "numbers": lambda size: _filled(size, lambda _: "1,\n", "a=[\n", "]"),
    "huge numbers": lambda size: _filled(size, lambda _: "9" * 1900 + ",\n", "a=[\n", "]"),
    "dates": lambda size: _filled(size, lambda _: "1979-05-27T00:32:00-07:00,\n", "a=[\n", "]"),
    "escapes": lambda size: _filled(size, lambda _: "\\u0041" * 300 + "\n", 'a="""\n', '"""'),
    "quotes": lambda size: _filled(size, lambda _: '"" ', 'a="""', '"""'),
    "lines of quotes": lambda size: _filled(size, lambda _: '"' * 1999 + "\n"),
    "lines of backslashes": lambda size: _filled(size, lambda _: '"' + "\\" * 1990 + "\n"),
    "a long name": lambda size: b"[materials." + b"a" * (size - 12) + b"]",
    "long names": lambda size: _filled(size, lambda name: f"[materials.{name}{'a' * 1900}]\n"),
    "long unknown keys": lambda size: _filled(size, lambda name: f"[materials.{name}]\n{'surface_energy' * 100} = 1\n"),
    "long quantities": lambda size: _filled(size, lambda name: f"[materials.{name}]\ndensity = '{'9' * 1900} g/cm3'\n"),
    "names of one material": lambda size: _filled(
        size, lambda name: f'"a_{name}",\n', "[materials.a]\naliases=[\n", "]"
    ),
    "aliases": lambda size: _filled(size, lambda name: f'"{name}",', "[materials.A]\naliases=[", "]"),
    "small materials": lambda size: _filled(size, lambda name: f'[materials.{name}]\ndensity="1 g/cm3"\n'),
    "empty materials": lambda size: _filled(size, lambda name: f"[materials.{name}]\n"),
    "materials with one alias": lambda size: _filled(size, lambda name: f'[materials.{name}]\naliases=["A{name}"]\n'),
    "materials without references": lambda size: _filled(
        size,
        lambda name: (
            f'[materials.{name}]\ndensity="1 g/cm3"\nsurface_energy="1 J/m2"\nyoungs_modulus="1 '
            'GPa"\npoisson_ratio="0"\n'
        ),
    ),
    "short keys": lambda size: _filled(size, lambda name: f'{name}=""\n', "[references.a]\n"),
    "odd values": lambda size: _filled(size, lambda name: f"{name}=1\n", "[references.a]\n"),
    "odd lists": lambda size: _filled(size, lambda _: "1,", "[references.a]\na=[", "]"),
    "keys of two parts": lambda size: _filled(size, lambda name: f'{name}.a=""\n', "[references.a]\n"),
    "lists over lines": lambda size: _filled(size, lambda name: f'{name}=[\n""\n]\n', "[references.a]\n"),
    "open lists": lambda size: _filled(size, lambda name: f"{name}=[\n", "[references.a]\n"),
    "tables in tables": lambda size: _filled(size, lambda name: f"[a.b.{name}]\n", "[a.b]\n"),
    "comments": lambda size: _filled(size, lambda _: "#\n"),
    "line ends": lambda size: b"\n" * size,
    "carriage returns": lambda size: b"\r\n" * (size // 2),
    "spaces": lambda size: b" " * size,
    "zeros": bytes,
    "no UTF-8": lambda size: b"\xff" * size,
}
