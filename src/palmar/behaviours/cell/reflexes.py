"""The hand's reflex layer: at every servo tick the reflex of highest priority that has a reason owns the hand.

Subsumption: a reflex above takes the hand from those below. From the top: safe stop (the arm's link was interrupted),
sensor fault, overload (a tendon at its limit), grip (every finger presses with the grip torque: stay), palm (a palm bit
closes the hand), and last what the behaviour orders.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from palmar.models.cell_messages import HandFelt, HandMode, HandOrder, Owner

BACK_OFF = 1.0
"""Rate (rad/s) at which an overloaded finger opens."""
GENTLE, FELT = 0.25, 0.3
"""A finger that presses with this share of the grip torque closes on at that share of its rate."""
ENOUGH, DWELL = 0.9, 0.03
"""A grip: every finger presses with this share of the grip torque for so long (s), longer than any impact."""
FULL, ARRIVED = 1.35, 1e-3
"""Curl (rad) beyond which no finger closes; how near (rad) a target counts as reached."""


@dataclass(frozen=True)
class ReflexState:
    """Set-points of the curls (rad); whether the palm reflex or the grip is latched; who owns the hand."""

    set_points: tuple[float, float, float]
    closing: bool = False
    gripped: bool = False
    owner: Owner = Owner.BEHAVIOUR
    at_end: bool = False
    pressing: float = 0.0
    """How long (s) every finger has pressed with the grip torque."""


def reflex_step(state: ReflexState, felt: HandFelt, order: HandOrder, stopped: bool, tick: float) -> ReflexState:
    """One servo tick (s): who owns the hand, and where its set-points go."""
    if order.mode is HandMode.SHAPE and not order.close_on_palm:
        state = replace(state, closing=False, gripped=False) if state.closing or state.gripped else state
    if stopped or felt.dead:
        return replace(state, owner=Owner.SAFE_STOP if stopped else Owner.SENSOR_FAULT)
    if felt.overload:
        opened = [
            c - BACK_OFF * tick if press > order.grip else c
            for c, press in zip(state.set_points, felt.press, strict=True)
        ]
        return replace(state, owner=Owner.OVERLOAD, set_points=(opened[0], opened[1], opened[2]))
    if state.gripped:
        return state if state.owner is Owner.GRIP else replace(state, owner=Owner.GRIP)
    armed = order.close_on_palm and any(felt.palm)
    if state.closing or armed or order.mode is HandMode.CLOSE:
        owner = Owner.BEHAVIOUR if order.mode is HandMode.CLOSE and not order.close_on_palm else Owner.PALM
        return _close(replace(state, closing=True, owner=owner), felt, order, tick)
    points = [_toward(c, goal, order.rate * tick) for c, goal in zip(state.set_points, order.target, strict=True)]
    there = all(abs(c - goal) < ARRIVED for c, goal in zip(points, order.target, strict=True))
    return ReflexState((points[0], points[1], points[2]), owner=Owner.BEHAVIOUR, at_end=there)


def _close(state: ReflexState, felt: HandFelt, order: HandOrder, tick: float) -> ReflexState:
    points = [_further(c, press, order, tick) for c, press in zip(state.set_points, felt.press, strict=True)]
    hard = [press >= ENOUGH * order.grip for press in felt.press]
    pressing = state.pressing + tick if all(hard) else 0.0
    ended = all(c >= FULL for c in points)
    return replace(
        state,
        set_points=(points[0], points[1], points[2]),
        gripped=pressing >= DWELL,
        at_end=ended,
        pressing=pressing,
    )


def _further(curl: float, press: float, order: HandOrder, tick: float) -> float:
    if press >= order.grip:
        return curl
    rate = order.rate if curl < order.soft_from else min(order.rate, order.soft_rate)
    return min(curl + rate * tick * (GENTLE if press > FELT * order.grip else 1.0), FULL)


def _toward(value: float, goal: float, most: float) -> float:
    return value + min(max(goal - value, -most), most)
