"""The answers in docs/integrator.md, from the commands that it names, and its closed forms computed anew."""

import json
from math import degrees, pi, radians, sin, tan
from pathlib import Path

from palmar.faces.cli.main import run

PAGE = " ".join((Path(__file__).parents[1] / "docs" / "integrator.md").read_text(encoding="utf-8").split())


def said(capsys, *words: str) -> str:
    run(["region", "testbed_table", *words])
    return capsys.readouterr().out


def on_page(text: str, *beginnings: str) -> None:
    """The lines of an answer that begin so stand on the page, whatever their spaces."""
    for begin in beginnings:
        (line,) = [each for each in text.splitlines() if each.startswith(begin)]
        assert " ".join(line.split()) in PAGE


def test_the_chance_of_a_catch(capsys):
    text = said(capsys, "--error", "30,20", "--at", "20,120")
    on_page(text, "chance of a catch", "the best place", "to get there", "standard deviations for 99%")
    on_page(text, "standard deviations for 99.9%")


def test_the_smallest_safe_opening(capsys):
    text = said(capsys, "--uncertainty", "disk:30")
    on_page(text, "all errors", "smallest safe opening there", "smallest safe opening, at", "most error allowed")


def test_where_it_ends_and_what_the_angles_say(capsys):
    text = said(capsys, "--ends")
    on_page(text, "pinched", "wedged", "Self-centring", "Fingers that have missed", "A disk held on the palm")
    structural = json.loads(said(capsys, "--ends", "--closure", "structural", "--json"))["ends"]
    (only,) = structural["kinds"]
    assert f"every start ends in the one pose, on the palm, at {degrees(only['smaller_finger_rad'][0]):.1f}°" in PAGE
    psi = only["smaller_finger_rad"][0]
    slope = -60.0 / (2.0 * sin(psi / 2.0) ** 2)
    assert f"{slope:.1f} mm per radian here, {-slope * pi / 180.0:.2f} mm per degree" in PAGE
    assert f"a pinch at 100° is a disk of 38 mm or one of {60.0 / tan(radians(50.0)):.0f} mm on the palm" in PAGE
    run(["region", "testbed_table_thick", "--ends", "--closure", "structural", "--json"])
    angles = json.loads(capsys.readouterr().out)["ends"]["finger_angles"]
    assert angles["caught_from_missed_rad"] == 0.0
    assert f"they meet around the disk at {degrees(angles['missed_rad']):.1f}°" in PAGE


def test_whether_the_model_applies(capsys):
    on_page(said(capsys), "Closing at", "It topples")
    assert f"{38.0 / 0.3:.1f} mm slowly" in PAGE
    structural = json.loads(said(capsys, "--closure", "structural", "--json"))["validity"]["quasi_static"]
    assert f"up to {structural['squeeze_speed_m_s']:.1f} m/s at 30°/s" in PAGE
    record = json.loads(said(capsys, "--json"))["validity"]["quasi_static"]
    peak = record["inertia_over_friction"] * 0.3 * 9.81 / record["rate_rad_s"] ** 2
    assert f"the acceleration rises to {peak:.2f} m here" in PAGE


def test_what_a_pressure_offset_costs(capsys):
    offset = json.loads(said(capsys, "--pressure-offset", "5", "--json"))["validity"]["pressure_offset"]
    left, without = 1e3 * offset["allowed_m"], 1e3 * offset["without_m"]
    assert (
        f"{left:.1f} mm of the {without:.1f} mm are left, {offset['lost_per_offset']:.2f} mm less per millimetre"
        in PAGE
    )
