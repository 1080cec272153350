"""Sweeps into folders: rows equal the commands' own answers, whole shards only, and one specification to a folder."""

import os
import signal
import subprocess
import sys
import time
from threading import current_thread

import numpy as np
import pytest

pytest.importorskip("pyarrow", reason="needs the extra palmar[sweep]")

import pyarrow.parquet as parquet

from palmar.errors import InputError, OutputError
from palmar.mechanics import batch
from palmar.mechanics.batch import in_parts
from palmar.models.sweep_file import parse_sweep
from palmar.studies.closure import closure_answer
from palmar.studies.simulate import simulate_start
from palmar.studies.sweep import shards
from palmar.studies.sweep.query import mean_by, query, status
from palmar.studies.sweep.run import run_sweep
from palmar.studies.sweep.shards import run_shard, shard_table
from palmar.studies.sweep.store import Manifest, Store

SPEC = """
[sweep]
case = "testbed_table"
samples = 40
[vary]
"object.radius_mm" = [30.0, 50.0]
"start.at_mm.0" = { uniform = [-250.0, 250.0] }
"start.at_mm.1" = { uniform = [0.0, 300.0] }
"""
SWEEP = parse_sweep(SPEC)


class Here:
    """An engine in this process, which stops after so many shards."""

    def __init__(self, most=10**9):
        self.most, self.asked = most, []

    def rate(self, sweep):
        return 7.0

    def run(self, sweep, url, todo):
        for shard, stretch in todo:
            if len(self.asked) == self.most:
                raise KeyboardInterrupt
            self.asked.append(shard)
            yield run_shard(sweep, url, shard, stretch)


def rows_of(store):
    return query(store, "SELECT * FROM sweep ORDER BY row").rows


def test_rows_are_what_simulate_says_of_each():
    table = shard_table(SWEEP, 30, 50).to_pydict()
    for k in range(0, 20, 3):
        case = SWEEP.case_at({"object.radius_mm": table["object.radius_mm"][k]})
        ends = simulate_start(case, (1e-3 * table["start.at_mm.0"][k], 1e-3 * table["start.at_mm.1"][k]))
        assert (table["outcome"][k], table["caught"][k]) == (ends.outcome.value, ends.outcome.caught)
        assert [table[name][k] for name in ("x_m", "y_m", "theta_rad")] == pytest.approx(ends.pose, abs=1e-12)
        assert (table["right_rad"][k], table["left_rad"][k]) == (ends.right[0], ends.left[0])
    assert set(table["outcome"]) > {"frictional"}


def test_a_shard_keeps_to_one_thread(monkeypatch):
    def seen(sweep, given):
        in_parts(lambda _: threads.add(current_thread()), 8, 1)
        return answers(sweep, given)

    threads, answers = set(), shards.answers
    monkeypatch.setattr(batch, "cpu_count", lambda: 4)
    monkeypatch.setattr(shards, "answers", seen)
    shard_table(SWEEP, 0, 2)
    assert threads == {current_thread()}


def test_a_row_that_is_refused_has_its_reason_and_no_answer():
    """A start with a velocity on a table: its neighbours in the batch are answered."""
    spec = SPEC.replace('"object.radius_mm" = [30.0, 50.0]', '"start.velocity_mm_s.0" = [0.0, 10.0]')
    table = shard_table(parse_sweep(spec), 38, 42).to_pydict()
    assert (
        [each is None for each in table["outcome"]]
        == [False, False, True, True]
        == [each is None for each in table["x_m"]]
    )
    assert table["error"][:2] == [None, None]
    assert table["error"][2].startswith("velocity: quasi-static")


def test_closure_region_and_plan_answer_row_by_row():
    spec = 'case = "testbed_table"\n[vary]\n"object.radius_mm" = [38.0, 500.0]\n'
    closure = shard_table(parse_sweep(f'[sweep]\ncommand = "closure"\n{spec}'), 0, 2).to_pydict()
    expected = closure_answer(SWEEP.case_at({"object.radius_mm": 38.0}))
    assert closure["frictional"] == [1.0, 0.0]
    assert closure["frictional_max_m"][0] == expected.frictional.radius_max
    region = shard_table(parse_sweep(f'[sweep]\ncommand = "region"\n{spec}'), 0, 2).to_pydict()
    assert region["area_m2"][0] > 0.05
    assert (region["area_m2"][1], region["error_m"][1]) == (0.0, None)
    plan = parse_sweep(f'[sweep]\ncommand = "plan"\nuncertainty_mm = 20.0\n{spec}')
    assert shard_table(plan, 0, 1).to_pydict()["guaranteed"] == [1.0]


def test_an_interrupted_sweep_goes_on_and_ends_alike(tmp_path):
    whole, parts = Store(str(tmp_path / "whole")), Store(str(tmp_path / "parts"))
    told = []
    done = run_sweep(SWEEP, whole, Here(), told.append)
    assert (done.rows, done.shards, done.found) == (80, 12, 0)
    assert told == [0, *range(7, 80, 7), 80]
    with pytest.raises(KeyboardInterrupt):
        run_sweep(SWEEP, parts, Here(most=5))
    assert (status(parts).shards, status(parts).complete) == (5, False)
    (tmp_path / "parts" / ".unfinished-1-shard-00000009.parquet").write_bytes(b"half")
    again = Here()
    assert run_sweep(SWEEP, parts, again).found == 5
    assert again.asked == list(range(5, 12))
    assert rows_of(parts) == rows_of(whole)
    assert len(rows_of(whole)) == 80
    assert not list((tmp_path / "parts").glob(".unfinished*"))


def test_a_folder_has_one_specification(tmp_path):
    store = Store(str(tmp_path))
    run_sweep(SWEEP, store, Here())
    with pytest.raises(InputError, match="another specification"):
        run_sweep(parse_sweep(SPEC.replace("40", "41")), store, Here())
    (tmp_path / "sweep.json").write_text("{")
    with pytest.raises(InputError, match="is not what a sweep writes"):
        run_sweep(SWEEP, store, Here())


def test_two_runs_in_one_folder_are_refused(tmp_path):
    store = Store(str(tmp_path))
    store.begin(Manifest(SWEEP.digest, SWEEP.rows, 40, "simulate"))
    with store.alone(), pytest.raises(InputError, match="another run"):
        run_sweep(SWEEP, store, Here())


def test_a_full_disk_leaves_no_half_shard(tmp_path, monkeypatch):
    store = Store(str(tmp_path))
    store.begin(Manifest(SWEEP.digest, SWEEP.rows, 40, "simulate"))

    def full(_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OutputError, match="No space left"):
        run_shard(SWEEP, store.url, 1, (40, 80))
    assert sorted(each.name for each in tmp_path.iterdir()) == ["sweep.json"]


def test_any_file_system_will_do():
    store = Store("memory://sweeps/one")
    run_sweep(SWEEP, store, Here())
    assert status(store).complete
    assert query(store, "SELECT count(*) FROM sweep").rows == ((80,),)


def test_questions_in_sql(tmp_path):
    store = Store(str(tmp_path))
    run_sweep(SWEEP, store, Here())
    by_radius = mean_by(store, "caught", ["object.radius_mm"], 10)
    rows = rows_of(store)
    caught = query(store, "SELECT caught FROM sweep WHERE row < 40 ORDER BY row").rows
    assert [row[2] for row in by_radius.rows] == [40, 40]
    assert by_radius.rows[0][:2] == (30.0, pytest.approx(np.mean([row[0] for row in caught])))
    binned = mean_by(store, "caught", ["start.at_mm.0", "start.at_mm.1"], 3).rows
    assert sum(row[3] for row in binned) == len(rows)
    assert len({row[0] for row in binned}) == 3
    with pytest.raises(InputError, match="nonsense"):
        query(store, "SELECT nonsense FROM sweep")
    with pytest.raises(InputError, match="must be one of row, object"):
        mean_by(store, "caugth", ["row"], 3)
    with pytest.raises(InputError, match="holds no sweep"):
        status(Store(str(tmp_path / "none")))


def test_a_killed_run_leaves_no_process_and_no_broken_shard(tmp_path):
    """kill -9 in the midst of it: what is there can be read, and its workers end by themselves."""
    script = """
import sys
from palmar.models.sweep_file import open_sweep
from palmar.studies.sweep.local import local_engine
from palmar.studies.sweep.run import run_sweep
from palmar.studies.sweep.store import Manifest, Store
if __name__ == "__main__":
    sweep, store = open_sweep(sys.argv[1]), Store(sys.argv[2])
    store.begin(Manifest(sweep.digest, sweep.rows, 100, "closure"))
    with local_engine(1) as engine:
        engine._pool.submit(int).result()
        print(*engine._pool._processes, flush=True)
        run_sweep(sweep, store, engine)
"""
    spec, folder = tmp_path / "spec.toml", tmp_path / "out"
    spec.write_text(
        '[sweep]\ncase = "testbed_table"\ncommand = "closure"\n[vary]\n'
        '"object.radius_mm" = { from = 20.0, to = 60.0, steps = 100000 }\n'
    )
    (tmp_path / "run.py").write_text(script)
    run = subprocess.Popen([sys.executable, tmp_path / "run.py", spec, folder], stdout=subprocess.PIPE, text=True)
    assert run.stdout is not None
    worker = int(run.stdout.readline())
    for _ in range(400):
        if len(Store(str(folder)).done()) > 1:
            break
        time.sleep(0.02)
    run.send_signal(signal.SIGKILL)
    run.wait()
    run.stdout.close()
    for _ in range(400):
        try:
            os.kill(worker, 0)
        except ProcessLookupError:
            break
        time.sleep(0.02)
    else:
        pytest.fail("the worker is still there")
    shards = sorted(folder.glob("shard-*.parquet"))
    assert len(shards) > 1
    assert all(parquet.read_table(each).num_rows == 100 for each in shards)
