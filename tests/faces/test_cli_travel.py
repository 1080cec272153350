"""``palmar behaviours travel``: what it finds is caught when simulated, and less is not."""

from __future__ import annotations

from pathlib import Path

import pytest

from palmar.models.shipped import open_case
from palmar.regions.moving import ArmMotion
from palmar.studies import arm_motion
from palmar.studies.arm_motion import room_of

SLOW_ARM = """
[hand]
palm_width_mm = 120.0
finger_links_mm = [137.0, 107.0]
[object]
radius_mm = 38.0
[behaviour]
name = "move_and_grab"
speed_mm_s = 20.0
"""


def test_the_best_arm_motions_for_an_uncertainty(palmar, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With a slow arm the quickest motion lies between the source's two ways, and both of those do worse."""
    monkeypatch.setattr(arm_motion, "STEPS", (0.25, 0.125))
    file = tmp_path / "slow.toml"
    file.write_text(SLOW_ARM)
    answer = palmar("behaviours", "travel", str(file), "--uncertainty", "disk:160", "--json")
    ways, (_, case) = answer.record["ways"], open_case(str(file))
    assert answer.status == 0
    assert ways["first"]["travel_m"] == pytest.approx(0.1020, abs=0.0006)
    assert ways["closing"]["travel_m"] == pytest.approx(0.232, abs=0.005)
    assert (ways["first"]["guarantee"], ways["closing"]["guarantee"]) == ("closed_form", "sampled")
    assert ways["shortest"] == ways["first"]
    assert 0.0 < ways["quickest"]["share_first"] < 1.0
    assert ways["quickest"]["seconds"] < 0.97 * min(ways["first"]["seconds"], ways["closing"]["seconds"])
    for way in ways.values():
        assert way["allowed_error_m"] >= 0.16
        less = room_of(case, ArmMotion(0.95 * way["first_m"], 0.95 * way["per_radian_m"]))
        assert less is not None and less[0].radius < 0.16
        before, closing = way["first_m"] / 0.02, 3.141592653589793 / way["finger_rate_rad_s"]
        assert before + closing == pytest.approx(way["seconds"])
        assert way["arm_speed_m_s"] == pytest.approx(way["per_radian_m"] * way["finger_rate_rad_s"])
        assert way["arm_speed_m_s"] <= 0.02 and way["finger_rate_rad_s"] <= case.hand.finger_rate


def test_the_best_arm_motions_in_words(palmar) -> None:
    text = palmar("behaviours", "travel", "testbed_table", "--uncertainty", "disk:50").out
    assert "with the least travel, 0 mm" in text
    none = palmar("behaviours", "travel", "testbed_table", "--uncertainty", "disk:900", "--check")
    assert none.status == 1 and "No arm motion straight ahead catches" in none.out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["testbed_table", "--uncertainty", "box:3,4"], "must be disk:R_MM"),
        (["testbed_table", "--uncertainty", "disk:-3"], "above 0"),
        (["testbed_table", "--uncertainty", "disk:x"], "--uncertainty"),
        (["testbed_free", "--uncertainty", "disk:3"], "objects on a table"),
        (["nowhere", "--uncertainty", "disk:3"], "nowhere"),
    ],
)
def test_bad_input_is_one_line(palmar, words: list[str], said: str) -> None:
    answer = palmar("behaviours", "travel", *words)
    assert (answer.status, answer.out) == (2, "")
    assert answer.err.splitlines()[-1].startswith("palmar: ") and said in answer.err.splitlines()[-1]
