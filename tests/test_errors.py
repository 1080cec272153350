"""What errors keep on their way."""

import pickle

from palmar.errors import InputError


def test_a_refusal_comes_back_whole_from_a_worker_process():
    refusal = pickle.loads(pickle.dumps(InputError("--grid", "0", "must be at least 1")))
    assert (refusal.where, refusal.received, refusal.allowed) == ("--grid", "0", "must be at least 1")
    assert str(refusal) == "--grid = 0: must be at least 1"
