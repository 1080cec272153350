"""The page's files, as built and committed: read once, so that no request names a file of this machine."""

from __future__ import annotations

import mimetypes
from dataclasses import dataclass
from importlib import resources
from importlib.resources.abc import Traversable

INDEX = "index.html"
FOREVER, ALWAYS_ASK = "public, max-age=31536000, immutable", "no-cache"
ABSENT = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>palmar studio</title></head>
<body><h1>The page has not been built</h1>
<p>This checkout has no bundle of the studio's page. With node 20 or newer, <code>python3 dev.py web</code> builds it.</p>
</body></html>
"""


@dataclass(frozen=True)
class Asset:
    """One file: its bytes, its type, and how long a browser may keep it."""

    data: bytes
    media_type: str
    cache: str


def assets() -> dict[str, Asset]:
    """By path below the address; without a bundle a page that says how to build it."""
    folder = resources.files("palmar.faces.studio") / "static"
    found = dict(_files(folder, "")) if folder.is_dir() else {}
    if INDEX not in found:
        found[INDEX] = Asset(ABSENT.encode(), "text/html; charset=utf-8", ALWAYS_ASK)
    found[""] = found[INDEX]
    return found


def _files(folder: Traversable, below: str) -> list[tuple[str, Asset]]:
    files: list[tuple[str, Asset]] = []
    for each in folder.iterdir():
        path = f"{below}{each.name}"
        if each.is_dir():
            files += _files(each, f"{path}/")
        else:
            files.append((path, Asset(each.read_bytes(), _type(each.name), FOREVER if below else ALWAYS_ASK)))
    return files


def _type(name: str) -> str:
    known = {"js": "text/javascript", "css": "text/css", "html": "text/html", "svg": "image/svg+xml"}
    kind = known.get(name.rpartition(".")[2]) or mimetypes.guess_type(name)[0] or "application/octet-stream"
    return f"{kind}; charset=utf-8" if kind.startswith("text/") else kind
