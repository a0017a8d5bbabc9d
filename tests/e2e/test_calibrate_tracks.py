"""A station that nobody has calibrated gets its heading from what all have followed: recordings of
a simulated flight, ols-calibrate tracks, ols-calibrate adjust."""

import csv
import json

import numpy as np
import pytest
from conftest import BIN, ROOT, finished

SEED = 3
SECONDS = 80  # once along the target's path
SCENARIO = ROOT / "sim" / "scenarios" / "new_units.toml"
KNOWN = ("alfa", "bravo", "charlie")
NEW = "delta"
PANS_DEG = np.arange(-120, 121, 20)
AIR = ("--pressure", 980, "--temperature", 10, "--ut1-utc", 0.03)
CALIBRATE = BIN / "ols-calibrate"


def run(*command):
    command = [str(part) for part in command]
    return finished(*command)


def good(*command):
    done = run(*command)
    assert done.returncode == 0, done.stderr
    return done


def simulate(*more):
    return good(BIN / "ols-sim", "--scenario", SCENARIO, "--seed", SEED, *more)


@pytest.fixture(name="site", scope="module")
def fixture_site(tmp_path_factory):
    print(f"seed {SEED}")
    folder = tmp_path_factory.mktemp("tracks")
    simulate("--write-observations", folder / "round")
    simulate("--lockstep", "--pixels", "--seconds", SECONDS, "--output", folder / "flight")
    return folder


def tracks(site, output, *more, stations=(*KNOWN, NEW)):
    configurations = [part for s in stations for part in ("--station", site / f"round/{s}.toml")]
    recording = ("--recording", site / "flight/sightings.lcm")
    return run(CALIBRATE, "tracks", *configurations, *recording, "--output", output, *more)


def round_of(site, names):
    """What these stations have seen of stars and landmarks, with names of their own."""
    lines, references = [], []
    for name in names:
        for line in (site / f"round/{name}.observations.jsonl").read_text().splitlines():
            one = json.loads(line)
            if one["kind"] == "star" and one["pose"] % 2:
                continue
            one |= {"station": name, "reference": f"{name}-{one['reference']}"}
            lines.append(json.dumps(one))
        head, *rows = (site / f"round/{name}.references.csv").read_text().splitlines()
        references += [f"{name}-{row}" for row in rows]
    return "\n".join(lines) + "\n", "\n".join([head, *references]) + "\n"


def azimuths(site, folder, names, observations, references, instruments=None):
    """(found, stated deviation) of the new station along the horizon [rad], by pan, after an
    adjustment of all of `names`."""
    folder.mkdir()
    (folder / "references.csv").write_text(references)
    rows = [f"{NEW},{round(pan / 360 * 112000)},0,640,480" for pan in PANS_DEG]
    header = "station,pan_counts,tilt_counts,x_px,y_px"
    (folder / "predict.csv").write_text("\n".join([header, *rows]) + "\n")
    command = [CALIBRATE, "adjust", *AIR, "--output", folder / "out"]
    for name in names:
        command += ["--station", site / f"round/{name}.toml"]
        if instruments:
            command += ["--instrument", instruments / f"{name}/out/instrument.toml"]
    for path in observations:
        command += ["--observations", path]
    references = ("--references", folder / "references.csv")
    predict = ("--predict", folder / "predict.csv") if NEW in names else ()
    done = run(*command, *references, *predict)
    assert done.returncode in (0, 1), done.stderr  # 1: a finding is beyond its limit
    print(done.stderr)
    if not predict:
        return None
    with (folder / "out/predictions.csv").open() as file:
        rows = list(csv.DictReader(file))
    found = np.radians([float(row["azimuth_deg"]) for row in rows])
    return found, np.radians(np.sqrt([float(row["cross_cross_deg2"]) for row in rows]))


def own_calibration(site, folder, name):
    observed, references = round_of(site, (name,))
    (folder / f"{name}.jsonl").write_text(observed)
    return azimuths(site, folder / name, (name,), (folder / f"{name}.jsonl",), references)


@pytest.mark.parametrize("unit", ["new", "calibrated"])
def test_a_station_without_references_gets_its_heading_from_a_joint_track(site, tmp_path, unit):
    """Its unit is new, or it was calibrated elsewhere and carried here."""
    made = tracks(site, tmp_path / "tracks.jsonl")
    assert made.returncode == 0, made.stderr
    lines = [json.loads(line) for line in (tmp_path / "tracks.jsonl").read_text().splitlines()]
    assert {line["kind"] for line in lines} == {"track"}
    assert sum(line["station"] == NEW for line in lines) > SECONDS / 2
    assert all(line["utime_us"] % 1_000_000 == 0 for line in lines)

    truth, _ = own_calibration(site, tmp_path, NEW)  # by 140 stars: to some arc seconds
    if unit == "calibrated":
        for name in KNOWN:
            own_calibration(site, tmp_path, name)
    observed, references = round_of(site, KNOWN)
    (tmp_path / "known.jsonl").write_text(observed)
    both = (tmp_path / "known.jsonl", tmp_path / "tracks.jsonl")
    instruments = tmp_path if unit == "calibrated" else None
    found, stated = azimuths(site, tmp_path / "joint", (*KNOWN, NEW), both, references, instruments)
    off = np.angle(np.exp(1j * (found - truth)))
    assert (np.abs(off) < 4 * stated).all()
    # Along its track it looked less than 60 degrees to both sides.
    seen = np.degrees(off[np.abs(PANS_DEG) < 60]) * 3600
    stated_deg = float(
        (site / f"round/{NEW}.toml").read_text().split("heading_deg = ")[1].split()[0]
    )
    before = (
        np.degrees(np.angle(np.exp(1j * (np.radians(stated_deg) - truth[PANS_DEG == 0])))) * 3600
    )
    print(f"{unit}: off by {before[0]:.0f} arc seconds before; along the track {seen.round(1)}")
    assert np.abs(np.mean(seen)) < {"new": 60, "calibrated": 15}[unit]


def test_nothing_is_overwritten_and_a_bad_recording_is_named(site, tmp_path):
    output = tmp_path / "tracks.jsonl"
    output.write_text("mine\n")
    done = tracks(site, output)
    assert done.returncode == 2
    assert "exists: it is not overwritten" in done.stderr
    assert output.read_text() == "mine\n"
    (tmp_path / "no.log").write_text("no log at all")
    done = run(
        *(CALIBRATE, "tracks", "--station", site / f"round/{NEW}.toml"),
        *("--recording", tmp_path / "no.log", "--output", tmp_path / "new.jsonl"),
    )
    assert done.returncode == 2
    assert "no.log: is no LCM log: from byte 0" in done.stderr
    assert not (tmp_path / "new.jsonl").exists()


def test_a_damaged_recording_is_named_and_what_is_left_is_used(site, tmp_path):
    whole = site / "flight/sightings.lcm"
    cut = tmp_path / "cut.lcm"
    cut.write_bytes(whole.read_bytes()[:-7])
    configurations = [part for s in KNOWN for part in ("--station", site / f"round/{s}.toml")]
    output = tmp_path / "cut.jsonl"
    done = run(CALIBRATE, "tracks", *configurations, "--recording", cut, "--output", output)
    assert done.returncode == 1, done.stderr
    assert f"{cut}: " in done.stderr and "the end is cut off" in done.stderr
    assert output.read_text()


def test_a_station_that_contributes_nothing_is_named(site, tmp_path):
    other = tmp_path / "elsewhere.toml"
    other.write_text((site / f"round/{NEW}.toml").read_text().replace(NEW, "elsewhere"))
    configurations = [part for s in KNOWN for part in ("--station", site / f"round/{s}.toml")]
    recording = ("--recording", site / "flight/sightings.lcm")
    output = tmp_path / "tracks.jsonl"
    done = run(
        *(CALIBRATE, "tracks", *configurations, "--station", other, *recording),
        *("--output", output),
    )
    assert done.returncode == 1, done.stderr
    assert "station 'elsewhere': nothing that it has followed can be used" in done.stderr
    assert "track 'alfa:" in done.stdout
    assert output.read_text()


def test_one_station_alone_has_no_track(site, tmp_path):
    done = tracks(site, tmp_path / "tracks.jsonl", stations=(NEW,))
    assert done.returncode == 2
    assert "nothing that two stations" in done.stderr
    assert "are of stations that --station does not name" in done.stderr


def test_aircraft_that_announces_itself_is_recognised(site, tmp_path):
    """The target, as if it announced itself: later by 0.4 s."""
    rows = ["landmark,latitude_deg,longitude_deg,height_m,sd_m,utime_us"]
    with (site / "flight/truth.csv").open() as file:
        for k, row in enumerate(csv.DictReader(file)):
            if k % 15 == 0:
                place = f"{row['latitude_deg']},{row['longitude_deg']},{row['height_m']}"
                rows.append(f"4ca2d6,{place},10,{int(row['utime_us']) + 400_000}")
    (tmp_path / "aircraft.csv").write_text("\n".join(rows) + "\n")
    done = tracks(site, tmp_path / "tracks.jsonl", "--aircraft", tmp_path / "aircraft.csv")
    assert done.returncode == 0, done.stderr
    lines = [json.loads(line) for line in (tmp_path / "tracks.jsonl").read_text().splitlines()]
    seen = {line["station"] for line in lines if line["kind"] == "aircraft"}
    assert NEW in seen
    assert {line["reference"] for line in lines if line["kind"] == "aircraft"} == {"4ca2d6"}
