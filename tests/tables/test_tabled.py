"""`jkroll.table` returns a table of the type given, with the columns that `batch` adds to a file."""

import csv
import importlib
import os
import subprocess
import sys
from collections.abc import Callable
from math import isnan
from pathlib import Path
from typing import Any

import numpy
import pint
import pytest

import jkroll
from harness import Run
from relative import approx

RADII, GAMMAS, SOLIDS = [100.0, 200.0, 50.0], [25.0, 370.0, 25.0], ["quartz", "iron", "quartz"]
WANTED = ["P_c", "n_grav"]
ADDED = ["pull_off_force [N]", "n_grav", "doubt", "status"]
NUMBERS = {"radius [nm]": RADII, "gamma [mJ/m2]": GAMMAS, "material": SOLIDS}


def bare(name: str) -> str:
    """Return the name in a header, without the unit."""
    return name.partition(" [")[0]


def of_dict() -> Any:
    return {name: numpy.array(column) for name, column in NUMBERS.items()}


def of_pandas() -> Any:
    return pytest.importorskip("pandas").DataFrame(NUMBERS, index=["a", "b", "c"])


def of_polars() -> Any:
    return pytest.importorskip("polars").DataFrame(NUMBERS)


def of_pyarrow() -> Any:
    return importlib.import_module("pyarrow").table(NUMBERS)


def of_astropy() -> Any:
    table = pytest.importorskip("astropy.table").Table({bare(name): column for name, column in NUMBERS.items()})
    table["radius"].unit, table["gamma"].unit = "nm", "mJ/m2"
    return table


def of_astropy_quantities() -> Any:
    return pytest.importorskip("astropy.table").QTable(of_astropy())


def of_xarray() -> Any:
    units = {"radius": {"units": "nm"}, "gamma": {"units": "mJ m-2"}, "material": {}}
    variables = {bare(name): ("grain", column, units[bare(name)]) for name, column in NUMBERS.items()}
    return pytest.importorskip("xarray").Dataset(variables, coords={"grain": ["a", "b", "c"]})


def of_pint() -> Any:
    quantity: Any = pint.application_registry.Quantity
    return {"radius": quantity(RADII, "nm"), "gamma": quantity(GAMMAS, "mJ/m**2"), "material": SOLIDS}


def of_pint_in_pandas() -> Any:
    pandas = pytest.importorskip("pandas")
    pytest.importorskip("pint_pandas")
    columns = {"radius": pandas.Series(RADII, dtype="pint[nm]"), "gamma": pandas.Series(GAMMAS, dtype="pint[mJ/m**2]")}
    return pandas.DataFrame({**columns, "material": SOLIDS})


KINDS = [
    of_dict,
    of_pandas,
    of_polars,
    of_pyarrow,
    of_astropy,
    of_astropy_quantities,
    of_xarray,
    of_pint,
    of_pint_in_pandas,
]


def values(found: Any, head: str) -> list[Any]:
    """Return the cells of a column, by its header or, if the unit is an attribute, its name; None for an empty cell."""
    try:
        column = found[head]
    except KeyError:
        column = found[bare(head)]
        assert str(getattr(column, "unit", None) or column.attrs["units"]) == "N"
    column = column.to_pylist() if hasattr(column, "to_pylist") else getattr(column, "value", column)
    if callable(column):  # a method of a Series
        column = found[head]
    cells = numpy.asarray(column).tolist()
    return [None if cell in ("", None) or (isinstance(cell, float) and isnan(cell)) else cell for cell in cells]


@pytest.mark.parametrize("make", KINDS)
def test_table_adds_the_columns_of_batch(make: Callable[[], Any], run: Run) -> None:
    data = make()
    Path("grains.csv").write_text(
        "\n".join(
            [
                ",".join(NUMBERS),
                *(f"{radius},{gamma},{solid}" for radius, gamma, solid in zip(RADII, GAMMAS, SOLIDS, strict=True)),
            ]
        )
        + "\n"
    )
    assert run("batch", "grains.csv", "--quantities", ",".join(WANTED), "-o", "forces.csv").code == 0
    with Path("forces.csv").open(encoding="utf-8") as file:
        records = [*csv.DictReader(file)]
    found = jkroll.table(data, quantities=WANTED)
    assert type(found) is type(data)
    for head in ADDED[:2]:
        assert values(found, head) == approx([float(record[head]) for record in records], rel=1e-15)
    for head in ADDED[2:]:
        assert values(found, head) == [record[head] or None for record in records]


@pytest.mark.parametrize("make", KINDS)
def test_table_leaves_its_argument_unchanged(make: Callable[[], Any]) -> None:
    data, other = make(), make()
    jkroll.table(data, WANTED)
    names = (getattr(each, "column_names", None) or getattr(each, "columns", each) for each in (data, other))
    assert [*next(names)] == [*next(names)]


def test_table_keeps_the_index_of_a_data_frame() -> None:
    data = of_pandas()
    found = jkroll.table(data, WANTED)
    assert found.index.equals(data.index)
    assert [*found.columns] == [*data.columns, *ADDED]


def test_the_statistics_of_a_data_frame_are_not_contacts() -> None:
    data = of_pandas()
    for statistics, count in ((data.describe(), 8), (data[[*NUMBERS][:2]].agg(["mean", "std"]), 2)):
        found = jkroll.table(statistics, "P_c")
        assert values(found, "pull_off_force [N]") == [None] * count
        assert [*found["status"]] == ["row of statistics"] * count


def test_a_named_index_is_a_column() -> None:
    data = of_pandas().assign(**{"E [GPa]": [10.0, 20.0, 30.0], "probe": "a"})
    expected = values(jkroll.table(data, "r_min"), "r_min [m]")
    for names in (["E [GPa]"], ["probe", "E [GPa]"], ["radius [nm]", "gamma [mJ/m2]"]):
        found = jkroll.table(data.set_index(names), "r_min")
        assert [*found.index.names] == names
        assert values(found, "r_min [m]") == expected
    with pytest.raises(jkroll.JkrollError, match=r"'foo .GPa.': not read, and E is the material's"):
        jkroll.table(data.rename(columns={"E [GPa]": "foo [GPa]"}).set_index("foo [GPa]"), "r_min")


def test_results_in_a_dataset_have_the_dimensions_of_their_inputs() -> None:
    xarray = pytest.importorskip("xarray")
    data = xarray.Dataset(
        {
            "radius": ("size", [100.0, 200.0], {"units": "nm"}),
            "gamma": ("solid", [25.0, 50.0, 100.0], {"units": "mJ/m2"}),
            "temperature": ("time", [1.0, 2.0, 3.0, 4.0]),
        },
        coords={"size": ["small", "large"]},
    )
    forces = jkroll.table(data, "P_c")["pull_off_force"]
    assert forces.dims == ("size", "solid")
    for size, radius in (("small", 1e-7), ("large", 2e-7)):
        for solid, gamma in enumerate((0.025, 0.05, 0.1)):
            force = jkroll.solve("P_c", radius=radius, gamma=gamma)
            assert float(forces.sel(size=size)[solid]) == approx(force, rel=1e-15)


def test_a_result_is_nan_if_an_input_is_nan() -> None:
    found = jkroll.table({"radius [nm]": numpy.array([100.0, numpy.nan]), "gamma [mJ/m2]": 25.0}, "P_c")
    assert numpy.isnan(found["pull_off_force [N]"]).tolist() == [False, True]
    assert found["status"].tolist() == [None, "needs radius"]


def test_missing_values_of_libraries_are_empty_cells() -> None:
    pandas = pytest.importorskip("pandas")
    data = pandas.DataFrame(
        {
            "radius [nm]": pandas.Series([100, None, 100], dtype="Int64"),
            "material": pandas.Series(["quartz", "quartz", None], dtype="category"),
        }
    )
    found = jkroll.table(data, "P_c")
    assert found["pull_off_force [N]"].notna().tolist() == [True, False, False]
    assert found["status"].tolist()[1:] == ["needs radius", "needs surface_energy"]


def test_a_table_without_rows_gets_columns_without_rows() -> None:
    found = jkroll.table({"radius [nm]": [], "material": []}, "P_c")
    assert [*found] == ["radius [nm]", "material", "pull_off_force [N]", "doubt", "status"]
    assert {len(column) for column in found.values()} == {0}


def test_a_series_is_not_a_table() -> None:
    pandas = pytest.importorskip("pandas")
    with pytest.raises(jkroll.JkrollError, match="Series is not a table; give a DataFrame"):
        jkroll.table(pandas.Series([1.0], name="radius [nm]"), "P_c", material="quartz")


def test_infinite_radii_are_planes() -> None:
    found = jkroll.table({"radius [nm]": [100.0, 100.0], "radius2 [nm]": [numpy.inf, 100.0]}, "P_c", material="quartz")
    plane, sphere = found["pull_off_force [N]"]
    assert plane == approx(2 * sphere)


def test_argument_columns_gives_meanings_to_names() -> None:
    data = {"a": [100.0, 200.0], "solid": ["quartz", "iron"], "r": [1.0, 2.0]}
    columns = {"a": "radius [nm]", "solid": "material", "r": ""}
    found = jkroll.table(data, "P_c", columns=columns)
    assert found["pull_off_force [N]"] == approx(
        jkroll.table(of_dict(), "P_c", columns={"gamma [mJ/m2]": ""})["pull_off_force [N]"][:2]
    )


def test_argument_columns_without_a_unit_keeps_the_unit_of_a_pint_array() -> None:
    quantity: Any = pint.application_registry.Quantity
    found = jkroll.table({"a": quantity([0.1], "um")}, "P_c", material="quartz", columns={"a": "radius"})
    assert found["pull_off_force [N]"] == approx([jkroll.solve("P_c", material="quartz", radius=1e-7)], rel=1e-15)


def test_uncertainties_and_best_ranges_have_columns() -> None:
    data = {"radius [nm]": [100.0], "gamma [mJ/m2]": [25.0], "gamma_err [mJ/m2]": [5.0], "E [GPa]": 54.0, "nu": 0.17}
    found = jkroll.table(data, "P_c", best=True)
    answered: Any = jkroll.answer("P_c", radius="100nm", gamma="25±5 mJ/m2", young="54GPa", poisson=0.17)
    assert found["pull_off_force_plus [N]"] == approx([answered["P_c"].uncertain.plus])
    assert found["pull_off_force_best_low [N]"] == approx([answered.best["pull_off_force"].low])
    assert found["pull_off_force_best_by"].tolist() == [answered.best["pull_off_force"].by]


def test_given_values_apply_to_all_rows_and_infer_takes_a_measured_column() -> None:
    forces = jkroll.table({"radius [nm]": [100.0, 200.0]}, "P_c", gamma=jkroll.Measured(0.025, 0.005))
    assert forces["pull_off_force_plus [N]"] == approx([0.2 * force for force in forces["pull_off_force [N]"]])
    measured = {"radius [nm]": [100.0, 200.0], "pull_off_force [N]": forces["pull_off_force [N]"]}
    found = jkroll.table(measured, infer="gamma", measured="P_c")
    assert found["surface_energy [J/m^2]"] == approx([0.025, 0.025])


def test_table_says_how_it_reads_the_columns() -> None:
    lines: list[str] = []
    jkroll.table({"R2 (nm)": [100.0], "radius [nm]": [50.0], "note": ["x"]}, "P_c", material="quartz", say=lines.append)
    assert lines[0] == 'read: radius2 [nm] from "R2 (nm)", radius [nm]; passed through: note'
    assert any(line.startswith("note: doubts in 1 of 1 rows") for line in lines)
    assert not any("--" in line for line in lines)


@pytest.mark.parametrize(
    ("data", "arguments", "words"),
    [
        ({"radius": [1e-7]}, {"material": "quartz"}, "columns={'radius': 'radius [UNIT]'}"),
        ({"radius [nm]": [1.0], "gamma": ["x"]}, {"material": "quartz", "columns": {"G": "load"}}, "no column 'G'"),
        ({"radius [nm]": [1, 2], "note": [1]}, {}, "the columns have different lengths: 'radius [nm]' 2, 'note' 1"),
        ({"radius [nm]": numpy.ones((2, 2))}, {"material": "quartz"}, "a column has the shape (2, 2)"),
        ({"radius [nm]": [1.0]}, {"gamma": numpy.ones(2)}, "surface_energy"),
        ({"radius [nm]": [1.0]}, {"infer": "gamma"}, "infer and measured go together"),
        ({"note": [1.0]}, {}, "no column is an input"),
        ({"radius [nm]": [1.0], "model": ["dmt"]}, {"material": "quartz"}, "the law is an option: model dmt"),
        ({"radius [nm]": [1.0]}, {"gamma": 0.025, "load": [0.0]}, "load: 'an array' is not one value for all rows"),
        ({"radius [nm]": [1.0], "pull_off_force [N]": [1.0]}, {"material": "quartz"}, "already has a column"),
        (3, {}, "int is not a table"),
        ([1, 2], {}, "list is not a table"),
    ],
)
def test_bad_tables_and_arguments_are_refused(data: Any, arguments: Any, words: str) -> None:
    with pytest.raises(jkroll.JkrollError) as caught:
        jkroll.table(data, "P_c", **arguments)
    assert words in str(caught.value)
    assert "--" not in str(caught.value)


def test_argument_strict_raises_the_error_of_the_first_bad_row() -> None:
    data = {"radius [nm]": [100.0] * 6000 + [-1.0], "material": "quartz"}
    assert jkroll.table(data, "P_c")["status"][6000] is not None
    with pytest.raises(jkroll.JkrollError, match="row 6000, counted from 0: radius"):
        jkroll.table(data, "P_c", strict=True)


def test_table_imports_only_the_library_of_its_argument() -> None:
    code = "import jkroll, sys; jkroll.table({'radius [nm]': [1.0]}, 'P_c', material='quartz'); print(*sys.modules)"
    environment = {**os.environ, "PYTHONPATH": str(Path(jkroll.__file__).parents[1])}
    ran = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    assert {"pandas", "polars", "xarray", "astropy", "pyarrow", "pint"}.isdisjoint(ran.stdout.split())


def test_texts_may_have_decimal_commas() -> None:
    """A column may mix such texts with floats, and other columns may hold floats only."""
    diameters = numpy.array(["4,91", 10.5, "1.234,5"], dtype=object)
    columns = {"diameter [um]": diameters, "gamma [mJ/m2]": [35.9, 30.0, 30.0]}
    found = jkroll.table(columns, "P_c")
    assert [*found["pull_off_force [N]"][:2]] == approx([4.15324e-07, 7.42201e-07], rel=1e-5)
    reason = "'1.234,5' has a point: this table has decimal commas, and no thousands separators"
    assert [*found["status"]] == [None, None, reason]
    with pytest.raises(jkroll.JkrollError, match="write 1,2000, with one more digit, or 1200"):
        jkroll.table({"diameter [um]": ["1,200"], "gamma [mJ/m2]": [35.9]}, "P_c")
