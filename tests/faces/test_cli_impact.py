"""``palmar impact`` as it is called: the numbers of an impact, by hand and by stepping it, and its complaints."""

from __future__ import annotations

from math import asin, atan2, hypot, pi, radians, sqrt

import pytest

LIGHT = """
[hand]
palm_width_mm = 120
finger_links_mm = [137, 107]
finger_mass_kg = 0.3
[object]
radius_mm = 38
mass_kg = 0.5
[contact]
restitution = 0.6
[support]
kind = "free"
[start]
at_mm = [-20, 130]
"""
FOOT = sqrt(0.04**2 + 0.13**2 - 0.038**2)
ANGLE = atan2(0.13, -0.04) - asin(0.038 / hypot(0.04, 0.13))


@pytest.fixture
def light(tmp_path):
    path = tmp_path / "light.toml"
    path.write_text(LIGHT, encoding="utf-8")
    return path


def stepped(mass: float, speed: float, k: float, damper: float) -> tuple[float, float, float]:
    """(peak force, duration, rebound) by small steps."""
    d, v, t, peak, step = 0.0, speed, 0.0, damper * speed, 1e-8
    while True:
        force = k * d + damper * v
        if force < 0.0:
            return peak, t, -v / speed
        peak, v = max(peak, force), v - force / mass * step
        d, t = d + v * step, t + step


def test_a_heavy_finger_without_loss(palmar):
    """v = rate X; the peak is v sqrt(k m), the duration pi sqrt(m / k)."""
    record = palmar("impact", "zero_g_example", "--stiffness", 20, "--json").record
    foot = sqrt(0.06**2 + 0.12**2 - 0.038**2)
    assert record["foot_m"] == pytest.approx(foot)
    assert record["speed_m_s"] == pytest.approx(radians(30.0) * foot)
    assert (record["mass_kg"], record["damping_ratio"]) == (1.0, 0.0)
    assert record["contact"]["peak_n"] == pytest.approx(record["speed_m_s"] * sqrt(20_000.0), rel=1e-6)
    assert record["contact"]["duration_s"] == pytest.approx(pi * sqrt(1.0 / 20_000.0), rel=1e-6)
    assert record["softest"] is record["pad_n_m"] is record["touch_down"] is record["feedback"] is None


def test_a_light_finger_with_the_case_s_restitution_as_stepped(palmar, light):
    record = palmar("impact", light, "--speed", 150, "--stiffness", 8, "--force-limit", 3, "--json").record
    inertia = 0.3 * 0.244**2 / 3.0
    mass = 1.0 / (1.0 / 0.5 + FOOT**2 / inertia)
    assert record["mass_kg"] == pytest.approx(mass)
    assert record["angle_rad"] == pytest.approx(ANGLE)
    for part, k in (("contact", 8000.0), ("softest", record["softest"]["stiffness_n_m"])):
        peak, duration, rebound = stepped(mass, 0.15, k, 2.0 * record["damping_ratio"] * sqrt(k * mass))
        assert record[part]["peak_n"] == pytest.approx(peak, rel=1e-4)
        assert record[part]["duration_s"] == pytest.approx(duration, rel=1e-3)
        assert rebound == pytest.approx(0.6, abs=1e-3)
    assert record["softest"]["peak_n"] == pytest.approx(3.0)
    pad = record["pad_n_m"]
    assert pad * 8000.0 / (pad + 8000.0) == pytest.approx(record["softest"]["stiffness_n_m"])


def test_a_limit_that_is_kept_needs_no_pad(palmar, light):
    answer = palmar("impact", light, "--speed", 10, "--stiffness", 1, "--force-limit", 500)
    assert "none is needed" in answer.out
    record = palmar("impact", light, "--speed", 10, "--stiffness", 1, "--force-limit", 500, "--json").record
    assert record["pad_n_m"] is None


def test_touch_down_and_feedback(palmar, light):
    """From rest the switch is at A / 2 + w1^2 / 4 a; the gain's limit is Routh and Hurwitz'."""
    words = ("impact", light, "--speed", 50, "--stiffness", 8, "--torque", 0.02, "--lag", 5)
    record = palmar(*words, "--json").record
    inertia, rate = 0.3 * 0.244**2 / 3.0, 0.05 / FOOT
    quick = 0.02 / inertia
    down = record["touch_down"]
    assert down["switch_angle_rad"] == pytest.approx(0.5 * ANGLE + rate**2 / (4.0 * quick))
    peak = quick * down["switch_time_s"]
    assert peak - quick * (down["time_s"] - down["switch_time_s"]) == pytest.approx(rate)
    assert down["speed_m_s"] == pytest.approx(0.05)
    finger, damper = inertia / FOOT**2, 2.0 * record["damping_ratio"] * sqrt(8000.0 * record["mass_kg"])
    lag, k = 0.005, 8000.0
    whole = 1.0 + record["feedback"]["gain_limit"]
    assert (finger + lag * damper) * (lag * k + damper * whole) == pytest.approx(lag * finger * k * whole)
    text = palmar(*words).out
    assert "torque reversed" in text and "stable below" in text


@pytest.mark.parametrize(("words", "said"), [
    (("zero_g_example",), "give at least one of"),
    (("zero_g_example", "--stiffness", "0"), "--stiffness = '0': must be greater than 0"),
    (("zero_g_example", "--stiffness", "soft"), "must be a finite number"),
    (("zero_g_example", "--force-limit", "-3"), "--force-limit"),
    (("zero_g_example", "--torque", "1"), "finger_mass_kg"),
    (("zero_g_example", "--lag", "1", "--stiffness", "1"), "finger_mass_kg"),
    (("no_such_case", "--stiffness", "1"), "no_such_case"),
])  # fmt: skip
def test_bad_input_is_one_line(palmar, words, said):
    answer = palmar("impact", *words)
    assert (answer.status, answer.out) == (2, "")
    assert said in answer.err
    assert answer.err.startswith("palmar: ") and answer.err.count("\n") == 1


@pytest.mark.parametrize(("old", "new", "said"), [
    ("restitution = 0.6", "restitution = 0", "--damping"),
    ("at_mm = [-20, 130]", "at_mm = [0, 600]", "no finger meets"),
    ("radius_mm = 38", 'shape = "polygon"\nvertices_mm = [[-30, -20], [30, -20], [30, 20]]', "polygon"),
])  # fmt: skip
def test_cases_that_do_not_allow_it_are_told(palmar, light, old, new, said):
    light.write_text(LIGHT.replace(old, new), encoding="utf-8")
    answer = palmar("impact", light, "--stiffness", 1)
    assert (answer.status, answer.out) == (2, "")
    assert said in answer.err and answer.err.count("\n") == 1


def test_letting_go_helps_only_within_a_quarter_period(palmar, light):
    early = palmar("impact", light, "--speed", "200", "--stiffness", "5", "--trigger", "0.5,0", "--json").record[
        "let_go"
    ]
    late = palmar("impact", light, "--speed", "200", "--stiffness", "5", "--trigger", "0.5,50", "--json").record[
        "let_go"
    ]
    assert late["peak_n"] == pytest.approx(late["without_n"]) == pytest.approx(0.2 * sqrt(5000.0 * 0.5))
    assert 0.5 < early["peak_n"] < 0.9 * early["without_n"]


def test_too_high_a_gain_grows_and_a_low_one_dies_out(palmar, light):
    def told(gain: float):
        given = ("--stiffness", "5", "--damping", "0.1", "--lag", "2", "--gain", str(gain))
        return palmar("impact", light, *given, "--json").record["feedback"]

    limit = told(1.0)["gain_limit"]
    below, above = told(0.99 * limit), told(1.01 * limit)
    assert below["growth_per_s"] < 0.0 < above["growth_per_s"]
    assert below["doubling_s"] is None
    assert above["doubling_s"] > 0.0


def test_a_paddle_stops_the_object_dead(palmar, light):
    given = ("--speed", "100", "--returned", "0", "--stroke", "50", "--acceleration", "200")
    paddle = palmar("impact", light, *given, "--json").record["paddle"]
    assert "paddle's mirror gain" in palmar("impact", light, *given).out
    assert paddle["mirror_gain"] == pytest.approx(-0.6 / 1.6)
    # The paddle yields at u = -g v; the object, struck at v - u, returns with e (v - u) against it.
    yields = -paddle["paddle_speed_m_s"]
    assert 0.6 * (0.1 - yields) - yields == pytest.approx(paddle["returned_m_s"], abs=1e-12) == pytest.approx(0.0)
    assert paddle["quadratic"]["force_n"] == pytest.approx(0.5 * 0.1**2 / 0.1)
    assert paddle["sinusoidal"]["force_n"] == pytest.approx(2.0 * paddle["quadratic"]["force_n"])
    assert paddle["run_up_m"] == pytest.approx(0.025)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (("--gain", "2", "--stiffness", "5"), "--lag"),
        (("--trigger", "1,1"), "--stiffness"),
        (("--trigger", "1,-1", "--stiffness", "5"), "must be positive"),
        (("--returned", "0"), "--speed"),
        (("--stroke", "10", "--stiffness", "5"), "--returned"),
    ],
)
def test_what_softening_lacks_is_said_in_one_line(palmar, light, given, words):
    done = palmar("impact", light, *given)
    assert done.status == 2
    assert words in done.err
    assert done.err.count("\n") == 1
