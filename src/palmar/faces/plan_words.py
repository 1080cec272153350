"""A plan in words: one line a move, indented by what was felt before."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees

from palmar.behaviours.policy import Approach, Close, Policy, approaches, closings, is_guaranteed
from palmar.faces.plan_record import sensor_name, why_not
from palmar.models.guarantee import Guarantee
from palmar.studies.plan import Plan, Rule
from palmar.studies.plan_trial import Trial

SAMPLED = " The regions closed in are simulated at points, not proven; the object is too heavy to be moved by touch."


def plan_text(plan: Plan, most: int, trial: Trial | None) -> str:
    """The verdict, the tree, what it rests on, and the trial."""
    policy = plan.found.policy
    verdict = _sure(plan) if is_guaranteed(policy) else f"Not certain: {why_not(plan, most)}.{_least(plan, most)}"
    lines = [verdict, "", *_moves(policy, plan, "")]
    lines += ["", _assumed(plan)]
    if trial is not None:
        lines += ["", _tried(trial)]
    return "\n".join(lines)


def _sure(plan: Plan) -> str:
    number, tries = approaches(plan.found.policy), closings(plan.found.policy)
    many = f"{number} approach{'es' * (number != 1)}"
    if plan.rule is Rule.CLOSINGS:
        return f"Certain, with at most {tries} closing{'s' * (tries != 1)} and no touch."
    if plan.found.minimal:
        return f"Certain, in at most {many} (no plan needs fewer)."
    return f"Certain, in at most {many} (no plan needs fewer than {plan.found.least}, as far as was proved)."


def _least(plan: Plan, most: int) -> str:
    """What is proved, whatever the offsets and distances."""
    if plan.found.least == 0 or plan.rule is Rule.CLOSINGS:
        return ""
    proved = "that none is there" if plan.found.least > most else f"that none has fewer than {plan.found.least}"
    hint = " Strips may do: --rule strips." if plan.rule is Rule.FEWEST and plan.stretches else ""
    return f" It is proved{' of all offsets and distances' if plan.found.least > 1 else ''} {proved}.{hint}"


def _assumed(plan: Plan) -> str:
    moved, off = (f"{1e3 * each:.4g} mm" for each in (plan.doubt.displacement, plan.doubt.pose_error))
    return (
        f"Assumed: the object moves at most {moved} before it is felt, the hand is within {off} of where it should be, "
        f"and no bit is missed or false.{SAMPLED if plan.guarantee is Guarantee.SAMPLED else ''}"
    )


def _tried(trial: Trial) -> str:
    return (
        f"Trial: {trial.starts} objects drawn, {trial.caught} caught, {trial.lost + trial.surprised} lost, "
        f"{trial.given_up} left by the plan, at most {trial.most_approaches} approaches."
    )


def _moves(policy: Policy, plan: Plan, indent: str) -> Iterator[str]:
    """What follows if nothing is felt, or caught, is not indented: it is the next thing that the hand does."""
    if isinstance(policy, Close):
        at, spare = _place(policy.place.x, policy.place.y), f"{1e3 * policy.place.margin:.3g} mm to spare"
        fingers = f"fingers open to {degrees(policy.opening):.3g} deg"
        yield f"{indent}{_turn(policy.turn)}close at {at}, {fingers}; {spare}"
        if policy.otherwise is not None:
            yield f"{indent}  fingers closed on nothing: go on"
            yield from _moves(policy.otherwise, plan, indent)
    elif isinstance(policy, Approach):
        at, fingers = _place(policy.x, policy.y), f"fingers open to {degrees(policy.opening):.3g} deg"
        until = f"until a sensor fires or {1e3 * policy.distance:.4g} mm"
        yield f"{indent}{_turn(policy.turn)}approach from {at} along y, {fingers}, {until}"
        for each in policy.branches:
            if each.sensor is not None:
                yield f"{indent}  {sensor_name(each.sensor, plan)}:"
                yield from _moves(each.then, plan, indent + "    ")
        for each in policy.branches:
            if each.sensor is None:
                yield f"{indent}  nothing felt: go on"
                yield from _moves(each.then, plan, indent)
    else:
        left, bottom, right, top = (1e3 * each for each in policy.belief.bounds)
        yield f"{indent}no way on; the object is in x {left:.4g} to {right:.4g}, y {bottom:.4g} to {top:.4g} mm"


def _turn(angle: float) -> str:
    return "" if angle == 0.0 else f"turn by {degrees(angle):.4g} deg, "


def _place(x: float, y: float) -> str:
    return f"({1e3 * x:.4g}, {1e3 * y:.4g}) mm"
