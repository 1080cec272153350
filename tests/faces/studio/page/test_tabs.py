"""Every page of the studio, in light, dark and on a tablet; and a connection that breaks."""

import pytest
from playwright.sync_api import expect


def tab(studio, name):
    studio.page.get_by_role("tab", name=name).click()


def test_the_map_draws_the_hand_at_the_pointer_and_loads_it_by_a_click(studio):
    page = studio.page
    tab(studio, "Closure map")
    field = page.get_by_label("Hand on the map")
    expect(page.locator(".map-cells path").first).to_be_visible()
    box = field.bounding_box()
    page.mouse.move(box["x"] + 0.4 * box["width"], box["y"] + 0.6 * box["height"])
    expect(page.get_by_role("heading", name="Q = 0.40, P = 0.40")).to_be_visible()
    expect(page.get_by_role("button", name="Load this hand")).to_be_enabled()
    expect(page.locator(".object.moving circle")).to_be_visible()
    page.mouse.down()
    page.mouse.up()
    expect(page.get_by_role("tab", name="Studio")).to_have_attribute("aria-selected", "true")
    links = studio.case()["hand"]["finger_links_mm"]
    assert links[0] == pytest.approx(links[1], rel=0.02)


def test_design_finds_the_finger_that_the_command_line_finds(studio, palmar):
    page = studio.page
    tab(studio, "Design")
    page.get_by_role("button", name="Dimensions for a range of radii").click()
    page.get_by_label("Largest radius", exact=True).fill("50")
    found = page.locator("[data-answer=sizing]")
    expect(found.get_by_role("button")).to_be_enabled()
    told = palmar("closure", "size", "--radius", "20..50", "--palm-width", "120", "--json")
    low = told.record["intervals_m"][0][0]
    expect(found).to_contain_text(f"{1e3 * low:.1f} mm or more")
    found.get_by_role("button").click()
    length = sum(studio.case()["hand"]["finger_links_mm"])
    assert length == pytest.approx(1e3 * low, abs=0.01)


def test_a_shipped_case_and_a_figure_of_the_source(studio):
    page = studio.page
    tab(studio, "Experiments")
    expect(page.locator(".paper img")).to_be_visible()
    assert page.locator(".paper img").evaluate("picture => picture.naturalWidth") > 100
    page.get_by_role("button", name="4.4").click()
    expect(page.get_by_role("img", name="Figure 4.4")).to_be_visible()
    row = page.get_by_role("row", name="first contact X1")
    expect(row).to_contain_text("2.8")
    expect(row).to_contain_text("5.251")
    tab(studio, "Cases")
    page.get_by_role("button", name="testbed_table_thick").click()
    expect(page.locator(".hand .capsule")).to_have_count(2)
    studio.settled()


@pytest.mark.parametrize(
    ("theme", "width", "height"), [("light", 1440, 900), ("dark", 1440, 900), ("light", 768, 1024)]
)
def test_every_page_fits_its_width(new_studio, tmp_path, theme, width, height):
    """Screenshots stay in the test's temporary folder, to look at."""
    studio = new_studio(viewport={"width": width, "height": height}, color_scheme=theme)
    studio.open()
    page = studio.page
    assert page.evaluate("document.documentElement.dataset.theme") == theme
    for name in ("Studio", "Closure map", "Design", "Experiments", "Cases"):
        page.get_by_role("tab", name=name).click()
        page.wait_for_timeout(250)
        page.screenshot(path=tmp_path / f"{theme}_{width}_{name}.png")
        wide = page.evaluate(
            "Math.max(document.documentElement.scrollWidth, document.querySelector('main').scrollWidth)"
        )
        assert wide <= width, name
    assert studio.wrong == []


def test_a_broken_connection_is_told_and_made_again_and_what_was_asked_is_answered(new_studio):
    studio = new_studio()
    page = studio.page
    sockets = []
    lost = []

    def through(socket):
        """The first connection goes silent once told so, the second is refused, the third works."""
        sockets.append(socket)
        if len(sockets) == 2:
            socket.close()
            return
        server = socket.connect_to_server()
        socket.on_message(lambda text: lost.append(text) if "silent" in lost else server.send(text))

    page.route_web_socket("**/ws", through)
    studio.open()
    before = studio.answer("area of the centre region")
    lost.append("silent")
    studio.drag("palm-left", -30.0, 0.0)
    page.wait_for_timeout(300)
    assert len(lost) > 1
    lost.clear()
    sockets[0].close()
    expect(page.get_by_role("status").first).to_contain_text("connection to palmar studio is lost")
    expect(page.get_by_text("connection to palmar studio is lost")).to_have_count(0)
    assert len(sockets) == 3
    studio.settled()
    assert studio.answer("area of the centre region") != before
    assert float(page.get_by_label("Palm width", exact=True).input_value()) > 130.0
