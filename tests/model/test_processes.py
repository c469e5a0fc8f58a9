"""Spawned processes, joblib and dask accept the functions of jkroll, and return their results."""

import multiprocessing
from typing import Any

import pytest

import jkroll

SCENE: dict[str, Any] = {"material": "quartz", "radius": 1e-7}
SCENES: list[dict[str, Any]] = [{"material": solid, "radius": 1e-7} for solid in ("quartz", "iron", "graphite")]
EXPECTED = [jkroll.solve("P_c", **scene) for scene in SCENES]


def force(scene: dict[str, Any]) -> float:
    return float(jkroll.answer("P_c", **scene)["P_c"])


def test_spawned_processes_return_tables_answers_and_curves() -> None:
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        found = pool.apply(jkroll.table, [{"radius [nm]": [100.0], "material": ["quartz"]}, "P_c"])
        assert found["pull_off_force [N]"].tolist() == EXPECTED[:1]
        result = pool.apply(jkroll.answer, ["P_c"], SCENE)["P_c"]
        assert result == jkroll.answer("P_c", **SCENE)["P_c"]
        drawn = pool.apply(jkroll.curve, [], SCENE)
        assert drawn.lines.keys() == jkroll.curve(**SCENE).lines.keys()
        forces: Any = pool.apply(jkroll.solve, ["P_c"], {"material": ["quartz", "iron"], "radius": 1e-7})
        assert forces.tolist() == EXPECTED[:2]


def test_dask_runs_the_functions_of_jkroll() -> None:
    dask = pytest.importorskip("dask")
    tasks = [dask.delayed(jkroll.solve)("P_c", **scene) for scene in SCENES]
    assert [*dask.compute(*tasks, scheduler="processes", num_workers=1)] == EXPECTED
    assert [*dask.compute(*map(dask.delayed(force), SCENES), scheduler="threads")] == EXPECTED


@pytest.mark.parametrize("backend", ["loky", "threading"])
def test_joblib_runs_the_functions_of_jkroll(backend: str) -> None:
    joblib = pytest.importorskip("joblib")
    tasks = (joblib.delayed(jkroll.solve)("P_c", **scene) for scene in SCENES)
    assert joblib.Parallel(n_jobs=2, backend=backend)(tasks) == EXPECTED
