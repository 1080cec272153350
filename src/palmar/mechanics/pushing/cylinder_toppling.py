"""A cylinder on a table under one force: does it topple before it slides?

Radius R, weight m g, friction mu_t with the table. The force F lies in a vertical plane through the axis. It has the
horizontal part F sin(lambda), towards the edge about which the cylinder would tip, and the part F cos(lambda) downwards; it
acts at height z, the distance b back from that edge. Moments about the edge, and Coulomb's law at the base:

    tips over at   F_top   = m g R / (z sin(lambda) - b cos(lambda)),
    slides from    F_slide = mu_t m g / (sin(lambda) - mu_t cos(lambda)),

each infinite where its denominator is not positive. Where both are finite, it tips first exactly if

    z > R / mu_t + (b - R) cot(lambda).

Pushed at its side b = 2R, and cot(lambda) lies between -mu and mu, the vertical friction of the pusher. On the top face b
is between 0 and 2R. Derived in docs/derivations/three_tips.md.
"""

from __future__ import annotations

from math import asin, atan, cos, inf, pi, sin, tan
from typing import NamedTuple

from palmar.mechanics.pushing.inertia import GRAVITY


class PushHeights(NamedTuple):
    """Heights (m) of a horizontal push at the side.

    Up to ``surely`` it slides whatever the tip does up or down; up to ``smooth`` it slides without friction at the tip;
    above ``level`` a tip that moves level topples it, since its friction then holds the rising side down.
    """

    surely: float
    smooth: float
    level: float


class Loads(NamedTuple):
    """Force (N) at which the cylinder tips over, and from which it slides; inf: never."""

    topples: float
    slides: float

    @property
    def first(self) -> str:
        """What happens as the force grows: topples, slides or stands."""
        if self.topples == inf and self.slides == inf:
            return "stands"
        return "topples" if self.topples < self.slides else "slides"


def push_heights(radius: float, table_friction: float, friction: float) -> PushHeights:
    """R (1/mu_t - mu), R / mu_t and R (1/mu_t + mu)."""
    if table_friction == 0.0:
        return PushHeights(inf, inf, inf)
    least = radius / table_friction
    return PushHeights(max(least - radius * friction, 0.0), least, least + radius * friction)


def loads(radius: float, mass: float, table_friction: float, at: tuple[float, float], angle: float) -> Loads:
    """``at``: height z and distance b back from the tipping edge (m); ``angle``: lambda (rad) from straight down."""
    z, back = at
    weight = mass * GRAVITY
    lever, excess = z * sin(angle) - back * cos(angle), sin(angle) - table_friction * cos(angle)
    return Loads(
        weight * radius / lever if lever > 0.0 else inf,
        table_friction * weight / excess if excess > 0.0 else inf,
    )


class RimBands(NamedTuple):
    """Distances (m) of a round tip's centre from the cylinder's axis as it comes down on the rim, from R to R + r_t.

    Up to ``lands`` it comes to rest on the rim, whatever its load. Beyond, it slides off and pushes the cylinder away, from
    ``topples`` on it topples it instead; inf: nowhere. ``blocked`` says where it slips but the cylinder stands: the
    tip then cannot go on down.
    """

    lands: float
    blocked: float
    topples: float


def rim_bands(radius: float, height: float, tip: float, frictions: tuple[float, float]) -> RimBands:
    """For friction (tip, table). The contact leans by kappa, sin(kappa) = (distance - R) / r_t; the force by kappa - alpha.

    The cylinder yields where tan(lambda) exceeds mu_t, or 2 R / H if it topples first.
    """
    friction, table_friction = frictions
    alpha = atan(friction)
    topples = toppling_slope(radius, height, table_friction)
    yields = min(table_friction, topples)
    lands = _rim_distance(radius, tip, alpha)
    blocked = _rim_distance(radius, tip, alpha + atan(yields))
    beyond = alpha + atan(topples)
    return RimBands(lands, blocked, _rim_distance(radius, tip, beyond) if beyond < 0.5 * pi else inf)


def _rim_distance(radius: float, tip: float, lean: float) -> float:
    return radius + tip * sin(min(lean, 0.5 * pi))


def rim_lean(radius: float, tip: float, distance: float) -> float:
    """kappa (rad): how far the normal of a round tip on the rim leans from the vertical, its centre at ``distance`` (m)."""
    return asin(min(max((distance - radius) / tip, 0.0), 1.0))


def toppling_slope(radius: float, height: float, table_friction: float) -> float:
    """tan(lambda) beyond which a force on the near rim topples before it slides; inf: none does.

    2 R / H for cylinders higher than 2 R / mu_t, mu_t R / (mu_t H - R) for those higher than R / mu_t.
    """
    if table_friction * height <= radius:
        return inf
    if table_friction * height >= 2.0 * radius:
        return 2.0 * radius / height
    return table_friction * radius / (table_friction * height - radius)


def steepest_landing(radius: float, height: float, off_axis: float) -> float:
    """tan(lambda) up to which a force on the top never topples, ``off_axis`` (m) from the axis towards the tipping edge.

    (R - off_axis) / H: a vertical force never does, wherever on the top it acts.
    """
    return (radius - off_axis) / height


def toppling_height(radius: float, table_friction: float, back: float, angle: float) -> float:
    """z (m) above which a force topples before it slides, where both can happen: R / mu_t + (b - R) cot(lambda)."""
    return radius / table_friction + (back - radius) / tan(angle) if abs(cos(angle)) > 0.0 else radius / table_friction
