"""The solver of the inverse problem, for numbers and for arrays: one unknown by `scans`, two by `pairs`."""

from typing import Any

import numpy

from ..errors import JkrollError, NoResult
from .inverse import Problem, Solution, Values
from .pairs import Pairs
from .scans import Scan, grid

_TOGETHER = 1 << 17  # values of a scan that are computed at once


def solution(problem: Problem) -> Solution:
    """Return the one solution of a problem of numbers. Raises why there is none, or the error of the inputs."""
    arrays = solutions(problem, 1)
    for error in arrays.failures.values():
        raise error
    values = {name: float(column[0]) for name, column in arrays.values.items()}
    growths = {name: _rounded(column[0]) for name, column in arrays.growths.items()}
    return Solution(problem, values, _rounded(arrays.condition[0]), growths)


def solutions(problem: Problem, size: int, near: Values | None = None) -> Solution:
    """Return the solutions of some rows. `near`: values of two unknowns from which Newton's method starts first."""
    problem.check()
    failures: dict[int, JkrollError] = {}
    values, growths = ({name: numpy.full(size, numpy.nan) for name in problem.unknowns} for _ in range(2))
    whole = Solution(problem, values, numpy.full(size, numpy.nan), growths, failures)
    if len(problem.unknowns) == 1:
        step = _TOGETHER // len(grid(problem.unknowns[0]))
        for start in range(0, size, step):
            rows = numpy.arange(start, min(start + step, size))
            part = Scan(problem.rows(rows), len(rows)).solution()
            _put(whole, rows, part)
            failures |= {start + row: error for row, error in part.failures.items()}
        return whole
    rest = numpy.arange(size)
    if near is not None:
        part, rest = Pairs(problem, size).followed(near, size)
        _put(whole, numpy.arange(size), part)
    for row in rest.tolist():
        try:
            _put(whole, [row], Pairs(problem.rows(row)).solution())
            whole.condition[row] = _rounded(whole.condition[row])
        except NoResult as error:
            failures[row] = error
    return whole


def _put(whole: Solution, rows: Any, part: Solution) -> None:
    """Take the solution of some rows."""
    for columns, own in ((whole.values, part.values), (whole.growths, part.growths)):
        for name, column in columns.items():
            column[rows] = own[name]
    whole.condition[rows] = part.condition


def _rounded(number: float) -> float:
    return float(f"{number:.6g}")
