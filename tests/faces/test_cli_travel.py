"""``palmar behaviours travel``: what it finds is caught when simulated, and less is not."""

from __future__ import annotations

import pytest

from palmar.models.shipped import open_case
from palmar.regions.moving import ArmMotion
from palmar.studies.arm_motion import room_of


def test_the_least_travel_for_an_uncertainty(palmar) -> None:
    answer = palmar("behaviours", "travel", "testbed_table", "--uncertainty", "disk:160", "--json")
    record, (_, case) = answer.record, open_case("testbed_table")
    assert answer.status == 0
    assert record["best"] == "first"
    assert record["ways"]["first"]["travel_m"] == pytest.approx(0.114, abs=0.003)
    assert record["ways"]["while"]["travel_m"] == pytest.approx(0.232, abs=0.005)
    assert record["ways"]["both"]["first_m"] == pytest.approx(0.5 * record["ways"]["both"]["travel_m"])
    for way in record["ways"].values():
        assert way["allowed_error_m"] >= 0.16
        less = room_of(case, ArmMotion(0.95 * way["first_m"], 0.95 * way["per_radian_m"]))
        assert less is not None and less.radius < 0.16
    assert record["ways"]["while"]["speed_m_s"] == pytest.approx(
        record["ways"]["while"]["per_radian_m"] * case.hand.finger_rate
    )


def test_the_least_travel_in_words(palmar) -> None:
    text = palmar("behaviours", "travel", "testbed_table", "--uncertainty", "disk:50").out
    assert "with the least travel by move and grab, 0 mm" in text
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
