"""`palmar sweep`: the record that scripts rely on, questions and pictures, and one plain line for misuse."""

import pytest

pytest.importorskip("pyarrow", reason="needs the extra palmar[sweep]")

SPEC = """
[sweep]
case = "testbed_table"
samples = 20
[vary]
"object.radius_mm" = [30.0, 50.0]
"start.at_mm.0" = { uniform = [-250.0, 250.0] }
"""


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    from palmar.faces.cli.main import run

    folder = tmp_path_factory.mktemp("sweep")
    (folder / "spec.toml").write_text(SPEC)
    run(["sweep", str(folder / "spec.toml"), "--out", str(folder / "out"), "--workers", "1"])
    return folder


def test_the_record_and_the_second_run_that_finds_all_done(palmar, swept):
    again = palmar("sweep", swept / "spec.toml", "--out", swept / "out", "--json", "--workers", "1")
    assert (again.status, again.err) == (0, "")
    assert {"rows": 40, "shards": 1, "found": 1}.items() <= again.record.items()
    assert again.record["seconds"] < 5.0
    record = palmar("sweep", "status", swept / "out", "--json").record
    assert (record["rows"], record["rows_in_all"], record["complete"]) == (40, 40, True)


def test_a_question_in_sql(palmar, swept):
    sql = 'SELECT "object.radius_mm" AS r, count(*) AS n FROM sweep GROUP BY r ORDER BY r'
    assert palmar("sweep", "query", swept / "out", "--sql", sql, "--json").record == {
        "columns": ["r", "n"],
        "rows": [[30.0, 20], [50.0, 20]],
    }
    assert palmar("sweep", "query", swept / "out", "--sql", sql).out.split() == ["r", "n", "30", "20", "50", "20"]


def test_a_picture(palmar, swept):
    for by, points in (("object.radius_mm", 2), ("object.radius_mm,start.at_mm.0", 8)):
        picture = swept / "picture.svg"
        answer = palmar("sweep", "plot", swept / "out", "--by", by, "--bins", 4, "--out", picture, "--json")
        assert len(answer.record["rows"]) == points
        text = picture.read_text()
        assert "object radius, mm" in text
        assert "share caught" in text
        assert ("start x, mm" in text) == (points == 8)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("nothing", "--out", "x"), "no such file and no shipped sweep, shipped are sweep_table"),
        (("sweep_table", "--out", "nowhere://x"), "--out = 'nowhere://x': is no folder"),
        (("sweep_table", "--out", "x", "--address", "tcp://a:1"), "--address"),
        (("sweep_table", "--out", "x", "--engine", "dask"), "takes --address"),
        (("sweep_table", "--out", "x", "--workers", "0"), "--workers = 0: must be 1 to 1024"),
        (("sweep_table", "--out", "x", "--device", "gpu", "--engine", "dask", "--address", "tcp://a:1"), "--device"),
        (("status", "nowhere"), "nowhere: holds no sweep"),
        (("query", "nowhere", "--sql", "SELECT 1"), "nowhere: holds no sweep"),
        (("plot", "nowhere", "--by", "a,b,c", "--out", "x.svg"), "--by = 'a,b,c': must be KEY or KEY,KEY"),
        (("plot", "nowhere", "--by", "a", "--bins", "1", "--out", "x.svg"), "--bins = 1: must be 2 to 1000"),
    ],
)
def test_misuse_is_one_plain_line(palmar, words, said):
    answer = palmar("sweep", *words)
    assert answer.status == 2
    assert said in answer.err
    assert answer.err.count("\n") == 1
