"""What is said beside a region as JSON-ready records: SI units and radians, places in the hand frame."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from palmar.models.case import Case
from palmar.regions.opening import Openings
from palmar.studies.capture import Capture, Chance
from palmar.studies.final_angles import FinalAngles
from palmar.studies.final_poses import LEVELS, FinalPoses
from palmar.studies.pre_opening import PreOpening, time_saved, tip_gap
from palmar.studies.region_questions import Answers
from palmar.studies.validity import Validity

Record = dict[str, Any]


def answers_record(case: Case, given: Answers) -> Record:
    """The fields ``capture``, ``pre_opening`` and ``ends`` where asked for (null where unknown), and ``validity`` always."""
    record: Record = {}
    if given.capture is not None:
        record["capture"] = capture_record(given.capture)
    if given.asked.uncertainty is not None:
        opened = given.pre_opening
        record["pre_opening"] = None if opened is None else pre_opening_record(case, opened)
    if given.asked.ends:
        record["ends"] = None if given.ends is None else ends_record(given.ends, given.angles)
    if given.velocity is not None:
        record["velocity"] = {
            "at_m": given.velocity.at,
            "about_m_s": given.velocity.about,
            "radius_m_s": given.velocity.radius,
            "worst_m_s": given.velocity.worst,
            "spacing_m_s": given.velocity.spacing,
        }
    return {**record, "validity": validity_record(given.validity)}


def capture_record(given: Capture) -> Record:
    """Chances at the nominal and the best place; scales are factors on the error, null where no error is small enough."""
    best = _chance(given.best)
    return {
        **_chance(given.nominal),
        **{f"best_{name}": value for name, value in best.items()},
        "best_offset_m": given.offset,
        "guarantee": given.guarantee.value,
        "sigma_m": given.error.sigma,
        "correlation": given.error.correlation,
        "sigma_theta_rad": given.error.sigma_theta,
        "tolerances": [
            {
                "probability": each.wanted,
                "sigma_m": _scaled(given.error.sigma, each.nominal),
                "best_sigma_m": _scaled(given.error.sigma, each.best),
            }
            for each in given.tolerances
        ],
        "notes": list(given.notes),
    }


def _chance(given: Chance | None) -> Record:
    if given is None:
        nothing = dict.fromkeys(("at_m", "probability_at_least", "probability_at_most"))
        return {**nothing, "probability": 0.0, "loss": 1.0}
    return {
        "at_m": given.at,
        "probability": given.probability,
        "loss": given.loss,
        "probability_at_least": given.at_least,
        "probability_at_most": given.at_most,
    }


def _scaled(sigma: tuple[float, float], scale: float | None) -> list[float] | None:
    return None if scale is None else [scale * each for each in sigma]


def pre_opening_record(case: Case, given: PreOpening) -> Record:
    """The smallest openings that work (the largest base angles) about the nominal and about the best place."""
    widest = given.widest
    return {
        "at_m": given.at,
        **_openings(case, given.nominal),
        "works_as_given": given.now,
        "best": {"at_m": given.best.at, **_openings(case, given.best)},
        "most_allowed": None if widest is None else {"open_rad": widest.angle, "allowed_error_m": widest.allowed},
    }


def _openings(case: Case, given: Openings) -> Record:
    angle = given.smallest
    return {
        "open_rad": angle,
        "works_rad": given.works,
        "tip_gap_m": None if angle is None else tip_gap(case.hand, angle),
        "time_saved_s": None if angle is None else time_saved(case.hand, angle),
    }


def ends_record(given: FinalPoses, angles: FinalAngles | None) -> Record:
    """Final poses of caught starts, the ways to end, and what the final finger angles say."""
    return {
        "guarantee": "sampled",
        "starts": given.starts,
        "spacing_m": given.spacing,
        "caught_share": given.caught,
        "x_m": given.x,
        "y_m": given.y,
        "turn_rad": given.turn,
        "y_quantiles": [{"share": share, "y_m": y} for share, y in zip(LEVELS, given.height_levels, strict=True)],
        "spread_before_m": given.before,
        "spread_after_m": given.after,
        "self_centring": given.centring,
        "kinds": [
            {
                "kind": each.name,
                "meaning": each.meaning,
                "caught": each.caught,
                "share": each.share,
                "x_m": each.x,
                "y_m": each.y,
                "turn_rad": each.turn,
                "smaller_finger_rad": each.smaller,
                "larger_finger_rad": each.larger,
            }
            for each in given.kinds
        ],
        "finger_angles": None if angles is None else _angles(angles),
    }


def _angles(given: FinalAngles) -> Record:
    return {
        "missed_rad": given.missed,
        "caught_from_missed_rad": given.caught_from_missed,
        "apart": [{"kinds": [each.one, each.other], "angle_rad": each.angle} for each in given.apart],
        "centred_rad": given.centred,
        "radius_per_angle_m_per_rad": given.radius_per_angle,
        "radii": [{"finger_rad": psi, "radius_m": radius} for psi, radius in given.radii],
    }


def validity_record(given: Validity) -> Record:
    """Rates in rad/s; null where there is no limit or nothing is known."""
    slow, offset = given.quasi_static, given.offset
    quasi_static = None
    if slow is not None:
        quasi_static = {
            "holds": slow.holds,
            "verdict": slow.verdict,
            "inertia_over_friction": slow.ratio,
            "coasting_m": slow.coasting,
            "drift_m": slow.drift,
            "allowed_error_m": slow.allowed,
            "rate_rad_s": slow.rate,
            "rate_limit_rad_s": slow.rate_limit,
            "drift_rate_limit_rad_s": slow.drift_rate_limit,
            "push_speed_m_s": slow.push_speed,
            "squeeze_speed_m_s": slow.squeeze_speed,
        }
    return {
        "quasi_static": quasi_static,
        "toppling": None
        if given.toppling is None
        else {"edge_m": given.toppling.edge, "push_height_m": given.toppling.height},
        "pressure_offset": None
        if offset is None
        else {**_metres(asdict(offset)), "lost_per_offset": offset.lost_per_offset},
        "uncovered": list(given.uncovered),
    }


def _metres(values: Record) -> Record:
    return {f"{name}_m": value for name, value in values.items()}
