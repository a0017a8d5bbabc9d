"""`ols-calibrate field` and a running station on their wires: answered over the bus by someone who
sees its pictures, aborted by a script, and ended by a loss of power. What procedures find and
decide is tested in simulated time (tests/unit/calibrate)."""

import os
import signal

import pytest
from ols_demo.site import Site
from tripod import Tripod, references


@pytest.fixture(scope="module")
def tripod(network, tmp_path_factory):
    folder = tmp_path_factory.mktemp("tripod")
    with Site(folder / "logs") as site:
        tripod = Tripod(folder, site)
        tripod.ready()
        yield tripod


@pytest.fixture(scope="module")
def accepted(tripod):
    """What was asked at the end of a calibration with a person at a console."""
    path = references(tripod.folder / "references.csv")
    process = tripod.begin("field", "--references", path, "--sweep-poses", 0, "--rounds", 1)
    seen = []

    def decide(state):
        assert "accept" in state.choice, state.text
        seen.append(state)
        return "accept"

    assert tripod.operate(process, decide) == 0, tripod.log.read_text()
    return seen[0]


def test_a_new_unit_is_calibrated_from_the_console(tripod, accepted):
    assert "What this calibration leaves" in accepted.text
    assert (tripod.store / "current" / "setup.toml").is_file()
    assert "(in use)" in tripod.run("history").stdout


def test_a_loss_of_power_leaves_the_old_one_and_is_named(tripod, accepted):
    before = os.readlink(tripod.store / "current")
    options = ("--references", tripod.folder / "references.csv", "--sweep-poses", 8)

    def at_work():
        return any(
            (path / "journal.jsonl").exists() for path in tripod.store.glob("*-field.running")
        )

    process = tripod.begin("field", *options)
    tripod.listener.wait(lambda: at_work() or process.poll() is not None, "a picture")
    assert process.poll() is None, tripod.log.read_text()
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert os.readlink(tripod.store / "current") == before
    script = tripod.folder / "script"
    script.write_text("# one sign, then no more\nabort\n")
    done = tripod.run("field", "--resume", "--script", script)
    assert "a procedure was interrupted; its observations are kept in" in done.stdout
    assert "under manual operation: release it" in done.stderr, "whose it is, nobody can tell"
    tripod.release()
    done = tripod.run("field", "--resume", "--script", script)
    assert done.returncode == 1, done.stdout + done.stderr
    assert "This is where it was interrupted; it goes on." in done.stdout
    assert "sweep, picture 8 of 8" in done.stdout, "as it was begun"
    assert "The old calibration stays in use" in done.stdout
    assert os.readlink(tripod.store / "current") == before
