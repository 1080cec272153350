"""Files that someone wrote."""

from pathlib import Path

import pytest

from palmar.errors import InputError
from palmar.models.text_file import read_text


def test_a_byte_order_mark_is_no_text(tmp_path: Path):
    path = tmp_path / "case.toml"
    path.write_bytes(b"\xef\xbb\xbfpalm = 1\n")
    assert read_text(path) == "palm = 1\n"


@pytest.mark.parametrize(("data", "words"), [(b"12345", "is larger than 4 bytes, a word"), (b"a\xff", "byte 1")])
def test_what_is_no_such_text_is_refused_in_a_line(tmp_path: Path, data, words):
    path = tmp_path / "case.toml"
    path.write_bytes(data)
    with pytest.raises(InputError, match=words) as refused:
        read_text(path, 4, ", a word")
    assert str(path) in str(refused.value)


def test_a_folder_is_no_file(tmp_path: Path):
    with pytest.raises(InputError, match="cannot be read: Is a directory"):
        read_text(tmp_path)
