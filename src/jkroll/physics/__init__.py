"""The formulas of Dominik & Tielens, and of other laws of attraction: plain functions of SI numbers, floats or arrays.

A formula's name and its parameters' names are names of the nomenclature, except a few that only derivations use: that
is all the wiring there is. Parameters are passed by name, because three radii, two energies per area (γ and w = 2γ) and
five forces are easily exchanged.

A formula gives a float for floats, and an array for arrays, which broadcast. Its annotations give the units, by
their names in `dimensions`. Unless its docstring says otherwise, its arguments are positive, with these exceptions:

- loads, approaches, pressures, positions and `load_constant` have a sign, and tension is negative;
- `radius2` is infinite for a plane, Young's moduli for rigid bodies, `mass2` and `moment_of_inertia2` for a fixed body;
- `radius_ratio` is 0 on a plane, edge ratios and `contact_radius_at_load` are 0 without contact;
- `load_margin` is 0 at pull-off, and negative between pull-off and the fold;
- Poisson's ratios lie between −1 and 1/2, filling factors below 0.74, humidities below 1, contact angles below π/2.
"""

from collections.abc import Callable, Mapping
from typing import Any

from . import any_law, contact, conventions, dmt, impact, jkr, maugis, meniscus, motion, rolling, sphere, tangential

_MODULES = (contact, jkr, rolling, motion, impact, conventions, tangential, any_law, meniscus, dmt, maugis, sphere)
FORMULAS: Mapping[str, Callable[..., Any]] = {  # the public functions of the modules, by name
    name: function
    for module in _MODULES
    for name, function in vars(module).items()
    if getattr(function, "__module__", None) == module.__name__ and not name.startswith("_")
}
