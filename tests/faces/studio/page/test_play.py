"""Playing a motion, painting starts, following a plan."""

import pytest
from playwright.sync_api import expect


def mode(studio, name):
    studio.page.get_by_role("group", name="What to do with the drawing").get_by_role("button", name=name).click()


def test_a_motion_ends_where_the_command_line_says(studio, palmar, tmp_path):
    page = studio.page
    page.get_by_label("x", exact=True).fill("60")
    page.get_by_label("y", exact=True).fill("150")
    mode(studio, "Play")
    outcome = page.locator("[data-answer=outcome]")
    expect(outcome).to_be_visible()
    told = palmar("simulate", studio.case_file(tmp_path), "--start", "60,150", "--json").record
    assert told["caught"] == ("Caught" in outcome.inner_text())
    times = page.locator("table.events tbody td.number")
    assert times.all_inner_texts()[: len(told["events"])] == [f"{each['t_s']:.3f}" for each in told["events"]]
    page.get_by_label("Play", exact=True).click()
    expect(page.get_by_label("Pause")).to_be_visible()
    page.wait_for_timeout(300)
    page.get_by_label("Pause").click()
    played = float(page.get_by_label("Time of the motion").input_value())
    assert 0.05 < played < told["events"][-1]["t_s"]
    page.locator("table.events tbody button").last.click()
    body = page.locator("[data-motion=motion] .object circle")
    place = [float(body.get_attribute(each)) for each in ("cx", "cy")]
    assert place == pytest.approx([1e3 * told["final"]["x_m"], 1e3 * told["final"]["y_m"]], abs=0.01)


def test_painted_starts_agree_with_the_region_and_a_click_sets_the_start(studio):
    page = studio.page
    mode(studio, "Paint")
    marks = page.locator("[data-marks=caught]")
    expect(marks).to_be_visible()
    expect(page.locator("[data-answer=counts]")).to_contain_text("frictional")
    before = studio.case().get("start")
    box = marks.bounding_box()
    page.mouse.click(box["x"] + 0.3 * box["width"], box["y"] + 0.6 * box["height"])
    after = studio.case()["start"]
    assert after != before
    assert after["at_mm"][0] < 0.0 < after["at_mm"][1]


def test_a_plan_by_touch_is_certain_and_its_belief_shrinks(studio, palmar, tmp_path):
    page = studio.page
    page.get_by_label("Sensors").select_option("distributed")
    mode(studio, "Plan")
    page.get_by_label("Uncertainty: a disk of radius", exact=True).fill("150")
    answer = page.locator("[data-answer=plan]")
    expect(answer).to_be_visible()
    expect(page.locator(".controls .badge.wait")).to_have_count(0)
    told = palmar("plan", studio.case_file(tmp_path), "--uncertainty", "disk:150", "--json").record
    assert told["guaranteed"] == ("caught for certain" in answer.inner_text())
    belief = page.locator(".belief")
    first = belief.bounding_box()
    page.get_by_label("Time of the motion").press("End")
    last = belief.bounding_box()
    assert last["width"] * last["height"] < 0.8 * first["width"] * first["height"]
