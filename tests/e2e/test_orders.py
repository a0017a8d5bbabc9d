"""Orders are answered by their station at once, whatever the interval of its statuses."""

import pytest
from conftest import BIN, finished
from console_site import Api
from ols_bench import orders


@pytest.fixture(scope="module")
def address(network, tmp_path_factory):
    """Of a console that has heard one status of a station, and will hear the next in a minute: no
    answer may take as long."""
    with orders.site(tmp_path_factory.mktemp("orders"), 60.0) as console:
        yield console


def ctl(*words):
    done = finished(BIN / "ols-ctl", orders.STATION, *words)
    return done.returncode, done.stdout.strip()


def test_the_console_is_answered(address):
    given = [answer for _, answer in orders.answers(address, 3)]
    assert [answer["accepted"] for answer in given] == [True] * 3


def test_a_command_that_has_heard_no_status_is_answered(address):
    assert ctl("release") == (0, "lone: done")
    refused = "lone: refused: there is no pan-tilt unit; see its alarms"
    assert ctl("home") == (1, refused)
    assert ctl("record", "1", "1", "bird") == (
        1,
        "lone: refused: the recorder does not record: this station records nothing",
    )


def test_a_stop_is_confirmed(address):
    assert ctl("stop") == (0, "lone: done")
    live = orders.LiveSocket(address)
    stop = {"do": "command", "number": 9, "station": "lone", "command": "stop"}
    assert live.answer_to(stop)["accepted"]
    events = Api(address).state()["events"]
    assert [e["outcome"] for e in events if e["text"] == "stop"] == ["done"]
