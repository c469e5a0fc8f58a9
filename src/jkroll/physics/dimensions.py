"""The dimension of every parameter and result, as an annotation that carries the SI unit.

A value is a float or an array of floats; floats give a float, and arrays broadcast. Readers, type checkers and help
texts use the annotation. The tests call each formula with pint Quantities, and compare the unit of its annotation with
that of the nomenclature (`typing.get_type_hints` with the names of this module). Python does not evaluate the
annotations: the aliases are texts, and the modules of formulas import `annotations` from `__future__`. So `help` shows
a dimension by its name.
"""

from typing import Annotated, TypeAlias

from .elementary import FloatOrArray

Length: TypeAlias = "Annotated[FloatOrArray, 'm']"
PerLength: TypeAlias = "Annotated[FloatOrArray, 'm^-1']"
Area: TypeAlias = "Annotated[FloatOrArray, 'm^2']"
Mass: TypeAlias = "Annotated[FloatOrArray, 'kg']"
Density: TypeAlias = "Annotated[FloatOrArray, 'kg/m^3']"
Inertia: TypeAlias = "Annotated[FloatOrArray, 'kg m^2']"
Time: TypeAlias = "Annotated[FloatOrArray, 's']"
Speed: TypeAlias = "Annotated[FloatOrArray, 'm/s']"
Acceleration: TypeAlias = "Annotated[FloatOrArray, 'm/s^2']"
Force: TypeAlias = "Annotated[FloatOrArray, 'N']"
ForcePerLength: TypeAlias = "Annotated[FloatOrArray, 'N/m']"
Stiffness: TypeAlias = "Annotated[FloatOrArray, 'N/m']"
Stress: TypeAlias = "Annotated[FloatOrArray, 'Pa']"
SurfaceEnergy: TypeAlias = "Annotated[FloatOrArray, 'J/m^2']"
Energy: TypeAlias = "Annotated[FloatOrArray, 'J']"
Moment: TypeAlias = "Annotated[FloatOrArray, 'N m']"
MomentPerLength: TypeAlias = "Annotated[FloatOrArray, 'N']"
MomentPerAngle: TypeAlias = "Annotated[FloatOrArray, 'N m/rad']"
Angle: TypeAlias = "Annotated[FloatOrArray, 'rad']"
AngularSpeed: TypeAlias = "Annotated[FloatOrArray, 'rad/s']"
Frequency: TypeAlias = "Annotated[FloatOrArray, 'Hz']"
Number: TypeAlias = "Annotated[FloatOrArray, '1']"
