"""Adhesive contact of two elastic spheres: pull-off, rolling, chains, vibrations.

>>> import jkroll
>>> f"{jkroll.solve('pull_off_force', material='quartz', radius=1e-7):.4e} N"
'1.1781e-08 N'
"""

__version__ = "0.4.0"

# The public names, by the modules that are imported when one is first used: a command line pays only for what it needs.
# Type checkers know them from the stub beside this file.
_HOMES = {
    "FORMULAS": "model.solver",
    "NOMENCLATURE": "quantities.nomenclature",
    "Interval": "quantities.values",
    "JkrollError": "errors",
    "Material": "materials.library",
    "Materials": "materials.library",
    "Measured": "quantities.values",
    "Quantity": "quantities.nomenclature",
    "answer": "write.answered",
    "fit": "pictures.fitted",
    "infer": "model.infer",
    "known_materials": "materials.library",
    "solve": "model.solver",
}
__all__ = list(_HOMES)


def __getattr__(name: str) -> object:
    """Return a public name, or a formula of `FORMULAS` by its own name: `jkroll.pull_off_force`."""
    from importlib import import_module

    if name in _HOMES:
        value = getattr(import_module(f".{_HOMES[name]}", __name__), name)
    elif name.startswith("_") or (value := import_module(".model.solver", __name__).FORMULAS.get(name)) is None:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return [*__all__, *__getattr__("FORMULAS")]
