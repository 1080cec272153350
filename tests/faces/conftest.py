"""A way to call the command line inside the test process, as its user would."""

import json
from dataclasses import dataclass

import pytest

from palmar.faces.cli.main import run


@dataclass(frozen=True)
class Answer:
    status: int
    out: str
    err: str

    @property
    def record(self):
        """The one JSON object on stdout."""
        return json.loads(self.out)


@pytest.fixture
def palmar(capsys):
    """palmar("closure", "testbed_table", "--json") -> Answer."""

    def call(*words: object) -> Answer:
        status = 0
        try:
            run([str(word) for word in words])
        except SystemExit as leave:
            status = int(leave.code or 0)
        out, err = capsys.readouterr()
        return Answer(status, out, err)

    return call
