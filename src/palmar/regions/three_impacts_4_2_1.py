"""The capture region of a free disk by three impacts: section 4.2.1, as published and with the right sign in 4.9.

A disk at rest is caught if it stays below the line of the fingertips until they stand 2 R apart. The construction takes
the one disk that meets the same finger three times, the third time with the tip at just that moment, and joins its three
contacts, polar about the base joint, by chords. Their image under contact -> centre, (r, phi) -> the same finger's line
at distance R, bounds the centre region; a horizontal chord joins its end to the axis. Starts that a finger would touch
before the first of the three contacts, at angles below phi0, are left out.

Chords in the contact plane are the join that kept every promise in simulation where R is at most ``SOUND`` of the
largest disk (docs/derivations/zero_gravity.md); distances linear in the angle, which bulge farther, did not.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import ceil, cos, sin, sqrt

import numpy as np
import shapely
from numpy.typing import NDArray
from shapely import LineString, affinity

from palmar.geometry.planar_set import EMPTY, areal, grown
from palmar.mechanics.impact.three_impacts_4_2_1 import Construction, construction
from palmar.regions.published_3_3_1 import PublishedSets, closed_by_chord, in_front

Floats = NDArray[np.float64]
SOUND = 0.8
"""R / D up to which simulation found no broken promise of the corrected region, at any restitution."""


@dataclass(frozen=True)
class Chord:
    """Contacts on the segment from ``first`` to ``last`` (m, hand frame), and the centres R off the finger's line there."""

    base: tuple[float, float]
    first: Floats
    last: Floats
    radius: float

    def flattened(self, tolerance: float) -> tuple[Floats, float]:
        """Centres (N, 2) at equal steps of the contact, and the bound (m) of the polyline's distance from the curve.

        With p the distance of the base from the segment's line and q that of the contact, c'' = R n'' per length of
        contact squared, |n''| = p sqrt(4 q^2 - 3 p^2) / q^4 <= 2 p / q^3.
        """
        span = self.last - self.first
        size = float(np.hypot(*span))
        to_first, to_last = self.first - self.base, self.last - self.base
        off = abs(float(span[0] * to_first[1] - span[1] * to_first[0])) / size
        inside = float(-to_first @ span) > 0.0 > float(-to_last @ span)
        nearest = off if inside else min(float(np.hypot(*to_first)), float(np.hypot(*to_last)))
        sharpest = 2.0 * self.radius * off / nearest**3
        steps = max(1, ceil(size * sqrt(sharpest / (8.0 * tolerance))))
        contacts = self.first + np.linspace(0.0, 1.0, steps + 1)[:, None] * span
        along = contacts - self.base
        along /= np.hypot(along[:, 0], along[:, 1])[:, None]
        normal = np.stack([-along[:, 1], along[:, 0]], axis=1)
        return contacts + self.radius * normal, sharpest * (size / steps) ** 2 / 8.0


def contact_points(half_palm: float, numbers: Construction) -> Floats:
    """The three contacts (3, 2) in the hand frame (m)."""
    polar = (
        (numbers.first, numbers.first_angle),
        (numbers.second, numbers.second_angle),
        (numbers.third, numbers.end),
    )
    return np.array([[half_palm + r * cos(angle), r * sin(angle)] for r, angle in polar])


def three_impact_sets(
    half_palm: float, finger_length: float, radius: float, opening: float, tolerance: float, *, published: bool
) -> PublishedSets:
    """Centre, contact and whole region for a hand that starts at base angle ``opening`` (rad), lengths in m.

    The polygons lie inside the curves. Starts that overlap the palm or the open fingers are cut away.
    """
    numbers = construction(half_palm, finger_length, radius, published=published)
    if numbers is None or numbers.end <= opening:
        return PublishedSets(EMPTY, EMPTY, EMPTY, 0.0)
    points = contact_points(half_palm, numbers)
    pieces = [Chord((half_palm, 0.0), *ends, radius).flattened(tolerance) for ends in pairwise(points)]
    line, bound = np.concatenate([piece for piece, _ in pieces]), max(each for _, each in pieces)
    first = max(numbers.first_angle, opening)
    reach = half_palm + finger_length + radius
    # The curve bends away from the region: its polyline is moved inwards by as much as it may lie outside.
    strip = LineString(line).buffer(1.001 * bound, cap_style="square", join_style="mitre")
    strips = shapely.union(strip, affinity.scale(strip, xfact=-1.0, origin=(0.0, 0.0)))
    before = in_front(half_palm, first, radius, reach)
    centre = areal(shapely.difference(shapely.intersection(closed_by_chord(line), before), strips))
    contact = areal(shapely.intersection(closed_by_chord(points), in_front(half_palm, first, 0.0, reach)))
    whole, grown_bound = grown(centre, radius, tolerance)
    return PublishedSets(centre, contact, whole, 2.1 * bound + grown_bound)
