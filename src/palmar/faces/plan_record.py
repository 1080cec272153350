"""A plan as a JSON-ready record: SI units and radians, every place in the frame of the hand before the move."""

from __future__ import annotations

from typing import Any

from palmar.behaviours.policy import Approach, Close, Lost, Policy, approaches, closings, is_guaranteed, leaves
from palmar.behaviours.superposed import left_over
from palmar.geometry.planar_set import areal, coordinates
from palmar.studies.plan import Plan, Rule
from palmar.studies.plan_trial import Trial

Record = dict[str, Any]


def plan_record(plan: Plan, most: int, trial: Trial | None) -> Record:
    """The contract's fields, what the search did, what is assumed, and the trial if there was one."""
    policy = plan.found.policy
    sure = is_guaranteed(policy)
    record: Record = {
        "guaranteed": sure,
        "guarantee": plan.guarantee.value,
        "rule": plan.rule.value,
        "approaches_max": approaches(policy) if sure else None,
        "policy": policy_record(policy, plan),
        "reason": None if sure else why_not(plan, most),
        "approaches_least": plan.found.least,
        "minimal": plan.found.minimal,
        "search_exhausted": plan.found.exhausted,
        "closings_max": closings(policy) if sure else None,
        "approaches_looked_at": plan.found.sweeps,
        "sensors": [each.name for each in plan.stretches],
        "displacement_m": plan.doubt.displacement,
        "pose_error_m": plan.doubt.pose_error,
        "left_over_m2": left_over(policy),
    }
    if trial is not None:
        record["trial"] = {
            "starts": trial.starts,
            "caught": trial.caught,
            "lost": trial.lost + trial.surprised,
            "given_up": trial.given_up,
            "approaches_max": trial.most_approaches,
        }
    return record


def policy_record(policy: Policy, plan: Plan) -> Record:
    """One move and what follows it."""
    belief = coordinates(areal(policy.belief))
    if isinstance(policy, Close):
        record: Record = {
            "move": "close",
            "turn_rad": policy.turn,
            "at_m": [policy.place.x, policy.place.y],
            "opening_rad": policy.opening,
            "margin_m": policy.place.margin,
            "belief": belief,
        }
        if policy.otherwise is not None:
            record["if_missed"] = policy_record(policy.otherwise, plan)
        return record
    if isinstance(policy, Lost):
        return {"move": "none", "belief": belief}
    return {
        "move": "approach",
        "turn_rad": policy.turn,
        "at_m": [policy.x, policy.y],
        "opening_rad": policy.opening,
        "distance_m": policy.distance,
        "belief": belief,
        "outcomes": [
            {"sensor": sensor_name(each.sensor, plan), "then": policy_record(each.then, plan)}
            for each in policy.branches
        ],
    }


def sensor_name(sensor: int | None, plan: Plan) -> str | None:
    """As in a case file; None if nothing fires."""
    return None if sensor is None else plan.stretches[sensor].name


def why_not(plan: Plan, most: int) -> str:
    """Why there is no plan, in a line."""
    ends = [each for each in leaves(plan.found.policy) if isinstance(each, Lost)]
    size = f"{1e3 * max(each.belief.bounds[2] - each.belief.bounds[0] for each in ends):.4g} mm wide"
    if plan.rule is Rule.CLOSINGS:
        return (
            f"what is known does not lie in islands, each in the closing region, at which the hand touches no other: "
            f"the object would be pushed unfelt; the belief that is left is {size}"
        )
    if not plan.stretches:
        return f"the hand has no sensors and the belief, {size}, does not fit into its closing region at any place"
    if not isinstance(plan.found.policy, Approach):
        return (
            f"no approach was found that feels the object before an unfelt part may touch it; the belief stays {size}"
        )
    if plan.rule is Rule.STRIPS:
        return f"beside the strips a belief is left, {size}"
    more = "" if plan.found.exhausted else ", as far as was searched"
    return (
        f"no plan within {most} approaches{more}: in {len(ends)} of its ends the object is known no better than {size}"
    )
