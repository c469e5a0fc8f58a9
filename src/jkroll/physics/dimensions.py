"""The dimension of every parameter and result, as an annotation that carries the SI unit.

A value is a float, or an array of them; arrays broadcast. The annotation is for the reader, for the help texts and for
the test that feeds each formula pint Quantities: at run time it costs nothing.
"""

from typing import Annotated, Any

Length = Annotated[Any, "m"]
Area = Annotated[Any, "m^2"]
Volume = Annotated[Any, "m^3"]
Mass = Annotated[Any, "kg"]
Density = Annotated[Any, "kg/m^3"]
Inertia = Annotated[Any, "kg m^2"]
Speed = Annotated[Any, "m/s"]
Acceleration = Annotated[Any, "m/s^2"]
Force = Annotated[Any, "N"]
ForcePerLength = Annotated[Any, "N/m"]
Stiffness = Annotated[Any, "N/m"]
Stress = Annotated[Any, "Pa"]
SurfaceEnergy = Annotated[Any, "J/m^2"]
Energy = Annotated[Any, "J"]
Moment = Annotated[Any, "N m"]
MomentPerLength = Annotated[Any, "N"]
RollingStiffness = Annotated[Any, "N m/rad"]
Angle = Annotated[Any, "rad"]
AngularSpeed = Annotated[Any, "rad/s"]
AngularAcceleration = Annotated[Any, "rad/s^2"]
Frequency = Annotated[Any, "Hz"]
Number = Annotated[Any, "1"]
