"""A plan in words: one line a move, indented by what was felt before."""

from __future__ import annotations

from collections.abc import Iterator
from math import degrees

from palmar.behaviours.policy import Approach, Close, Policy, approaches, is_guaranteed
from palmar.faces.plan_record import sensor_name, why_not
from palmar.studies.plan import Plan
from palmar.studies.plan_trial import Trial


def plan_text(plan: Plan, most: int, trial: Trial | None) -> str:
    """The verdict, the tree, what it rests on, and the trial."""
    policy = plan.found.policy
    if is_guaranteed(policy):
        number = approaches(policy)
        least = "the fewest there are on the grid searched" if plan.found.minimal else "fewer were not searched out"
        verdict = f"Certain, in at most {number} approach{'es' * (number != 1)} ({least})."
    else:
        verdict = f"Not certain: {why_not(plan, most)}."
    lines = [verdict, "", *_moves(policy, plan, "")]
    lines += ["", _assumed(plan)]
    if trial is not None:
        lines += ["", _tried(trial)]
    return "\n".join(lines)


def _assumed(plan: Plan) -> str:
    moved, off = (f"{1e3 * each:.4g} mm" for each in (plan.doubt.displacement, plan.doubt.pose_error))
    return (
        f"Assumed: the object moves at most {moved} before it is felt, the hand is within {off} of where it should be, "
        "and no bit is missed or false."
    )


def _tried(trial: Trial) -> str:
    return (
        f"Trial: {trial.starts} objects drawn, {trial.caught} caught, {trial.lost + trial.surprised} lost, "
        f"{trial.given_up} left by the plan, at most {trial.most_approaches} approaches."
    )


def _moves(policy: Policy, plan: Plan, indent: str) -> Iterator[str]:
    if isinstance(policy, Close):
        at, spare = _place(policy.place.x, policy.place.y), f"{1e3 * policy.place.margin:.3g} mm to spare"
        yield f"{indent}close at {at}, fingers open to {degrees(policy.opening):.3g} deg; {spare}"
    elif isinstance(policy, Approach):
        at, fingers = _place(policy.x, policy.y), f"fingers open to {degrees(policy.opening):.3g} deg"
        yield f"{indent}approach from {at} along y, {fingers}, until a sensor fires or {1e3 * policy.distance:.4g} mm"
        for each in policy.branches:
            yield f"{indent}  {sensor_name(each.sensor, plan) or 'nothing felt'}:"
            yield from _moves(each.then, plan, indent + "    ")
    else:
        left, bottom, right, top = (1e3 * each for each in policy.belief.bounds)
        yield f"{indent}no way on; the object is in x {left:.4g} to {right:.4g}, y {bottom:.4g} to {top:.4g} mm"


def _place(x: float, y: float) -> str:
    return f"({1e3 * x:.4g}, {1e3 * y:.4g}) mm"
