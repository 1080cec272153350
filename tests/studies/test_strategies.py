"""The search over closing strategies, with regions whose areas are known functions of angle and ratio."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import degrees, radians

import pytest

from palmar.errors import NotCoveredError
from palmar.models.behaviour import BehaviourName
from palmar.models.case import Case
from palmar.models.case_file import parse_case
from palmar.studies import strategies as study

HAND = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [137, 107]\n"
DISK = "[object]\nradius_mm = 38\n"
FREE = '[support]\nkind = "free"\n'
LENGTH = 0.244


@dataclass
class Fake:
    """Areas peak at an angle and a ratio; what was asked is kept as (behaviour, spacing in finger lengths or None)."""

    angle: float = radians(33.0)
    ratio: float = 0.83
    asked: list[tuple[object, float | None]] = field(default_factory=list)
    counted: list[float] = field(default_factory=list)

    def region(self, case: Case, tolerance: float | None = None) -> study.Region:
        self.asked.append((case.behaviour, None if tolerance is None else tolerance / LENGTH))
        found = type("Known", (), {"area": self.area(case), "spacing": tolerance})
        return found()  # type: ignore[no-any-return]

    def area(self, case: Case) -> float:
        does = case.behaviour
        if does.name is BehaviourName.CURL_AND_CLOSE:
            return 3.0 - (does.preshape - self.angle) ** 2
        return 2.0 - (does.ratio - self.ratio) ** 2 if does.name is BehaviourName.CLOSE_COUPLED else 1.0

    def count(self, case: Case, spacing: float) -> float:
        self.counted.append(spacing / LENGTH)
        return self.area(case)


@pytest.fixture
def fake(monkeypatch: pytest.MonkeyPatch) -> Fake:
    made = Fake()
    monkeypatch.setattr(study, "build_region", made.region)
    monkeypatch.setattr(study, "captured_count", made.count)
    monkeypatch.setattr(study, "jointed_count", made.count)
    return made


def by_name(text: str, effort: study.Effort | None = None) -> dict[str, study.Strategy]:
    return {each.name: each for each in study.strategies(parse_case(text), effort=effort)}


def test_the_careful_search_comes_within_its_step_of_the_best(fake: Fake) -> None:
    found = by_name(HAND + DISK)
    curl, coupled = found["curl first"], found["coupled"]
    assert curl.step == pytest.approx(radians(1.25)) and curl.spacing == pytest.approx(LENGTH / 64)
    assert curl.value == pytest.approx(fake.angle, abs=curl.step)
    assert coupled.step == pytest.approx(0.03125) and coupled.value == pytest.approx(fake.ratio, abs=coupled.step)
    assert curl.behaviour.preshape == curl.value and coupled.behaviour.ratio == coupled.value
    assert study.winner(tuple(found.values())) is curl
    asked = [spacing for does, spacing in fake.asked if does.name is BehaviourName.CURL_AND_CLOSE][1:]
    parts = [None if each is None else round(1.0 / each) for each in asked]
    assert parts == [32] * (len(parts) - 6) + [64] * 5 + [None]  # the best, its neighbours, one halving; what is told


def test_the_finer_spacing_may_move_the_best(fake: Fake, monkeypatch: pytest.MonkeyPatch) -> None:
    """As if the coarse regions were wrong by two degrees."""
    true = fake.angle

    def region(case: Case, tolerance: float | None = None) -> study.Region:
        fake.angle = true + (radians(2.0) if tolerance is not None and tolerance > LENGTH / 40 else 0.0)
        return fake.region(case, tolerance)

    monkeypatch.setattr(study, "build_region", region)
    curl = by_name(HAND + DISK)["curl first"]
    assert curl.value == pytest.approx(true, abs=curl.step)


def test_the_quick_search_counts_and_tells_coarse_regions(fake: Fake) -> None:
    found = by_name(HAND + DISK + FREE, study.QUICK)
    assert degrees(found["curl first"].value) == pytest.approx(33.0, abs=5.0)
    assert found["curl first"].spacing == pytest.approx(LENGTH / 20)
    assert fake.counted == pytest.approx([1 / 20] * len(fake.counted)) and len(fake.counted) > 10
    assert [spacing for _, spacing in fake.asked] == pytest.approx([1 / 32] * 4)
    fake.asked.clear()
    by_name(HAND + DISK, study.QUICK)
    assert fake.asked[0][1] is None  # straight closing on a table is a closed form
    assert all(spacing == pytest.approx(1 / 32) for _, spacing in fake.asked[1:])


def test_theory_says_the_least_curl_without_sliding_and_the_one_without_rolling(fake: Fake) -> None:
    assert degrees(by_name(HAND + DISK + FREE)["centrifugal"].value) == pytest.approx(116.80, abs=0.01)
    assert degrees(by_name(HAND + DISK)["no rolling"].value) == pytest.approx(20.31, abs=0.01)


def test_no_angle_beyond_the_distal_joint_s_limit_is_asked(fake: Fake) -> None:
    found = by_name(HAND + "joint_limits_deg = [[0, 180], [0, 31]]\n" + DISK + FREE)
    assert "centrifugal" not in found
    angles = [does.preshape for does, _ in fake.asked if does.name is BehaviourName.CURL_AND_CLOSE]
    assert max(angles) <= radians(31.0)
    assert found["curl first"].value == pytest.approx(radians(30.0), abs=radians(1.25))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("[hand]\npalm_width_mm = 120\nfinger_links_mm = [137, 70, 37]\n" + DISK, "two links, not 3"),
        (HAND + DISK + "[support]\nwall_mm = 300\n", "without a wall"),
        (HAND + DISK + '[contact]\nfriction = "0.2..0.4"\n', "plain numbers"),
        (HAND + DISK + '[behaviour]\nname = "close_coupled"\nbend_deg = 40\n', "joints that move one by one"),
    ],
)
def test_what_is_not_covered_is_said(text: str, said: str) -> None:
    with pytest.raises(NotCoveredError, match=said):
        study.strategies(parse_case(text))
