"""The lines that `jkroll export` writes, and the contact laws of other programs. test_lammps_export.py runs LAMMPS."""

import math
import re
from typing import Any

import pytest

from harness import Run
from jkroll import solve
from jkroll.physics.motion import STICKS_FROM
from jkroll.write.exports import PROGRAMS
from relative import approx

NUMBER = r"([-+.e\d]+)"
COEFFICIENTS = re.compile(
    rf"pair_coeff (\d \d) (jkr|dmt) {NUMBER} 0 0 {NUMBER} tangential mindlin_rescale {NUMBER} 0 {NUMBER} rolling sds "
    rf"{NUMBER} 0 {NUMBER}"
)
TWISTING = re.compile(rf" twisting sds {NUMBER} 0 {NUMBER}")


def coefficients(text: str) -> dict[str, tuple[float, ...]]:
    """Return the coefficients of each pair of types."""
    return {types: tuple(map(float, numbers)) for types, _, *numbers in COEFFICIENTS.findall(text)}


def test_coefficients_for_lammps_follow_the_formulas(run: Run) -> None:
    """The numbers are 2E*, γ, 8G*, F_slide/2P_c, k_roll = 4P_c/R and μ_roll = 2ξ/R."""
    [(modulus, gamma, tangential, slip, rolling, cap)] = coefficients(run("export lammps quartz 100nm").out).values()
    assert modulus == approx(54e9 / (1 - 0.17**2), rel=1e-11)
    assert gamma == 0.025
    assert tangential == approx(4 * 54e9 / (2 * 1.17) / 1.83, rel=1e-11)
    force = solve("pull_off_force", material="quartz", radius=1e-7)
    assert slip == approx(solve("sliding_force", material="quartz", radius=1e-7) / (2 * force), rel=1e-11)
    assert rolling == approx(4 * force / 5e-8, rel=1e-11)
    assert cap == approx(2 * 2e-10 / 5e-8, rel=1e-11)


@pytest.mark.parametrize("load", [0.0, 5e-9, -1e-8])
def test_thresholds_of_sliding_and_twisting_are_those_at_the_load(run: Run, load: float) -> None:
    """Each cap is μ(P + 2P_c): the sliding force, and the twisting moment, for which μ is in metres."""
    text = run(f"export lammps quartz 100nm --load={load}N --shear-strength 12MPa").out
    scene: dict[str, Any] = {"material": "quartz", "radius": 1e-7, "load": load, "shear_strength": 12e6}
    names = ("pull_off_force", "sliding_force", "twisting_stiffness", "twisting_moment")
    force, slide, stiffness, twist = solve(names, **scene).values()
    [(*_, slip, _, _)] = coefficients(text).values()
    [(printed, cap)] = TWISTING.findall(text)
    assert slip * (load + 2 * force) == approx(slide, rel=1e-11)
    assert float(printed) == approx(stiffness, rel=1e-11)
    assert float(cap) * (load + 2 * force) == approx(twist, rel=1e-11)
    assert "tau = 1.2e+07 Pa" in text


def test_coefficients_by_dmt_follow_the_formulas(run: Run) -> None:
    """The moment is P_DMT ξ at any load, and the yield force of LAMMPS is μ(P + 2P_DMT)."""
    pull_off = solve("pull_off_force_dmt", material="quartz", radius=1e-7)
    for load in (0.0, 5e-9):
        text = run(f"export lammps quartz 100nm --model dmt --load {load}N").out
        assert "pair_coeff 1 1 dmt " in text
        assert "twisting" not in text.partition("timestep")[0]
        [(_, _, tangential, slip, rolling, cap)] = coefficients(text).values()
        assert tangential == approx(4 * 54e9 / (2 * 1.17) / 1.83, rel=1e-11)
        assert slip == 1e9  # no sliding
        assert rolling == approx(pull_off / 5e-8, rel=1e-11)
        assert cap == approx(pull_off * 2e-10 / 5e-8 / (load + 2 * pull_off), rel=1e-11)


def test_the_state_of_a_dmt_contact_is_that_of_dmt(run: Run) -> None:
    """An approach gives the load by DMT, which holds more tension than JKR."""
    load = solve("load", material="quartz", radius=1e-7, approach_at_load=2e-11, model="dmt")
    by_approach = run("export lammps quartz 100nm --model dmt --approach 0.02nm").out
    assert f"P = {load:.12g} N" in by_approach
    assert coefficients(by_approach) == coefficients(run(f"export lammps quartz 100nm --model dmt --load {load}N").out)
    assert run("export lammps quartz 100nm --model dmt --load -13nN").code == 0


def test_unequal_spheres_have_three_pairs_of_types(run: Run) -> None:
    text = run("export lammps quartz 100nm --radius2 300nm --material2 iron --load -1nN").out
    assert "\n# set type 2 diameter 6e-07 density 7700\n" in text
    pairs = coefficients(text)
    assert [*pairs] == ["1 1", "2 2", "1 2"]
    assert pairs["1 1"] == coefficients(run("export lammps quartz 100nm").out)["1 1"]
    assert pairs["2 2"] == coefficients(run("export lammps iron 300nm").out)["1 1"]
    steps = [
        float(re.findall(r"timestep (\S+)", run(f"export lammps {grain}").out)[0])
        for grain in ("quartz 100nm", "iron 300nm")
    ]
    assert float(re.findall(r"timestep (\S+)", text)[0]) <= min(steps)
    comment = "# Like spheres touch without load. The time step is the shortest of all pairs.\n"
    assert comment in text
    assert comment not in run("export lammps quartz 100nm --load -1nN").out


@pytest.mark.parametrize(
    ("words", "radii"),
    [
        ("quartz 100nm", (1e-7, 1e-7)),
        ("quartz 1mm --radius2 100nm", (1e-3, 1e-7)),
        ("quartz 1um --radius2 plane", (1e-6, math.inf)),
        ("quartz 100nm --young 1MPa", (1e-7, 1e-7)),
    ],
)
def test_the_skin_for_lammps_reaches_all_contacts(run: Run, words: str, radii: tuple[float, float]) -> None:
    """LAMMPS refuses its default skin of 1 mm for small grains. It breaks a contact at a gap of 0.397 δ0."""
    text = run(f"export lammps {words}").out
    [skin] = map(float, re.findall(r"^neighbor (\S+) bin$", text, re.MULTILINE))
    young = {"youngs_modulus": 1e6} if "1MPa" in words else {}
    pairs = [(radii[0], radii[0]), radii]
    if math.isfinite(radii[1]):
        pairs.append((radii[1], radii[1]))
    for radius, radius2 in pairs:
        scene: dict[str, Any] = {"material": "quartz", "radius": radius, "radius2": radius2, **young}
        assert skin >= 0.397 * solve("approach", **scene)
    assert skin <= max(radii)


def test_a_work_of_adhesion_applies_to_all_contacts_between_the_two_given_materials(run: Run) -> None:
    text = run("export lammps quartz 100nm --material2 iron --work-of-adhesion 50mJ/m2").out
    assert [numbers[1] for numbers in coefficients(text).values()] == [0.025, 3.0, 0.025]
    text = run("export lammps quartz 100nm --radius2 1um --work-of-adhesion 80mJ/m2").out
    assert {numbers[1] for numbers in coefficients(text).values()} == {0.04}


def test_a_plane_is_a_wall(run: Run) -> None:
    text = run("export lammps quartz 1um --radius2 plane --material2 iron --load 10nN").out
    assert "zplane 0 NULL\n" in text
    of_wall = text.replace("fix wall all wall/gran granular", "pair_coeff 0 0")
    modulus, gamma, _, _, rolling, cap = coefficients(of_wall)["0 0"]
    scene: dict[str, Any] = {
        "material": "quartz",
        "material2": "iron",
        "radius": 1e-6,
        "radius2": math.inf,
        "load": 1e-8,
    }
    assert modulus == approx(2 * solve("contact_modulus", **scene), rel=1e-11)
    assert gamma == approx(math.sqrt(0.025 * 3.0), rel=1e-11)
    assert rolling == approx(solve("rolling_stiffness", **scene) / 1e-12, rel=1e-11)
    held = 1e-8 + 2 * solve("pull_off_force", **scene)
    assert cap == approx(solve("yield_moment", **scene) / (1e-6 * held), rel=1e-11)
    alone = run("export lammps quartz 1um").out
    assert coefficients(text) == coefficients(alone)  # coefficients of two grains


def test_a_program_may_be_given_by_the_name_that_its_authors_use(run: Run) -> None:
    for name, program in PROGRAMS.items():
        assert run(f"export {program.title} quartz 100nm --quiet").out == run(f"export {name} quartz 100nm --quiet").out


@pytest.mark.parametrize("program", ["lammps", "liggghts", "dust-collider", "dust-simulation"])
def test_best_ranges_and_the_caveat_are_in_the_file_or_among_the_notes(run: Run, program: str) -> None:
    """Notes in a file are comments in ASCII. --quiet leaves out notes and changes no number."""
    ran = run(f"export {program} quartz 100nm")
    quiet = run(f"export {program} quartz 100nm --quiet")
    assert (quiet.code, quiet.err) == (0, "")
    printed = re.sub("\n#? +", " ", ran.err if program == "dust-simulation" else ran.out.replace(quiet.out, ""))
    assert re.search(r"best ranges: .*P_c 14[-–]15 nN \(Maugis\)", printed)
    assert re.search("(γ|gamma) of quartz: in air; in vacuum or baked take", printed)
    assert "changes no result here" not in printed
    assert "--model" not in printed  # no program has Maugis' law
    assert quiet.out in ran.out
    if program != "dust-simulation":
        assert ran.out.isascii()
        assert all(line.startswith("# ") for line in printed.splitlines())
        assert ran.err == ""


def test_each_word_of_lammps_is_explained(run: Run) -> None:
    for options, words in (
        ("", ["jkr", "mindlin_rescale", "rolling sds", "twisting sds"]),
        (" --model dmt", ["dmt", "mindlin_rescale"]),
    ):
        text = run(f"export lammps quartz 100nm{options} --quiet").out
        comments = [line for line in text.partition("timestep")[2].splitlines() if line.startswith("#")]
        explained = "\n".join(comments)
        assert [word for word in words if f"{word}: " not in explained] == []
        assert "coeff_restitution" in explained


def test_an_export_by_dmt_does_not_mention_results_of_other_laws(run: Run) -> None:
    assert "not in DMT" not in run("export lammps quartz 100nm --model dmt").out


def test_a_pair_that_lacks_an_input_is_left_out(run: Run) -> None:
    """The work of adhesion does not give γ of the first solid, so two spheres of this solid have no coefficients."""
    words = (
        "export lammps 100nm --young 54GPa --poisson 0.17 --density 2g/cm3 --material2 iron --work-of-adhesion 50mJ/m2"
    )
    ran = run(words)
    assert ran.code == 0
    assert (
        "# pair_coeff 1 1: needs surface energy per surface; name a material, such as quartz, or give --gamma 25mJ/m2"
        in ran.out.replace("\n#  ", "")
    )
    assert [*coefficients(ran.out)] == ["2 2", "1 2"]


def test_a_pair_of_rigid_bodies_is_left_out(run: Run) -> None:
    ran = run("export lammps quartz 100nm --young2 rigid --shear-strength 12MPa")
    assert ran.code == 0
    assert "# pair_coeff 2 2: both bodies are rigid" in ran.out
    assert [*coefficients(ran.out)] == ["1 1", "1 2"]


_NAMES = "lammps, liggghts, dust-collider, dust-simulation"
WHICH = (
    f"export: which program, {_NAMES}? Write jkroll export lammps quartz 100nm; jkroll guide dem says what other "
    "codes call γ"
)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("", WHICH),
        ("yade quartz 100nm", WHICH),
        ("liggghts quartz 100nm --model dmt", "--model: LIGGGHTS has jkr, not 'dmt'"),
        ("liggghts quartz 100nm --load 1nN", "export: liggghts finds the load by itself; give none"),
        ("liggghts quartz 100nm --young2 rigid", "export: liggghts needs a finite Young's modulus of each body"),
        (
            "dust-simulation quartz 100nm --shear-strength 1MPa",
            "export: dust-simulation has a shear strength of its own, and takes no other",
        ),
        (
            "dust-simulation quartz 100nm --approach 0.1nm",
            "export: dust-simulation finds the load by itself; give none",
        ),
        (
            "dust-simulation quartz 100nm --poisson 0",
            "export: dust-simulation divides by Poisson's ratio, which is 0 here",
        ),
        ("lammps quartz,iron 100nm", "export takes one pair of spheres, not 2; for an unequal pair: --radius2"),
        ("lammps quartz 100nm --model maugis", "--model: LAMMPS has jkr and dmt, not 'maugis'"),
        (
            "lammps 100nm --gamma 25mJ/m2 --young 54GPa --poisson 0.17",
            "time step for a simulation needs mass density; name a material, such as quartz, or give --density 1g/cm3",
        ),
        (
            "dust-collider 100nm --gamma 25mJ/m2 --young 54GPa --poisson 0.17",
            "needs mass density; name a material, such as quartz, or give --density 1g/cm3",
        ),
    ],
)
def test_a_wrong_export_is_refused_with_a_reason(run: Run, words: str, message: str) -> None:
    ran = run(*"export".split(), *words.split())
    assert (ran.code, ran.out, ran.err) == (2, "", f"jkroll: {message}\n")


# --- LIGGGHTS: Hertz minus kA, with the area A of cohesion_model_sjkr2.h and _sjkr.h ----------------------------------


def liggghts_force(
    overlap: float, modulus: float, radii: tuple[float, float], density: float, *, exact_circle: bool
) -> float:
    """Return the force of LIGGGHTS on two spheres, or on a sphere and a wall, which has an infinite radius."""
    radius, radius2 = radii
    at_wall = math.isinf(radius2)
    reduced = radius if at_wall else radius * radius2 / (radius + radius2)
    r = (radius if at_wall else radius + radius2) - overlap
    if at_wall:
        area = math.pi * (radius**2 - r**2) if exact_circle else 2 * math.pi * radius * overlap
    elif exact_circle:
        factors = (r - radius - radius2) * (r + radius - radius2) * (r - radius + radius2) * (r + radius + radius2)
        area = -math.pi / 4 * factors / r**2
    else:
        area = 2 * math.pi * 2 * reduced * overlap
    return float(4 / 3 * modulus * math.sqrt(reduced) * overlap**1.5 - density * area)


@pytest.mark.parametrize(
    ("words", "index", "radii"),
    [
        ("quartz 1um", 0, (1e-6, 1e-6)),
        ("quartz 1um --radius2 3um --material2 iron", 0, (1e-6, 1e-6)),
        ("quartz 1um --radius2 3um --material2 iron", 1, (1e-6, 3e-6)),
        ("quartz 1um --radius2 3um --material2 iron", 3, (3e-6, 3e-6)),
        ("quartz 1um --radius2 plane --material2 iron", 1, (1e-6, math.inf)),
    ],
)
def test_the_exported_cohesion_gives_liggghts_the_pull_off_force_of_jkr(
    run: Run, words: str, index: int, radii: tuple[float, float]
) -> None:
    """The strongest pull by sjkr2 is JKR's pull-off force. With sjkr, two spheres need twice k, up to terms in δ/R."""
    text = run(f"export liggghts {words}").out
    moduli = [*map(float, re.findall(r"youngsModulus peratomtype (.*)", text)[0].split())]
    ratios = [*map(float, re.findall(r"poissonsRatio peratomtype (.*)", text)[0].split())]
    count, *densities = re.findall(r"peratomtypepair (.*)", text)[0].split()
    assert len(densities) == int(count) ** 2 == len(moduli) ** 2
    types = divmod(index, int(count))
    modulus = 1 / sum((1 - ratios[number] ** 2) / moduli[number] for number in types)
    materials = ["quartz", "iron"]
    scene: dict[str, Any] = {
        "material": materials[types[0]], "material2": materials[types[1]], "radius": radii[0], "radius2": radii[1]
    }  # fmt: skip
    force, approach = solve(["pull_off_force", "approach"], **scene).values()
    overlaps = [approach * step / 2000 for step in range(1, 8000)]
    for exact_circle, factor in ((False, 1), (True, 1 if math.isinf(radii[1]) else 2)):
        density = factor * float(densities[index])
        least = min(liggghts_force(at, modulus, radii, density, exact_circle=exact_circle) for at in overlaps)
        assert -least == approx(force, rel=2e-2 if exact_circle else 1e-6)


# --- DustSimulation: the constants of Simulation::setMaterialConstants ------------------------------------------------


@pytest.mark.parametrize(
    "words", ["quartz 0.6um --xi 2nm", "100nm --gamma 20mJ/m2 --young 54GPa --poisson 0.3 --density 2g/cm3"]
)
def test_constants_that_dust_simulation_derives_equal_results_of_jkroll(run: Run, words: str) -> None:
    ran = run(f"export dust-simulation {words}")
    version, name, *numbers = ran.out.splitlines()
    assert (version, name) == ("MATERIAL_FILE_VERSION_1_4", "quartz" if "quartz" in words else "jkroll")
    radius, density, gamma, nu, young, xi, _, _, *modifiers = map(float, numbers)
    assert modifiers == [1, 1, 1]
    assert "Silicate.mat" in ran.err
    modulus, reduced, shear = young / 2 / (1 - nu**2), radius / 2, young / 2 / (1 + nu)
    a0 = (9 * math.pi * gamma * reduced**2 / modulus) ** (1 / 3)
    pull_off = 3 * math.pi * gamma * reduced  # in cgs units, so dyn = 1e-5 N
    sliding, twisting = 8 * (shear / 2 / (2 - nu)) * a0, 16 / 3 * (shear / 2) * a0**3
    names = "pull_off_force yield_moment sliding_force twisting_moment tangential_stiffness mass".split()
    own = [float(run(f"report {words} --quantities {name} --bare").out) for name in names]
    theirs = [
        1e-5 * pull_off,
        1e-7 * 4 * pull_off / reduced * xi * reduced,
        1e-5 * sliding * (2 - nu) / (16 * math.pi) * a0,
        1e-7 * twisting / (16 * math.pi),
        1e-3 * sliding,
        1e-3 * 4 / 3 * math.pi * radius**3 * density,
    ]
    assert own == approx(theirs, rel=1e-11)


# --- DustCollider: the line of a material as pipeline.cuh reads it ----------------------------------------------------


def test_dust_collider_gets_a_line_with_the_numbers_of_a_material(run: Run) -> None:
    """A line has `<material id = "ID"> "name"` and six numbers; DustCollider ignores text after #."""
    ran = run("export dust-collider quartz 0.6um --xi 2nm")
    [line] = [line for line in ran.out.splitlines() if not line.startswith("#")]
    tag, name, *numbers = line.replace('<material id = "1">', "tag").split()
    assert (tag, name) == ("tag", '"quartz"')
    assert [float(number) for number in numbers] == [0.025, 5.4e10, 0.17, 2600, 2e-9, 0]
    assert ran.out.isascii()


# --- Time steps -------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("program", ["lammps", "liggghts"])
def test_the_shorter_time_step_of_two_rules_is_exported(run: Run, program: str) -> None:
    """The rules are a twentieth of the period of sliding and a fifth of the Rayleigh time of either sphere.

    The least step of the pair and of both pairs of like spheres counts. The square of the speed of a Rayleigh wave,
    relative to that of shear waves, is a root of Rayleigh's equation.
    """

    def step(words: str) -> float:
        return float(re.findall(r"timestep ([-.e\d]+)", run(f"export {program} {words}").out)[0])

    def by_sliding(**scene: Any) -> float:
        return 1 / (20 * float(solve("sliding_frequency", material="quartz", **scene)))

    shear, ratio = 54e9 / (2 * 1.17), (1 - 2 * 0.17) / (2 - 2 * 0.17)
    wave = 0.820424
    assert (2 - wave) ** 2 == approx(4 * math.sqrt(1 - wave) * math.sqrt(1 - ratio * wave), rel=1e-5)
    by_rayleigh = math.pi * 1e-7 / math.sqrt(wave * shear / 2600) / 5
    assert step("quartz 100nm") == approx(by_rayleigh, rel=5e-3)
    assert step("iron 300nm") > by_rayleigh
    assert step("quartz 100nm --radius2 plane") == approx(by_rayleigh, rel=5e-3)  # the wall has no Rayleigh time
    assert step("silica-humid 5um") == approx(
        solve("rayleigh_time", material="silica-humid", radius=5e-6) / 5, rel=1e-11
    )
    scene = {"radius": 1e-7, "material2": "iron"}
    assert step("quartz 100nm --radius2 300nm --material2 iron") == approx(by_sliding(**scene, radius2=3e-7), rel=1e-11)
    assert step("quartz 100nm --radius2 plane --material2 iron") == approx(
        by_sliding(**scene, radius2=math.inf), rel=1e-11
    )
    assert step("quartz 10nm") == approx(by_sliding(radius=1e-8), rel=1e-11)


@pytest.mark.parametrize(
    ("words", "held"),
    [
        ("quartz 25um", "real surfaces hold 0.74-1.5 uN (smooth glass, dry air)"),
        ("quartz 25um --model dmt", "real surfaces hold 0.74-1.5 uN (smooth glass, dry air)"),
        ("lactose-crystalline 40um --poisson 0.3", "real spheres hold 0.040-3.9 uN if like SiO2"),
    ],
)
def test_an_export_says_what_real_surfaces_hold(run: Run, words: str, held: str) -> None:
    assert f"# note: {held}" in run(f"export lammps {words}").out


def test_the_advice_names_what_the_input_of_the_program_lacks(run: Run) -> None:
    wanted = {"lammps": "damping (now 0) and friction (now that of adhesion)", "dust-collider": "viscous time (now 0)"}
    for program, lacking in wanted.items():
        assert f"# You must still write your {lacking}.\n" in run(f"export {program} quartz 600nm").out


def test_a_note_says_that_the_middle_of_a_range_was_used(run: Run) -> None:
    assert "# note: computed with the middle of gamma1 = 20 to 25 mJ/m^2\n" in run("export lammps silica-humid 5um").out
    assert "computed with the middle" not in run("export lammps quartz 5um").out
    drawn = run("map pull-off --gamma 25±5mJ/m2 --x radius=1um:10um:3 --data out.csv")
    assert "note: computed with the middle of γ1 = 25.0 ± 5.0 mJ/m²" in drawn.err.splitlines()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (
            "quartz 100nm",
            "below 246 nm stick at every speed: their T* = (T_vis/ν²)√(E*a0/m) is above 0.6817; here it is 1.95",
        ),
        (
            "quartz 600nm",
            "below 246 nm stick at every speed: their T* = (T_vis/ν²)√(E*a0/m) is above 0.6817; here it is 0.241",
        ),
    ],
)
def test_grains_that_stick_at_every_speed_in_dust_simulation_are_noted(run: Run, words: str, said: str) -> None:
    assert said in run(f"export dust-simulation {words}").err
    names = ("contact_modulus", "contact_radius", "reduced_mass")
    modulus, radius, mass = solve(names, material="quartz", radius=246.4e-9).values()
    assert 1.25e-11 / 0.17**2 * math.sqrt(modulus * radius / mass) == approx(STICKS_FROM, rel=1e-3)
