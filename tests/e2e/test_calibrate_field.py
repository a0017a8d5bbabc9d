"""`ols-calibrate field` on a simulated tripod: answered over the bus by someone who sees its
pictures, answered by a script, aborted, and ended by a loss of power."""

import io
import json
import os
import signal
import tomllib

import numpy as np
import ols
import ols_msg
import pytest
from conftest import BIN, finished
from helpers import VideoViewer
from ols_demo.places import geodetic
from ols_demo.site import Site
from PIL import Image
from tripod import SCENARIO, SIGNS, Tripod, found_values, heading_of_picture_deg, references

SWEEP_POSES = 10


@pytest.fixture(scope="module")
def site(network, tmp_path_factory):
    with Site(tmp_path_factory.mktemp("site") / "logs") as site:
        yield site


@pytest.fixture(scope="module")
def tripod(site, tmp_path_factory):
    tripod = Tripod(tmp_path_factory.mktemp("tripod"), site)
    tripod.ready()
    return tripod


@pytest.fixture(scope="module")
def accepted(tripod):
    """A calibration with a person at a console, accepted."""
    path = references(tripod.folder / "references.csv")
    options = ("--references", path, "--sweep-poses", SWEEP_POSES)
    process = tripod.begin("field", *options)
    seen = []

    def decide(state):
        seen.append(state)
        return "accept"

    status = tripod.operate(process, decide)
    assert status == 0, tripod.log.read_text()
    return seen[0]


def test_a_new_unit_is_calibrated_from_the_console(tripod, accepted):
    assert "What this calibration leaves" in accepted.text
    assert accepted.elapsed_s < 300.0
    current = tripod.store / "current"
    for name in ("instrument.toml", "setup.toml", "covariance.csv", "report.json"):
        assert (current / name).is_file(), name
    frames = (current / "frames.jsonl").read_text().splitlines()
    # In real time: a unit that arrives too late on a busy machine costs a pose or a sighting.
    assert len(frames) >= SWEEP_POSES // 2 + len(SIGNS)
    assert all((current / json.loads(line)["file"]).is_file() for line in frames)
    kinds = [
        json.loads(line)["kind"]
        for line in (current / "observations.jsonl").read_text().splitlines()
    ]
    assert kinds.count("landmark") >= len(SIGNS) + 2
    assert kinds.count("scene") > 20


@pytest.mark.skipif(
    os.environ.get("OLS_WHOLE_FIELD") != "1", reason="takes five minutes: OLS_WHOLE_FIELD=1 runs it"
)
def test_all_of_it_takes_five_minutes(tripod, accepted):
    """From a unit of which nothing is known: 60 pictures, and two rounds over eight signs."""
    signs = [mark["id"] for mark in tomllib.loads(SCENARIO.read_text())["mark"]]
    path = references(tripod.folder / "all.csv", signs)
    process = tripod.begin("field", "--instrument", "new", "--references", path)
    seen = []

    def decide(state):
        seen.append(state)
        return "accept"

    assert tripod.operate(process, decide, deadline_s=600.0) == 0, tripod.log.read_text()
    [result] = seen
    off = heading_of_picture_deg(found_values(tripod.store / "current"))
    off_arcsec = 3600 * ((off - heading_of_picture_deg(tripod.truth()) + 180) % 360 - 180)
    print(f"{result.elapsed_s:.0f} s; heading of the picture off by {off_arcsec:+.1f} arcsec")
    print(result.text)
    assert result.elapsed_s < 300.0
    assert abs(off_arcsec) < WHOLE_ARCSEC


WHOLE_ARCSEC = 60.0  # 11 RMS are told, 22 in the worst direction
UNSEEN = "barn"  # a sign that no calibration here has used
MOST_ARCSEC = 150.0  # of ten poses of a sweep and two rounds over four signs: 40 to 70 were seen


def restart(tripod, site, config):
    site.stop("ols-station-alfa")
    tripod.listener.observer.status.pop("alfa", None)
    site.start_and_wait(
        "ols-station-alfa", [str(BIN / "ols-station"), "--config", str(config)], "ready"
    )
    tripod.ready()
    ok = ols_msg.station_status_t.DEVICE_OK
    tripod.listener.wait(lambda: tripod.listener.device("alfa", "video")[0] == ok, "video")


def point(tripod, pan_deg, tilt_deg):
    done = finished(BIN / "ols-ctl", "alfa", "manual", f"{pan_deg:.4f}", f"{tilt_deg:.4f}")
    assert done.returncode == 0, done.stdout + done.stderr

    def there():
        status = tripod.listener.observer.status["alfa"]
        off = np.degrees([status.pan_rad, status.tilt_rad]) - [pan_deg, tilt_deg]
        return np.all(np.abs(off) < 0.01)

    tripod.listener.wait(there, f"the unit at {pan_deg}, {tilt_deg} deg")


def place_of(name):
    """In ECEF, as the simulator has it."""
    scenario = tomllib.loads(SCENARIO.read_text())
    site = scenario["site"]
    origin = geodetic(site["latitude_deg"], site["longitude_deg"], site["height_m"])
    mark = next(mark for mark in scenario["mark"] if mark["id"] == name)
    return ols.LocalFrame(origin).to_ecef(np.array(mark["position_enu_m"]))


def seen_and_expected(tripod, place):
    """Where the sign is in a picture, where the calibration puts it [px]; pixels a radian."""
    viewer = VideoViewer(tripod.listener.device("alfa", "video")[1])
    first = viewer.picture(width=16)
    frame = viewer.picture(after_utime=first.utime, width=4096)
    viewer.close()
    picture = np.asarray(Image.open(io.BytesIO(frame.jpeg)), dtype=float)
    rows, columns = np.nonzero(picture > 0.93 * 255)
    assert len(rows) >= 3, "the sign is not in the picture"
    to_camera = np.reshape(frame.camera_from_ecef, (3, 3))
    x, y, z = to_camera @ (place - np.array(frame.camera_ecef_m))
    fx, fy, cx, cy, _ = frame.camera_matrix_px
    expected = np.array([fx * x / z + cx, fy * y / z + cy])
    return np.array([np.median(columns), np.median(rows)]), expected, fx


@pytest.fixture(scope="module")
def calibrated(tripod, accepted, site):
    """The station works with the calibration from now on. How far from its expected place an unused
    sign was seen before and after [arc seconds]."""
    place = place_of(UNSEEN)
    before = beside_arcsec(tripod, place)
    config = tripod.folder / "calibrated.toml"
    folder = f'[calibration]\nfolder = "{tripod.store}/current"'
    config.write_text(tripod.config.read_text().replace("[calibration]", folder, 1))
    tripod.config = config
    restart(tripod, site, config)
    return before, beside_arcsec(tripod, place)


def pan_and_tilt_of(tripod, place):
    """Where the unit points at a place, by what the station believes now [deg]."""
    status = tripod.listener.wait_for_status("alfa")
    camera = np.array(status.camera_ecef_m)
    enu = ols.LocalFrame(ols.geodetic_from_ecef(camera)).to_enu(place)
    azimuth, elevation = np.arctan2(enu[0], enu[1]), np.arcsin(enu[2] / np.linalg.norm(enu))
    pan = status.pan_rad + status.azimuth_rad - azimuth  # a positive pan turns left
    tilt = status.tilt_rad + elevation - status.elevation_rad
    return np.degrees([np.angle(np.exp(1j * pan)), tilt])


def beside_arcsec(tripod, place):
    """How far from the place where the station expects it the sign is seen."""
    point(tripod, *pan_and_tilt_of(tripod, place))
    seen, expected, px = seen_and_expected(tripod, place)
    tripod.release()
    return np.degrees(np.linalg.norm(seen - expected) / px) * 3600.0


def test_a_sign_that_was_not_used_is_where_the_calibrated_station_expects_it(
    tripod, accepted, calibrated
):
    before, after = calibrated
    print(f"{UNSEEN} beside its expected place: {before:.0f} arcsec before, {after:.1f} after")
    assert after < MOST_ARCSEC
    assert before > 5.0 * after


def test_the_tripod_stands_as_it_was_calibrated(tripod, calibrated):
    done = tripod.run("check")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "The tripod stands" in done.stdout


def test_a_script_that_aborts_leaves_the_old_one_and_what_was_observed(tripod, accepted):
    script = tripod.folder / "script"
    script.write_text("# one sign, then no more\nabort\n")
    before = os.readlink(tripod.store / "current")
    done = tripod.run(
        "field",
        *("--references", tripod.folder / "references.csv"),
        *("--sweep-poses", 0, "--script", script),
    )
    assert done.returncode == 1, done.stdout + done.stderr
    assert "The old calibration stays in use" in done.stdout
    assert os.readlink(tripod.store / "current") == before
    kept = [path for path in tripod.store.iterdir() if path.name.endswith(".interrupted")]
    assert kept and (kept[0] / "frames.jsonl").read_text().count("\n") == 1


def test_a_loss_of_power_leaves_the_old_one_and_is_named(tripod, accepted):
    before = os.readlink(tripod.store / "current")
    process = tripod.begin(
        "field", *("--references", tripod.folder / "references.csv", "--sweep-poses", 8)
    )

    def at_work():
        return any(
            (path / "journal.jsonl").exists() for path in tripod.store.glob("*-field.running")
        )

    tripod.listener.wait(lambda: at_work() or process.poll() is not None, "a picture")
    assert process.poll() is None, tripod.log.read_text()
    process.send_signal(signal.SIGKILL)
    process.wait()
    assert os.readlink(tripod.store / "current") == before
    script = tripod.folder / "script"
    script.write_text("abort\n")
    done = tripod.run("field", "--resume", "--script", script)
    assert "a procedure was interrupted; its observations are kept in" in done.stdout
    assert "under manual operation: release it" in done.stderr, "whose it is, nobody can tell"
    tripod.release()
    done = tripod.run("field", "--resume", "--script", script)
    assert "This is where it was interrupted; it goes on." in done.stdout
    assert "sweep, picture 8 of 8" in done.stdout, "as it was begun"


def sweep(tripod, answer, *options, **more):
    """What it said, and the folder in which its panorama is kept."""
    script = tripod.folder / "script"
    script.write_text(answer + "\n")
    before = set(tripod.store.iterdir())
    done = tripod.run("sweep", "--script", script, *options, **more)
    kept = {path for path in set(tripod.store.iterdir()) - before if not path.is_symlink()}
    [folder] = [path for path in kept if (path / "frames.jsonl").is_file()]
    return done, folder


def see_that_lens_and_gears_were_checked(done, folder, poses):
    assert "Lens and gears against the calibration in use:" in done.stdout, done.stderr
    assert "sweep, residuals: " in done.stdout
    for name in ("focal length", "backlash of pan", "backlash of tilt"):
        [line] = [line for line in done.stdout.splitlines() if f" {name}: " in line]
        assert "from what was known" in line
    assert folder.name.lstrip("-").isdigit(), "by its id, not set aside"
    assert len((folder / "frames.jsonl").read_text().splitlines()) >= poses // 2
    assert (folder / "instrument.toml").is_file()
    assert not (folder / "setup.toml").exists()


def test_a_sweep_that_was_interrupted_goes_on_to_an_instrument_and_is_compared_with(
    tripod, accepted
):
    before = os.readlink(tripod.store / "current")
    process = tripod.begin("sweep", "--sweep-poses", 20)

    def at_work():
        return any(
            (path / "journal.jsonl").exists() for path in tripod.store.glob("*-sweep.running")
        )

    tripod.listener.wait(lambda: at_work() or process.poll() is not None, "a picture")
    assert process.poll() is None, tripod.log.read_text()
    process.send_signal(signal.SIGINT)
    tripod.listener.wait(lambda: process.poll() is not None, "its end")
    assert "to resume it: the same command with --resume" in tripod.log.read_text()
    assert not (tripod.store / "instrument").exists()
    done, folder = sweep(tripod, "accept", "--resume")
    assert "This is where it was interrupted; it goes on." in done.stdout, done.stderr
    assert "sweep, picture 20 of 20" in done.stdout, "as it was begun"
    assert done.returncode == 0, done.stdout + done.stderr
    see_that_lens_and_gears_were_checked(done, folder, 20)
    assert os.readlink(tripod.store / "instrument") == folder.name
    assert os.readlink(tripod.store / "current") == before, "it has no setup"
    assert f"check --panorama {folder.name}" in done.stdout
    looked = tripod.run("check", "--panorama", folder.name)
    assert looked.returncode == 0, looked.stdout + looked.stderr
    assert "The tripod stands" in looked.stdout
    assert "has no 'another'" in tripod.run("check", "--panorama", "another").stderr
    # What follows begins with the calibration in use.
    (tripod.store / "instrument").unlink()


@pytest.mark.skipif(
    os.environ.get("OLS_WHOLE_FIELD") != "1", reason="takes some minutes: OLS_WHOLE_FIELD=1 runs it"
)
def test_how_long_ninety_pictures_take(tripod, accepted):
    """What is measured stands in docs/benchmarks.md."""
    _, folder = sweep(tripod, "keep", "--sweep-poses", 90, deadline_s=400.0)
    frames = [json.loads(line) for line in (folder / "frames.jsonl").read_text().splitlines()]
    times_s = 1e-6 * np.array([frame["utime_us"] for frame in frames])
    ways_deg = np.degrees(np.abs(np.diff([[f["pan_rad"], f["tilt_rad"]] for f in frames], axis=0)))
    steps_s = np.diff(times_s)
    print(
        f"{len(frames)} pictures in {times_s[-1] - times_s[0]:.0f} s; from one to the next"
        f" {np.median(steps_s):.2f} s in the median, {steps_s.max():.1f} s at most,"
        f" over {np.median(ways_deg.max(axis=1)):.1f} degrees"
    )
    assert len(frames) >= 88
    assert times_s[-1] - times_s[0] <= 120.0


def test_wrong_serial_numbers_are_refused_before_anything_moves(tripod, accepted):
    config = tripod.folder / "other.toml"
    config.write_text(tripod.config.read_text() + '\n[serials]\nlens = "another"\n')
    instrument = tripod.folder / "instrument.toml"
    text = (tripod.store / "current" / "instrument.toml").read_text()
    text = text.replace('lens = ""', 'lens = "one"').replace('covariance = "covariance.csv"\n', "")
    instrument.write_text(text)
    command = tripod.command(
        "field", *("--references", tripod.folder / "references.csv", "--instrument", instrument)
    )
    command[command.index(str(tripod.config))] = str(config)
    done = finished(*command)
    assert done.returncode == 2
    assert "serials.lens" in done.stderr


def test_history_and_revert_which_the_running_station_follows(tripod, calibrated):
    first = os.readlink(tripod.store / "current")
    path = references(tripod.folder / "references.csv")
    process = tripod.begin("field", "--references", path, "--sweep-poses", 0, "--rounds", 1)
    assert tripod.operate(process, lambda _state: "accept") == 0, tripod.log.read_text()
    second = os.readlink(tripod.store / "current")
    assert second != first
    assert "The station works with it" in tripod.log.read_text()

    def works_with(calibration):
        status = tripod.listener.observer.status["alfa"]
        return status.calibration_id == int(calibration)

    tripod.listener.wait(lambda: works_with(second), "the new calibration in the status")
    done = tripod.run("revert")
    assert done.returncode == 0, done.stderr
    assert os.readlink(tripod.store / "current") == first
    tripod.listener.wait(lambda: works_with(first), "the old one again")
    history = tripod.run("history").stdout
    assert f"{first}" in history and f"{second}" in history
    assert "reverted" in history and "(in use)" in history
