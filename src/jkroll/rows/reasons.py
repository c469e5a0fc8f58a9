"""Why cells of a row are empty, and in what words: of notes and of the column status."""

from collections.abc import Mapping, Sequence

from ..errors import JkrollError
from ..quantities.nomenclature import NOMENCLATURE
from ..scene.failures import NO_END, MissingInput, NoContact, reason_of
from ..text import first_of

ROW = ""  # stands for the row as a whole, in place of the name of a column
UNCERTAINTY = "±"  # stands for the columns of uncertainties that a table does not have
_MAX_NAMES = 3  # of quantities in a clause of a status

Reasons = Mapping[str, JkrollError]  # why cells of a row are empty, by the names of their columns


def lack(reasons: Reasons) -> JkrollError | None:
    """Return why nothing of a row is to be trusted; None if it has a contact, though maybe not at all ends of its uncertain inputs."""
    for name, error in reasons.items():
        if name == ROW or (isinstance(error, NoContact) and name in NOMENCLATURE):
            return error
    return None


def worded(reasons: Reasons) -> str:
    """Return why cells are empty: a clause for all that lack an input, and one for each other reason."""
    of_values, of_sides = of_quantities(reasons)
    clauses = [*_clauses(of_values), *_clauses(of_sides, NO_END)]
    if UNCERTAINTY in reasons:
        clauses.append(str(reasons[UNCERTAINTY]))
    return "; ".join(clauses)


def of_quantities(reasons: Reasons) -> tuple[Reasons, Reasons]:
    """Return by the names of quantities why they have no values, and why values have no uncertainties."""
    of_values = {name: error for name, error in reasons.items() if name in NOMENCLATURE}
    sides = reasons.keys() - of_values.keys() - {ROW, UNCERTAINTY}
    return of_values, {key.rpartition("_")[0]: error for key, error in reasons.items() if key in sides}


def _clauses(errors: Mapping[str, JkrollError], lead: str = "") -> list[str]:
    lacking = {name: one for name, one in errors.items() if isinstance(one, MissingInput) and one.missing}
    joined = _joined([*lacking.values()])
    reasons: dict[str, list[str]] = {}
    for name, error in errors.items():
        reason = joined if name in lacking else reason_of(name, error)
        reasons.setdefault(reason, []).append(name)
    return [f"{first_of(names, _MAX_NAMES)}: {lead}{reason}" for reason, names in reasons.items()]


def _joined(errors: Sequence[MissingInput]) -> str:
    """Return the reason of quantities that lack inputs, with all that some of them need."""
    if len({error.missing for error in errors}) < 2:
        reasons = (error.reason_of_several() if errors[1:] else error.reason() for error in errors)
        return min(reasons, key=len, default="")
    missing = dict.fromkeys(name for error in errors for name in error.missing)
    instead = [name for name in errors[0].instead if all(name in error.instead for error in errors)]
    lacking = dict.fromkeys(filter(None, (text for error in errors for text in error.lacking.split(", "))))
    return f"need some of {MissingInput('', [*missing], instead, ', '.join(lacking)).needs()}"
