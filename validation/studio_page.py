"""The studio's page in a browser: first paint, how soon a drag is redrawn, how often, and how large the bundle is.

    python3 dev.py validate studio_page [--seconds 6] [--rounds 3]

Starts a server of its own and Debian's chromium without a window, and prints a table for docs/results/studio.md. The time
from drag to redraw runs from the pointer's event to the first moment after the frame that shows the region of that case.
"""

from __future__ import annotations

import argparse
import gzip
import math
import os
import platform
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
from playwright.sync_api import Browser, Page, sync_playwright

STATIC = Path(__file__).parents[1] / "src" / "palmar" / "faces" / "studio" / "static"
RATE = 60.0
"""Moves of the pointer a second."""
WATCH = """
(() => {
  const log = window.measured = {redraws: [], moves: 0};
  const asked = new Map();
  let moved = 0, wanted = null;
  window.addEventListener("pointermove", event => { moved = event.timeStamp; log.moves += 1; }, true);
  window.addEventListener("pointerrawupdate", event => { moved = event.timeStamp; }, true);
  window.WebSocket = class extends WebSocket {
    constructor(...given) {
      super(...given);
      this.addEventListener("message", event => {  // before the page's own listener, which draws at once
        const part = JSON.parse(event.data);
        if (part.part === "region" && part.kind === "look")
          wanted = {seq: part.seq, stage: part.stage, computed: part.ms, answered: performance.now()};
      });
    }
    send(text) {
      const frame = JSON.parse(text);
      if (frame.kind === "look") asked.set(frame.seq, [moved, performance.now()]);
      super.send(text);
    }
  };
  new MutationObserver(changes => {
    if (!wanted || !changes.some(each => each.target.dataset && each.target.dataset.region === "centre")) return;
    const {seq, stage, computed, answered} = wanted, drawn = performance.now();
    const [began, sent] = asked.get(seq);
    wanted = null;
    const tell = () => log.redraws.push(
      [seq, stage, performance.now() - began, sent - began, answered - sent, computed, drawn - answered]);
    requestAnimationFrame(() => setTimeout(tell, 0));
  }).observe(document, {subtree: true, attributes: true, attributeFilter: ["d"]});
})()
"""
PHASES = ("until asked, ms", "until answered, ms", "of it computing, ms", "until drawn, ms")
"""Medians of what the time from move to redraw is made of; the rest is painting."""


@contextmanager
def studio() -> Iterator[str]:
    """The address of a server."""
    words = [sys.executable, "-m", "palmar.faces.cli.main", "studio", "--no-browser", "--port", "0"]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        try:
            yield process.stdout.readline().strip()
        finally:
            process.terminate()


def opened(browser: Browser, address: str) -> Page:
    """The page, watched, with its first region."""
    page = browser.new_page(viewport={"width": 1440, "height": 900})
    page.add_init_script(WATCH)
    page.goto(address)
    page.wait_for_selector("[data-region=centre]", timeout=300_000)
    return page


def first_paint(browser: Browser, address: str) -> tuple[float, float]:
    """First content and first region (ms after the navigation began), of a browser that has not been here before."""
    page = opened(browser, address)
    content = page.evaluate("performance.getEntriesByName('first-contentful-paint')[0].startTime")
    drawn = page.evaluate(
        """new Promise(done => { const look = () => document.querySelector("[data-region=centre]")
           ? done(performance.now()) : requestAnimationFrame(look); look(); })"""
    )
    page.close()
    return float(content), float(drawn)


def processor_seconds(word: str) -> float:
    """Used so far by those of this program's own processes whose command holds a word; it tells even on a busy machine."""
    parents, used = {}, {}
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            command = (folder / "cmdline").read_bytes()
            words = (folder / "stat").read_text().rpartition(") ")[2].split()
        except OSError:
            continue  # it has ended
        parents[int(folder.name)] = int(words[1])
        used[int(folder.name)] = (int(words[11]) + int(words[12])) * (word.encode() in command)
    ours = {os.getpid()}
    while grown := {each for each, parent in parents.items() if parent in ours} - ours:
        ours |= grown
    return sum(used.get(each, 0) for each in ours - {os.getpid()}) / os.sysconf("SC_CLK_TCK")


def drag(page: Page, grip: str, seconds: float) -> dict[str, float]:
    """Sweep a grip back and forth; milliseconds from the pointer's event to the redraw."""
    box = page.locator(f"[data-grip={grip}]").bounding_box()
    assert box is not None
    x, y = box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"]
    page.mouse.move(x, y)
    page.mouse.down()
    page.evaluate("measured.redraws.length = 0, measured.moves = 0")
    before = processor_seconds("chromium"), processor_seconds("studio")
    begin, k = time.perf_counter(), 0
    while time.perf_counter() - begin < seconds:
        k += 1
        page.mouse.move(x - 50.0 + 50.0 * math.cos(0.05 * k), y - 60.0 + 60.0 * math.cos(0.037 * k))
        time.sleep(max(0.0, begin + k / RATE - time.perf_counter()))
    took = time.perf_counter() - begin
    used = processor_seconds("chromium") - before[0], processor_seconds("studio") - before[1]
    page.mouse.up()
    page.wait_for_timeout(1000)
    moves, redraws = page.evaluate("[measured.moves, measured.redraws]")
    first = {seq: times for seq, _, *times in reversed(redraws)}
    lates, *phases = np.array(list(first.values())).T
    return {
        "moves a second": moves / took,
        "updates a second": len(first) / took,
        "median, ms": float(np.median(lates)),
        "95th percentile, ms": float(np.percentile(lates, 95)),
        "browser's processor time a move, ms": 1e3 * used[0] / moves,
        "server's an update, ms": 1e3 * used[1] / len(first),
        **{name: float(np.median(each)) for name, each in zip(PHASES, phases, strict=True)},
    }


def bundle() -> list[tuple[str, float]]:
    """Kilobytes of what a browser loads, compressed."""
    files = [path for path in sorted(STATIC.rglob("*")) if path.suffix in (".js", ".css", ".html", ".svg")]
    return [(path.suffix, len(gzip.compress(path.read_bytes(), 9, mtime=0)) / 1e3) for path in files]


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seconds", type=float, default=6.0)
    parser.add_argument("--rounds", type=int, default=3)
    given = parser.parse_args()
    chromium = shutil.which("chromium")
    if chromium is None:
        sys.exit("studio_page: needs chromium (Debian: apt-get install chromium)")
    sizes = bundle()
    print(f"bundle, gzipped: {sum(size for _, size in sizes):.1f} kB ({', '.join(f'{k} {v:.1f}' for k, v in sizes)})")
    with studio() as address, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        print(
            f"{platform.machine()}, {os.cpu_count()} cores, load {os.getloadavg()[0]:.1f}, chromium {browser.version}"
        )
        first_paint(browser, address)
        for _ in range(given.rounds):
            content, drawn = first_paint(browser, address)
            print(f"first content {content:.0f} ms, first region {drawn:.0f} ms")
        page = opened(browser, address)
        for grip in ("tip-right", "palm-right", "radius"):
            for _ in range(given.rounds):
                found = drag(page, grip, given.seconds)
                words = ", ".join(f"{name} {value:.1f}" for name, value in found.items())
                print(f"{grip}: {words}, load {os.getloadavg()[0]:.1f}", flush=True)
        browser.close()


if __name__ == "__main__":
    main()
