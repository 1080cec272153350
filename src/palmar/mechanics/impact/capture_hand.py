"""Hands for the capture kernel: joint rates constant by phases, each finger until the end of its travel, then walls."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import inf, pi

import numpy as np
from numpy.typing import ArrayLike, NDArray

from palmar.errors import InputError
from palmar.mechanics.impact.enclosed import closed_since, meets_at
from palmar.mechanics.impact.finger_motion import FINGER_WIDTH, MOST_LINKS, CaptureHand

Floats = NDArray[np.float64]
SAMPLES, REFINEMENTS = 20_001, 4
CLOSE = 1e-13
"""Gap, in hand reaches, at which fingers of one plane have met."""


def closing_hand(
    half_palm: float, links: ArrayLike, radius: float, half_thickness: float = 0.0, *, first: float = 0.0,
    rate: float = 1.0, limit: float = pi, offsets: ArrayLike | None = None, ratios: ArrayLike | None = None,
    delay: float = 0.0, duration: float = inf, colliding: bool = False,
) -> CaptureHand:  # fmt: skip
    """Both fingers turn alike from the base angle ``first`` at ``rate`` (rad/s), from ``delay`` (s) on for ``duration``.

    They end where a link reaches the palm, or at the base angle ``limit``, or, ``colliding``, where they meet.
    ``offsets`` and ``ratios`` (links - 1): distal joint j, counted from straight, is at offset + ratio (psi - first).
    """
    lengths = np.atleast_1d(np.asarray(links, dtype=float))
    rest = len(lengths) - 1
    bends = np.zeros(rest) if offsets is None else np.asarray(offsets, dtype=float)
    turns = np.zeros(rest) if ratios is None else np.asarray(ratios, dtype=float)
    if bends.shape != (rest,) or turns.shape != (rest,):
        raise InputError("offsets and ratios", None, f"one entry for each of the {rest} distal joints")
    joints, rates = np.append(first, bends), rate * np.append(1.0, turns)
    programme = [(delay, np.zeros((2, rest + 1))), (duration, np.tile(rates, (2, 1)))]
    return programmed_hand(
        half_palm, lengths, radius, half_thickness, np.tile(joints, (2, 1)), programme, limit=limit, colliding=colliding
    )


def programmed_hand(
    half_palm: float, links: ArrayLike, radius: float, half_thickness: float, joints: ArrayLike,
    programme: Sequence[tuple[float, ArrayLike]], *, limit: float = pi, colliding: bool = False,
) -> CaptureHand:  # fmt: skip
    """A hand whose ``joints`` (2, links; right, left; from straight, the base's from the palm line) turn by a programme.

    ``programme``: pairs (duration in s, joint rates (2, links) in rad/s), the last duration may be infinite. A finger ends
    where one of its links, pointing inward, comes down on the palm line, or where its base joint reaches ``limit``; then it
    is at rest for good. ``colliding`` fingers both end where they touch. Straight, stiff links count as one.
    """
    lengths = np.atleast_1d(np.asarray(links, dtype=float))
    angles = np.cumsum(np.asarray(joints, dtype=float), axis=1)
    turns = [(float(each), np.cumsum(np.asarray(rates, dtype=float), axis=1)) for each, rates in programme]
    _check(half_palm, lengths, radius, half_thickness, angles, turns)
    lengths, angles, turns = _merge_straight(lengths, angles, turns)
    hand = CaptureHand(
        float(half_palm), lengths, float(half_thickness), float(radius),
        np.zeros(1), angles[None].copy(), np.zeros((1, *angles.shape)), np.zeros((0, 3)),
    )  # fmt: skip
    ended = np.zeros(2, dtype=bool)
    for duration, rates in turns:
        hand, ended = _through(hand, duration, rates, ended, limit, colliding)
    return _with_closures(hand)


def _check(
    half_palm: float, lengths: Floats, radius: float, half_thickness: float, angles: Floats,
    turns: list[tuple[float, Floats]],
) -> None:  # fmt: skip
    if not 1 <= len(lengths) <= MOST_LINKS or not (lengths > 0.0).all():
        raise InputError("links", str(lengths.tolist()), f"1 to {MOST_LINKS} links of positive length")
    if not (half_palm > 0.0 and radius > 0.0 and half_thickness >= 0.0):
        raise InputError(
            "half palm, radius and half thickness",
            f"{half_palm}, {radius}, {half_thickness}",
            "positive, the last not negative",
        )
    if any(each.shape != (2, len(lengths)) for each in (angles, *(rates for _, rates in turns))):
        raise InputError("joints and rates", None, f"arrays of the shape (2, {len(lengths)})")
    if any(duration < 0.0 for duration, _ in turns):
        raise InputError("durations", None, "not negative")


def _merge_straight(
    lengths: Floats, angles: Floats, turns: list[tuple[float, Floats]]
) -> tuple[Floats, Floats, list[tuple[float, Floats]]]:
    """Without the joints that are straight and stay so on both fingers."""
    kept = [0]
    merged = [float(lengths[0])]
    for j in range(1, len(lengths)):
        if all(np.array_equal(each[:, j], each[:, j - 1]) for each in (angles, *(rates for _, rates in turns))):
            merged[-1] += float(lengths[j])
        else:
            kept.append(j)
            merged.append(float(lengths[j]))
    whole = [(duration, np.ascontiguousarray(rates[:, kept])) for duration, rates in turns]
    return np.array(merged), np.ascontiguousarray(angles[:, kept]), whole


def _through(
    hand: CaptureHand, duration: float, rates: Floats, ended: NDArray[np.bool_], limit: float, colliding: bool
) -> tuple[CaptureHand, NDArray[np.bool_]]:
    """The hand with the phases of one row of the programme, and which of its fingers have ended for good."""
    left = duration
    while left > 0.0:
        now = np.where(ended[:, None], 0.0, rates)
        if not now.any():
            return (_with_phase(hand, np.zeros_like(now), left) if np.isfinite(left) else hand), ended
        stops = np.array([_end_of_travel(hand, f, now[f], limit, left) for f in range(2)])
        part = min(left, float(stops.min()))
        if not np.isfinite(part):
            raise InputError("duration", "inf", "finite for a motion without an end")
        met = _meeting(hand, now, part) if colliding and not ended.all() else inf
        part = min(part, met)
        hand = _with_phase(hand, now, part)
        ended = ended | (stops <= part) | (met <= part)
        left -= part
    return hand, ended


def _with_phase(hand: CaptureHand, rates: Floats, duration: float) -> CaptureHand:
    """The hand that goes on with a phase before it comes to rest."""
    if duration == 0.0:
        return hand
    return hand._replace(
        times=np.append(hand.times, hand.times[-1] + duration),
        angles=np.concatenate([hand.angles, hand.angles[-1:] + duration * rates]),
        rates=np.concatenate([hand.rates[:-1], rates[None], np.zeros((1, *rates.shape))]),
    )


def _end_of_travel(hand: CaptureHand, f: int, rates: Floats, limit: float, left: float) -> float:
    """Time until the finger's base reaches the limit or one of its links the palm line; inf if not within ``left``."""
    angles, h, rate = hand.angles[-1, f], hand.half_thickness, float(rates[0])
    at_limit = max((limit - float(angles[0])) / rate, 0.0) if rate > 0.0 else inf
    high = min(left, at_limit)
    if not np.isfinite(high):
        return inf

    def down(time: Floats) -> NDArray[np.bool_]:
        now = angles + rates * time[:, None]
        y = np.cumsum(hand.lengths * np.sin(now), axis=1)
        found: NDArray[np.bool_] = np.logical_or.reduce((y <= h) & (now > 0.5 * pi) & (rates > 0.0), axis=1)
        return found

    low = 0.0
    for _ in range(REFINEMENTS):
        time = np.linspace(low, high, SAMPLES)
        at = down(time)
        if not at.any():
            break
        k = int(np.argmax(at))
        low, high = float(time[max(k - 1, 0)]), float(time[k])
    else:
        return high
    return at_limit if at_limit <= left else inf


def _meeting(hand: CaptureHand, rates: Floats, part: float) -> float:
    """Time until the fingers touch, within ``part``; else inf."""
    ahead = _with_phase(hand, rates, part)
    phase = len(ahead.times) - 2
    chain = np.zeros((2 * len(hand.lengths) + 2, 2))
    start = float(ahead.times[phase])
    met = meets_at(ahead, phase, float(ahead.times[-1]), CLOSE * hand.reach, np.zeros((2, FINGER_WIDTH)), chain) - start
    return met if met < part else inf


def _with_closures(hand: CaptureHand) -> CaptureHand:
    """The hand with the times from which on its loops are closed, at which phases are divided."""
    fingers, chain = np.zeros((2, FINGER_WIDTH)), np.zeros((2 * len(hand.lengths) + 2, 2))
    rows = []
    for i in range(2 * len(hand.lengths) - 1):
        for j in range(i + 2, 2 * len(hand.lengths) + 1):
            since = closed_since(hand, i, j, fingers, chain)
            if np.isfinite(since):
                rows.append((since, float(i), float(j)))
    return divided(hand, [row[0] for row in rows])._replace(closures=np.array(rows).reshape(-1, 3))


def divided(hand: CaptureHand, moments: Iterable[float]) -> CaptureHand:
    """The same motion with phases that also begin at these moments (s), which are noted in a run's events."""
    times, angles, rates = [*hand.times], [*hand.angles], [*hand.rates]
    for since in sorted(set(moments) - set(times)):
        k = int(np.searchsorted(times, since)) - 1
        times.insert(k + 1, since)
        angles.insert(k + 1, angles[k] + (since - times[k]) * rates[k])
        rates.insert(k + 1, rates[k])
    return hand._replace(times=np.array(times), angles=np.array(angles), rates=np.array(rates))
