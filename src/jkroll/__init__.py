"""Adhesive contact of two elastic spheres: pull-off, rolling, chains, vibrations.

>>> import jkroll
>>> f"{jkroll.solve('pull_off_force', material='quartz', radius=1e-7):.4e} N"
'1.1781e-08 N'
"""

__version__ = "0.5.0"

# The module of each public name. It is imported when the name is first used, so that a command loads only what it
# needs. Type checkers know the names from the stub next to this file.
_HOMES = {
    "FORMULAS": "model.solver",
    "NOMENCLATURE": "write.nomenclature",
    "Interval": "quantities.values",
    "JkrollError": "errors",
    "Material": "materials.library",
    "Materials": "materials.library",
    "Measured": "quantities.values",
    "Quantity": "quantities.quantity",
    "answer": "pictures.answers",
    "curve": "pictures.drawn",
    "figure": "pictures.drawn",
    "fit": "pictures.fitted",
    "formulas": "formulas",  # the module
    "infer": "model.infer",
    "known_materials": "materials.library",
    "map": "pictures.drawn",
    "solve": "model.solver",
    "table": "tables.tabled",
}
__all__ = list(_HOMES)


def __getattr__(name: str) -> object:
    """Return a public object by its name, after importing its module."""
    from importlib import import_module

    if name in _HOMES:
        module = import_module(f".{_HOMES[name]}", __name__)
        globals()[name] = value = module if _HOMES[name] == name else getattr(module, name)
        return value
    is_formula = not name.startswith("_") and name in import_module(".model.solver", __name__).FORMULAS
    remedy = f"; it is jkroll.formulas.{name}" if is_formula else ""
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}{remedy}")


def __dir__() -> list[str]:
    return __all__
