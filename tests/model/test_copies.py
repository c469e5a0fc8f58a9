"""Public names, answers and errors survive copying and a round trip to another process."""

import copy
import math
import multiprocessing
import pickle
import subprocess
import sys
from collections.abc import Iterator
from typing import Any

import pytest

import jkroll
from jkroll.errors import BadRow, BadTable, JkrollError, MissingExtra, NoResult
from jkroll.fitting.branches import BadCurve
from jkroll.model import unknowns
from jkroll.model.reasons import BEYOND_PULL_OFF, NoErrorBar
from jkroll.quantities.numeric import NoValue
from jkroll.tables.workers import LostWorker
from relative import approx


def copies(original: Any) -> Iterator[Any]:
    """Iterate over copies of an object."""
    yield pickle.loads(pickle.dumps(original))
    yield copy.deepcopy(original)
    yield copy.copy(original)


PUBLIC = {name: getattr(jkroll, name) for name in dir(jkroll) if name != "formulas"}


@pytest.mark.parametrize("name", [*PUBLIC, *dir(jkroll.formulas)])
def test_public_name_is_copied(name: str) -> None:
    original = PUBLIC.get(name) or getattr(jkroll.formulas, name)
    for again in copies(original):
        assert type(again) is type(original)
        if callable(original):
            assert again is original


def test_nomenclature_can_be_pickled_right_after_the_import() -> None:
    code = "import jkroll, pickle; print(pickle.loads(pickle.dumps(jkroll.NOMENCLATURE))['radius'].symbol)"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout == "R1\n"


# --- Answers ----------------------------------------------------------------------------------------------------------


OWN = jkroll.known_materials()["quartz"]._replace(name="mine", properties={"surface_energy": 0.03}, uncertainties={})
ANSWERS: dict[str, dict[str, Any]] = {
    "report": {"material": "quartz", "radius": 1e-7},
    "pull-off": {"material": "ice-warm", "material2": "quartz", "radius": "100±5 nm", "load": "1 nN"},
    "yield-force": {"material": "silica-humid", "radius": 5e-7},
    "contact": {"material": "quartz", "radius": "80 to 120 nm", "model": "maugis"},
    "P_c,n_roll": {"material": OWN, "radius": 1e-7},
}


@pytest.mark.parametrize("asked", ANSWERS)
def test_answer_is_copied(asked: str) -> None:
    """An answer is copied before and after it is shown, since showing it computes its texts."""
    answered = jkroll.answer(asked, **ANSWERS[asked])
    before = [pickle.loads(pickle.dumps(answered)), copy.deepcopy(answered)]
    print(answered, repr(answered), answered.doubts, answered.best)
    for again in (*before, pickle.loads(pickle.dumps(answered)), copy.deepcopy(answered)):
        assert str(again) == str(answered)
        assert again.as_dict() == answered.as_dict()
        assert again.inputs == answered.inputs


@pytest.mark.parametrize("asked", ANSWERS)
def test_parts_of_an_answer_are_copied(asked: str) -> None:
    answered = jkroll.answer(asked, **ANSWERS[asked])
    for part in (answered.values, answered.inputs, answered.doubts, answered.best, answered.notes):
        assert repr(pickle.loads(pickle.dumps(part))) == repr(copy.deepcopy(part)) == repr(part)


def test_inferred_values_are_copied() -> None:
    found: Any = jkroll.infer(["gamma"], measured={"pull_off_force": "300 nN"}, radius="1 um")
    for again in copies(found):
        assert (again, again.condition) == (found, found.condition)


# --- Errors -----------------------------------------------------------------------------------------------------------


def raised(call: Any, *arguments: Any, **scene: Any) -> Any:
    """Return the error that a call raises."""
    with pytest.raises(JkrollError) as caught:
        call(*arguments, **scene)
    return caught.value


def every_error() -> Iterator[JkrollError]:
    """Iterate over at least one error of each type."""
    solve, scene = jkroll.solve, {"material": "quartz", "radius": 1e-7}
    yield raised(solve, "pull_off_force", gamma=0.1)
    yield raised(solve, "contact_radius_at_pull_off", **scene, model="dmt")
    yield raised(solve, "pull_off_fork", **scene)
    yield raised(solve, "pull_off_force", material="quarz", radius=1e-7)
    yield raised(solve, "pull_off_force", material="ice", radius=1e-7)
    yield raised(solve, "pull_off_force", gamma="25 kg", radius=1e-7)
    yield raised(solve, "pull_off_force", gamma=[0.1, -0.1], radius=1e-7)
    yield raised(solve, "contact_radius_at_load", **scene, load=-1.0)
    yield raised(solve, "pull_off_force", **scene, model="jrk")
    yield raised(jkroll.formulas.load_margin, load=-1.0, pull_off_force=0.5)
    yield raised(jkroll.Materials, "no such file")
    unsolved = raised(jkroll.infer, "xi", measured={"pull_off_force": 1e-9}, **scene)
    yield unsolved
    yield unknowns.Undetermined(unsolved.problem, "any value", (1.0, 2.0))
    yield unknowns.NoSolution(unsolved.problem, [(1.0, 2.0)])
    yield unknowns.SeveralSolutions(unsolved.problem, [{"yield_displacement": size} for size in (1e-10, 2e-10)])
    yield unknowns.Unseparated(unsolved.problem, "they leave it open")
    yield from (
        MissingExtra("this needs pandas"),
        BadTable("two headers"),
        BadRow(3, "bad radius"),
        BadCurve("the curve has 3 points", "too few points"),
        NoErrorBar("pull_off_force", "the load breaks this contact"),
        LostWorker("ended"),
        NoValue("pull_off_force", "needs a radius"),
    )


EVERY_ERROR = [*every_error()]


def kinds_of(kind: type[JkrollError]) -> Iterator[type[JkrollError]]:
    """Iterate over all subclasses of a type of error."""
    for narrower in kind.__subclasses__():
        yield narrower
        yield from kinds_of(narrower)


@pytest.mark.parametrize("error", EVERY_ERROR, ids=lambda error: type(error).__name__)
def test_error_is_copied_with_its_attributes(error: JkrollError) -> None:
    for again in copies(error):
        assert type(again) is type(error)
        assert str(again) == str(error)
        assert vars(again).keys() == vars(error).keys()
        for name in vars(error).keys() - {"problem"}:  # a Problem has no equality
            assert vars(again)[name] == vars(error)[name]


def test_errors_of_all_types_are_copied() -> None:
    families = {NoResult, unknowns.Unsolved}  # base classes: every raised error has a narrower type
    assert {*kinds_of(JkrollError)} - families <= {type(error) for error in EVERY_ERROR}


# --- Another process --------------------------------------------------------------------------------------------------


def test_another_process_computes_and_answers() -> None:
    """A spawned process imports everything again."""
    scene: dict[str, Any] = {"material": "quartz", "radius": 1e-7}
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        formula, given = jkroll.formulas.pull_off_force, {"work_of_adhesion": 0.05, "reduced_radius": 5e-8}
        assert pool.apply(formula, kwds=given) == approx(3 * math.pi / 2 * 0.05 * 5e-8)
        answered = pool.apply(jkroll.answer, ["report"], scene)
        assert answered.as_dict() == jkroll.answer("report", **scene).as_dict()
        assert pool.apply(str, [answered]) == str(answered)
        error = raised(pool.apply, jkroll.solve, ["load_margin"], {**scene, "load": -1.0})
        assert "breaks this contact" in str(error)
        assert error.cause == BEYOND_PULL_OFF


def test_top_level_of_jkroll_has_few_names() -> None:
    assert len(dir(jkroll)) < 25
    assert {"answer", "solve", "table", "fit", "infer", "formulas"} <= {*dir(jkroll)}
    with pytest.raises(AttributeError, match=r"it is jkroll\.formulas\.pull_off_force"):
        jkroll.pull_off_force  # type: ignore[attr-defined]  # noqa: B018
    with pytest.raises(AttributeError, match=r"dir\(jkroll\.formulas\) lists the formulas"):
        jkroll.formulas.pull_of_force  # type: ignore[attr-defined]  # noqa: B018
