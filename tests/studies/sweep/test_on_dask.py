"""A sweep on a Dask cluster: the same rows as here, written by its workers."""

import pytest

pytest.importorskip("distributed", reason="needs the extra palmar[dask]")
pytest.importorskip("pyarrow", reason="needs the extra palmar[sweep]")

from distributed import LocalCluster

from palmar.errors import InputError
from palmar.models.sweep_file import parse_sweep
from palmar.studies.sweep.on_dask import dask_engine
from palmar.studies.sweep.query import query
from palmar.studies.sweep.run import run_sweep
from palmar.studies.sweep.shards import shard_table
from palmar.studies.sweep.store import Manifest, Store

SWEEP = parse_sweep("""
[sweep]
case = "testbed_table"
samples = 30
[vary]
"object.radius_mm" = [30.0, 50.0]
"start.at_mm.0" = { uniform = [-250.0, 250.0] }
""")


def test_a_cluster_writes_the_rows_that_this_process_makes(tmp_path):
    store = Store(str(tmp_path))
    store.begin(Manifest(SWEEP.digest, SWEEP.rows, 7, "simulate"))
    quiet = {"dashboard_address": None, "scheduler_kwargs": {"dashboard": False}}
    with (
        LocalCluster(n_workers=1, threads_per_worker=1, processes=False, **quiet) as cluster,
        dask_engine(cluster.scheduler_address) as engine,
    ):
        assert engine.rate(SWEEP) > 10.0
        done = run_sweep(SWEEP, store, engine)
    assert (done.rows, done.shards) == (60, 9)
    rows = query(store, "SELECT * FROM sweep ORDER BY row").rows
    assert rows == tuple(tuple(row.values()) for row in shard_table(SWEEP, 0, 60).to_pylist())


def test_where_no_scheduler_answers_it_is_said_in_one_line(monkeypatch):
    monkeypatch.setattr("palmar.studies.sweep.on_dask.PATIENCE", "1s")
    with pytest.raises(InputError, match="no Dask scheduler answers") as refused, dask_engine("tcp://127.0.0.1:1"):
        pass
    assert "\n" not in str(refused.value)
