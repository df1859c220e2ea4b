# SPDX-License-Identifier: Apache-2.0
"""A chord through a spiral in ball arithmetic, cut into pieces on which the sign of the indicator is known.

The solid is a union of *parts*: two balls, and for each whole number m the disks of all s = m + theta in [0, T]. Each
part has a function g with the sign of its indicator: D^2 - r^2, smooth along the chord. The azimuth theta is continued
along the chord without a jump, so a part needs no branch; that all whole numbers m are tried makes up for which
continuation it is. Beyond the half planes of both ends a disk does not count. In the half plane itself it has the g
of the ball about that end. Inside of the distance c = min(R - r) from the axis there is no disk.
"""

from collections.abc import Iterator
from typing import NamedTuple

from flint import arb

LEAF = arb(2) ** -68  # cells shorter than that are not cut any more
FINE = arb(2) ** -65  # width of a refined root
ZERO, ONE, HALF = arb(0), arb(1), arb(0.5)
# Places of the first cells. No round numbers, where simple scenes have roots: signs must be known there.
CUTS = (0.0, 0.1317432, 0.2561391, 0.3792163, 0.5031127, 0.6278153, 0.7519329, 0.8766131, 1.0)


def root(square: arb) -> arb:
    """Square root of the part of a ball that is not negative."""
    if square > ZERO:
        return square.sqrt()
    return ZERO.union(max(square.upper(), ZERO).sqrt())


def length(*legs: arb) -> arb:
    """Square root of the sum of squares."""
    return root(sum((leg * leg for leg in legs), ZERO))


def full_turn() -> arb:
    """2 pi."""
    return 2 * arb.pi()


def turns_of(x: arb, y: arb) -> arb:
    """Azimuth of a box that does not hold the axis, in turns: beyond -1/2 and below 3/2, continuous over the box."""
    a, b = x.mid(), y.mid()
    if abs(a) >= abs(b):
        if a > 0:
            return arb.atan2(y, x) / full_turn()
        return HALF + arb.atan2(-y, -x) / full_turn()
    if b > 0:
        return arb(0.25) + arb.atan2(-x, y) / full_turn()
    return arb(0.75) + arb.atan2(x, -y) / full_turn()


def nearest(found) -> arb:
    """The least of enclosures, each with a flag: whether it counts for certain (the first one does)."""
    low, high = found[0][0].lower(), found[0][0].upper()
    if not all(value.is_finite() for value, _ in found):
        raise ArithmeticError("an enclosure is not finite")  # no comparison with it would tell
    for value, certain in found[1:]:
        low = min(low, value.lower())
        if certain:
            high = min(high, value.upper())
    return low.union(high)


class Solid:
    """The surface's parameters as balls of the present precision.

    balls  centre and radius at both ends
    clear  lower bound of the distance between axis and solid
    Raises ValueError where the length, a radius, or the distance from the axis is not positive.
    """

    def __init__(self, surface):
        names = ("R", "r", "pitch", "turns", "R_growth", "r_growth")
        self.R, self.r, self.pitch, self.turns, self.R_growth, self.r_growth = (arb(getattr(surface, n)) for n in names)
        self.range = (self.turns / 2).union(ZERO).union(self.turns)
        self.balls, distances = [], []
        for s in (ZERO, self.turns):
            a, radius = self.R + self.R_growth * s, self.r + self.r_growth * s
            self.balls.append(((a * (2 * s).cos_pi(), a * (2 * s).sin_pi(), self.pitch * s), radius))
            distances.append(a - radius)
            if not (radius > 0 and a > radius):
                raise ValueError(f"at s = {s.str(6)} the tube's radius is {radius.str(6)}, the curve's {a.str(6)}")
        if not self.turns > 0:
            raise ValueError(f"spiral of {self.turns.str(6)} turns")
        self.clear = min(v.lower() for v in distances)

    def within(self, s: arb) -> tuple[arb | None, bool]:
        """The part of ``s`` that is on the spiral, None if there is none, and whether that is all of it."""
        if s < ZERO or s > self.turns:
            return None, False
        if s >= ZERO and s <= self.turns:
            return s, True
        return s.intersection(self.range), False

    def disks(self, rho: arb, theta: arb, z: arb) -> Iterator[tuple[arb, bool]]:
        """Of each turn that may pass the points: enclosure of D - r, and whether it passes all of them."""
        for m in turns_below(self.turns):
            s, certain = self.within(theta + m)
            if s is not None:
                across, along = rho - self.R - self.R_growth * s, z - self.pitch * s
                yield length(across, along) - self.r - self.r_growth * s, certain


def turns_below(turns: arb) -> range:
    """The whole numbers m for which m + theta may be in [0, turns], -1 <= theta <= 3/2."""
    return range(-2, int(turns.upper().fmpq().ceil()) + 2)


class Place:
    """A point of a chord, or all points between two of them: balls in each of the slots.

    t      place on the chord
    u      distance from the foot of the axis' perpendicular, along the chord's projection
    rho    distance from the axis
    theta  azimuth in turns
    z      height
    """

    __slots__ = ("t", "u", "rho", "theta", "z", "rates")

    def __init__(self, t, u, rho, theta, z):
        self.t, self.u, self.rho, self.theta, self.z, self.rates = t, u, rho, theta, z, None


class Ball:
    """The part of the solid that is the ball about an end: g is a quadratic polynomial of t."""

    def __init__(self, line, centre, radius):
        offset = [arb(a) - b for a, b in zip(line.h, centre, strict=True)]
        self.radius = radius
        self.square = arb(sum(v * v for v in line.d))
        self.linear = sum((arb(v) * o for v, o in zip(line.d, offset, strict=True)), ZERO)
        self.constant = sum((o * o for o in offset), ZERO) - radius * radius

    def value(self, at: Place) -> arb:
        """g."""
        return (self.square * at.t + 2 * self.linear) * at.t + self.constant

    def slope(self, at: Place) -> arb:
        """Its derivative by t."""
        return 2 * (self.square * at.t + self.linear)

    def size(self, at: Place) -> arb:
        """r."""
        return self.radius

    def counts(self, at: Place) -> int:
        """1: everywhere."""
        return 1


class Tube:
    """The part of the solid that turn m is."""

    def __init__(self, line, m):
        self.line, self.solid, self.m = line, line.solid, m

    def value(self, at: Place) -> arb:
        """g."""
        solid, s = self.solid, at.theta + self.m
        across, along = at.rho - solid.R - solid.R_growth * s, at.z - solid.pitch * s
        size = solid.r + solid.r_growth * s
        return across * across + along * along - size * size

    def slope(self, at: Place) -> arb:
        """Its derivative by t."""
        solid, s = self.solid, at.theta + self.m
        outwards, turning = self.line.rates(at)
        across, along = at.rho - solid.R - solid.R_growth * s, at.z - solid.pitch * s
        size = solid.r + solid.r_growth * s
        change = across * (outwards - solid.R_growth * turning) + along * (self.line.dz - solid.pitch * turning)
        return 2 * (change - size * solid.r_growth * turning)

    def size(self, at: Place) -> arb:
        """r, where the part counts."""
        s, _ = self.solid.within(at.theta + self.m)
        return self.solid.r + self.solid.r_growth * s

    def counts(self, at: Place) -> int:
        """1: everywhere there, -1: nowhere, 0: not known, or in places."""
        s = at.theta + self.m
        if s >= ZERO and s <= self.solid.turns:
            return 1
        return -1 if s < ZERO or s > self.solid.turns else 0


class Line:
    """A chord h + t (e - h) with exact ends (fractions).

    Raises ValueError if it has no length.
    """

    def __init__(self, solid: Solid, h, e):
        self.solid, self.h, self.d = solid, h, [b - a for a, b in zip(h, e, strict=True)]
        if not any(self.d):
            raise ValueError("a chord without length")
        x, y, dx, dy = h[0], h[1], self.d[0], self.d[1]
        self.z, self.dz = arb(h[2]), arb(self.d[2])
        cross = dx * y - dy * x
        if dx or dy:
            self.speed = arb(dx * dx + dy * dy).sqrt()
            self.start = arb(x * dx + y * dy) / self.speed
            self.theta = turns_of(arb(dx), arb(dy))
        else:  # along the axis: ahead is away from it
            self.speed, self.start = ZERO, arb(x * x + y * y).sqrt()
            self.theta = turns_of(arb(x), arb(y)) if x or y else ZERO
        self.left = 1 if cross > 0 else -1 if cross < 0 else 0
        self.aside = arb(abs(cross)) / self.speed if cross else ZERO
        self.swirl = -arb(cross) / full_turn()
        self.parts: list[Ball | Tube] = [Ball(self, *ball) for ball in solid.balls]
        self.parts += [Tube(self, m) for m in turns_below(solid.turns)]

    def place(self, t: arb) -> Place:
        """The point at an exact t."""
        u = self.start + self.speed * t
        rho = length(u, self.aside)
        if self.left:
            theta = self.theta + self.left * arb.atan2(self.aside, u) / full_turn()
        else:  # through the axis, or along it; at the axis itself it does not matter
            theta = self.theta if u > ZERO else self.theta + HALF
        return Place(t, u, rho, theta, self.z + self.dz * t)

    def between(self, low: Place, high: Place) -> Place:
        """All points between two.

        Height and azimuth change in one direction only (where a chord meets the axis the azimuth changes by half a turn
        at once, and both are among the points), and the distance from the axis has one minimum.
        """
        u, rho = low.u.union(high.u), low.rho.union(high.rho)
        if u.contains(ZERO):
            rho = rho.union(self.aside)
        return Place(low.t.union(high.t), u, rho, low.theta.union(high.theta), low.z.union(high.z))

    def rates(self, at: Place) -> tuple[arb, arb]:
        """Change of rho and of s with t; not finite, and so without a sign, where the axis may be among the points."""
        if at.rates is None:
            at.rates = at.u * self.speed / at.rho, self.swirl / at.rho / at.rho
        return at.rates

    def sign(self, at: Place, parts) -> int:
        """The sign of the least g of the parts at a point; 0: not known."""
        positive, no_tubes = True, at.rho < self.solid.clear
        for part in parts:
            if no_tubes and isinstance(part, Tube):
                continue
            value, counts = part.value(at), part.counts(at)
            if value < ZERO and counts > 0:
                return -1
            positive &= value > ZERO or counts < 0
        return 1 if positive else 0


class Piece(NamedTuple):
    """A part of a chord between two points.

    before, after  the sign of the indicator at both; equal: everywhere between them, different: it changes once between
                   them, both 0: not known
    parts          those on which a change depends
    """

    low: Place
    high: Place
    before: int
    after: int
    parts: tuple = ()


def pieces(line: Line) -> Iterator[Piece]:
    """The chord's pieces in order of t, each determined when it is asked for."""
    ends = [line.place(arb(t)) for t in CUTS]
    stack = [(low, high, line.parts) for low, high in zip(ends[-2::-1], ends[:0:-1], strict=True)]
    while stack:
        low, high, parts = stack.pop()
        middle = line.place(((low.t + high.t) / 2).mid())
        signs, left = _settled(line, low, middle, high, parts)
        if signs:
            before, after = signs
            yield Piece(low, high, before, after, tuple(left))
        elif high.t - low.t < LEAF or any(_is_flat(part, (middle, low, high)) for part in left):
            yield Piece(low, high, 0, 0)
        else:
            stack += [(middle, high, left), (low, middle, left)]


def _is_flat(part, places) -> bool:
    """Whether g is zero in several places, as far as the balls can tell: then shorter cells tell no more."""
    return all(part.value(place).contains(ZERO) for place in places)


INSIDE, OUTSIDE = (-1, -1), (1, 1)


def _settled(line: Line, low: Place, middle: Place, high: Place, parts):
    """The signs at both ends of a cell, None where they are not known, and the parts that may be zero or less."""
    span = line.between(low, high)
    if span.rho < line.solid.clear:
        parts = [part for part in parts if isinstance(part, Ball)]
    left, slopes = [], []
    for part in parts:
        counts = part.counts(span)
        if counts < 0:
            continue
        least = most = part.value(span)
        slope = direction = 0
        if not (least > ZERO or most < ZERO):
            slope = part.slope(span)
            direction = 1 if slope > ZERO else -1 if slope < ZERO else 0
            if direction:
                least, most = (part.value(p) for p in ((low, high) if direction > 0 else (high, low)))
            else:
                least = most = part.value(middle) + slope * (span.t - middle.t)
        if least > ZERO:
            continue
        if most < ZERO and counts > 0:
            return INSIDE, []
        left.append(part)
        slopes.append(direction)
    if not left:
        return OUTSIDE, []
    if slopes[0] and all(v == slopes[0] for v in slopes):  # the least of them has one zero at most, as each has
        before, after = line.sign(low, left), line.sign(high, left)
        if before and after:
            return (before, after), left
    return None, left


def refine(line: Line, piece: Piece) -> arb:
    """The place of a sign change, as narrow as `FINE`: Newton's method for one part, halving for several."""
    low, high, parts = piece.low, piece.high, list(piece.parts)
    while high.t - low.t > FINE:
        middle = line.place(((low.t + high.t) / 2).mid())
        parts = [p for p in parts if not (p.value(low) > ZERO and p.value(high) > ZERO)] if len(parts) > 1 else parts
        if len(parts) == 1:
            found = middle.t - parts[0].value(middle) / parts[0].slope(line.between(low, high))
            a, b = max(low.t, found.lower()), min(high.t, found.upper())
            if b - a < (high.t - low.t) / 2:
                low, high = line.place(a), line.place(b)
                continue
        sign = line.sign(middle, parts)
        if not sign:
            break
        low, high = (middle, high) if sign == piece.before else (low, middle)
    return low.t.union(high.t)


def sampled(line: Line, t: arb) -> arb:
    """The indicator at a place."""
    at = line.place(t)
    return value_over(line, at, at)


def value_over(line: Line, low: Place, high: Place) -> arb:
    """Enclosure of the indicator between two points.

    Off the axis its excess is their distance times what is small near the surface: the indicator, or that distance.
    """
    span, middle = line.between(low, high), line.place(((low.t + high.t) / 2).mid())
    with_tubes = span.rho > ZERO
    found = []
    for part in line.parts[: None if with_tubes else 2]:
        counts = part.counts(span)
        if counts >= 0:
            value = part.value(middle) + part.slope(span) * (span.t - middle.t)
            size = part.size(span)
            found.append((value / (root(value + size * size) + size), counts > 0))
    if not with_tubes:
        found += line.solid.disks(span.rho, HALF.union(ZERO).union(ONE), span.z)
    return nearest(found)
