"""The server from outside: its address, a look over its socket, a file, its end."""

import asyncio
import json
import signal
import socket
import subprocess
import sys
import urllib.request
from functools import partial

import pytest
from websockets.asyncio.client import connect
from websockets.exceptions import ConnectionClosedError, InvalidStatus

from palmar.faces.records import finite
from palmar.faces.studio.answering import answered
from palmar.faces.studio.kinds import STEPS, Kind
from palmar.faces.studio.requests import LARGEST_MESSAGE
from palmar.models.shipped import shipped_text

CASE = "chapter3_example"


@pytest.fixture(scope="module")
def server():
    words = [sys.executable, "-m", "palmar.faces.cli.main", "studio", "--no-browser", "--port", "0"]
    # A shell's background jobs ignore Ctrl-C, and so would what the test starts.
    heard = partial(signal.signal, signal.SIGINT, signal.default_int_handler)
    pipe = subprocess.PIPE
    process = subprocess.Popen(words, stdout=pipe, stderr=pipe, text=True, preexec_fn=heard)
    yield process, process.stdout.readline().strip()
    process.kill()
    process.communicate()


def on_socket(url, talk, **options):
    """What ``talk`` returns, after the greeting."""

    async def run():
        async with connect(url.replace("http", "ws") + "ws", max_size=None, **options) as page:
            assert json.loads(await page.recv())["kind"] == "hello"
            return await talk(page)

    return asyncio.run(run())


async def until_last(page):
    frames = []
    while not frames or not frames[-1]["last"]:
        frames.append(json.loads(await asyncio.wait_for(page.recv(), 120.0)))
    return frames


def test_a_look_over_the_socket_is_that_of_the_functions(server):
    async def look(page):
        await page.send(json.dumps({"id": "a", "seq": 7, "kind": "look", "case": shipped_text(CASE)}))
        return await until_last(page)

    frames = [each for each in on_socket(server[1], look) if each["part"] != "wait"]
    assert {(each["id"], each["seq"], each["kind"]) for each in frames} == {("a", 7, "look")}
    expected = [
        each for step in range(len(STEPS[Kind.LOOK])) for each in answered(Kind.LOOK, step, shipped_text(CASE), {})
    ]
    assert [(each["part"], each["stage"]) for each in frames[:-1]] == [(each.name, each.stage) for each in expected]
    last = json.loads(json.dumps(finite(expected[3].value)))
    assert frames[3]["value"] == last
    assert frames[-1]["part"] == "end"


def test_bad_frames_are_answered_in_a_line_and_harm_nobody(server):
    async def talk(page):
        told = []
        bad_case = json.dumps({"id": "b", "seq": 1, "kind": "look", "case": {"hand": 3}})
        for frame in (
            "{",
            b"\x00",
            json.dumps({"id": "\ud800", "seq": 1, "kind": "cases", "case": "\ud800"}),
            bad_case,
        ):
            await page.send(frame)
            told += await until_last(page)
        await page.send(json.dumps({"id": "c", "seq": 2, "kind": "cases"}))
        return told, await until_last(page)

    told, good = on_socket(server[1], talk)
    assert all(each["error"] and "\n" not in each["error"] for each in told)
    assert len(told) == 4
    assert good[0]["part"] == "cases"


@pytest.mark.parametrize("message", ["x" * (LARGEST_MESSAGE + 1), ["x" * 1024] * (LARGEST_MESSAGE // 1024 + 1)])
def test_a_message_that_is_too_long_closes_the_socket_in_pieces_too(server, message):
    async def talk(page):
        await page.send(message)
        await page.recv()

    with pytest.raises(ConnectionClosedError) as closed:
        on_socket(server[1], talk)
    assert closed.value.rcvd.code == 1009


def test_a_page_of_another_site_gets_no_socket(server):
    with pytest.raises(InvalidStatus):
        on_socket(server[1], until_last, origin="http://evil.example")


def test_files_come_by_post(server):
    def post(wish, kind="application/json"):
        request = urllib.request.Request(server[1] + "export", json.dumps(wish).encode(), {"Content-Type": kind})
        try:
            with urllib.request.urlopen(request) as answer:
                return answer.status, answer.headers["Content-Disposition"], answer.read()
        except urllib.error.HTTPError as error:
            with error:
                return error.code, None, json.loads(error.read())["error"]

    case = shipped_text(CASE)
    status, name, data = post({"what": "case", "format": "toml", "case": case})
    assert (status, name, data[:6]) == (200, 'attachment; filename="palmar_case.toml"', b"[hand]")
    assert post({"what": "case", "format": "toml", "case": case}, "text/plain")[0] == 400
    assert post({"what": "case", "format": "toml", "case": case + "#" * LARGEST_MESSAGE})[0] == 400
    assert post({"what": "nothing", "format": "toml"})[::2] == (422, "what = 'nothing': must be one of region, comparison,"
        " solid, film, trace, simulation, plan, map, closure, report, figure, case,"
        " design, brief")  # fmt: skip


def test_ctrl_c_ends_it_cleanly_with_a_page_open(server):
    process, url = server

    async def end(page):
        process.send_signal(signal.SIGINT)
        await page.wait_closed()

    on_socket(url, end)
    assert process.wait(20.0) == 0
    told = process.stderr.read()
    assert told.endswith("palmar: the studio is closed\n")
    assert "Traceback" not in told


def test_an_address_that_is_not_allowed_is_one_line(palmar):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        answer = palmar("studio", "--no-browser", "--port", port)
    assert (answer.status, answer.err) == (2, f"palmar: 127.0.0.1 port {port} is in use, another --port may be free\n")
    for words, said in (
        (["--host", "0.0.0.0"], "needs --token too"),
        (["--host", "0.0.0.0", "--token", "short"], "at least 16"),
        (["--port", "70000"], "from 0 to 65535"),
    ):
        answer = palmar("studio", "--no-browser", *words)
        assert answer.status == 2
        assert said in answer.err
        assert answer.err.count("\n") == 1


def test_without_the_extra_it_says_how_to_get_it(palmar, monkeypatch):
    monkeypatch.setattr("palmar.faces.cli.studio.find_spec", lambda name: None)
    answer = palmar("studio")
    assert (answer.status, answer.err.count("\n")) == (2, 1)
    assert "pip install palmar[studio]" in answer.err
