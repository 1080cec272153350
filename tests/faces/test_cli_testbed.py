"""`palmar validate` and `palmar testbed limits`: the records that scripts rely on, and one plain line for misuse."""

import json

import pytest

HAND = "[hand]\npalm_width_mm = 120\nfinger_links_mm = [244]\nfinger_rate_deg_s = 20\n[object]\nradius_mm = 38\n"


def test_a_region_is_put_to_the_test(palmar):
    answer = palmar("validate", "testbed_table", "--world", "planar", "--samples", "50", "--seed", "7", "--json")
    assert (answer.status, answer.err) == (0, "")
    assert answer.record["samples"] == 50
    assert answer.record["inside"] == {"caught": 25, "lost": 0}
    assert answer.record["outside"] == {"caught": 0, "lost": 25}
    assert answer.record["worst"] is None
    again = palmar("validate", "testbed_table", "--world", "planar", "--samples", "50", "--seed", "7", "--check")
    assert again.status == 0
    assert "inside" in again.out


def test_outcomes_are_kept_and_taken_up_again(palmar, tmp_path):
    pytest.importorskip("mujoco", reason="needs the extra palmar[mujoco]")
    case, log = tmp_path / "case.toml", tmp_path / "starts.jsonl"
    case.write_text(HAND.replace("rate_deg_s = 20", "rate_deg_s = 40"), encoding="utf-8")
    words = ("validate", case, "--samples", "4", "--seed", "1", "--log", log, "--json")
    first = palmar(*words).record
    lines = log.read_text(encoding="utf-8").splitlines()
    assert len(lines) == 5
    kept = [json.loads(line) for line in lines[1:]]
    kept[0]["outcome"] = "missed" if kept[0]["outcome"] != "missed" else "frictional"
    log.write_text("\n".join([lines[0], *(json.dumps(each) for each in kept)]) + "\n", encoding="utf-8")
    second = palmar(*words).record
    assert first["agreement"] == {"same": 4, "alike": 4, "disputed": []}
    assert second["agreement"]["same"] == second["agreement"]["alike"] == 3
    (odd,) = second["agreement"]["disputed"]
    assert odd["planar"] != odd["outcome"] and "planar_changes_within_m" in odd
    assert palmar(*words, "--margin-mm", "1").status == 2


def test_the_cases_behaviour_is_what_is_tried(palmar, tmp_path):
    """An arm that goes 60 mm ahead and then grabs catches what lies further out."""
    case = tmp_path / "case.toml"
    move = '[behaviour]\nname = "{name}"\nadvance_mm = 60\n[sensors]\nlayout = "palm"\n'
    case.write_text(HAND + move.format(name="move_and_grab"), encoding="utf-8")
    record = palmar("validate", case, "--world", "planar", "--samples", "4", "--margin-mm", "9", "--json").record
    assert (record["inside"]["caught"], record["outside"]["lost"], record["agreement"]) == (2, 2, None)
    words = ("--world", "planar", "--angles", "90", "--tolerance-mm", "4", "--json")
    (further,) = palmar("testbed", "limits", case, *words).record["limits"]
    assert -4.1e-3 < further["difference_m"] <= 1e-4
    (closing,) = palmar("testbed", "limits", "testbed_table", *words).record["limits"]
    assert further["limit_m"] - closing["limit_m"] == pytest.approx(0.06, abs=5e-3)
    case.write_text(HAND + move.format(name="scoop"), encoding="utf-8")
    for command in (("validate", case), ("testbed", "limits", case)):
        answer = palmar(*command, "--world", "planar")
        assert (answer.status, answer.err.strip().count("\n")) == (2, 0)
        assert "scoop" in answer.err


def test_in_mujoco(palmar, tmp_path):
    pytest.importorskip("mujoco", reason="needs the extra palmar[mujoco]")
    case = tmp_path / "case.toml"
    case.write_text(HAND, encoding="utf-8")
    words = ("--world", "mujoco", "--samples", "2", "--seed", "1", "--margin-mm", "10", "--json")
    record = palmar("validate", case, *words).record
    assert (record["inside"]["caught"], record["outside"]["lost"]) == (1, 1)
    assert (record["world"], record["margin_m"]) == ("mujoco", 0.01)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("--samples", "1"), "--samples"),
        (("--margin-mm", "-1"), "--margin-mm"),
        (("--margin-mm", "400"), "--margin-mm"),
        (("--seed", "-1"), "--seed"),
    ],
)
def test_misuse_of_validate_is_one_line(palmar, words, told):
    answer = palmar("validate", "testbed_table", "--world", "planar", *words)
    assert (answer.status, answer.out, answer.err.strip().count("\n")) == (2, "", 0)
    assert told in answer.err


def limits(palmar, *words):
    options = ("--world", "planar", "--angles", "30,90", "--tolerance-mm", "2", *words)
    return palmar("testbed", "limits", "testbed_table", *options)


def test_limits_are_kept_and_taken_up_again(palmar, tmp_path):
    log = tmp_path / "limits.jsonl"
    first = limits(palmar, "--log", log, "--json").record
    lines = log.read_text(encoding="utf-8").splitlines()
    assert len(lines) == first["trials"] + 1
    log.write_text("\n".join(lines[:6]) + "\n" + lines[6][:9], encoding="utf-8")
    assert limits(palmar, "--log", log, "--json").record == first
    assert len(log.read_text(encoding="utf-8").splitlines()) == len(lines)
    assert all(-2.1e-3 < each["difference_m"] <= 1e-5 for each in first["limits"])
    other = limits(palmar, "--log", log, "--seed", "2")
    assert other.status == 2
    assert "another search" in other.err


def test_a_log_that_is_none_is_refused(palmar, tmp_path):
    log = tmp_path / "limits.jsonl"
    log.write_text(json.dumps([1, 2]) + "\nrubbish\n", encoding="utf-8")
    answer = limits(palmar, "--log", log)
    assert (answer.status, answer.err.strip().count("\n")) == (2, 0)
    assert limits(palmar, "--angles", "30,x").status == 2
    assert limits(palmar, "--angles", "200").status == 2
