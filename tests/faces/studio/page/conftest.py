"""The page in a browser: a server of its own, Debian's chromium without a window, and hands to use it with."""

import base64
import json
import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import Browser, Locator, Page, expect, sync_playwright

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
PATIENCE = 120_000.0
"""ms: the first answer of a kind may have to wait for kernels to be compiled."""


# Not for the whole session: Playwright keeps an event loop running, in which asyncio's other tests cannot start theirs.
@pytest.fixture(scope="module")
def chromium() -> Iterator[Browser]:
    if CHROMIUM is None:
        pytest.skip("no chromium here (Debian: apt-get install chromium)")
    with sync_playwright() as playwright:
        found = playwright.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        expect.set_options(timeout=PATIENCE)
        yield found
        found.close()


@pytest.fixture(scope="session")
def address() -> Iterator[str]:
    """Where `palmar studio` says it is."""
    words = [sys.executable, "-m", "palmar.faces.cli.main", "studio", "--no-browser", "--port", "0"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout is not None
        yield server.stdout.readline().strip()
        server.terminate()


@dataclass
class Studio:
    """The page, and what went wrong on it."""

    page: Page
    address: str
    wrong: list[str] = field(default_factory=list)

    def open(self, fragment: str = "") -> None:
        """Load the page and wait for its first region."""
        self.page.goto(self.address + fragment)
        expect(self.page.locator("[data-region=centre]")).to_be_visible()
        self.settled()

    def settled(self) -> None:
        """Wait until every answer to the present case is there."""
        expect(self.page.locator("[data-answer=guarantee]")).to_be_visible()
        expect(self.page.locator(".badge.wait")).to_have_count(0)

    def grip(self, name: str) -> Locator:
        return self.page.locator(f"[data-grip={name}]")

    def drag(self, name: str, across: float, up: float, steps: int = 12) -> None:
        """Take a grip by so many pixels."""
        box = self.grip(name).bounding_box()
        assert box is not None
        x, y = box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"]
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        self.page.mouse.move(x + across, y - up, steps=steps)
        self.page.mouse.up()

    def answer(self, name: str) -> str:
        return self.page.locator(f"[data-answer='{name}']").inner_text()

    def case(self) -> dict:
        """The case in the address, once that has followed."""
        self.page.evaluate("new Promise(done => setTimeout(done, 400))")
        found = re.search(r"case=([\w-]+)", self.page.url)
        assert found is not None, self.page.url
        text = found[1] + "=" * (-len(found[1]) % 4)
        return json.loads(base64.urlsafe_b64decode(text))

    def case_file(self, folder: Path) -> Path:
        """The same as a case file."""
        sections = (
            f"[{name}]\n"
            + "".join(f"{key} = {json.dumps(value)}\n" for key, value in part.items() if value is not None)
            for name, part in self.case().items()
        )
        path = folder / "case.toml"
        path.write_text("\n".join(sections), encoding="utf-8")
        return path


def _watched(page: Page, address: str) -> Studio:
    """Keep every error of the page, and every request that would leave the machine."""
    studio = Studio(page, address)
    home = urlsplit(address).netloc
    page.on("pageerror", lambda error: studio.wrong.append(str(error)))
    page.on("console", lambda line: studio.wrong.append(line.text) if line.type in ("error", "warning") else None)
    page.on(
        "request",
        lambda request: (
            studio.wrong.append(request.url)
            if urlsplit(request.url).scheme.startswith("http") and urlsplit(request.url).netloc != home
            else None
        ),
    )
    return studio


@pytest.fixture
def new_studio(chromium: Browser, address: str) -> Iterator[Callable[..., Studio]]:
    """Opens the page as a browser of its own would see it, with other options."""
    contexts = []

    def opened(**options: object) -> Studio:
        wide = {"viewport": {"width": 1440, "height": 900}, "color_scheme": "light"}
        context = chromium.new_context(**{**wide, **options})
        context.set_default_timeout(PATIENCE)
        contexts.append(context)
        return _watched(context.new_page(), address)

    yield opened
    for context in contexts:
        context.close()


@pytest.fixture
def studio(new_studio: Callable[..., Studio]) -> Iterator[Studio]:
    """The page with its first answer; at the end nothing must have gone wrong on it."""
    found = new_studio()
    found.open()
    yield found
    assert found.wrong == []
