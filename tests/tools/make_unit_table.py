"""Write src/jkroll/quantities/unit_table.py: the meanings, from pint, of the unit names that are used in this field.

    python tests/tools/make_unit_table.py > src/jkroll/quantities/unit_table.py

Names that take prefixes and names that do not are kept apart. Where a prefix and a name form a word to which pint gives
another meaning (`hbar` is Planck's constant, not a hectobar), that word goes into PLAIN with pint's meaning, so that no
such word is misread.
"""

import pint

from jkroll.quantities.units import lookup

PREFIXES = """y z a f p n u m c d da h k M G T P E Z Y
yocto zepto atto femto pico nano micro milli centi deci deca hecto kilo mega giga tera peta exa zetta yotta""".split()

PREFIXABLE = """m meter meters metre metres g gram grams s sec second seconds N newton newtons J joule joules
Pa pascal pascals Hz hertz eV electron_volt W watt watts bar dyn dyne dynes erg ergs rad radian radians
A ampere K kelvin V volt""".split()

PLAIN = """Å angstrom angstroms bars micron microns in inch inches ft foot feet mile miles yd yard
min minute minutes h hr hour hours day days yr year years
deg degree degrees arcmin arcsec turn turns revolution cycle rpm
lb pound pounds oz ounce t tonne tonnes u amu Da parsec
lbf kgf psi atm torr mmHg Gal standard_gravity percent
mph kph knot knots fps""".split()

OTHER_NAMES = {
    "°": "deg",
    "%": "percent",
    "kmph": "kph",
    "kmh": "kph",
}  # that pint does not know, or knows as something else


def factor_of(name: str) -> tuple[int, int, tuple[int, ...]]:
    found = lookup(name)
    if found is None:
        raise SystemExit(f"pint does not know {name}")
    return found


def power_of_ten(prefix: str) -> int:
    numerator, denominator, _ = factor_of(prefix + ("meter" if len(prefix) > 2 else "m"))
    return len(str(numerator)) - len(str(denominator))


def main() -> None:
    prefixes = {prefix: power_of_ten(prefix) for prefix in PREFIXES}
    prefixable = {name: factor_of(name) for name in PREFIXABLE}
    plain = {name: factor_of(name) for name in PLAIN}
    plain |= {name: factor_of(known) for name, known in OTHER_NAMES.items()}
    for prefix, exponent in prefixes.items():
        for name, (numerator, denominator, dimension) in prefixable.items():
            meant = lookup(prefix + name)
            if meant is not None and prefix + name not in plain:
                scaled = (
                    (numerator * 10**exponent, denominator)
                    if exponent > 0
                    else (numerator, denominator * 10**-exponent)
                )
                same = meant[0] * scaled[1] == meant[1] * scaled[0] and meant[2] == dimension
                if not same:
                    plain[prefix + name] = meant
            elif meant is None:
                raise SystemExit(f"pint does not know {prefix + name}")
    print('"""Unit names and their meanings, made from pint by tests/tools/make_unit_table.py: do not edit."""\n')
    print(f'PINT_VERSION = "{pint.__version__}"')
    print("# fmt: off")
    print("PREFIXES = {  # name: power of ten")
    for prefix, exponent in prefixes.items():
        print(f'    "{prefix}": {exponent},')
    print("}")
    for title, table in (("PREFIXABLE", prefixable), ("PLAIN", plain)):
        print(f"{title} = {{  # name: numerator, denominator, powers of BASE_UNITS")
        for name, meaning in table.items():
            print(f'    "{name}": {tuple(meaning)},')
        print("}")


if __name__ == "__main__":
    main()
