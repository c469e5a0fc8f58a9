"""`jkroll fit` on the command line: its output, and its messages about curves that cannot be fitted."""

import csv
import gzip
import io
import json
from pathlib import Path
from typing import Any

import numpy
import pytest

import jkroll
from curves import autoregression, dmt_force, jkr_curve, jkr_force, jkr_state, ramp, soft_lever_curve
from harness import Run
from jkroll.cli.call import Call
from jkroll.cli.commands import COMMANDS
from jkroll.fitting.branches import UNLOADING
from relative import approx

KNOWN = "--radius 7.5um --radius2 plane --spring 3.01N/m"
FORCE_CURVE = Path(__file__).parents[1] / "data" / "force_curve.csv"


def table(z: Any, force: Any, head: str = "travel [um],force [nN]") -> str:
    """Return a curve as CSV."""
    return head + "\n" + "".join(f"{a * 1e6:.6f},{b * 1e9:.5f}\n" for a, b in zip(z, force, strict=True))


def values(text: str) -> dict[str, float]:
    """Return the results of an answer in JSON, by name."""
    return {result["name"]: result["value"] for result in json.loads(text)["results"]}


@pytest.fixture
def curve() -> str:
    """Write a noisy curve by JKR, with adhesion hysteresis, to curve.csv; return its text."""
    z, force = jkr_curve(count=250)
    text = table(z, force + autoregression(1, len(z), 3e-9, 0.0))
    Path("curve.csv").write_text(text, encoding="utf-8")
    return text


def check(found: dict[str, float]) -> None:
    """Check the results for the curve of the fixture."""
    assert found["work_of_adhesion_opening"] == approx(0.06, rel=5e-3)
    assert found["work_of_adhesion_closing"] == approx(0.047, rel=1e-2)
    assert found["contact_modulus"] == approx(1.75e6, rel=2e-2)


def test_a_curve_is_read_from_every_format_of_file(run: Run, curve: str) -> None:
    check(values(run(f"fit curve.csv {KNOWN} --json").out))
    Path("curve.csv.gz").write_bytes(gzip.compress(curve.encode()))
    check(values(run(f"fit curve.csv.gz {KNOWN} --json").out))
    Path("curve.txt").write_text(curve.replace(",", "\t"), encoding="utf-8")
    check(values(run(f"fit curve.txt {KNOWN} --json").out))
    rows = [*csv.reader(io.StringIO(curve))]
    Path("curve.tsv").write_text(
        "# instrument\n# gain 3\ntime\tz\tF\ns\tum\tnN\n"
        + "".join(f"{number}\t{z}\t{force}\n" for number, (z, force) in enumerate(rows[1:])),
        encoding="utf-8",
    )
    words = "--column z=lever_travel --column F=lever_force"
    check(values(run(f"fit curve.tsv {KNOWN} --json {words}").out))
    lines = [json.dumps({rows[0][0]: float(z), rows[0][1]: float(force)}) for z, force in rows[1:]]
    Path("curve.ndjson").write_text("\n".join(lines) + "\n", encoding="utf-8")
    check(values(run(f"fit curve.ndjson {KNOWN} --json").out))


def test_a_deflection_becomes_a_force(run: Run, curve: str) -> None:
    rows = [line.split(",") for line in curve.splitlines()[1:]]
    text = "travel [um],deflection [nm]\n" + "".join(f"{z},{float(force) / 3.01}\n" for z, force in rows)
    Path("curve.csv").write_text(text, encoding="utf-8")
    check(values(run(f"fit curve.csv {KNOWN} --json").out))


def of_fixed_grips() -> tuple[Any, Any]:
    """Return travel and force for PDMS (2 MPa, 50 mJ/m²) on a lever of 3 N/m, without adhesion hysteresis.

    As with fixed grips, the approach is prescribed, so the travel of the last points in contact is farther out than
    that of the first free points.
    """
    way = numpy.linspace(-6e-7, 6e-7, 500)
    approach, modulus, stiffness = numpy.concatenate([way, way[::-1]]), 2e6 / 0.75, 3.0
    is_free = approach < jkr_state(0.5, 0.05, modulus, 1e-5)[0]  # at pull-off
    is_free[:250] = True
    force = numpy.where(is_free, 0.0, jkr_force(approach, 0.05, modulus, 1e-5, numpy.inf))
    force += numpy.random.default_rng(1).normal(0, 5e-9, len(force))
    return approach + force / stiffness, force


def test_a_deflection_of_the_other_sign_is_reversed(run: Run) -> None:
    z, force = of_fixed_grips()
    for sign in (1, -1):
        text = table(sign * z, -force / 3, "Z piezo [um],Deflection [nm]")
        Path("curve.csv").write_text(text, encoding="utf-8")
        ran = run("fit curve.csv --radius 10um --radius2 plane --spring 3N/m --json")
        assert values(ran.out)["work_of_adhesion_opening"] == approx(0.05, rel=2e-3)
        assert values(ran.out)["contact_modulus"] == approx(2e6 / 0.75, rel=5e-3)
        assert json.loads(ran.out)["notes"][0]["text"] == (
            "the force falls on the way into the contact: its sign is reversed, so a pull is negative"
        )


SWAPPED = "are columns or units swapped"


@pytest.mark.parametrize(
    ("head", "factors", "said"),
    [
        (
            "z [nm],F [nN]",  # z is an approach
            (1.0, 1.0),
            (
                f"which no solid has: {SWAPPED}, is the spring wrong or is the travel an approach (--column "
                "'HEADER=approach_at_load [UNIT]')? read: lever_travel [nm] from z [nm], lever_force [nN] from F [nN]"
            ),
        ),
        (
            "approach [um],F [nN]",
            (1.0, 1.0),
            (
                f"jkroll: the fit gives a/R = 11, which no sphere has: {SWAPPED}? read: approach_at_load [um] from "
                "approach [um], lever_force [nN] from F [nN]"
            ),
        ),
        ("approach [nm],F [nN]", (1e3, 1e-3), "jkroll: the fit gives E* = 84.4 mPa, which no solid has: "),
        ("approach [nm],F [nN]", (1.0, 1e6), "jkroll: the fit gives w = 50 kJ/m², which no solid has: "),
        ("F [nN],approach [nm]", (1.0, 1.0), "Pa, which no solid has: "),
    ],
)
def test_results_that_no_solid_can_have_are_refused(
    run: Run, head: str, factors: tuple[float, float], said: str
) -> None:
    z, force = of_fixed_grips()
    columns = (1e9 * (z - force / 3) * factors[0], 1e9 * force * factors[1])
    text = "".join(f"{a:.6g},{b:.6g}\n" for a, b in zip(*columns, strict=True))
    Path("curve.csv").write_text(f"{head}\n{text}", encoding="utf-8")
    ran = run("fit curve.csv --radius 10um --radius2 plane --spring 3N/m")
    assert (ran.code, ran.out) == (1, "")
    assert said in " ".join(ran.err.split())
    assert SWAPPED in ran.err


@pytest.mark.parametrize(
    ("head", "shown"),
    [
        ("Indentation (nm)", '"Indentation (nm)"'),
        ("indentation [nm]", "indentation [nm]"),
        ("Depth_nm", "Depth_nm"),
        ("Penetration depth (nm)", '"Penetration depth (nm)"'),
        ("Tip-Sample Separation (nm)", '"Tip-Sample Separation (nm)"'),
    ],
)
def test_an_indentation_or_a_separation_is_read_as_an_approach_in_a_curve(run: Run, head: str, shown: str) -> None:
    z, force = jkr_curve(stiffness=numpy.inf, low=-1e-6, count=250)
    force += autoregression(1, len(z), 3e-9, 0.0)
    for sign in (1, -1):
        text = "".join(f"{sign * a * 1e9:.3f},{b * 1e9:.3f}\n" for a, b in zip(z, force, strict=True))
        Path("curve.csv").write_text(f"{head},Force (nN)\n{text}", encoding="utf-8")
        ran = run("fit curve.csv --radius 7.5um --radius2 plane --json")
        check(values(ran.out))
        read = f'read: approach_at_load [nm] from {shown}, lever_force [nN] from "Force (nN)"'
        assert " ".join(ran.err.split()) == read


def test_a_wide_table_fits_80_columns_and_a_hysteresis_within_its_error_is_left_out(run: Run) -> None:
    Path("curve.csv").write_text(table(*of_fixed_grips()), encoding="utf-8")
    lines = run("fit curve.csv --radius 10um --radius2 plane --spring 3N/m", terminal=True).out.splitlines()
    assert lines[1:7] == [
        "quantity            symbol  fit             unit  noise  calibration model",
        "─" * 76,
        "adhesion on opening w_open  50.04 ± 0.65    mJ/m² 0.017  –           0.65",
        "adhesion on closing w_close 49.99 ± 0.65    mJ/m² 0.053  –           0.65",
        "adhesion hysteresis Δw      46 ± 59         µJ/m² 58     –           11",
        "hysteresis over w   Δw/w    0.0009 ± 0.0012       0.0012 –           0.00021",
    ]
    assert lines[-2:] == [
        "then: jkroll yield-force 10um --radius2 plane --work-of-adhesion 50.04±0.65mJ/m2",
        "  --contact-modulus 2.6668±0.0029MPa",
    ]


def test_the_suggested_command_has_a_hysteresis_only_if_its_error_is_small(run: Run) -> None:
    """The error must be less than 45 % of the hysteresis."""
    known = "yield-force 7.5um --radius2 plane --work-of-adhesion 60.0±1.6mJ/m2 --contact-modulus 1.745±0.011MPa"
    for closing, said in ((0.0598, known), (0.0594, f"{known} --adhesion-hysteresis 780±230uJ/m2")):
        z, force = jkr_curve(closing=closing, count=250)
        Path("curve.csv").write_text(table(z, force + autoregression(1, len(z), 1e-8, 0.0)), encoding="utf-8")
        ran = run(f"fit curve.csv {KNOWN} ", terminal=True)
        command = " ".join(ran.out.split()).partition("then: jkroll ")[2]
        assert command == said
        assert run(*command.split()).code == 0


def test_a_curve_in_reverse_order_of_time_has_a_code_and_no_next_command(run: Run, curve: str) -> None:
    head, *rows = curve.splitlines()
    Path("curve.csv").write_text("\n".join([head, *reversed(rows)]), encoding="utf-8")
    out = " ".join(run(f"fit curve.csv {KNOWN}", terminal=True).out.split())
    assert (
        "negative-hysteresis: the loading branch needs more work than the unloading one, which no contact does: the "
        "branches may be exchanged; check the order of the points, or the column of branches"
    ) in out
    assert "then:" not in out
    (row,) = csv.DictReader(io.StringIO(run(f"fit curve.csv {KNOWN} --csv").out))
    assert "negative-hysteresis" in row["codes"].split()


def test_a_column_of_branches_divides_a_curve(run: Run, curve: str) -> None:
    rows = curve.splitlines()
    names = ["approach"] * 250 + ["retract"] * 250
    text = "\n".join([f"{rows[0]},branch", *(f"{row},{name}" for row, name in zip(rows[1:], names, strict=True))])
    Path("curve.csv").write_text(text, encoding="utf-8")
    check(values(run(f"fit curve.csv {KNOWN} --json").out))


def test_a_fit_by_either_law_agrees_with_an_independent_fit(run: Run) -> None:
    """A fit of `jkroll.solve` by scipy gave γ = 27.84 ± 0.11 (JKR) and 26.41 ± 0.11 mJ/m² (Maugis).

    E was 5.95 GPa; the test allows 0.8 % around 5.96 GPa.
    """
    for law, gamma in (("jkr", 27.84e-3), ("maugis", 26.41e-3)):
        found = values(run("fit", str(FORCE_CURVE), *"--radius 1um --radius2 plane --json --model".split(), law).out)
        assert found["work_of_adhesion_opening"] == approx(2 * gamma, rel=0.008)
        assert found["contact_modulus"] == approx(5.96e9 / (1 - 0.09), rel=0.008)


def test_the_output_ends_with_a_command_for_the_next_step_that_works(run: Run, curve: str) -> None:
    assert curve
    out = run(f"fit curve.csv {KNOWN} --young rigid --poisson2 0.5").out
    assert "E2 = 1.31 MPa for the other body" in out
    command = out.splitlines()[-1].partition("then: jkroll ")[2]
    assert "--adhesion-hysteresis 1" in command
    ran = run(*command.split())
    assert ran.code == 0
    assert ran.out.startswith("yield_force ")


def test_a_fit_by_a_law_that_does_not_hold_is_followed_by_a_fit_by_the_better_law(run: Run) -> None:
    """A tip of 100 nm with w = 20 mJ/m² and E* = 50 GPa has a Tabor parameter of 0.06."""
    z = ramp(-4e-9, 4e-9, 200, UNLOADING)
    force = dmt_force(z, 0.02, 50e9, 1e-7, 40.0) + autoregression(1, len(z), 1e-10, 0.0)
    Path("tip.csv").write_text(table(z, force), encoding="utf-8")
    known = "fit tip.csv --radius 100nm --radius2 plane --spring 40N/m"
    lines = run(known, terminal=True).out.splitlines()
    assert " ".join(" ".join(lines[:2]).split()) == (
        "law-off: w by JKR is 36% above w by Maugis, which holds at a Tabor parameter of 0.081: give --model maugis"
    )
    assert lines[-2:] == [
        "then: jkroll fit tip.csv --radius=100nm --radius2=plane --spring=40N/m",
        "  --model=maugis",
    ]
    (row,) = csv.DictReader(io.StringIO(run(f"{known} --csv").out))
    assert "law-off" in row["codes"].split()
    then = " ".join(run(f"{known} --model maugis", terminal=True).out.split()).partition("then: ")[2]
    assert then.startswith("jkroll yield-force 100nm --radius2 plane --work-of-adhesion 22.0±1.4mJ/m2")


def test_a_fit_cites_its_law_and_describes_its_method(run: Run, curve: str) -> None:
    assert curve
    cited = run(f"fit curve.csv {KNOWN} --model dmt --cite").out
    assert "@article{derjaguin-muller-toporov-1975," in cited
    assert "johnson-kendall-roberts" not in cited
    method = " ".join(run("fit curve.csv --radius 7.5um --radius2 plane --spring 3.01±0.1N/m --cite --tex").out.split())
    assert r"the JKR theory for a paraboloid of radius 7.5~${\mu}$m~\cite{johnson-kendall-roberts-1971}" in method
    assert r"stiffness of 3.01~${\pm}$~0.10~N/m" in method
    fitted = jkroll.fit("curve.csv", radius="7.5 um", radius2="plane", spring="3.01±0.1 N/m")
    error = 1e3 * fitted.errors["work_of_adhesion_opening"].total
    assert f"work of adhesion on opening {1e3 * fitted.values['work_of_adhesion_opening']:.1f}" in method
    assert "Residuals were whitened as an autoregression of first order" in method
    assert rf"${{\pm}}$~{error:.1f}~mJ/m$^{{2}}$" in method
    assert run("fit curve.csv curve.csv --cite").code == 2


def test_the_method_of_a_fit_of_few_points_names_white_residuals(run: Run) -> None:
    a = numpy.linspace(3e-4, 1e-4, 15)
    load = 4 / 3 * 2e6 * a**3 / 1e-3 - numpy.sqrt(8 * numpy.pi * 0.045 * 2e6 * a**3)
    Path("radii.csv").write_text(table(a, load, "a [um],load [nN]"), encoding="utf-8")
    method = " ".join(run("fit radii.csv --radius 1mm --radius2 plane --cite --tex").out.split())
    assert "Residuals were taken as white" in method
    assert "whitened" not in method


def test_a_fit_in_python_has_its_points_and_a_picture(curve: str) -> None:
    assert curve
    fitted = jkroll.fit("curve.csv", radius="7.5 um", radius2="plane", spring="3.01 N/m")
    columns = fitted.curve
    assert columns["residual [N]"] == approx(columns["load [N]"] - columns["load_fitted [N]"])
    pytest.importorskip("matplotlib")
    assert len(fitted.plot()) == 3


def test_json_has_the_given_inputs_and_the_range_of_the_fit(run: Run, curve: str) -> None:
    assert curve
    words = "--radius 7.5±0.1um --radius2 plane --spring 3.01±0.1N/m --branch unload --range -100%:30% --json"
    answer = json.loads(run(f"fit curve.csv {words}").out)
    inputs = answer["inputs"]
    assert inputs["reduced_radius_err"] == approx(1e-7)
    assert inputs["lever_stiffness_err"] == approx(0.1)
    assert (inputs["branch"], inputs["baseline"]) == ("unload", "median")
    assert inputs["range"] == {"low": -1.0, "high": 0.3, "unit": "1"}
    low, high = answer["fitted_loads"]["unloading"]
    assert -2.2e-6 < low < -2.0e-6
    assert high == approx(0.3 * (jkr_curve(count=250)[1][250:].max() - 1e-8), rel=0.05)
    assert set(answer["baselines"]) == {"loading", "unloading"}
    assert answer["baselines"]["unloading"]["force"] == approx(1e-8, abs=1e-9)
    unloaded = (9 * numpy.pi * 0.06 / (2 * 1.75e6 * 7.5e-6)) ** (1 / 3)
    assert answer["goodness"]["unloaded_contact_over_radius"] == approx(unloaded, rel=0.01)


def test_only_columns_that_are_used_are_named_as_read(run: Run, curve: str) -> None:
    rows = [line.split(",") for line in curve.splitlines()[1:]]
    text = "travel [um],approach [um],force [nN],segment\n" + "".join(
        f"{z},{float(z) - float(force) / 3.01e3},{force},{'extend' if number < 250 else 'retract'}\n"
        for number, (z, force) in enumerate(rows)
    )
    Path("curve.csv").write_text(text, encoding="utf-8")
    ran = run(f"fit curve.csv {KNOWN} --json")
    check(values(ran.out))
    read = " ".join(ran.err.split())
    assert (
        "read: approach_at_load [um] from approach [um], lever_force [nN] from force [nN]; branches from segment"
        in read
    )
    assert "passed through: travel [um]" in read
    paused = text + "".join(f"{z},0,{force},pause\n" for z, force in rows[245:250])
    Path("curve.csv").write_text(paused, encoding="utf-8")
    assert "pause: 5 points of a pause are left out" in " ".join(
        run(f"fit curve.csv {KNOWN}", terminal=True).out.split()
    )
    stated = run(f"fit curve.csv {KNOWN} --column segment= --json")
    assert "branches from" not in stated.err


def test_a_curve_without_adhesion_has_an_upper_limit_in_each_form(run: Run) -> None:
    z = numpy.linspace(-1e-6, 1e-6, 300)
    force = 4 / 3 * 1e6 * 5e-6**0.5 * numpy.maximum(z, 0) ** 1.5 + numpy.random.default_rng(1).normal(0, 1e-10, 300)
    Path("hertz.csv").write_text(table(z, force, "approach [um],force [nN]"), encoding="utf-8")
    words = "fit hertz.csv --radius 5±0.05um --radius2 plane"
    (row,) = csv.DictReader(io.StringIO(run(f"{words} --csv").out))
    limit = float(row["largest_work_of_adhesion [J/m^2]"])
    assert limit == approx(5 * 1e-10 / (1.5 * numpy.pi * 5e-6), rel=0.2)
    assert row["work_of_adhesion_opening [J/m^2]"] == ""
    assert json.loads(run(f"{words} --json").out)["largest_work_of_adhesion"] == approx(limit)
    assert "w is below" in run(words, terminal=True).out


def test_a_sphere_that_is_not_rigid_is_refused(run: Run, curve: str) -> None:
    """A rigid sphere needs E1 ≥ 100 E2, and E2 of the curve is about 1.3 MPa."""
    assert curve
    words = f"fit curve.csv {KNOWN} --profile sphere --poisson2 0.5 --poisson 0.5"
    assert run(f"{words} --young 1GPa").code == 0
    ran = run(f"{words} --young 50MPa")
    assert ran.code == 1
    assert "100 times as stiff as the plane, and E1 is 3" in " ".join(ran.err.split())


def test_an_error_that_was_not_computed_is_a_dash(run: Run, curve: str) -> None:
    assert curve
    out = run(f"fit curve.csv {KNOWN}", terminal=True).out
    row = next(line for line in out.splitlines() if line.startswith("contact modulus"))
    assert row.split()[-2] == "–"
    parts = json.loads(run(f"fit curve.csv {KNOWN} --json").out)["results"][0]["errors"]
    assert parts["calibration"] is None


def test_a_part_of_an_error_that_is_rounding_is_0(run: Run, curve: str) -> None:
    """The contact point does not depend on the radius, except for the limits of the fit."""
    assert curve
    out = run("fit curve.csv --radius 7.5±0.1um --radius2 plane --spring 3.01N/m", terminal=True).out
    row = next(line for line in out.splitlines() if line.startswith("contact point"))
    assert row.split()[-2] == "0"


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ("", "w +2.6%, E* -0.5% by JKR with --profile sphere --poisson2 0.5"),
        ("--poisson2 0.5", "w +2.6%, E* -0.5% by JKR with --profile sphere"),
    ],
)
def test_the_advice_on_a_sphere_has_the_options_that_it_needs(run: Run, curve: str, given: str, said: str) -> None:
    assert curve
    out = " ".join(run(f"fit curve.csv {KNOWN} {given}", terminal=True).out.split())
    assert f"where a sphere is no paraboloid: {said} lever-decides" in out
    assert run(f"fit curve.csv {KNOWN} {given} {said.partition('with ')[2]}").code == 0


@pytest.mark.parametrize("given", ["--radius 7.5um --radius2 plane --poisson2 0.3", "--radius 15um"])
def test_a_sphere_is_not_advised_where_its_profile_is_refused(run: Run, curve: str, given: str) -> None:
    assert curve
    out = " ".join(run(f"fit curve.csv {given} --spring 3.01N/m", terminal=True).out.split())
    assert "w +2.6%, E* -0.5% by JKR for a rigid sphere on a plane that keeps its volume" in out
    assert "--profile" not in out
    assert run(f"fit curve.csv {given} --spring 3.01N/m --profile sphere").code == 2


def test_fit_in_python_takes_files_and_columns(run: Run, curve: str) -> None:
    known = {"radius": "7.5 um", "radius2": "plane", "spring": "3.01 N/m"}
    fitted = jkroll.fit("curve.csv", **known)
    z, force = numpy.loadtxt(io.StringIO(curve), delimiter=",", skiprows=1).T
    other = jkroll.fit({"travel [um]": z, "force [nN]": force}, **known)
    assert other.values == approx(fitted.values)
    check(fitted.values)
    at_prompt = values(run(f"fit curve.csv {KNOWN} --json").out)
    assert at_prompt == approx(fitted.values)
    index = fitted.names.index("contact_modulus")
    assert fitted.covariance[index, index] ** 0.5 == approx(fitted.errors["contact_modulus"].statistical)


def test_each_of_many_files_gets_a_row(run: Run) -> None:
    for seed in range(3):
        z, force = jkr_curve(count=150, opening=0.06 + 0.002 * seed, branches=(UNLOADING,))
        Path(f"{seed}.csv").write_text(table(z, force + autoregression(seed, 150, 3e-9, 0.0)), encoding="utf-8")
    Path("bad.csv").write_text("travel [um],force [nN]\n1,2\n", encoding="utf-8")
    ran = run(f"fit *.csv {KNOWN} --csv")
    rows = [*csv.DictReader(io.StringIO(ran.out))]
    assert ran.code == 1
    assert [row["file"] for row in rows] == ["0.csv", "1.csv", "2.csv", "bad.csv"]
    opening = [float(row["work_of_adhesion_opening [J/m^2]"]) for row in rows[:3]]
    assert opening == approx([0.06, 0.062, 0.064], rel=5e-3)
    assert rows[3]["status"] == "too few points"
    assert "work_of_adhesion_opening: 3 of 4 files; median 62" in ran.err
    assert run(f"fit *.csv {KNOWN} --csv --jobs 2").out == ran.out


def test_a_curve_is_written_point_by_point(run: Run, curve: str) -> None:
    assert curve
    rows = [*csv.DictReader(io.StringIO(run(f"fit curve.csv {KNOWN} --curve --csv").out))]
    residuals = numpy.array([float(row["residual [N]"]) for row in rows])
    assert residuals.std() == approx(3e-9, rel=0.15)
    rates = [float(row["energy_release_rate [J/m^2]"]) for row in rows if row["branch"] == "unloading"]
    assert numpy.median(rates) == approx(0.06, rel=5e-3)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("", "give the lever's stiffness with --spring, as in 3.01N/m"),
        ("--spring 0N/m", "must be positive"),
        ("--spring 3N/m --branch up", "is not one of: both, load and unload"),
        ("--spring 3N/m --profile cone", "is not one of paraboloid, sphere"),
        ("--spring 3N/m --radius 1um --profile sphere", "0.45 or more, as in --poisson2 0.5"),
        ("--spring 3N/m --profile sphere --poisson2 0.5", "needs --radius"),
        ("--spring 3N/m --profile sphere --poisson2 0.5 --radius 1um", "give --radius2 plane"),
        ("--spring 3N/m --range 30%", "is not of the form FROM:TO"),
        ("--spring 3N/m --range 30%:1nN", "write two of the same"),
        ("--spring 3N/m --range 30%:10%", "does not rise"),
        ("--spring 3N/m --model hertz", "hertz"),
        ("--spring 3N/m --model maugis", "needs --radius"),
        ("--spring 3N/m --radius2 plane", "--radius2 needs --radius"),
    ],
)
def test_wrong_options_of_fit_are_refused_with_a_reason(run: Run, curve: str, words: str, said: str) -> None:
    assert curve
    ran = run(f"fit curve.csv {words}")
    assert ran.code == 2
    assert said in " ".join(ran.err.split())


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("t,q\n1,2\n3,4\n", "no column has the contact radius, approach or travel"),
        ("travel [um],signal [V]\n1,2\n3,4\n", "force of the curve; 'signal [V]' is in volts: multiply its numbers by"),
        ("travel [um],Defl (mV)\n1,2\n3,4\n", "force of the curve; 'Defl (mV)' is in volts: multiply its numbers by"),
        ("travel [um],force [nN],branch\n1,2,up\n3,4,down\n", "branch: 'up' is not one of: loading and unloading"),
        (
            "travel [um],force [nN],Direction\n1,2,1\n3,4,0\n",
            (
                "branch: '1' is not one of: loading and unloading, approach and retract, pause; write these words, or "
                "--column 'Direction=' to divide the curve where it turns"
            ),
        ),
        (
            "distance (nm),force (nN)\n1,2\n3,4\n",
            (
                "header: no column has the contact radius, approach or travel of the curve; write "
                "--column 'distance (nm)=approach_at_load [nm]' or --column 'distance (nm)=lever_travel [nm]'"
            ),
        ),
        ("Ramp_nm,F_nN\n1,2\n", "of the curve; write --column 'Ramp_nm=approach_at_load [nm]' or"),
        ("z [um],vertical (nm)\n1,2\n", "force of the curve; write --column 'vertical (nm)=lever_deflection [nm]'"),
        (
            "t,q\n1,2\n3,4\n",
            "of the curve (the table has t, q); write --column 'HEADER=approach_at_load [UNIT]' or",
        ),
        ("a (um),X (mN)\n1,2\n", "force of the curve; write --column 'X (mN)=load [mN]'"),
        ("-7.68e-07,2.98e-07\n-7.6e-07,2.9e-07\n", "the header is missing: '-7.68e-07' is a number; begin with a line"),
        ("", "no header"),
        ("travel (um);force (nN)\n1,0;2,0\n3,0;4,0\n", "write --delimiter semicolon"),
    ],
)
def test_a_table_without_a_curve_is_refused_with_a_reason(run: Run, text: str, said: str) -> None:
    Path("curve.csv").write_text(text, encoding="utf-8")
    ran = run(f"fit curve.csv {KNOWN}")
    assert ran.code == 2
    assert said in " ".join(ran.err.split())


COMMA = "has a comma: write a decimal point, and no thousands separators; expected a value in N"
NO_UNIT = "is not a number and a unit; expected a value in N"
VOLTS = "is in volts: multiply its numbers by the sensitivity (nm/V), and write the new unit into the header"


@pytest.mark.parametrize(
    ("head", "row", "said"),
    [
        ("z [um],F [nN]", '2,"-1,144.4"', f"line 4: lever_force: '-1,144.4' {COMMA}"),
        ("z [um],F [nN]", "2,-1,144.4", "line 4: '2,-1,144.4' has 3 cells, and the header 2"),
        ("z [um]\tF [nN]", "2\t-1,144.4", f"line 4: lever_force: '-1,144.4' {COMMA}"),
        ("z [um]\tF [nN]", "2\t-1 144.4", f"line 4: lever_force: '-1 144.4' {NO_UNIT}"),
        ("z [um]\tF [nN]", "2\t-1'144.4", f"line 4: lever_force: '-1'144.4' {NO_UNIT}"),
        ("z [um],F [nN]", "2,-1144.4*", f"line 4: lever_force: '-1144.4*' {NO_UNIT}"),
        ("z [um],F [nN],F_err", "2,-1144.4*,", f"line 4: lever_force: '-1144.4*' {NO_UNIT}"),
        ("z [um],F [nN]", "2.0.1,-1144.4", "line 4: lever_travel: '2.0.1' "),
        ("z [um],deflection", "2,0.036 V", f"line 4: lever_deflection: '0.036 V' {VOLTS}"),
        ("z [um],deflection", "2,36mV", f"line 4: lever_deflection: '36mV' {VOLTS}"),
    ],
)
def test_a_filled_cell_that_is_no_number_is_refused_with_its_line(run: Run, head: str, row: str, said: str) -> None:
    mark, path = ("\t", "curve.tsv") if "\t" in head else (",", "curve.csv")
    cells = ("1", "1.5" if "[nN]" in head else "1.5 nm", "0.1")[: head.count(mark) + 1]
    Path(path).write_text("\n".join([head, *[mark.join(cells)] * 2, row, row, ""]), encoding="utf-8")
    ran = run(f"fit {path} {KNOWN}")
    assert (ran.code, ran.out) == (1, "")
    assert said in " ".join(ran.err.split())


def test_marks_for_missing_values_and_comments_between_rows_are_gaps(run: Run, curve: str) -> None:
    lines = curve.splitlines()
    lines[20:20] = ["-2.4,", "-2.4,nan", "-,-2.4", "-2.4,NA", "# segment: approach", "# z, F"]
    Path("curve.csv").write_text("\n".join(lines), encoding="utf-8")
    ran = run(f"fit curve.csv {KNOWN} --json")
    check(values(ran.out))
    (note,) = (note["text"] for note in json.loads(ran.out)["notes"] if note["code"] == "gaps")
    assert note == "6 of 506 points have no number and are left out"


def test_rows_without_numbers_need_no_branch_and_no_time(run: Run, curve: str) -> None:
    head, *rows = curve.splitlines()
    lines = [f"{row},{'extend' if number < 250 else 'retract'},{number}" for number, row in enumerate(rows)]
    lines[250:250] = ["# segment: retract", ",,,"]
    del lines[300:330]
    Path("curve.csv").write_text("\n".join([f"{head},segment,time [s]", *lines]), encoding="utf-8")
    ran = run(f"fit curve.csv {KNOWN} --json")
    check(values(ran.out))
    notes = {note["code"]: note["text"] for note in json.loads(ran.out)["notes"]}
    assert notes["gaps"] == "2 of 472 points have no number and are left out"
    assert notes["time-gaps"].startswith("unloading: the time has 1 gap of 31 usual steps")


def test_a_text_that_is_no_number_in_a_python_table_is_refused_with_its_row() -> None:
    columns = {"z [um]": [1.0, 2.0, 3.0], "F [nN]": ["1.0", "-2.0", "-1'144.4"]}
    with pytest.raises(jkroll.JkrollError, match=r"^row 2, counted from 0: lever_force: '-1'144\.4' is not a number"):
        jkroll.fit(columns, radius="7.5 um", radius2="plane", spring="3.01 N/m")


@pytest.mark.parametrize(
    ("head", "cell", "said"),
    [
        ("radius (um)", "5", "column 'radius (um)': it is 5 µm there, and --radius gives 7.5 µm; correct one, or"),
        ("R_tip [nm]", "7600", "column 'R_tip [nm]': it is 7.6 µm there, and --radius gives 7.5 µm; correct one, or"),
        ("diameter (um)", "7.5", "column 'diameter (um)': it is 7.5 µm there, and --radius gives 7.5 µm; correct one"),
        ("k (N/m)", "2", "column 'k (N/m)': it is 2 N/m there, and --spring gives 3.01 N/m; correct one, or --column"),
        ("radius (um)", "7.52", ""),
        ("diameter (um)", "15", ""),
        ("k (N/m)", "3.01", ""),
        ("radius2 (um)", "5", ""),
        ("k", "2", ""),
    ],
)
def test_a_column_that_contradicts_an_option_is_refused(run: Run, curve: str, head: str, cell: str, said: str) -> None:
    first, *rows = curve.splitlines()
    Path("curve.csv").write_text("\n".join([f"{first},{head}", *(f"{row},{cell}" for row in rows)]), encoding="utf-8")
    ran = run(f"fit curve.csv --radius 7.5um --spring 3.01N/m {'--radius2 plane' * ('2' not in head)} --json")
    assert ran.code == (2 if said else 0)
    assert said in " ".join(ran.err.split())


@pytest.mark.parametrize(("unit", "said"), [("pN", "is 3.01 mN/m in the columns"), ("nN", "")])
def test_a_force_that_is_not_the_deflection_times_the_spring_has_a_code(run: Run, unit: str, said: str) -> None:
    z, force = jkr_curve(count=250)
    rows = "".join(f"{a * 1e6:.6f},{b * 1e9 / 3.01 - 20:.5f},{b * 1e9:.5f}\n" for a, b in zip(z, force, strict=True))
    Path("curve.csv").write_text(f"z (um),Defl (nm),Force ({unit})\n{rows}", encoding="utf-8")
    ran = run(f"fit curve.csv {KNOWN} --json")
    answer = json.loads(ran.out)
    notes = [note["text"] for note in answer["notes"] if note["code"] == "spring-differs"]
    assert [said in note for note in notes] == [True] * bool(said)
    assert bool(answer["next"]) == (not said)
    assert 'passed through: "Defl (nm)"' in " ".join(ran.err.split())


def test_words_for_a_load_in_other_languages_are_read(run: Run) -> None:
    for word in ("Last", "Charge", "Auflast"):
        Path("curve.csv").write_text(f"a (um),{word} (mN)\n1,2\n", encoding="utf-8")
        assert "and the curve has 1" in run(f"fit curve.csv {KNOWN}").err


def broken(text: str, seed: int) -> bytes:
    """Return a table with a fault that depends on the seed."""
    rng = numpy.random.default_rng(seed)
    lines = text.splitlines()
    kind = seed % 10
    if kind == 0:
        return text.encode()[: int(rng.integers(0, len(text)))]
    if kind == 1:
        lines[1:] = rng.permutation(lines[1:])
    elif kind == 2:
        lines = [line.replace(",", ";", 1) if rng.random() < 0.3 else line for line in lines]
    elif kind == 3:
        lines = [line if rng.random() < 0.7 else "nan,inf" for line in lines]
    elif kind == 4:
        lines = lines[: int(rng.integers(1, 12))]
    elif kind == 5:
        data = bytearray(text.encode())
        for index in rng.integers(0, len(data), 30):
            data[index] = int(rng.integers(0, 256))
        return bytes(data)
    elif kind == 6:
        lines = [lines[0], *(f"{line.split(',')[0]},{10 ** rng.uniform(-300, 300):g}" for line in lines[1:])]
    elif kind == 7:
        lines = [lines[0], *(f"{rng.normal()},{rng.normal()}" for _ in range(int(rng.integers(5, 300))))]
    elif kind == 8:
        lines = [lines[0], *(f"{number},{number * rng.integers(-1, 2)}" for number in range(100))]
    else:
        part = slice(int(rng.integers(1, 200)), int(rng.integers(200, len(lines))))
        lines = [lines[0], *lines[part]]
    return "\n".join(lines).encode()


@pytest.mark.parametrize(("first", "last"), [(0, 5), (85, 86), pytest.param(5, 200, marks=pytest.mark.slow)])
def test_a_broken_file_is_fitted_or_refused_with_a_message(run: Run, curve: str, first: int, last: int) -> None:
    for seed in range(first, last):
        Path("broken.csv").write_bytes(broken(curve, seed))
        ran = run(f"fit broken.csv {KNOWN}")
        assert "bug" not in ran.err, seed
        assert ran.code == 0 or ran.err, seed


def test_the_suggested_command_has_the_law_and_the_output_names_two_spheres(run: Run, curve: str) -> None:
    assert curve
    by_maugis = run(f"fit curve.csv {KNOWN} --branch unload --model maugis --z0 3angstrom", terminal=True).out
    assert "--model maugis --z0 3angstrom" in " ".join(by_maugis.split()).partition("then: ")[2]
    of_two = " ".join(run("fit curve.csv --radius 15um --spring 3.01N/m --branch unload", terminal=True).out.split())
    assert "R = 7.5 µm of two equal spheres (--radius2 plane for a flat)" in of_two


@pytest.mark.parametrize(
    ("columns", "given", "said"),
    [
        ({}, {}, "header: no column has the contact radius, approach or travel of the curve"),
        ([1, 2], {}, "list is not a table; give a DataFrame"),
        ({"z [m]": [1]}, {"radius": [1e-6, 2e-6]}, "radius: a curve takes a single value, not an array"),
        ({"z [m]": [1]}, {"load": 1.0}, "fit takes no 'load'"),
        ({"z [m]": [1]}, {"reduced_radius": 0.0}, "reduced_radius"),
    ],
)
def test_wrong_arguments_of_fit_in_python_are_refused_with_a_reason(
    columns: Any, given: dict[str, Any], said: str
) -> None:
    with pytest.raises(jkroll.JkrollError, match=said):
        jkroll.fit(columns, **given)


# --- Output and arguments ---------------------------------------------------------------------------------------------


def test_the_command_line_on_a_picture_has_an_option_that_repeats_once_for_each_value() -> None:
    options = {"radius": "7.5um", "columns": ("z=lever_travel [um]", "F=load [nN]"), "curve": True, "target": "fit.pdf"}
    assert Call(COMMANDS["fit"], ["curve.csv"], options).line == (
        "jkroll fit curve.csv --radius=7.5um '--column=z=lever_travel [um]' '--column=F=load [nN]' --curve"
    )


def test_a_meaning_in_nanometres_for_a_header_in_volts_is_refused(run: Run) -> None:
    Path("curve.csv").write_text("travel [um],Deflection (V)\n1,2\n3,4\n", encoding="utf-8")
    ran = run("fit", "curve.csv", *KNOWN.split(), "--column", "Deflection (V)=lever_deflection [nm]")
    assert ran.code == 2
    assert "'Deflection (V)' is in volts: multiply its numbers by the sensitivity (nm/V)" in " ".join(ran.err.split())


@pytest.mark.parametrize("end", ["xls", "csv.gz", "parquet"])
def test_a_file_that_cannot_hold_a_fit_is_refused(run: Run, curve: str, end: str) -> None:
    assert curve
    ran = run(f"fit curve.csv {KNOWN} -o fit.{end}")
    assert ran.code == 2
    assert f"is not written as {end.rpartition('.')[2]}; name the file 'fit.csv'" in ran.err
    assert not Path(f"fit.{end}").exists()


def test_a_fit_in_a_file_of_rows_has_a_row(run: Run, curve: str) -> None:
    assert curve
    for end, separator in (("csv", ","), ("tsv", "\t")):
        assert run(f"fit curve.csv {KNOWN} -o fit.{end}").code == 0
        head, row = csv.reader(Path(f"fit.{end}").read_text(encoding="utf-8").splitlines(), delimiter=separator)
        assert float(row[head.index("work_of_adhesion_opening [J/m^2]")]) == approx(0.06, rel=5e-3)


def test_results_that_are_too_uncertain_for_the_next_command_are_named(run: Run) -> None:
    z, force = soft_lever_curve()
    Path("curve.csv").write_text(table(z, force + autoregression(1, len(z), 1.5e-9, 0.0)), encoding="utf-8")
    known = "fit curve.csv --radius 5um --radius2 plane --spring"
    out = " ".join(run(f"{known} 0.6±0.06N/m", terminal=True).out.split())
    assert out.endswith("no command follows: an error above 45% (E* and Δw)")
    assert " -0 ± " not in out


def test_fit_in_python_takes_the_names_of_options_and_names_arguments_in_errors(curve: str) -> None:
    assert curve
    known: dict[str, Any] = {"radius": "7.5 um", "radius2": "plane", "spring": "3.01 N/m"}
    fitted = jkroll.fit("curve.csv", young="rigid", poisson2=0.5, **known)
    assert fitted.other_modulus == ("youngs_modulus2", approx(0.75 * fitted.values["contact_modulus"]))
    with pytest.raises(jkroll.JkrollError, match=r"give the lever's stiffness with spring, as in 3\.01N/m"):
        jkroll.fit("curve.csv", radius="7.5 um")
    with pytest.warns(UserWarning, match="radius=10 is a sphere of 10 m") as warned:
        jkroll.fit("curve.csv", radius=10, radius2="plane", spring=3.01)
    assert [warning.filename for warning in warned] == [__file__]


@pytest.mark.usefixtures("curve")
@pytest.mark.parametrize("target", ["", " -o curve.json"])
def test_the_look_of_a_picture_is_refused_without_a_picture(run: Run, target: str) -> None:
    ran = run(f"fit curve.csv {KNOWN} --style dark --width 85mm{target}")
    assert ran == (2, "", "jkroll: --width and --style apply to files; add -o FILE\n")
