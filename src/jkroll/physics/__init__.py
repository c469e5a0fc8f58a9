"""The formulas of Dominik & Tielens, and of other laws of attraction: plain functions of SI numbers, floats or arrays.

The names of formulas and of their parameters are names of the nomenclature, which alone connects the formulas; the few
others, such as `pressure` at a `distance`, serve pictures and comparisons. Parameters are passed by name, because three
radii, two energies per area (γ and w = 2γ) and five forces are easily exchanged.

A formula gives a float for floats, and an array for arrays, which broadcast. Its annotations are dimensions, with their
SI units in `dimensions`. "As Eq (25)" after "Valid:" means: as the formula that has Eq (25) after "Source:". Unless a
docstring says otherwise, the arguments of a formula are positive, with these exceptions:

- loads, approaches, pressures, positions and `load_constant` have a sign; a load or a pressure is negative in tension;
- `radius2` is infinite for a plane, Young's moduli for rigid bodies, `mass2` and `moment_of_inertia2` for a fixed body;
- Rayleigh frequencies are 0 for a plane and for rigid bodies;
- `radius_ratio` is 0 on a plane, edge ratios and `contact_radius_at_load` are 0 without contact;
- `load_margin` is 0 at pull-off, and lies between −1 and 0 beyond;
- Poisson's ratios lie between −1 and 1/2, filling factors below 0.74, humidities below 1; contact angles
  are below π/2, and may be 0.
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
