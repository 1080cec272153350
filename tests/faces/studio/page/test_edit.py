"""Changing the case on the page: what follows is what the command line answers."""

import re

import numpy as np
import pytest
from playwright.sync_api import expect


def drawn_box(studio, name):
    """Left, bottom, right and top (mm) of a region's path."""
    path = studio.page.locator(f"[data-region={name}]").get_attribute("d")
    numbers = np.array(re.findall(r"-?[\d.]+(?:e-?\d+)?", path), dtype=float).reshape(-1, 2)
    return [*numbers.min(axis=0), *numbers.max(axis=0)]


def record_box(coordinates):
    points = 1e3 * np.array([point for polygon in coordinates for ring in polygon for point in ring])
    return [*points.min(axis=0), *points.max(axis=0)]


def test_a_dragged_fingertip_changes_region_and_numbers_to_the_command_lines(studio, palmar, tmp_path):
    before = studio.answer("area of the centre region")
    studio.drag("tip-right", -60.0, 90.0)
    studio.settled()
    case = studio.case()
    assert case["hand"]["open_deg"] > 5.0
    path = studio.case_file(tmp_path)
    region = palmar("region", path, "--json").record
    closure = palmar("closure", path, "--json").record
    assert studio.answer("area of the centre region") != before
    assert f"{1e4 * region['area_m2']:.4g} cm²" in studio.answer("area of the centre region")
    assert f"{1e3 * region['allowed_error']['radius_m']:.1f} mm" in studio.answer("allowed error")
    assert drawn_box(studio, "centre") == pytest.approx(record_box(region["centre"]), abs=0.05)
    assert f"{1e3 * closure['frictional']['radius_max_m']:.1f} mm" in studio.answer("frictional")
    assert f"{1e3 * closure['structural']['radius_max_m']:.1f} mm" in studio.answer("structural")


def test_the_drawing_follows_while_the_grip_is_still_held(studio):
    before = studio.page.locator("[data-region=centre]").get_attribute("d")
    box = studio.grip("palm-right").bounding_box()
    x, y = box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"]
    studio.page.mouse.move(x, y)
    studio.page.mouse.down()
    studio.page.mouse.move(x + 40.0, y, steps=8)
    expect(studio.page.locator("[data-region=centre]")).not_to_have_attribute("d", before)
    studio.page.mouse.up()


def test_undo_and_redo_take_a_whole_drag(studio):
    width = studio.page.get_by_label("Palm width", exact=True)
    studio.drag("palm-right", 50.0, 0.0)
    wider = width.input_value()
    assert float(wider) > 140.0
    studio.page.get_by_role("button", name="Undo").click()
    expect(width).to_have_value("120")
    studio.page.keyboard.press("Control+Shift+z")
    expect(width).to_have_value(wider)
    studio.page.keyboard.press("Control+z")
    expect(width).to_have_value("120")
    expect(studio.page.get_by_role("button", name="Undo")).to_be_disabled()


def test_keyboard_alone_opens_the_hand_and_moves_between_pages(studio, palmar, tmp_path):
    page = studio.page
    page.keyboard.press("Tab")
    expect(page.get_by_role("tab", name="Studio")).to_be_focused()
    for _ in range(80):
        page.keyboard.press("Tab")
        if page.evaluate("document.activeElement.dataset.grip") == "tip-right":
            break
    expect(studio.grip("tip-right")).to_be_focused()
    for key in ("ArrowUp", "ArrowUp", "Shift+ArrowUp", "ArrowRight"):
        page.keyboard.press(key)
    studio.settled()
    hand = studio.case()["hand"]
    assert (hand["open_deg"], hand["finger_links_mm"]) == (12, [137, 108])
    assert "open at 12°" in studio.grip("tip-right").get_attribute("aria-valuetext")
    region = palmar("region", studio.case_file(tmp_path), "--json").record
    assert f"{1e4 * region['area_m2']:.4g} cm²" in studio.answer("area of the centre region")
    page.get_by_role("tab", name="Studio").focus()
    page.keyboard.press("ArrowRight")
    expect(page.get_by_role("tab", name="Closure map")).to_be_focused()
    expect(page.get_by_role("group", name="Closure map", exact=True)).to_be_visible()


def test_a_value_that_cannot_be_is_explained_at_its_field_and_undone(studio, palmar, tmp_path):
    angle = studio.page.get_by_label("Opening angle", exact=True)
    angle.fill("200")
    complaint = studio.page.locator(".field", has=angle).get_by_role("alert")
    expect(complaint).to_contain_text("hand.open_deg")
    said = palmar("closure", studio.case_file(tmp_path)).err
    assert complaint.inner_text().split("hand.open_deg")[1] in said
    angle.fill("20")
    expect(complaint).to_have_count(0)
    studio.settled()


def test_a_polygons_corner_stays_convex_and_is_removed_by_key(studio):
    page = studio.page
    page.get_by_label("Shape").select_option("polygon")
    studio.settled()  # until then the view may change under the pointer, to show all of the region
    studio.drag("corner1", 60.0, 60.0)
    corners = studio.case()["object"]["vertices_mm"]
    assert corners[0] != [-38, -38]
    assert corners[0][0] + corners[0][1] < 0.0, "beyond the diagonal it would be a reflex corner"
    studio.grip("corner1").focus()
    page.keyboard.press("Delete")
    assert studio.case()["object"]["vertices_mm"] == corners[1:]
