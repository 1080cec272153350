"""Files and functions stay short enough to read; exceptions are listed here with their reason."""

import ast
from pathlib import Path

import pytest

SOURCES = sorted((Path(__file__).parents[1] / "src").rglob("*.py"))
WEB = Path(__file__).parents[1] / "src" / "palmar" / "faces" / "studio" / "web" / "src"
WEB_SOURCES = sorted(path for path in WEB.rglob("*") if path.suffix in (".ts", ".tsx", ".css"))
LONGEST_FILE, LONGEST_BODY = 300, 40
LONG_FILES: dict[str, str] = {}
LONG_FUNCTIONS: dict[str, str] = {}


def body_lines(function: ast.FunctionDef | ast.AsyncFunctionDef) -> int:
    body = function.body
    documented = isinstance(body[0], ast.Expr) and isinstance(body[0].value, ast.Constant)
    first = body[1] if documented and len(body) > 1 else body[0]
    return function.end_lineno - first.lineno + 1


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.name)
def test_file_and_its_functions_are_short(path: Path):
    text = path.read_text(encoding="utf-8")
    assert len(text.splitlines()) <= LONGEST_FILE or path.name in LONG_FILES
    functions = [node for node in ast.walk(ast.parse(text)) if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)]
    long = [f"{each.name}: {body_lines(each)}" for each in functions if body_lines(each) > LONGEST_BODY]
    assert [each for each in long if each.split(":")[0] not in LONG_FUNCTIONS] == []


@pytest.mark.parametrize("path", WEB_SOURCES, ids=lambda path: path.name)
def test_file_of_the_page_is_short(path: Path):
    assert len(path.read_text(encoding="utf-8").splitlines()) <= LONGEST_FILE
