#!/usr/bin/env python3
"""Everything a developer or a first user does, with nothing but python3 and pip.

    python3 dev.py run      the report of the shipped test-bed case, on screen and as a page
    python3 dev.py test     the test suite
    python3 dev.py lint     style, types and import contracts
    python3 dev.py docs     the documentation, as HTML
    python3 dev.py bench    the benchmarks
    python3 dev.py validate WHAT   a long hunt: one of validation/*.py, its figures go into docs/results
    python3 dev.py web      the studio's page, from its sources (needs node 20.19 or newer; users do not need it)
    python3 dev.py lock     the requirement lock, anew
    python3 dev.py setup    only the environment (.venv); every other command does this by itself

Words after `run`, `test`, `bench` and `validate` go to the program behind them.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parent
VENV = ROOT / ".venv"
BIN = VENV / ("Scripts" if os.name == "nt" else "bin")
PYTHON = BIN / ("python.exe" if os.name == "nt" else "python")
LOCK = ROOT / "requirements.lock"
STAMP = VENV / "palmar-stamp"
GROUPS = ("test", "lint", "docs", "build")
EXTRAS = ("mujoco", "realtime", "sweep", "dask", "studio")
"""All but ``gpu``: half a gigabyte that is of no use without a device."""
OLDEST_PYTHON = (3, 11)


def stop(message: str) -> None:
    """Leave with one plain line."""
    sys.exit(f"dev.py: {message}")


def call(*words: str | Path) -> None:
    """Run a program in the checkout; leave with its exit status if it fails."""
    status = subprocess.run([str(word) for word in words], cwd=ROOT, check=False).returncode
    if status:
        sys.exit(status)


def fingerprint(*parts: bytes) -> str:
    return hashlib.sha256(b"\n".join(parts)).hexdigest()


def setup() -> None:
    """Make `.venv` hold exactly what the lock says, and the project itself; idempotent."""
    packages = fingerprint(sys.version.encode(), LOCK.read_bytes())
    project = fingerprint((ROOT / "pyproject.toml").read_bytes())
    stamp = f"{packages} {project}"
    found = STAMP.read_text() if STAMP.exists() else ""
    if found == stamp:
        return
    if sys.version_info < OLDEST_PYTHON:
        stop(f"needs Python {'.'.join(map(str, OLDEST_PYTHON))} or newer, this is {sys.version.split()[0]}")
    if subprocess.run([sys.executable, "-m", "pip", "--version"], capture_output=True, check=False).returncode:
        stop("needs pip for this python3 (Debian: apt-get install python3-pip)")
    pip = (sys.executable, "-m", "pip", "--python", PYTHON, "install", "-qq", "--disable-pip-version-check")
    if not found.startswith(packages):
        print("dev.py: preparing .venv, once per change of requirements", file=sys.stderr, flush=True)
        shutil.rmtree(VENV, ignore_errors=True)
        venv.create(VENV, with_pip=False, symlinks=os.name != "nt")
        call(*pip, "--require-hashes", "--no-deps", "-r", LOCK)
    call(*pip, "--no-deps", "--no-build-isolation", "--editable", ROOT)
    STAMP.write_text(stamp)


def run(*words: str) -> None:
    """The first answer: can the test-bed hand hold the disk, and from where does it catch it?"""
    call(BIN / "palmar", "report", *(words or ("testbed_table", "--out", "build/report")))


def test(*words: str) -> None:
    call(PYTHON, "-m", "pytest", *words)


def lint() -> None:
    call(BIN / "ruff", "check")
    call(BIN / "ruff", "format", "--check")
    call(BIN / "mypy")
    call(BIN / "lint-imports")


def docs() -> None:
    call(PYTHON, "-m", "sphinx", "-W", "--keep-going", "-q", "-b", "html", "docs", "build/docs")
    print("documentation: build/docs/index.html")


def bench(*words: str) -> None:
    if words[:1] in (("comparison",), ("gpu",)):
        call(PYTHON, f"benchmarks/{words[0]}.py", *words[1:])
        return
    call(PYTHON, "-m", "pytest", "benchmarks", "-n0", "--benchmark-only", *words)


def validate(*words: str) -> None:
    known = sorted(path.stem for path in (ROOT / "validation").glob("*.py"))
    if not words or words[0] not in known:
        stop(f"validate what? One of: {', '.join(known)}")
    call(PYTHON, f"validation/{words[0]}.py", *words[1:])


def web() -> None:
    """The bundle in faces/studio/static, by the packages that the lock beside the sources names."""
    npm = shutil.which("npm")
    if npm is None:
        stop("needs node 20.19 or newer and npm (the built page is in the repository, only changing it needs them)")
    sources = ROOT / "src" / "palmar" / "faces" / "studio" / "web"
    call(npm, "--prefix", sources, "ci", "--ignore-scripts", "--no-progress")
    call(npm, "--prefix", sources, "run", "build")


def lock() -> None:
    groups = [word for group in GROUPS for word in ("--group", group)]
    extras = [word for extra in EXTRAS for word in ("--extra", extra)]
    call(
        BIN / "uv", "pip", "compile", "pyproject.toml", *groups, *extras, "--universal", "--generate-hashes",
        "--no-emit-index-url", "--no-annotate", "--no-header", "--quiet", "--output-file", LOCK,
    )  # fmt: skip


COMMANDS = {
    "run": run, "test": test, "lint": lint, "docs": docs, "bench": bench, "validate": validate, "web": web, "lock": lock,
    "setup": None,
}  # fmt: skip
TAKE_WORDS = ("run", "test", "bench", "validate")


def main(words: list[str]) -> None:
    if not words or words[0] not in COMMANDS or (words[1:] and words[0] not in TAKE_WORDS):
        print(__doc__, file=sys.stderr)
        sys.exit(0 if words in (["-h"], ["--help"]) else 2)
    if words[0] != "web":
        setup()
    command = COMMANDS[words[0]]
    if command is not None:
        command(*words[1:])


if __name__ == "__main__":
    main(sys.argv[1:])
