"""`palmar closure` as scripts and people see it."""

import pytest

EXACT = {"rel": 1e-12}


def test_the_chapter_2_example_to_its_printed_digits(palmar):
    answer = palmar("closure", "chapter2_example", "--json")
    assert answer.status == 0
    assert answer.err == ""
    record = answer.record
    assert record["structural"]["radius_min_m"] == pytest.approx(0.226, abs=5e-4)
    assert record["structural"]["radius_max_m"] == pytest.approx(0.974, abs=5e-4)
    assert record["frictional"]["radius_min_m"] == pytest.approx(0.220, abs=5e-4)
    assert record["frictional"]["radius_max_m"] == pytest.approx(2.054, abs=5e-4)
    assert record["object"]["structural"] is True
    assert record["object"]["frictional"] is True
    text = palmar("closure", "chapter2_example").out
    for printed in ("225.8 to 974.2 mm", "220.0 to 2053.6 mm"):
        assert printed in text


def case_file(tmp_path, radius=38.0, friction=0.7, palm=120.0, finger=244.0, more=""):
    path = tmp_path / "case.toml"
    path.write_text(
        f"[hand]\npalm_width_mm = {palm}\nfinger_links_mm = [{finger}]\n{more}"
        f"[object]\nradius_mm = {radius}\n[contact]\nfriction = {friction}\n"
    )
    return path


def test_without_friction_both_closures_are_the_same(palmar, tmp_path):
    record = palmar("closure", case_file(tmp_path, friction=0.0), "--json").record
    assert record["frictional"] == record["structural"]


def test_no_hold_is_null_and_exit_status_one_only_with_check(palmar, tmp_path):
    path = case_file(tmp_path, palm=1000.0, finger=100.0, friction=0.1)
    answer = palmar("closure", path, "--json")
    assert (answer.status, answer.record["structural"], answer.record["frictional"]) == (0, None, None)
    assert palmar("closure", path, "--check").status == 1
    assert palmar("closure", "testbed_table", "--check").status == 0


@pytest.mark.parametrize(
    ("radius", "said"),
    [
        (38.0, "held without friction, 22 mm below the largest"),
        (64.2, "too large by 4.2 mm: it is wider than the gap between the finger bases"),
        (250.0, "with friction 0.7 too large by 5.96 mm"),
    ],
)
def test_the_reason_names_the_distance_and_the_cause(palmar, tmp_path, radius, said):
    record = palmar("closure", case_file(tmp_path, radius=radius), "--json").record
    assert said in record["object"]["reason"]


def test_a_suggested_change_is_enough_and_no_more(palmar, tmp_path):
    record = palmar("closure", case_file(tmp_path, radius=64.2), "--json").record
    (change,) = [each for each in record["changes"] if each["dimension"] == "palm_width"]
    assert change["to"] == pytest.approx(0.1284, rel=1e-9)
    for palm, held in ((128.4001, True), (128.3999, False)):
        assert (
            palmar("closure", case_file(tmp_path, radius=64.2, palm=palm), "--json").record["object"]["structural"]
            is held
        )


def test_slopes_agree_with_neighbouring_hands(palmar, tmp_path):
    record = palmar("closure", case_file(tmp_path, palm=300.0), "--json").record
    wider = palmar("closure", case_file(tmp_path, palm=300.1), "--json").record
    (slope,) = [e for e in record["slopes"] if (e["closure"], e["dimension"]) == ("frictional", "palm_width")]
    moved = (wider["frictional"]["radius_max_m"] - record["frictional"]["radius_max_m"]) / 1e-4
    assert slope["radius_max"][1] == pytest.approx(moved, rel=1e-3)


def test_ranges_report_what_holds_for_all_of_them(palmar, tmp_path):
    record = palmar("closure", case_file(tmp_path, friction='"0.2..0.8"', radius='"30..70"'), "--json").record
    least = palmar("closure", case_file(tmp_path, friction=0.2), "--json").record
    assert record["frictional"] == pytest.approx(least["frictional"])
    assert record["object"]["structural"] is False
    assert record["object"]["frictional"] is True


def test_size_gives_the_other_dimension_or_says_why_none_does(palmar):
    record = palmar("closure", "size", "--radius", "20..60", "--palm-width", "130", "--json").record
    ((low, high),) = record["intervals_m"]
    assert low == pytest.approx((0.060**2 + 0.005**2) ** 0.5, rel=1e-9)
    assert high is None
    answer = palmar("closure", "size", "--radius", "20..70", "--palm-width", "120", "--check")
    assert answer.status == 1
    assert "at most 60 mm" in answer.out
    answer = palmar("closure", "size", "--radius", "1..230", "--finger-length", "100", "--friction", "0.7")
    assert "no palm width serves both ends" in answer.out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["closure"], "requires an argument"),
        (["closure", "nope"], "no shipped case of this name"),
        (["closure", "nope.toml"], "cannot be read"),
        (["closure", "testbed_table", "extra"], "extra"),
        (["closure", "testbed_table", "--nope"], "--nope"),
        (["clsure", "testbed_table"], "closure"),
        (["closure", "size", "--radius", "abc", "--palm-width", "3"], "must be a finite number"),
        (["closure", "size", "--radius", "nan", "--palm-width", "3"], "must be a finite number"),
        (["closure", "size", "--radius", "-3", "--palm-width", "3"], "must be greater than 0"),
        (["closure", "size", "--radius", "5..3", "--palm-width", "3"], "the smaller radius comes first"),
        (["closure", "size", "--radius", "5"], "exactly one"),
        (["closure", "size", "--radius", "5", "--palm-width", "3", "--friction", "-1"], "must be at least 0"),
    ],
)
def test_bad_input_is_one_line_and_status_two(palmar, words, said):
    answer = palmar(*words)
    assert answer.status == 2
    assert answer.out == ""
    assert answer.err.count("\n") == 1
    assert said in answer.err
