"""`jkroll.answer` with lists: a table of answers, and pictures of answers."""

import csv
import io
import math
import pickle
from typing import Any

import numpy
import pytest

import jkroll
from harness import Run
from jkroll.text import spelled
from relative import approx

SOLIDS, RADII = ["quartz", "iron"], ["100 nm", "1 um"]


def test_lists_give_an_answer_for_each_combination() -> None:
    answers = jkroll.answer("pull-off", material=SOLIDS, radius=RADII)
    assert len(answers) == 4
    singles = [jkroll.answer("pull-off", material=solid, radius=radius) for solid in SOLIDS for radius in RADII]
    assert [answer.as_dict() for answer in answers] == [answer.as_dict() for answer in singles]
    assert answers["P_c"].tolist() == [float(answer["P_c"]) for answer in singles]
    assert (str(answers[-1]), repr(answers)) == (str(singles[-1]), "<Answers: P_c of 4 scenes>")
    with pytest.raises(IndexError, match="4 answers"):
        answers[4]
    with pytest.raises(jkroll.JkrollError, match="'a0' is not in these answers, which have pull_off_force"):
        answers["a0"]


def test_columns_are_those_of_csv(run: Run) -> None:
    words = "contact quartz,iron 100nm,1um --radius2 plane --load -20nN --model jkr,maugis --csv --best"
    answers = jkroll.answer(
        "contact", material=SOLIDS, radius=RADII, radius2="plane", load="-20nN", model=["jkr", "maugis"]
    )
    heads, *rows = csv.reader(io.StringIO(run(*words.split()).out))
    columns = answers.to_dict()
    assert [*columns] == heads
    for head, texts in zip(heads, zip(*rows, strict=True), strict=True):
        assert [as_csv(head, cell) for cell in columns[head]] == [*texts], head


def as_csv(head: str, cell: Any) -> str:
    """Return a cell as CSV writes it."""
    if cell is None or (isinstance(cell, float) and math.isnan(cell)):
        return ""
    if head == "radius2 [m]":
        return "plane"
    return spelled(cell) if isinstance(cell, float) else str(cell)


def test_a_list_of_one_material_gives_a_list_of_one_answer() -> None:
    answers = jkroll.answer("pull-off", material=["quartz"], radius="100 nm")
    assert [*answers[0]] == [*jkroll.answer("pull-off", material="quartz", radius="100 nm")]
    assert len(answers) == 1


def test_answer_takes_arrays_and_materials_made_by_hand() -> None:
    solid = jkroll.known_materials()["quartz"]._replace(name="mine", properties={"surface_energy": 0.05})
    answers = jkroll.answer(
        "P_c", material=[solid, "iron"], material2=["quartz"], radius=numpy.geomspace(1e-8, 1e-6, 3)
    )
    forces = jkroll.solve(
        "P_c", material=[[solid], ["iron"]], material2="quartz", radius=numpy.geomspace(1e-8, 1e-6, 3)
    )
    assert answers["P_c"].tolist() == forces.reshape(-1).tolist()


def test_values_of_many_scenes_equal_those_of_single_answers() -> None:
    """So many scenes are computed as arrays, but a single answer is not."""
    many = jkroll.answer("P_c", material=SOLIDS, radius=numpy.geomspace(1e-8, 1e-6, 400))
    assert many["P_c"][::50].tolist() == [float(many[position]["P_c"]) for position in range(0, 800, 50)]


def test_a_data_frame_has_a_row_for_each_answer() -> None:
    pandas = pytest.importorskip("pandas")
    frame = jkroll.answer("pull-off", material=SOLIDS, radius=RADII).to_pandas()
    assert frame["material"].tolist() == ["quartz", "quartz", "iron", "iron"]
    assert pandas.api.types.is_float_dtype(frame["pull_off_force_best_low [N]"])
    again = jkroll.table(frame[["material", "radius [m]", "radius2 [m]", "surface_energy [J/m^2]"]], "P_c")
    assert again["pull_off_force [N]"].tolist() == frame["pull_off_force [N]"].tolist()


def test_columns_of_a_data_frame_are_not_combined() -> None:
    pandas = pytest.importorskip("pandas")
    data = pandas.DataFrame({"material": SOLIDS, "radius": [1e-7, 1e-6]})
    with pytest.raises(jkroll.JkrollError, match="material and radius are columns, whose rows belong"):
        jkroll.answer("pull-off", **data)
    assert len(jkroll.answer("pull-off", material=SOLIDS, radius=data["radius"])) == 4


def test_one_contact_beyond_pull_off_among_others_has_a_gap_and_a_reason() -> None:
    answers = jkroll.answer("contact", material=SOLIDS, radius="100 nm", load="-100 nN")
    assert numpy.isnan(answers["a"]).tolist() == [True, False]
    assert answers.to_dict()["status"] == ["beyond pull-off", None]
    assert "breaks this contact" in answers[0]["a"].reason


@pytest.mark.parametrize(
    ("scene", "words"),
    [
        ({"material": SOLIDS}, "needs radius"),
        ({"material": SOLIDS, "radius": []}, "is an empty list"),
        ({"material": [], "radius": 1e-7}, "is an empty list"),
        ({"material": ["quarz", "iron"], "radius": 1e-7}, "no material 'quarz'"),
        ({"material": SOLIDS, "radius": [1e-7, -1e-7]}, "must be positive"),
        ({"material": SOLIDS, "radius": 1e-7, "model": ["jkr", "jkr"]}, "are one law"),
        ({"material": SOLIDS, "radius": [[1e-7], [1e-6]]}, "is a list of lists"),
        ({"material": SOLIDS, "radius": numpy.ones((2, 2))}, "more than one dimension"),
        ({"gamma": 0.025, "radius": numpy.ones(20000) * 1e-7}, "20000 scenes are more than 10000"),
        ({"gamma": 0.025, "radius": [1e-7], "surface_energy": [1.0]}, "name one quantity; give one of them"),
    ],
)
def test_invalid_scenes_are_refused(scene: dict[str, Any], words: str) -> None:
    with pytest.raises(jkroll.JkrollError, match=words):
        jkroll.answer("pull-off", **scene)


@pytest.mark.parametrize("radii", [[100, 50], ["100 nm", 100]])
def test_a_radius_of_100_m_in_a_list_gives_a_warning(radii: list[Any]) -> None:
    with pytest.warns(UserWarning, match="100 is a sphere of 100 m") as warned:
        jkroll.answer("P_c", gamma=0.025, radius=radii)
    assert [warning.filename for warning in warned] == [__file__]


def test_answers_can_be_pickled() -> None:
    answers = jkroll.answer("pull-off", material=SOLIDS, radius=RADII)
    assert str(pickle.loads(pickle.dumps(answers))) == str(answers)


# --- Pictures ---------------------------------------------------------------------------------------------------------


def same_lines(drawn: Any, other: Any) -> bool:
    """Return whether two pictures have the same lines."""
    return [*drawn.lines] == [*other.lines] and all(
        numpy.array_equal(line, other.lines[label], equal_nan=True) for label, line in drawn.lines.items()
    )


def test_an_answer_is_drawn_as_the_force_curve_of_its_contact() -> None:
    scene: dict[str, Any] = {"material": "quartz", "radius": "100 nm", "model": "maugis"}
    drawn, curve = jkroll.answer("contact", **scene, load="5nN").drawn, jkroll.curve(**scene)
    assert same_lines(drawn, curve)
    state = jkroll.solve("approach_at_load", **scene, load=5e-9)
    assert drawn.points == {**curve.points, "P = 5 nN": (state, 5e-9)}
    assert jkroll.answer("pull-off", **scene).drawn.points == curve.points


def test_answers_by_several_laws_are_drawn_as_force_curves() -> None:
    laws = ["jkr", "dmt"]
    drawn = jkroll.answer("pull-off", material="quartz", radius=1e-7, model=laws).drawn
    assert same_lines(drawn, jkroll.curve(material="quartz", radius=1e-7, model=laws))


def test_answers_are_drawn_over_an_input_with_several_values() -> None:
    drawn = jkroll.answer("pull-off", material="quartz", radius=["1 um", "10 nm", "100 nm"]).drawn
    (line,) = jkroll.map("P_c", material="quartz", x="radius=10nm:1um").lines.values()
    assert numpy.array_equal(drawn.lines["quartz"], line)
    both = jkroll.answer("r-min", radius=["1 um", "10 nm", "100 nm"], xi=["1 angstrom", "2 angstrom"]).drawn
    assert [*both.lines] == ["ξ = 100 pm", "ξ = 200 pm"]
    x, y = both.lines["ξ = 200 pm"]
    assert y.tolist() == approx((x**2 / 2e-10).tolist())  # R_min = R1·R2/ξ
    assert [*jkroll.answer("P_c", material=SOLIDS, radius=["1 um", "10 nm"]).drawn.lines] == SOLIDS


def test_plot_draws_on_given_axes_and_returns_them() -> None:
    pytest.importorskip("matplotlib")
    from matplotlib.figure import Figure

    axes = Figure().subplots(1, 2)
    answers = jkroll.answer("pull-off", material="quartz", radius=["1 um", "10 nm"])
    assert answers.plot(axes[0]) is axes[0]
    assert answers[0].plot(ax=axes[1], style="dark") is axes[1]
    assert answers.plot().get_xlabel() == axes[0].get_xlabel() != ""
    assert len(axes[1].lines) > 1


def test_an_error_says_why_answers_cannot_be_drawn() -> None:
    with pytest.raises(jkroll.JkrollError, match="no input has several values to draw over: give several values"):
        _ = jkroll.answer("pull-off", material=SOLIDS, radius="100 nm").drawn
    many = jkroll.answer("P_c", radius=numpy.geomspace(1e-8, 1e-6, 31), gamma=numpy.geomspace(0.01, 0.1, 30))
    with pytest.raises(jkroll.JkrollError, match="30 lines are more than the 24"):
        _ = many.drawn
    with pytest.raises(jkroll.JkrollError, match="needs Young's modulus"):
        jkroll.answer("pull-off", gamma=0.025, radius="100 nm").plot()
