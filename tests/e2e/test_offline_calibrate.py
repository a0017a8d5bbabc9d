"""`ols-calibrate adjust` as a surveyor meets it: what it finds, and what it says of it."""

import datetime
import json
import tomllib

import numpy as np
import pytest
from calibrate_run import SEED, Run
from ols_calibration import cases
from ols_calibration.__main__ import accepted_stars, errors_of, predict_text, volume
from ols_calibration.model import ARCSEC, azimuth_elevation
from ols_calibration.site import UTIME_US, anywhere, icrs_of


def day_of(utime_us):
    return f"{datetime.datetime.fromtimestamp(utime_us / 1e6, datetime.UTC):%Y-%m-%d}"


@pytest.fixture(name="run")
def fixture_run(tmp_path):
    print(f"seed {SEED}")
    return Run(tmp_path)


def test_a_prediction_is_the_direction_of_the_pixel(run):
    run.adjusted()
    header, row = run.lines("out/predictions.csv")
    found = dict(zip(header.split(","), map(float, row.split(",")), strict=True))
    shafts = run.one.unit.shafts(1000, 2000, (1, -1))
    azimuth, elevation = np.degrees(azimuth_elevation(run.one.unit.look(shafts, (600, 500))))
    across = (found["azimuth_deg"] - azimuth) * np.cos(np.radians(elevation))
    assert abs(across) < 5 * np.sqrt(found["cross_cross_deg2"]) < 0.03
    off = found["elevation_deg"] - elevation
    assert abs(off) < 5 * np.sqrt(found["elevation_elevation_deg2"]) < 0.03


def test_the_instrument_found_is_the_next_ones_prior(run):
    run.adjusted()
    first = run.report()["stations"][0]
    at = run.arguments.index("--instrument") + 1
    run.arguments[at] = run.output / "instrument.toml"
    run.output = run.folder / "again"
    run.adjusted()
    second = run.report()["stations"][0]
    assert second["systematic_rms_arcsec"] < first["systematic_rms_arcsec"]
    before = {one["parameter"]: one["prior_sd"] for one in second["parameters"]}
    after = {one["parameter"]: one["sd"] for one in first["parameters"]}
    # It was carried to its new place since: the mounting is less certain again, the lens is not.
    assert before["mount_z_deg"] == pytest.approx(
        np.hypot(after["mount_z_deg"], 30 / 3600), rel=1e-6
    )
    assert before["focal_px"] == pytest.approx(after["focal_px"], rel=1e-6)


def test_what_is_not_within_the_limits_is_said_and_is_no_success(run):
    """The tripod has moved between the first and the last sighting of a landmark."""
    lines = run.lines("observations.jsonl")
    at = max(n for n, line in enumerate(lines) if '"landmark0"' in line)
    one = json.loads(lines[at])
    one["x_px"] += 4.0
    lines[at] = json.dumps(one)
    (run.folder / "observations.jsonl").write_text("\n".join(lines) + "\n")
    done = run.adjusted()
    assert done.returncode == 1
    assert "BAD  landmark 'landmark0', first and last sighting: " in done.stderr
    assert f"not within the limits; the results are in {run.output}" in done.stderr
    page = (run.output / "report.html").read_text()
    bad, good = (page.index(f"<h2>{which} the limits") for which in ("Not within", "Within"))
    assert bad < page.index("first and last sighting") < good < page.index("systematic error, RMS")
    assert 'class="bad"' not in page[good : page.index("<h2>Residuals")]


def test_stations_that_aim_at_each_other_find_their_headings(tmp_path):
    """Three, whose only references are each other; the configured headings are 1 deg off."""
    run = Run(tmp_path, cases.other_stations)
    rows = volume(run.site, np.random.default_rng(SEED))
    (tmp_path / "predict.csv").write_text(predict_text(rows))
    run.adjusted()
    assert run.rejected() == []
    groups = {
        (group["kind"], group["name"], group["sightings"]) for group in run.report()["groups"]
    }
    names = {one.name for one in run.site.stations}
    assert {("station", name, 8) for name in names} <= groups
    errors = list(errors_of(rows, run.output / "predictions.csv"))
    for name in names:
        actual = np.sqrt(np.mean([e @ e / 2 for station, e, _ in errors if station == name]))
        told = np.sqrt(np.mean([np.trace(C) / 2 for station, _, C in errors if station == name]))
        print(f"{name}: {actual / ARCSEC:.1f} arcsec, told {told / ARCSEC:.1f}")
        assert actual < 40 * ARCSEC
        assert 0.4 < told / actual < 2.5


def moved_station(run, north_m):
    """Its configuration says that it stands farther north."""
    path = run.folder / "alfa.toml"
    lines = path.read_text().splitlines()
    at = next(n for n, line in enumerate(lines) if line.startswith("latitude_deg"))
    latitude = float(lines[at].split("=")[1]) + north_m / 111_200
    lines[at] = f"latitude_deg = {latitude:.10f}"
    path.write_text("\n".join(lines) + "\n")


def test_a_station_that_is_surveyed_wrongly_is_named_and_no_landmark_is_blamed(run):
    moved_station(run, 0.8)
    error = run.refused()
    assert "; all agree if station 'alfa' stood " in error
    assert " m to the south and " in error


def landmarks_and_drone(rng):
    site = cases.rtk_landmarks(rng)
    [one] = site.stations
    for k in range(12):
        point = anywhere(rng, one.unit, (3, 29)) * rng.uniform(600, 900)
        utime_us = UTIME_US + 10_000_000 * k
        one.sight("drone", point, "drone", utime_us=utime_us)
        for at in (utime_us - 1_000_000, utime_us + 1_000_000):
            site.refer("drone", one.true_place.to_ecef(point), 0.02, at)
    return site


def landmarks_and_stars(rng):
    site = cases.rtk_landmarks(rng)
    [one] = site.stations
    for frame in range(5):
        counts = np.round(np.array([-120 + 60 * frame, 20]) / 360 * 112000)
        shafts = one.unit.posed(rng, *counts, (1, 1))
        utime_us = UTIME_US + 3_000_000 * frame
        for k in range(4):
            pixel, name = rng.uniform([20, 20], [1260, 940]), f"star{frame}-{k}"
            site.refer_star(name, *icrs_of(one.place, one.unit.look(shafts, pixel), utime_us))
            one.add(
                *("star", counts, (1, 1), pixel),
                **{"sd_px": 0.3, "pose": 1000 + frame, "reference": name, "utime_us": utime_us},
            )
    return site


def eight_landmarks(rng):
    """The first two stand 2 m apart, and are exchanged."""
    site, one = cases.one_station(rng, is_new=False)
    points = cases.landmark_points(rng, one, 8)
    points[1] = points[0] + np.cross(points[0], [0, 0, 2.0]) / np.linalg.norm(points[0])
    cases.sight_landmarks(site, one, points, 0.02, 2)
    for line in one.lines:
        swapped = {"landmark0": "landmark1", "landmark1": "landmark0"}
        if line.get("reference") in swapped:
            line["reference"] = swapped[line["reference"]]
    return site


@pytest.mark.parametrize(
    ("build", "name"), [(landmarks_and_drone, "drone"), (landmarks_and_stars, "star2-1")]
)
def test_a_wrong_survey_is_named_beside_a_mistaken_sighting(tmp_path, build, name):
    """A bird instead of the drone, or a double star."""
    run = Run(tmp_path, build)
    observations = run.observations()
    mistaken = [one for one in observations if one.get("reference") == name]
    mistaken[len(mistaken) // 2]["x_px"] += 15.0
    run.observe(observations)
    moved_station(run, 0.4)
    said = run.adjust().stderr
    assert "all agree if station 'alfa' stood " in said
    assert " m to the south and " in said


def test_exchanged_landmarks_are_no_mistake_of_the_station(tmp_path):
    """Two of eight, 2 m apart."""
    run = Run(tmp_path, eight_landmarks)
    done = run.adjusted()
    assert "landmarks 'landmark0' and 'landmark1' seem to be exchanged" in done.stderr
    assert "all agree if" not in done.stderr


def test_a_pressure_reduced_to_sea_level_is_refused_if_the_sky_is_sighted(tmp_path):
    run = Run(tmp_path, cases.stars)
    run.change("alfa.toml", 5, "height_m = 310.0000", "height_m = 1500.0")
    run.arguments[run.arguments.index("--pressure") + 1] = 1013
    error = run.refused()
    assert "--pressure: station 'alfa': 1013.0 hPa cannot be the pressure at 1500 m" in error
    assert "it looks reduced to sea level" in error


def test_of_landmarks_alone_the_pressure_does_not_matter(run):
    run.arguments[run.arguments.index("--pressure") + 1] = 700
    run.adjusted()


def test_stars_leave_their_clock_unchecked_and_its_error_is_in_the_result(tmp_path):
    run = Run(tmp_path, cases.stars)
    done = run.adjusted()
    assert "the error of the clock is not stated (--clock-sd): taken as 0.05 s" in done.stderr
    [station] = run.report()["stations"]
    findings = {one["name"]: one for one in station["acceptance"]["findings"]}
    assert findings["detectable clock"]["judgement"] == "unchecked"
    run.output = run.folder / "known"
    assert "--clock-sd" not in run.adjusted("--clock-sd", "2").stderr
    [other] = run.report()["stations"]
    # Two seconds turn the sky by 30 arc seconds.
    assert other["systematic_rms_arcsec"] > station["systematic_rms_arcsec"] + 10.0


def test_one_landmark_alone_is_said_to_be_unchecked(run):
    lines = [line for line in run.lines("observations.jsonl") if "landmark0" in line]
    (run.folder / "observations.jsonl").write_text("\n".join(lines) + "\n")
    done = run.adjusted()
    assert "landmark 'landmark0' is the only reference: nothing checks it" in done.stderr
    [group] = run.report()["groups"]
    assert group["detectable_across_arcsec"] is None


def test_what_no_adjustment_changes_is_in_the_instrument(run):
    with (run.folder / "alfa.toml").open("a") as file:
        file.write("p1 = 0.001\n[chain]\ntilt_zero_deg = 0.001\n")
    run.adjusted()
    instrument = tomllib.loads((run.output / "instrument.toml").read_text())
    assert instrument["lens"] == {"model": "pinhole", "skew": 0, "p1": 0.001, "p2": 0}
    assert instrument["unit"]["tilt_zero_deg"] == 0.001
    assert instrument["unit"]["pan_sign"] == 1
    assert instrument["unit"]["pan_counts_per_turn"] == 112000


def test_the_counts_of_a_turn_follow_from_the_printed_resolution(run):
    at = run.arguments.index("--instrument")
    del run.arguments[at : at + 2]
    run.adjusted("--resolution", "11.5714")
    unit = tomllib.loads((run.output / "instrument.toml").read_text())["unit"]
    assert unit["pan_counts_per_turn"] == unit["tilt_counts_per_turn"] == 112000
    run.output = run.folder / "other"
    error = run.refused("--resolution", "11.6")
    assert "--resolution: is no whole fraction" in error


def test_without_an_instrument_the_unit_is_a_new_one(run):
    run.adjusted()
    known = run.report()["stations"][0]["systematic_rms_arcsec"]
    at = run.arguments.index("--instrument")
    del run.arguments[at : at + 2]
    run.output = run.folder / "new"
    run.adjusted()
    assert run.report()["stations"][0]["systematic_rms_arcsec"] > 1.5 * known


def test_without_ut1_its_uncertainty_is_in_the_result(tmp_path):
    run = Run(tmp_path, cases.stars)
    run.adjusted()
    stated = run.report()["stations"][0]["systematic_rms_arcsec"]
    at = run.arguments.index("--ut1-utc")
    del run.arguments[at : at + 2]
    run.output = run.folder / "without"
    done = run.adjusted()
    assert "UT1 - UTC is not stated" in done.stderr
    assert run.report()["stations"][0]["systematic_rms_arcsec"] > stated + 0.4


def test_an_old_ut1_is_named_and_its_age_is_in_the_result(tmp_path):
    run = Run(tmp_path, cases.stars)
    run.adjusted("--ut1-date", day_of(UTIME_US))
    fresh = run.report()["stations"][0]["systematic_rms_arcsec"]
    run.output = run.folder / "old"
    done = run.adjusted("--ut1-date", day_of(UTIME_US - 200 * 86400 * 10**6))
    assert "UT1 - UTC is old" in done.stderr
    assert run.report()["stations"][0]["systematic_rms_arcsec"] > fresh + 0.2
    run.output = run.folder / "none"
    done = run.adjust("--ut1-date", "29.5.2026")
    assert done.returncode != 0 and "is no day" in done.stderr
    assert not run.output.exists()


def test_exchanged_stars_and_false_ones_are_counted(tmp_path):
    """Of the names that the program gives, two are exchanged and one goes to a false detection."""
    run = Run(tmp_path, cases.nameless_stars)
    run.adjusted()
    report, names = run.report(), run.one.true_names
    before = accepted_stars(report, names)
    rows = [row for row in report["residuals"] if row["kind"] == "star" and not row["rejected"]]
    one, other, third = rows[0], rows[1], rows[2]
    one["reference"], other["reference"] = other["reference"], one["reference"]
    third["line"] = names.index(None) + 1
    counted = accepted_stars(report, names)
    assert counted == {"right": before["right"] - 3, "exchanged": 2, "false": 1}


def test_two_stations_are_one_network(tmp_path):
    run = Run(tmp_path, cases.joint_track)
    (tmp_path / "predict.csv").write_text(
        "station,pan_counts,tilt_counts,x_px,y_px\nbravo,0,0,1,2\nalfa,0,0,1,2\n"
    )
    run.adjusted()
    report = run.report()
    assert [one["station"] for one in report["stations"]] == ["alfa", "bravo"]
    [difference] = report["heading_differences"]
    heading = {p["parameter"]: p["sd"] for p in report["stations"][0]["parameters"]}
    assert 0 < difference["sd_arcsec"] < 3600 * heading["heading_deg"]
    assert (run.output / "alfa/setup.toml").exists() and (run.output / "bravo/setup.toml").exists()


def test_rectification_targets_give_an_instrument_without_a_setup(tmp_path):
    run = Run(tmp_path, cases.rectification)
    done = run.adjusted()
    assert "the result is an instrument without a setup" in done.stderr
    assert sorted(path.name for path in run.output.iterdir()) == [
        *("covariance.csv", "instrument.toml", "report.html", "report.json")
    ]
    report = run.report()
    assert report["stations"][0]["systematic_rms_arcsec"] is None
    angles = {one["angle"]: one for one in report["rectification"]}
    for name, truth in run.one.angles.items():
        off_arcsec = 3600 * (angles[name]["value_deg"] - np.degrees(truth))
        assert abs(off_arcsec) < 4 * angles[name]["sd_arcsec"] < 160
    assert "Rectification" in (run.output / "report.html").read_text()
    run.output = tmp_path / "predicted"
    done = run.adjust("--predict", tmp_path / "predict.csv")
    assert done.returncode == 2
    assert "--predict: the observations do not determine a heading" in done.stderr
