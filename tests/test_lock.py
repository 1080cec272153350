"""The locks name hashes and no address, and pin what the project asks for."""

import json
import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[1]
LOCK = (ROOT / "requirements.lock").read_text(encoding="utf-8")

WEB = ROOT / "src" / "palmar" / "faces" / "studio" / "web"


def test_lock_has_hashes_and_no_address():
    assert "://" not in LOCK
    pins = [line for line in LOCK.splitlines() if re.match(r"[a-z0-9]", line)]
    assert len(pins) > 30
    assert LOCK.count("--hash=sha256:") >= len(pins)


def test_every_direct_requirement_is_pinned_and_the_build_backend_too():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    wanted = [*project["project"]["dependencies"], *project["build-system"]["requires"]]
    wanted += [each for group in project["dependency-groups"].values() for each in group]
    for requirement in wanted:
        name = re.split(r"[<>=!~\[ ;]", requirement)[0]
        assert re.search(rf"^{name}==", LOCK, re.MULTILINE), name


def test_every_extra_but_that_for_gpus_is_pinned():
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["optional-dependencies"]
    pinned = set(re.findall(r"^([a-z0-9-]+)==", LOCK, re.MULTILINE))
    names = {extra: {re.split(r"[<>=\[]", each)[0] for each in wanted} for extra, wanted in extras.items()}
    assert {extra for extra, wanted in names.items() if not wanted <= pinned} == {"gpu"}


def test_lock_of_the_page_has_hashes_and_no_address():
    text = (WEB / "package-lock.json").read_text(encoding="utf-8")
    assert '"resolved"' not in text
    packages = {name: each for name, each in json.loads(text)["packages"].items() if name}
    assert {"node_modules/react", "node_modules/react-dom"} <= packages.keys()
    assert [name for name, each in packages.items() if not each.get("integrity", "").startswith("sha512-")] == []


def test_page_needs_react_alone_at_run_time():
    assert json.loads((WEB / "package.json").read_text(encoding="utf-8"))["dependencies"].keys() == {
        "react",
        "react-dom",
    }
