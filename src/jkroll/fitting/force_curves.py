"""Force curves of the laws as functions of one variable, with the derivatives by ln w and ln E* that a fit needs.

A variable q sets the state: the contact radius a in JKR, the approach δ in DMT, the edge ratio v in Maugis' law. Given
q, the formulas for a, δ and P are explicit. A fit compares loads at a measured x: an approach, the travel δ + P/k of a
lever, or a contact radius.

All values are in SI units: floats, or arrays of one dimension. `profile` is the shape of body 1; w and E* are positive.
"""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple, Protocol

import numpy
from numpy import inf, pi, sqrt

from ..physics import any_law, dugdale, jkr, maugis, sneddon
from ..physics.contact import contact_radius, tabor_parameter
from ..quantities.laws import DMT, MAUGIS, PARABOLOID, SPHERE

Array = Any  # a float, or an array of floats

_STEPS = 60  # most steps of Newton's method, which usually takes about 5
_NEAR = 1e-7  # a smaller relative step is the last one, since the next would be its square
_SECANTS = 60  # most steps of the Illinois method
_STRETCH = 1e-5  # relative step of numerical derivatives
_WIDEST = 1 - 1e-9  # largest a/R of a sphere
_LEAST_RATIO = 1e-6  # edge ratio, or a/R, below which there is no contact


class Contact(NamedTuple):
    """The constants of a contact: work of adhesion, contact modulus, reduced radius, atomic spacing."""

    work_of_adhesion: float
    contact_modulus: float
    reduced_radius: float
    atomic_spacing: float

    @property
    def without_spacing(self) -> dict[str, float]:
        """The constants for laws without an atomic spacing."""
        return {name: value for name, value in self._asdict().items() if name != "atomic_spacing"}


class Values(NamedTuple):
    """A contact radius, an approach and a load; or their derivatives."""

    radius: Array
    approach: Array
    load: Array


class States(NamedTuple):
    """States of a force curve, with derivatives by q along the curve, and by ln w and ln E* at fixed q."""

    values: Values
    slopes: Values
    by_adhesion: Values
    by_modulus: Values


class Grip(NamedTuple):
    """The meaning of a measured x: an approach, the travel of a lever, or a contact radius.

    An approach is the travel of an infinitely stiff lever.
    """

    stiffness: float = inf
    is_radius: bool = False

    def x(self, values: Values) -> Array:
        """Return x of some values, or its derivative from their derivatives."""
        return values.radius if self.is_radius else values.approach + values.load / self.stiffness


class CurveLaw(Protocol):
    """The interface of a law's force curve."""

    def states(self, q: Array, contact: Contact) -> States:
        """Return states with their derivatives."""

    def values(self, q: Array, contact: Contact) -> tuple[Values, Values]:
        """Return states and their derivatives by q."""

    def last(self, contact: Contact, grip: Grip) -> float:
        """Return q of the last state before the contact is lost, where dx/dq = 0 or a = 0."""

    def start(self, x: Array, contact: Contact, grip: Grip, last: float, x_last: float) -> Array:
        """Return a first guess of q at x, preferably too high. `last`, `x_last`: q and x of the last state."""

    def most(self, contact: Contact) -> float:
        """Return the upper bound of q."""


def state_at(law: CurveLaw, x: Array, contact: Contact, grip: Grip) -> tuple[Array, float, float]:
    """Return q of the stable states at x, with q and x of the last state, whose q also stands for a smaller x.

    Newton's method runs between bounds. Where a step would leave them, the next q is their middle, or twice the last q
    if there is no upper bound. In JKR with a paraboloid, no step leaves the bounds, since x is convex in a.
    """
    last, most = law.last(contact, grip), law.most(contact)
    x_last = float(grip.x(law.values(last, contact)[0]))
    is_held = x > x_last
    held = x[is_held]
    low, high = numpy.full_like(held, last), numpy.full_like(held, most)
    root = numpy.clip(law.start(held, contact, grip, last, x_last), last, most)
    for _ in range(_STEPS):
        values, slopes = law.values(root, contact)
        excess = grip.x(values) - held
        low, high = numpy.where(excess < 0, root, low), numpy.where(excess < 0, high, root)
        new = root - excess / grip.x(slopes)
        is_inside = (new >= low) & (new <= high)
        if not is_inside.all():
            new = numpy.where(is_inside, new, numpy.where(high < inf, (low + high) / 2, 2 * root))
        is_done = bool((abs(new - root) <= _NEAR * root).all())
        root = new
        if is_done:
            break
    q = numpy.full_like(x, last)
    q[is_held] = root
    return q, last, x_last


def _root(excess: Callable[[float], float], low: float, high: float) -> float:
    """Return the root of a rising function by the Illinois method, or an end of the interval if there is no root."""
    below, above = excess(low), excess(high)
    if below >= 0 or above <= 0:
        return low if below >= 0 else high
    side = 0
    for _ in range(_SECANTS):
        middle = (low * above - high * below) / (above - below)
        if not low < middle < high or high - low <= 1e-14 * high:
            break
        value = excess(middle)
        if value < 0:
            low, below, above, side = middle, value, above / 2 if side < 0 else above, -1
        elif value > 0:
            high, above, below, side = middle, value, below / 2 if side > 0 else below, 1
        else:
            return middle
        if abs(value) <= 1e-14 * max(-below, above):
            break
    return middle


# --- JKR --------------------------------------------------------------------------------------------------------------


class Profile(NamedTuple):
    """The shape of body 1: δ_H, dδ_H/da, d²δ_H/da² and P_H/E* of a contact without adhesion, and the largest a/R."""

    without_adhesion: Callable[[Array, float], tuple[Array, Array, Array, Array]]
    most: float


def _paraboloid(a: Array, reduced_radius: float) -> tuple[Array, Array, Array, Array]:
    """Return δ_H = a²/R and its derivatives, and P_H/E* = 4a³/(3R)."""
    square, slope = a * a, 2 * a / reduced_radius
    return square / reduced_radius, slope, 2 / reduced_radius + 0 * a, 4 / 3 * a * square / reduced_radius


def _sphere(a: Array, radius: float) -> tuple[Array, Array, Array, Array]:
    """Return δ_H of a rigid sphere and its derivatives, and P_H/E*, by Sneddon's formulas."""
    artanh = sneddon.artanh_of_contact(a, radius)
    depth, curvature = radius * sneddon.indentation(artanh), sneddon.indentation_curvature(artanh) / radius
    return depth, sneddon.indentation_slope(artanh), curvature, radius * radius * sneddon.load_without_adhesion(artanh)


PROFILES: Mapping[str, Profile] = {PARABOLOID: Profile(_paraboloid, inf), SPHERE: Profile(_sphere, _WIDEST)}


class Jkr(NamedTuple):
    """JKR's law for a profile: δ = δ_H − u, P = P_H − 2E*au, u = √(2πwa/E*)."""

    profile: Profile

    def states(self, q: Array, contact: Contact) -> States:
        """Return states with their derivatives."""
        a, modulus = q, contact.contact_modulus
        values, slopes = self.values(a, contact)
        u = sqrt(2 * pi * contact.work_of_adhesion / modulus * a)
        pull, zero = 2 * modulus * a * u, 0 * a
        return States(values, slopes, Values(zero, -u / 2, -pull / 2), Values(zero, u / 2, values.load + pull / 2))

    def values(self, q: Array, contact: Contact) -> tuple[Values, Values]:
        """Return states and their derivatives by a."""
        a, modulus = q, contact.contact_modulus
        depth, slope, _, hertz = self.profile.without_adhesion(a, contact.reduced_radius)
        u = sqrt(2 * pi * contact.work_of_adhesion / modulus * a)
        rise = u / (2 * a)
        stiffness = 2 * modulus * a
        values = Values(a, depth - u, modulus * hertz - stiffness * u)
        return values, Values(1 + 0 * a, slope - rise, stiffness * (slope - 3 * rise))

    def last(self, contact: Contact, grip: Grip) -> float:
        """Return the contact radius at which dx/da = 0; if x is a contact radius, a radius near 0.

        Fixed grips lose the contact at the fold, a dead load loses it at pull-off.
        """
        if grip.is_radius:
            return _LEAST_RATIO * contact.reduced_radius
        unloaded = contact_radius(**contact.without_spacing)
        high = min(float(jkr.contact_radius_at_pull_off(contact_radius=unloaded)), self.most(contact))
        low = 0.2 * high

        def slope(a: float) -> float:
            return float(grip.x(self.values(a, contact)[1]))

        return _root(slope, low, high)

    def start(self, x: Array, contact: Contact, grip: Grip, last: float, x_last: float) -> Array:
        """Return an approximate radius at x, from d²x/da² at the last state; x itself if x is a radius."""
        if grip.is_radius:
            return x
        radius, modulus = contact.reduced_radius, contact.contact_modulus
        _, slope, bend, _ = self.profile.without_adhesion(last, radius)
        u = sqrt(2 * pi * contact.work_of_adhesion * last / modulus)
        approach_bend = bend + u / (4 * last * last)
        load_bend = 2 * modulus * (slope + last * bend - 0.75 * u / last)
        x_bend = approach_bend + load_bend / grip.stiffness
        most = self.most(contact)
        return numpy.minimum(last + sqrt(2 * numpy.maximum(x - x_last, 0) / x_bend), (last + most) / 2)

    def most(self, contact: Contact) -> float:
        """Return the largest contact radius on the profile."""
        return self.profile.most * contact.reduced_radius


# --- DMT --------------------------------------------------------------------------------------------------------------


class Dmt:
    """DMT's law: a = √(Rδ), P = (4/3)E*√R δ^(3/2) − 2πwR. It has no fold: the contact is lost at δ = 0."""

    def states(self, q: Array, contact: Contact) -> States:
        """Return states with their derivatives."""
        values, slopes = self.values(q, contact)
        zero = 0 * q
        attraction = 2 * pi * contact.work_of_adhesion * contact.reduced_radius
        return States(
            values, slopes, Values(zero, zero, zero - attraction), Values(zero, zero, values.load + attraction)
        )

    def values(self, q: Array, contact: Contact) -> tuple[Values, Values]:
        """Return states and their derivatives by δ."""
        modulus, radius = contact.contact_modulus, contact.reduced_radius
        a = sqrt(radius * q)
        load = 4 / 3 * modulus * a * q - 2 * pi * contact.work_of_adhesion * radius
        slope = radius / (2 * numpy.maximum(a, 1e-12 * radius))
        return Values(a, q, load), Values(slope, 1 + 0 * q, 2 * modulus * a)

    def last(self, contact: Contact, grip: Grip) -> float:  # noqa: ARG002
        """Return δ = 0."""
        return 0.0

    def start(self, x: Array, contact: Contact, grip: Grip, last: float, x_last: float) -> Array:  # noqa: ARG002
        """Return an approach that is too large at x, as the lever's deflection is ignored; exact if x is a radius."""
        return x * x / contact.reduced_radius if grip.is_radius else numpy.maximum(x - x_last, 0)

    def most(self, contact: Contact) -> float:  # noqa: ARG002
        """Return infinity: δ has no bound."""
        return inf


# --- Maugis -----------------------------------------------------------------------------------------------------------


class Maugis:
    """Maugis' law in contact at a fixed atomic spacing. Derivatives are central differences."""

    def states(self, q: Array, contact: Contact) -> States:
        """Return states with their derivatives."""
        partials = []
        for name in ("work_of_adhesion", "contact_modulus"):
            value = getattr(contact, name)
            ends = [self._values(q, contact._replace(**{name: value * (1 + step)})) for step in (-_STRETCH, _STRETCH)]
            partials.append(_difference(ends[0], ends[1], 2 * _STRETCH))
        return States(*self.values(q, contact), *partials)

    def values(self, q: Array, contact: Contact) -> tuple[Values, Values]:
        """Return states and their derivatives by v."""
        below, above = self._values(q * (1 - _STRETCH), contact), self._values(q * (1 + _STRETCH), contact)
        return self._values(q, contact), _difference(below, above, 2 * _STRETCH * q)

    def _values(self, q: Array, contact: Contact) -> Values:
        """Return the states at edge ratios."""
        transition, length, depth = _scales(contact)
        ring = dugdale.Shape(q)
        span = dugdale.span(transition, ring)
        force = pi * contact.work_of_adhesion * contact.reduced_radius
        load, approach = dugdale.load(transition, ring, span), dugdale.approach(transition, ring, span)
        return Values(q * span * length, approach * depth, load * force)

    def last(self, contact: Contact, grip: Grip) -> float:
        """Return the v where dx/dv = 0; a small v if the contact radius vanishes first, or if x is a contact radius."""
        if grip.is_radius:
            return _LEAST_RATIO
        transition, *_ = _scales(contact)
        low, high = (float(ratio(transition)) for ratio in (dugdale.fold_ratio, dugdale.pull_off_ratio))

        def slope(v: float) -> float:
            return float(grip.x(self.values(v, contact)[1]))

        return _root(slope, max(low, _LEAST_RATIO), max(high, 2 * _LEAST_RATIO))

    def start(self, x: Array, contact: Contact, grip: Grip, last: float, x_last: float) -> Array:
        """Return an approximate v at x, from Hertz' contact radius and the width of the ring."""
        transition, length, depth = _scales(contact)
        area = (x / length) ** 2 if grip.is_radius else numpy.maximum(x - x_last, 0) / depth
        wide = numpy.minimum(sqrt(pi / 4 * transition * area), numpy.cbrt(2 / 3 * transition * area))
        return last + wide + transition * sqrt(2 / 3 * sqrt(area))

    def most(self, contact: Contact) -> float:  # noqa: ARG002
        """Return infinity: v has no bound."""
        return inf


def _scales(contact: Contact) -> tuple[float, float, float]:
    """Return λ and the units of length and approach of Maugis' curve."""
    transition = any_law.transition_parameter(tabor_parameter=tabor_parameter(**contact._asdict()))
    length = maugis.length_unit_maugis(**contact.without_spacing)
    depth = maugis.approach_unit_maugis(**contact.without_spacing)
    return float(transition), float(length), float(depth)


def _difference(below: Values, above: Values, step: Array) -> Values:
    """Return the difference quotient of values."""
    return Values(*((high - low) / step for low, high in zip(below, above, strict=True)))


def curve_law(name: str, profile: str) -> CurveLaw:
    """Return the force curve of the law jkr, dmt or maugis; dmt and maugis exist for a paraboloid only."""
    others: Mapping[str, CurveLaw] = {DMT: Dmt(), MAUGIS: Maugis()}
    return others.get(name) or Jkr(PROFILES[profile])
