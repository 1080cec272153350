"""Files and links: share, open, drop, save, export."""

from playwright.sync_api import expect

DROP = """text => {
  const given = new DataTransfer();
  given.items.add(new File([text], "dropped.toml"));
  window.dispatchEvent(new DragEvent("drop", {dataTransfer: given, bubbles: true, cancelable: true}));
}"""
GRIPPER = '[hand]\npalm_width_mm = 90.0\nfinger_links_mm = [80.0]\n[object]\nshape = "disk"\nradius_mm = 25.0\n'


def test_a_shared_link_opens_the_same_case_elsewhere(studio):
    studio.drag("radius", 20.0, 20.0)
    studio.settled()
    studio.page.get_by_role("button", name="Share").click()
    shown = studio.answer("area of the centre region")
    link, case = studio.page.url, studio.case()
    studio.page.goto("about:blank")
    studio.page.goto(link)
    studio.settled()
    assert studio.answer("area of the centre region") == shown
    assert studio.case()["object"] == case["object"]


def test_a_damaged_link_says_so_and_the_page_works(studio):
    studio.page.goto("about:blank")
    studio.open("#tab=studio&case=bm90IGEgY2FzZQ")
    expect(studio.page.get_by_role("alert")).to_contain_text("could not be read")


def test_case_files_open_by_dropping_and_are_saved(studio, tmp_path, palmar):
    studio.page.evaluate(DROP, GRIPPER)
    expect(studio.page.get_by_label("Palm width", exact=True)).to_have_value("90")
    with studio.page.expect_download() as saved:
        studio.page.get_by_title("Save the case as TOML").click()
    path = tmp_path / "saved.toml"
    saved.value.save_as(path)
    studio.settled()
    region = palmar("region", path, "--json").record
    assert f"{1e4 * region['area_m2']:.4g} cm²" in studio.answer("area of the centre region")


def test_a_file_that_is_no_case_is_refused_in_one_line(studio):
    studio.page.get_by_label("Case file").set_input_files(
        {"name": "broken.toml", "mimeType": "text/plain", "buffer": b"[hand]\npalm = 3"}
    )
    complaint = studio.page.get_by_role("alert")
    expect(complaint).to_contain_text("broken.toml")
    expect(complaint).to_contain_text("hand.palm")
    expect(studio.page.get_by_label("Palm width", exact=True)).to_have_value("120")


def test_the_region_is_exported_as_the_command_line_writes_it(studio, palmar, tmp_path):
    studio.drag("tip-left", 40.0, 60.0)
    studio.settled()
    case = studio.case_file(tmp_path)
    for kind in ("svg", "geojson"):
        studio.page.get_by_label("Export", exact=True).select_option(f"region {kind}")
        with studio.page.expect_download() as saved:
            studio.page.get_by_label("Save the export").click()
        ours, theirs = tmp_path / f"page.{kind}", tmp_path / f"cli.{kind}"
        saved.value.save_as(ours)
        palmar("region", case, "--out", theirs)
        assert ours.read_bytes() == theirs.read_bytes()
