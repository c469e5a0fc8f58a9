"""The fit of a measured curve: work of adhesion of each branch, contact modulus and contact point, with three errors.

The unloading branch gives w of opening, E* and z_c. With these E* and z_c the loading branch gives w of closing: by
itself it hardly tells w from E*. Three standard deviations stand side by side: statistical (noise, correlated),
calibration (R, k and the baseline) and model (range, shape of the sphere, atomic spacing).
"""

from collections.abc import Mapping
from functools import cached_property

import numpy
from numpy import exp, inf, pi, sqrt

from ..physics.contact import tabor_parameter
from .fit_branches import (
    APPROACH,
    LOADING,
    RADIUS,
    TRAVEL,
    UNLOADING,
    BadCurve,
    Branch,
    Branches,
    Measured,
    Range,
    branches_of,
    running_median,
)
from .fit_branches import LEAST_POINTS as LEAST
from .fit_laws import PROFILES, Array, Grip, law_of
from .fit_minimum import (
    ADHESION,
    FEW_INDEPENDENT,
    MODULUS,
    POINT,
    Minimum,
    Noise,
    Points,
    Setting,
    best_of,
    minimum,
    residuals,
    with_point,
)
from .fit_result import STRONG, Errors, Fit, Known

FIRST_RANGE = Range(-1.0, 0.3, True)
_PLATEAU = 0.03  # of the energy release rate, within which it is constant
_PLATEAUS = 4  # times that the plateau of contact radii is found anew
_BINS = 24
_FEW = 300  # points of a fit that shows how much the model moves the result
_WIDE_CONTACT = 0.1  # a/R from which on the sphere's shape matters
_UNDETERMINED = 0.5  # standard deviation of ln E* from which on E* is not determined
_POOR = 0.1  # rms over the pull-off force from which on the curve is no contact's
_LARGEST = 60.0  # ln w or ln E* beyond which a minimum is none
_NO_ADHESION = 5.0  # standard deviations of the noise that a tension must have


def fit_curve(curve: Measured, known: Known) -> Fit:
    """Return the fit of a curve. Raises BadCurve where there is none."""
    if curve.kind == RADIUS and known.radius is None:
        raise BadCurve("contact radii give w with the radius of the sphere alone: give --radius", "no radius")
    try:
        with numpy.errstate(all="ignore"):
            return _Run(curve, known).fit()
    except (ArithmeticError, ValueError):
        raise BadCurve("the fit does not converge; check the radius, the spring and the units", "no fit") from None


class _Run:
    """One curve on its way to a fit."""

    def __init__(self, curve: Measured, known: Known) -> None:
        self.curve, self.known = curve, known
        only = {"load": LOADING, "unload": UNLOADING}.get(known.branch, "")
        stiffness = known.stiffness if curve.kind == TRAVEL else inf
        self.branches: Branches = branches_of(curve, stiffness, tilt=known.tilt, only=only)
        self.result = Fit(known, curve.kind, remarks={**self.branches.remarks})
        chosen = [only] if only else [UNLOADING, LOADING]
        self.names = [name for name in chosen if name in self.branches.by_name]
        if not self.names:
            raise BadCurve(f"the curve has no {chosen[0]} branch", "branch is missing")

    @cached_property
    def setting(self) -> Setting:
        """The setting of the law that was asked for."""
        return self._setting(self.known.law, self.known.profile)

    def _setting(self, law: str, profile: str = "paraboloid", spacing: float | None = None) -> Setting:
        grip = Grip(self.known.stiffness if self.curve.kind == TRAVEL else inf, self.curve.kind == RADIUS)
        return Setting(law_of(law, profile), self.result.radius, spacing or self.known.spacing, grip)

    # --- The fit ------------------------------------------------------------------------------------------------------

    def fit(self) -> Fit:
        """Return the fit."""
        first = self.branches.by_name[self.names[0]]
        tension = -float(running_median(first.in_contact.force, 3).min())
        if self.curve.kind != RADIUS and tension < _NO_ADHESION * self.branches.noise:
            return self._without_adhesion(first)
        self.main, self.points, first = self._of_branch(first)
        self._put_main(first)
        if len(self.names) > 1:
            try:
                self._put_other(self._extended(self.branches.by_name[self.names[1]], self.main))
            except BadCurve as problem:  # of the range
                self.result.remarks["branch-left-out"] = f"{problem}; the branch is left out"
        self._calibrate()
        self._compare_models()
        self._judge(first)
        return self.result

    def _starts(self, points: Points) -> list[Array]:
        """Return two starts: by the depth and the width of the tensile part, and from a modulus 3 times as large."""
        setting, radius = self.setting, self.result.radius
        w = max(-float(running_median(points.force, 3).min()), 1e-300) / (1.5 * pi * radius)
        if setting.grip.is_radius:
            shape = 4 / 3 / radius * points.z**1.5
            rows = numpy.stack([shape, -numpy.ones_like(shape)], 1)
            modulus, offset = numpy.linalg.lstsq(rows, points.force / points.z**1.5, rcond=None)[0]
            modulus = modulus if modulus > 0 else 0.75 * radius * float((points.force / points.z**3).max())
            w = offset**2 / (8 * pi * modulus) if offset > 0 else w
            return [with_point(points, setting, w, abs(modulus) * factor) for factor in (1.0, 3.0)]
        approach = points.z - points.force / setting.grip.stiffness
        least = int(numpy.argmin(points.force))
        pressed = points.force > 0.3 * points.force.max()
        zero = int(numpy.argmin(abs(points.force)))
        width = abs(float(approach[zero] - approach[least])) / (1 / 3 + 1 / 3 / 4 ** (2 / 3))
        if width == 0 and pressed.any():
            width = float(numpy.ptp(approach))
        unloaded = sqrt(radius * max(width, 1e-6 * float(numpy.ptp(points.z))))
        modulus = 9 * pi * w * radius**2 / (2 * unloaded**3)
        return [with_point(points, setting, w, modulus * factor) for factor in (1.0, 5.0)]

    def _of_branch(self, branch: Branch) -> tuple[Minimum, Points, Branch]:
        """Return the minimum of a branch with all unknowns, in the given range or up to the end of G's plateau.

        A first minimum says how far the contact holds behind the least load.
        """
        asked = self.known.range
        if self.curve.kind == RADIUS and asked is None:
            return self._of_radii(branch)
        within = self._range(branch, asked or FIRST_RANGE)
        found = self._minimum(branch.points.chosen(within))
        branch = self._extended(branch, found)
        if asked is not None or branch.name == LOADING:
            within = self._range(branch, asked or FIRST_RANGE)
        else:
            within = self._plateau(branch, found)
        points = branch.points.chosen(within)
        return minimum(points, self.setting, found.unknowns), points, branch

    def _of_radii(self, branch: Branch) -> tuple[Minimum, Points, Branch]:
        """Return the minimum of contact radii; of unloading from where the edge recedes, which E* decides with it."""
        points = branch.in_contact
        found = self._minimum(points)
        for _ in range(_PLATEAUS if branch.name == UNLOADING else 0):
            within = self._plateau(branch, found)
            points = branch.points.chosen(within)
            found = minimum(points, self.setting, found.unknowns)
        return found, points, branch

    def _extended(self, branch: Branch, found: Minimum) -> Branch:
        """Return a branch with the contact as far as a minimum holds it, by fixed grips."""
        if self.curve.kind != APPROACH:
            return branch  # a lever's way from its least load is its way apart
        contact, grip, law = self.setting.contact(found.unknowns), self.setting.grip, self.setting.law
        x_last = float(grip.x(law.values(numpy.float64(law.last(contact, grip)), contact)[0]))
        return branch.extended(found.unknowns[POINT] + x_last)

    def _range(self, branch: Branch, asked: Range) -> slice:
        """Return the range, or all of the contact where it would hold too few points and was not asked for."""
        try:
            return asked.within(branch)
        except BadCurve:
            if self.known.range is not None:
                raise
            return branch.contact

    def _minimum(self, points: Points) -> Minimum:
        """Return the best minimum from some starts; by other laws than JKR from that of JKR, too."""
        starts, setting = self._starts(points), self.setting
        try:
            if self.known.law != "jkr":
                by_jkr = best_of(starts, points, self._setting("jkr")).unknowns
                starts = [*starts, with_point(points, setting, *(float(exp(each)) for each in by_jkr[:POINT]))]
            found = best_of(starts, points, setting)
        except ValueError:
            found = None
        if found is None or not (abs(found.unknowns[:POINT]) < _LARGEST).all():
            raise BadCurve("no contact of this law resembles the curve", "no minimum")
        return found

    def _plateau(self, branch: Branch, found: Minimum) -> slice:
        """Return the slice from where the energy release rate is constant to the last point in contact."""
        points = branch.in_contact
        rate, _ = self.release_rate(points, found)
        size = max(LEAST, len(rate) // _BINS)
        middles = [float(numpy.median(rate[at : at + size])) for at in range(0, len(rate) - size + 1, size)]
        lower = middles[len(middles) // 2 :]
        if len(lower) < 2:
            return branch.contact
        level = float(numpy.median(lower))
        scatter = 1.4826 * float(numpy.median(abs(numpy.array(lower) - level)))
        tolerance = max(_PLATEAU * level, 3 * scatter)
        outside = [place for place, value in enumerate(middles) if abs(value - level) > tolerance]
        above = [place for place in outside if place < len(middles) - 3]
        first = (above[-1] + 1) * size if above else 0
        start = min(branch.contact.start + first, branch.contact.stop - 4 * LEAST)
        return slice(max(start, branch.contact.start), branch.contact.stop)

    def release_rate(self, points: Points, found: Minimum) -> tuple[Array, Array]:
        """Return the energy release rate G and the contact radius of measured points, by the fitted E* and z_c."""
        modulus, radius = float(exp(found.unknowns[MODULUS])), self.result.radius
        grip = self.setting.grip
        depth_of = PROFILES[self.known.profile]
        if grip.is_radius:
            a = points.z
            hertz = modulus * depth_of.without_adhesion(a, radius)[3]
            return (hertz - points.force) ** 2 / (8 * pi * modulus * a**3), a
        approach = points.z - found.unknowns[POINT] - points.force / grip.stiffness
        root = sqrt(numpy.maximum(radius * approach, 0))
        a = numpy.maximum(1.5 * root, numpy.cbrt(abs(points.force) * radius * 3 / modulus)) + 2 * root
        a = numpy.clip(a, 1e-9 * radius, 0.999999 * depth_of.most * radius)
        for _ in range(40):
            depth, _, _, hertz = depth_of.without_adhesion(a, radius)
            excess = 2 * modulus * a * (depth - approach) - modulus * hertz + points.force
            new = numpy.maximum(a - excess / (2 * modulus * (depth - approach)), 1e-9 * radius)
            is_done = bool((abs(new - a) <= 1e-10 * a).all())
            a = new
            if is_done:
                break
        depth = depth_of.without_adhesion(a, radius)[0]
        return modulus * (depth - approach) ** 2 / (2 * pi * a), a

    # --- Results and their statistical errors -------------------------------------------------------------------------

    def _put_main(self, branch: Branch) -> None:
        """Put w of the first branch, E* and z_c into the result, with their covariance."""
        w_name = "work_of_adhesion_opening" if branch.name == UNLOADING else "work_of_adhesion_closing"
        names = [w_name, "contact_modulus", "contact_point"][: len(self.main.covariance)]
        scale = [*exp(self.main.unknowns[:POINT]), self.branches.sign][: len(names)]
        self.result.names = (*names,)
        self.result.covariance = self.main.covariance * numpy.outer(scale, scale)
        values = [*exp(self.main.unknowns[:POINT]), self.branches.sign * self.main.unknowns[POINT]]
        self.result.values |= dict(zip(names, map(float, values), strict=False))
        self._set_statistical()
        force = -float(running_median(branch.in_contact.force, 3).min())
        self.result.values |= {"pull_off_force_measured": force} if force > 0 else {}
        self.result.values["pull_off_force_fitted"] = self._pull_off(self.main.unknowns)
        rate, radius = self.release_rate(branch.in_contact, self.main)
        model = residuals(branch.in_contact, self.main.unknowns, self.setting)
        self._put_points(branch, model.loads, rate, radius)

    def _put_points(self, branch: Branch, loads: Array, rate: Array, radius: Array) -> None:
        points = branch.in_contact
        columns = {
            "z": points.z * self.branches.sign, "force": points.force, "model": loads,
            "residual": points.force - loads, "release_rate": rate, "contact_radius": radius,
            "branch": numpy.full(len(points.z), branch.name),
        }  # fmt: skip
        old = self.result.points
        self.result.points = {
            name: numpy.concatenate([old[name], column]) if old else column for name, column in columns.items()
        }

    def _pull_off(self, unknowns: Array) -> float:
        """Return the largest tension of the fitted curve, by a lever or grips that hold all of it."""
        setting = self.setting._replace(grip=Grip(1e-9 * float(exp(unknowns[MODULUS])) * self.result.radius))
        last = setting.law.last(setting.contact(unknowns), setting.grip)
        return -float(setting.law.values(numpy.float64(last), setting.contact(unknowns))[0].load)

    def _set_statistical(self) -> None:
        variances = numpy.diag(self.result.covariance)
        for name, variance in zip(self.result.names, variances, strict=True):
            self.result.errors[name] = Errors(statistical=float(sqrt(variance)))

    def _put_other(self, branch: Branch) -> None:
        """Put w of closing into the result, with E* and z_c of the unloading branch, and the hysteresis."""
        within = self._range(branch, self.known.range or Range(-inf, inf, False))
        points = branch.points.chosen(within)
        start = self.main.unknowns.copy()
        other = minimum(points, self.setting, start, free=[ADHESION])
        own = float(other.covariance[0, 0])
        count = len(self.main.covariance)
        rows = other.noise.whitened(other.residuals.derivatives)
        weighted = rows[:, ADHESION] * other.weights
        pulls = -(weighted @ rows[:, :count]) / (weighted @ rows[:, ADHESION])
        pulls[ADHESION] = 0.0
        variance = own + float(pulls @ self.main.covariance @ pulls)
        with_main = self.main.covariance @ pulls
        w = float(exp(other.unknowns[ADHESION]))
        scale = numpy.array([*exp(self.main.unknowns[:POINT]), self.branches.sign][:count])
        column = with_main * scale * w
        result = self.result
        result.covariance = numpy.block([[result.covariance, column[:, None]], [column[None], variance * w * w]])
        result.names = (*result.names, "work_of_adhesion_closing")
        result.values["work_of_adhesion_closing"] = w
        self._set_statistical()
        self.other, self.other_points = other, points
        opening = result.values["work_of_adhesion_opening"]
        result.values["adhesion_hysteresis"] = opening - w
        result.values["hysteresis_fraction"] = 1 - w / opening
        matrix = result.covariance
        spread = sqrt(max(matrix[0, 0] + matrix[-1, -1] - 2 * matrix[0, -1], 0.0))
        result.errors["adhesion_hysteresis"] = Errors(statistical=float(spread))
        relative = sqrt(max(matrix[0, 0] / opening**2 + matrix[-1, -1] / w**2 - 2 * matrix[0, -1] / opening / w, 0.0))
        result.errors["hysteresis_fraction"] = Errors(statistical=float(relative * w / opening))
        rate, radius = self.release_rate(branch.in_contact, self.main)
        trial = self.main.unknowns.copy()
        trial[ADHESION] = other.unknowns[ADHESION]
        self._put_points(branch, residuals(branch.in_contact, trial, self.setting).loads, rate, radius)

    # --- Calibration and model ----------------------------------------------------------------------------------------

    def _refitted(self, change: Setting, points: Points, other: Points | None = None) -> dict[str, float]:
        """Return the results of a fit with something changed, from the present minimum."""
        main = minimum(points, change, self.main.unknowns, noise=self.main.noise)
        return self._results_of(main, change, other)

    def _results_of(self, main: Minimum, setting: Setting, other: Points | None = None) -> dict[str, float]:
        w, modulus = (float(each) for each in exp(main.unknowns[:POINT]))
        values = {self.result.names[0]: w, "contact_modulus": modulus}
        if not setting.grip.is_radius:
            values["contact_point"] = self.branches.sign * float(main.unknowns[POINT])
        if hasattr(self, "other"):
            points = self.other_points if other is None else other
            second = minimum(points, setting, main.unknowns, free=[ADHESION], noise=self.other.noise)
            closing = float(exp(second.unknowns[ADHESION]))
            values |= {"work_of_adhesion_closing": closing, "adhesion_hysteresis": w - closing}
            values["hysteresis_fraction"] = 1 - closing / w
        return values

    def _add(self, part: str, changes: list[dict[str, float]]) -> None:
        """Add the squares of changes of results to a part of their errors."""
        for name, errors in [*self.result.errors.items()]:
            moves = [each[name] - self.result.values[name] for each in changes if name in each]
            size = float(sqrt(getattr(errors, part) ** 2 + sum(move * move for move in moves)))
            self.result.errors[name] = errors._replace(**{part: size})

    def _calibrate(self) -> None:
        """Put the errors of radius, spring and baseline into the results."""
        known, setting, changes = self.known, self.setting, []
        self.by_lever: dict[str, float] = {}
        if known.radius is not None and known.radius_error:
            larger = setting._replace(reduced_radius=known.radius * (1 + known.radius_error))
            changes.append(self._refitted(larger, self.points))
        if known.stiffness < inf and known.stiffness_error and self.curve.kind == TRAVEL:
            stiffer = setting._replace(grip=Grip(known.stiffness * (1 + known.stiffness_error)))
            self.by_lever = self._refitted(stiffer, self.points)
            changes.append(self.by_lever)
        if error := self.branches.baseline_error:
            points = self.points._replace(force=self.points.force + error)
            changes.append(self._refitted(setting, points))
        self._add("calibration", changes)

    def _compare_models(self) -> None:
        """Put the errors of the model into the results: by the range, the sphere's shape and the atomic spacing."""
        few = self.points.thinned(_FEW)
        other = self.other_points.thinned(_FEW) if hasattr(self, "other") else None
        noise = Noise(0.0, self.main.noise.scale)
        middle = minimum(few, self.setting, self.main.unknowns, noise=noise)
        here = self._results_of(middle, self.setting, other)
        spread = {name: [0.0] for name in here}
        forces = few.force
        for share in (0.5, 0.0):
            top = share * float(forces.max()) + (1 - share) * float(forces.min()) * (0.0 if share else 0.1)
            which = forces <= top
            if which.sum() >= 4 * LEAST and (forces[which].min() < 0):
                there = minimum(few.chosen(which), self.setting, middle.unknowns, noise=noise)
                for name, value in self._results_of(there, self.setting, other).items():
                    spread[name].append(value - here[name])
        ranges = {name: self.result.values[name] + (max(each) - min(each)) / 2 for name, each in spread.items()}
        self._add("model", [ranges])
        self._compare_laws(few, middle, other, here)

    def _compare_laws(self, few: Points, middle: Minimum, other: Points | None, here: Mapping[str, float]) -> None:
        """Put results by each law into the fit, and the effect of shape and spacing into the errors."""
        result, known = self.result, self.known
        contact = self.setting.contact(self.main.unknowns)
        tabor = float(tabor_parameter(**contact._asdict())) if not result.is_scaled else inf
        result.goodness["tabor_parameter"] = tabor
        result.by_law[known.law] = {name: result.values[name] for name in here}
        result.goodness["contact_over_radius"] = float(self.main.residuals.radii.max()) / result.radius
        noise = Noise(0.0, self.main.noise.scale)

        def by(law: str, profile: str = "paraboloid", spacing: float | None = None) -> dict[str, float]:
            setting = self._setting(law, profile, spacing)
            start = middle.unknowns if law != "dmt" else with_point(few, setting, contact.work_of_adhesion * 0.75,
                contact.contact_modulus)  # fmt: skip
            found = minimum(few, setting, start, noise=noise)
            values = self._results_of(found, setting, other)
            shift = {name: value - here[name] for name, value in values.items()}
            return {name: result.values[name] + shift[name] for name in values}

        if result.is_scaled:
            result.remarks["radius-free"] = "no radius is given: w is wR and E* is E*√R, for a paraboloid by JKR"
            return
        for law in ("jkr", "maugis", "dmt"):
            if law != known.law and not (law == "maugis" and tabor > 50):
                result.by_law[law] = by(law)
        if tabor > 50 and "maugis" not in result.by_law:
            result.by_law["maugis"] = dict(result.by_law[known.law if known.law == "jkr" else "jkr"])
        elif tabor < STRONG:
            half = by("maugis", spacing=known.spacing / 2)
            result.by_law["maugis, z0/2"] = half
            self._add("model", [_sum(result.values, half, result.by_law["maugis"])])
        wide = result.goodness["contact_over_radius"] > _WIDE_CONTACT
        if wide and known.profile == "paraboloid" and known.law == "jkr":
            sphere = by("jkr", "sphere")
            result.by_law["jkr, sphere"] = sphere
            before = {name: errors.total for name, errors in result.errors.items()}
            self._add("model", [sphere])
            w_name = result.names[0]
            if any(abs(sphere[name] - result.values[name]) > before[name] for name in (w_name, "contact_modulus")):
                result.remarks["profile-matters"] = (
                    f"the contact is {result.goodness['contact_over_radius']:.2f} of the radius wide, where a sphere "
                    f"is no paraboloid: w {sphere[w_name] / result.values[w_name] - 1:+.1%}, E* "
                    f"{sphere['contact_modulus'] / result.values['contact_modulus'] - 1:+.1%} by --profile sphere"
                )

    # --- Goodness -----------------------------------------------------------------------------------------------------

    def _judge(self, branch: Branch) -> None:
        """Put measures of goodness and codes into the result."""
        result, main, known = self.result, self.main, self.known
        misfit = self.points.force - main.residuals.loads
        rms = float(sqrt(numpy.mean(numpy.where(main.residuals.is_beyond, 0.0, misfit) ** 2)))
        tau = main.correlation_time
        count = len(self.points.z)
        result.goodness |= {
            "points": count, "rms": rms, "rms_over_pull_off": rms / result.values["pull_off_force_fitted"],
            "rms_over_noise": rms / self.branches.noise, "correlation_time": tau,
            "independent_points": count / max(tau, 1.0), "longest_run": _longest_run(misfit),
        }  # fmt: skip
        remarks, errors, values = result.remarks, result.errors, result.values
        if branch.name == LOADING and self.curve.kind != RADIUS:
            remarks["loading-only"] = "a loading branch alone hardly tells w from E*: their errors are of one another"
        if count / max(tau, 1.0) < FEW_INDEPENDENT:
            cause = "the misfit is one trend" if tau > count / 2 else f"neighbours are alike over {tau:.0f} points"
            few = f"{count} points are few" if tau < 2 else cause
            remarks["few-independent"] = f"{few}: the statistical error is not to be trusted"
        elif tau > 1 and result.goodness["longest_run"] > 0.1 * count + 10:
            remarks["residual-trend"] = (
                f"residuals have one sign over {result.goodness['longest_run']:.0f} points in a row: the model, not "
                "the noise, limits the fit"
            )
        if result.goodness["rms_over_pull_off"] > _POOR:
            remarks["poor-fit"] = (
                f"the misfit is {result.goodness['rms_over_pull_off']:.0%} of the pull-off force: this is not the "
                "curve of one contact"
            )
        modulus = values["contact_modulus"]
        if not errors["contact_modulus"].statistical < _UNDETERMINED * modulus:
            remarks["modulus-undetermined"] = (
                "E* is not determined: the contact is stiffer than the lever, or has too few points; P_c alone counts"
            )
        if self.by_lever and abs(self.by_lever["contact_modulus"] - modulus) > max(
            errors["contact_modulus"].statistical, errors["contact_modulus"].model
        ):
            move = self.by_lever["contact_modulus"] / modulus - 1
            remarks["lever-decides"] = f"the spring's error moves E* by {abs(move):.0%}, more than all else"
        if self.curve.kind != RADIUS and int((self.points.force < 0).sum()) < LEAST:
            remarks["few-below-zero"] = "fewer than 5 points are in tension: w is hardly determined"
        if known.profile == "sphere" and result.goodness.get("contact_over_radius", 0) > 0.9:
            remarks["wide-contact"] = "the contact is wider than 0.9 of the radius: no theory of a half-space holds"
        self._find_pinned_edge(branch)

    def _find_pinned_edge(self, branch: Branch) -> None:
        """Remark on a vertical stretch of G over a: the edge rests while G moves by a fifth of w or more."""
        points = self.result.points
        is_own = points["branch"] == branch.name
        rate, radius = (running_median(points[name][is_own]) for name in ("release_rate", "contact_radius"))
        size = max(LEAST, len(rate) // 15)
        w = self.result.values[self.result.names[0]]
        noise = 1.4826 * float(numpy.median(abs(points["release_rate"][is_own] - rate)))
        for at in range(0, len(rate) - size, max(1, size // 2)):
            moved_rate = float(numpy.ptp(rate[at : at + size]))
            moved_radius = float(numpy.ptp(radius[at : at + size]))
            if moved_rate > max(0.2 * w, 10 * noise) and moved_radius < 0.01 * float(radius[at]):
                place = float(radius[at]) / self.result.radius
                self.result.remarks["edge-pinned"] = (
                    f"G has a vertical stretch at a/R = {place:.2f}: the edge of the contact is held there"
                )
                return

    # --- Without adhesion ---------------------------------------------------------------------------------------------

    def _without_adhesion(self, branch: Branch) -> Fit:
        """Return the fit of Hertz' contact, and the upper limit of w that the noise leaves."""
        result, radius = self.result, self.result.radius
        points = branch.points.chosen(self._range(branch, self.known.range or Range(-inf, inf, False)))
        result.largest_adhesion = _NO_ADHESION * self.branches.noise / (1.5 * pi * radius)
        setting = self._setting("dmt")
        w = 1e-6 * result.largest_adhesion
        depth = float(numpy.ptp(points.z)) or 1e-9
        modulus = 0.75 * float(points.force.max()) / (sqrt(radius) * depth**1.5)
        free = [MODULUS] if setting.grip.is_radius else [MODULUS, POINT]
        starts = [with_point(points, setting, w, modulus * factor) for factor in (1.0, 10.0)]
        try:
            main = best_of(starts, points, setting, free)
        except ValueError:
            raise BadCurve("no contact resembles the curve", "no minimum") from None
        result.names = ("contact_modulus", "contact_point")[: len(free)]
        scale = numpy.array([exp(main.unknowns[MODULUS]), self.branches.sign][: len(free)])
        result.covariance = main.covariance * numpy.outer(scale, scale)
        result.values = {"contact_modulus": float(exp(main.unknowns[MODULUS]))}
        if not setting.grip.is_radius:
            result.values["contact_point"] = self.branches.sign * float(main.unknowns[POINT])
        self._set_statistical()
        loads = residuals(branch.in_contact, main.unknowns, setting).loads
        nothing = numpy.full(len(loads), numpy.nan)
        self._put_points(branch, loads, nothing, nothing)
        result.goodness = {"points": len(points.z), "rms": float(numpy.std(points.force - main.residuals.loads))}
        result.remarks["no-adhesion"] = "no tension above the noise: Hertz' contact, and an upper limit of w"
        return result


def _sum(values: Mapping[str, float], one: Mapping[str, float], other: Mapping[str, float]) -> dict[str, float]:
    """Return values moved by the difference of two others."""
    return {name: values[name] + one[name] - other[name] for name in one}


def _longest_run(misfit: Array) -> int:
    """Return the largest number of residuals of one sign in a row."""
    changes = numpy.nonzero(numpy.diff(numpy.sign(misfit)) != 0)[0]
    ends = numpy.concatenate([[-1], changes, [len(misfit) - 1]])
    return int(numpy.diff(ends).max())
