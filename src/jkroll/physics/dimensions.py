"""The dimension of every parameter and result, as an annotation that carries the SI unit.

A value is a float, or an array of floats; floats give a float, and arrays broadcast. The annotation is for the reader,
for type checkers, for the help texts and for the tests, which feed each formula pint Quantities and compare the units
of the nomenclature: at run time it costs nothing. The formulas import `annotations` from `__future__`, so that `help`
shows the dimension by its name.
"""

from typing import TYPE_CHECKING, Annotated

if TYPE_CHECKING:  # the formulas run without numpy
    from numpy import bool_, float64
    from numpy.typing import NDArray

    FloatOrArray = float | NDArray[float64]
    Condition = bool | NDArray[bool_]
else:
    FloatOrArray = float
    Condition = bool

Length = Annotated[FloatOrArray, "m"]
PerLength = Annotated[FloatOrArray, "m^-1"]
Area = Annotated[FloatOrArray, "m^2"]
Mass = Annotated[FloatOrArray, "kg"]
Density = Annotated[FloatOrArray, "kg/m^3"]
Inertia = Annotated[FloatOrArray, "kg m^2"]
Time = Annotated[FloatOrArray, "s"]
Speed = Annotated[FloatOrArray, "m/s"]
Acceleration = Annotated[FloatOrArray, "m/s^2"]
Force = Annotated[FloatOrArray, "N"]
ForcePerLength = Annotated[FloatOrArray, "N/m"]
Stiffness = Annotated[FloatOrArray, "N/m"]
Stress = Annotated[FloatOrArray, "Pa"]
SurfaceEnergy = Annotated[FloatOrArray, "J/m^2"]
Energy = Annotated[FloatOrArray, "J"]
Moment = Annotated[FloatOrArray, "N m"]
MomentPerLength = Annotated[FloatOrArray, "N"]
RollingStiffness = Annotated[FloatOrArray, "N m/rad"]
Angle = Annotated[FloatOrArray, "rad"]
AngularSpeed = Annotated[FloatOrArray, "rad/s"]
Frequency = Annotated[FloatOrArray, "Hz"]
Number = Annotated[FloatOrArray, "1"]
