"""What comes from outside is read strictly, and refused in one line."""

import json

import pytest

from palmar.errors import InputError
from palmar.faces.studio.kinds import Kind
from palmar.faces.studio.requests import read_file_request, read_request

GOOD = {"id": "a", "seq": 3, "kind": "look", "case": {"hand": {}}, "parameters": {"settled": False}}


def test_a_question_is_read():
    request = read_request(json.dumps(GOOD))
    assert (request.kind, request.case, request.parameters) == (Kind.LOOK, {"hand": {}}, {"settled": False})
    assert request.head == {"id": "a", "seq": 3, "kind": "look", "channel": ""}


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "message: is not JSON"),
        ("[" * 100_000, "message: is not JSON: nested too deep"),
        ('{"id": NaN}', "NaN is no number"),
        ('{"seq": ' + "9" * 5000 + "}", "is not JSON"),
        ("[]", "message: must be a JSON object"),
        (json.dumps({**GOOD, "seq": -1}), "message.seq = -1: must be at least 0"),
        (json.dumps({**GOOD, "seq": 1.5}), "message.seq = 1.5"),
        (json.dumps({**GOOD, "id": "x" * 65}), "message.id"),
        (json.dumps({**GOOD, "kind": "delete"}), "must be one of"),
        (json.dumps({**GOOD, "kind": "export"}), "files come by POST"),
        (json.dumps({**GOOD, "path": "/etc/passwd"}), "path: unknown"),
        (json.dumps({**GOOD, "case": [1]}), "message.case"),
    ],
)
def test_anything_else_is_refused(text, words):
    with pytest.raises(InputError) as refused:
        read_request(text)
    assert words in str(refused.value)


def test_a_wish_for_a_file_names_no_path():
    with pytest.raises(InputError, match="out: unknown"):
        read_file_request(json.dumps({"what": "region", "format": "svg", "out": "/tmp/x.svg"}))
