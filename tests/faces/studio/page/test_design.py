"""The design page: a brief in, the command line's hand out; no hand, newest answer, front, files, and keys alone."""

import re

import pytest
from playwright.sync_api import expect

OCTAGON = "source_half_octagon"


@pytest.fixture
def design(studio):
    """The page with the answer to its first brief, one in closed form."""
    studio.page.get_by_role("tab", name="Design").click()
    found(studio, "what binds")
    return studio


def answer(studio):
    return studio.page.locator("[data-answer=design]")


def found(studio, words):
    """Wait for the answer to the brief as it is, tried; it must say these words."""
    expect(answer(studio)).to_contain_text(words)
    expect(answer(studio)).to_have_attribute("aria-busy", "false")


def begin_with(studio, name):
    studio.page.get_by_label("Begin with").select_option(name)


def row(studio, name):
    return answer(studio).get_by_role("row", name=re.compile(f"^{name} ")).locator("td").inner_text()


def test_a_brief_gives_the_command_lines_hand_which_the_studio_takes(design, palmar):
    begin_with(design, OCTAGON)
    found(design, "165.69 mm")
    told = palmar("design", OCTAGON, "--json").record
    assert row(design, "palm and both fingers") == f"{1e3 * told['size_m']:.2f} mm"
    assert row(design, "what binds") == ", ".join(told["binds"])
    assert row(design, "tried") == "100000 random cases, 0 lost"
    design.page.get_by_role("button", name="Load this hand").click()
    expect(design.page.get_by_role("tab", name="Studio")).to_have_attribute("aria-selected", "true")
    hand = design.case()["hand"]
    assert [1e-3 * each for each in hand["finger_links_mm"]] == pytest.approx(told["hand"]["finger_links_m"], rel=1e-9)
    assert 1e-3 * hand["palm_width_mm"] == pytest.approx(told["hand"]["palm_width_m"], rel=1e-9)
    design.page.get_by_role("tab", name="Design").click()
    found(design, "165.69 mm")


def test_an_impossible_brief_has_its_reason_and_no_hand(design, palmar):
    begin_with(design, "too_short")
    expect(design.page.locator("[data-answer=impossible]")).to_contain_text("Impossible, because")
    found(design, "proven by closed forms")
    said = palmar("design", "too_short").out
    assert design.page.locator("[data-answer=impossible]").inner_text().removeprefix("✗").strip() in said
    assert answer(design).get_by_role("alert").count() == 0
    expect(design.page.get_by_text("No hand to draw.")).to_be_visible()
    expect(design.page.get_by_role("button", name="Load this hand")).to_be_disabled()


def test_the_newest_brief_is_answered_and_survives_a_reload(design, palmar, tmp_path):
    begin_with(design, "source_4r")
    found(design, "200.00 mm")
    radii = design.page.get_by_label("Radii", exact=True)
    for each in range(20, 31):
        radii.fill(str(each))
    found(design, "120.00 mm")
    design.page.reload()
    expect(radii).to_have_value("30")
    found(design, "120.00 mm")
    brief = tmp_path / "brief.toml"
    brief.write_text("[targets]\nradii_mm = 30\n[limits]\nlinks = [1]\nmargin = 0\n")
    assert palmar("design", brief, "--json").record["size_m"] == pytest.approx(0.12)


def test_a_long_search_is_begun_by_a_button_given_up_and_does_not_stand_in_the_way(design):
    begin_with(design, "free_catch")
    search = design.page.get_by_role("button", name="Search for the smallest hand")
    search.click()
    expect(answer(design).get_by_text("Searching")).to_be_visible()
    design.page.get_by_role("button", name="Give up").click()
    expect(search).to_be_visible()
    begin_with(design, "source_4r")
    found(design, "200.00 mm")


def test_a_range_that_cannot_be_is_explained_at_its_field(design):
    radii = design.page.get_by_label("Radii", exact=True)
    radii.fill("45..25")
    complaint = design.page.locator(".field", has=radii).get_by_role("alert")
    expect(complaint).to_contain_text('targets.radii_mm = "45..25": the lower end comes first')
    expect(design.page.get_by_text("No hand to draw.")).to_be_visible()
    radii.fill("25..45")
    expect(complaint).to_have_count(0)
    found(design, "what binds")


def test_a_point_of_the_front_shows_its_hand_and_loads_it(design):
    begin_with(design, "source_4r")
    found(design, "200.00 mm")
    design.page.get_by_role("button", name="Draw the front").click()
    point = design.page.get_by_role("button", name=re.compile("which tolerates 12.5 mm"))
    point.hover()
    drawn = design.page.get_by_role("group", name="The hand found")
    expect(drawn.locator(".region.centre")).to_be_visible()
    point.dispatch_event("click")  # it may move as further points come
    expect(design.page.get_by_role("tab", name="Studio")).to_have_attribute("aria-selected", "true")
    hand = design.case()["hand"]
    assert hand["palm_width_mm"] + 2.0 * sum(hand["finger_links_mm"]) == pytest.approx(4.0 * 62.5, rel=2e-3)


def test_a_briefs_file_is_opened_and_saved_and_the_design_exported(design, tmp_path):
    page = design.page
    page.get_by_role("tab", name="Studio").click()
    brief = tmp_path / "mine.toml"
    brief.write_text("[targets]\nradii_mm = 20\nfriction = 0\n[limits]\nlinks = [1]\nmargin = 0\n")
    page.get_by_label("Case file or brief").set_input_files(brief)
    expect(page.get_by_role("tab", name="Design")).to_have_attribute("aria-selected", "true")
    found(design, "80.00 mm")
    for option, ending in (("brief, toml", "toml"), ("design, svg", "svg")):
        page.get_by_label("Export", exact=True).select_option(label=option)
        with page.expect_download() as saved:
            page.get_by_role("button", name="Save the export").click()
        assert saved.value.suggested_filename.endswith(ending)
        assert "20" in saved.value.path().read_text()
    brief.write_text("[targets]\nradii_mm = -1\n")
    page.get_by_label("Case file or brief").set_input_files(brief)
    expect(page.get_by_role("alert").first).to_contain_text("mine.toml: brief: targets.radii_mm[0] = -1")


def test_keys_alone_set_a_brief_and_load_its_hand(design):
    page = design.page
    page.get_by_role("tab", name="Design").focus()
    for _ in range(40):
        page.keyboard.press("Tab")
        if page.evaluate("document.activeElement.labels?.[0]?.textContent") == "Radii":
            break
    page.keyboard.press("Control+A")
    page.keyboard.type("30")
    page.keyboard.press("ArrowUp")
    expect(page.get_by_label("Radii", exact=True)).to_have_value("31")
    found(design, "To hold disks of radius 31 mm")
    for _ in range(60):
        page.keyboard.press("Tab")
        if "Load this hand" in page.evaluate("document.activeElement.textContent"):
            break
    page.keyboard.press("Enter")
    expect(page.get_by_role("tab", name="Studio")).to_have_attribute("aria-selected", "true")
    assert design.case()["object"]["radius_mm"] == 31
