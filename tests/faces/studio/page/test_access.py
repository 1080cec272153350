"""What people need who see little, or use keys or a reader: names, contrast, roles, order of focus; on every page."""

from importlib import resources

import pytest
from playwright.sync_api import expect

AXE = (resources.files("axe_playwright_python") / "axe.min.js").read_text(encoding="utf-8")
PAGES = {
    "Studio": "[data-answer=guarantee]",
    "Closure map": ".map-cells path >> nth=0",
    "Design": "[data-answer=design][aria-busy=false] .facts >> nth=0",
    "Experiments": "[data-answer=numbers]",
    "Cases": ".case-card:enabled >> nth=0",
}


def complaints(page):
    """What axe finds wrong: rule, element, why."""
    page.evaluate(AXE)
    page.evaluate("Promise.all(document.getAnimations().map(each => each.finished))")
    found = page.evaluate("axe.run(document, {resultTypes: ['violations']})")["violations"]
    return [(each["id"], node["html"][:120], node["failureSummary"]) for each in found for node in each["nodes"]]


@pytest.mark.parametrize(("theme", "width", "height"), [("light", 820, 1180), ("dark", 1440, 900)])
def test_axe_finds_nothing_wrong_and_no_page_is_wider_than_a_tablet(new_studio, theme, width, height):
    studio = new_studio(viewport={"width": width, "height": height}, color_scheme=theme)
    studio.open()
    page = studio.page
    for name, there in PAGES.items():
        page.get_by_role("tab", name=name).click()
        expect(page.locator(there)).to_be_visible()
        assert complaints(page) == [], name
        assert page.evaluate("document.querySelector('main').scrollWidth") <= width, name
    assert studio.wrong == []


def test_grips_tell_between_what_they_move(studio):
    page = studio.page
    page.get_by_label("Shape").select_option("polygon")
    sliders = page.locator("[role=slider]")
    expect(sliders).to_have_count(12)
    for each in sliders.all():
        low, now, high = (float(each.get_attribute(f"aria-value{end}")) for end in ("min", "now", "max"))
        assert low <= now <= high
        assert each.get_attribute("aria-label")
        assert each.get_attribute("aria-valuetext")
    joint = studio.grip("joint1-right")
    assert (joint.get_attribute("aria-valuenow"), joint.get_attribute("aria-valuemax")) == ("137", "244")


def test_focus_goes_from_the_head_to_the_fields_and_the_answer_and_shows_where_it_is(studio):
    page = studio.page
    page.get_by_role("tab", name="Design").click()
    order = []
    for _ in range(12):
        page.keyboard.press("Tab")
        shown = page.evaluate(
            "(({matches, textContent, labels, tagName}) =>"
            " [tagName, labels?.[0]?.textContent ?? textContent])(document.activeElement)"
        )
        assert page.evaluate("getComputedStyle(document.activeElement).outlineStyle") == "solid", shown
        order.append(shown[1])
    wanted = ["Open", "Save", "Share", "The smallest hand for a brief", "Begin with", "Objects", "Radii"]
    places = [order.index(each) for each in wanted]
    assert places == sorted(places), order
