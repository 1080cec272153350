"""Who is next."""

from palmar.faces.studio.turns import Turns


def taken(turns, count, fits=lambda item: True):
    return [turns.take(fits) for _ in range(count)]


def test_the_newest_of_a_channel_waits_in_the_place_of_the_older():
    turns = Turns()
    for item in (1, 2, 3):
        turns.put("anna", "look", item)
    turns.put("anna", "plan", 4)
    assert len(turns) == 2
    assert taken(turns, 3) == [3, 4, None]


def test_whoever_was_served_least_recently_is_next_however_often_others_ask():
    turns = Turns()
    served = []
    for _ in range(30):
        for client in ("anna", "bert", "cleo"):
            for _ in range(5 if client == "anna" else 1):
                turns.remove(client, "look")
                turns.put(client, "look", client)
        served.append(turns.take(lambda item: True))
    assert {client: served.count(client) for client in served} == {"anna": 10, "bert": 10, "cleo": 10}


def test_what_does_not_fit_keeps_its_turn():
    turns = Turns()
    turns.put("anna", "look", "slow")
    turns.put("bert", "look", "quick")
    assert turns.take(lambda item: item == "quick") == "quick"
    turns.put("bert", "look", "quick")
    assert turns.take(lambda item: True) == "slow"


def test_of_one_who_has_left_nothing_waits():
    turns = Turns()
    turns.put("anna", "look", 1)
    turns.drop("anna")
    assert not list(turns)
    assert turns.take(lambda item: True) is None
