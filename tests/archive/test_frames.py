"""pandas frames of logs, archives and positions."""

import re

import numpy as np
import ols
import ols.frames as frames
import pandas as pd
import pytest
from archive_site import REGION, ROOT, archived, event, flown, write_log
from ols_bench import flights

DOCUMENT = (ROOT / "docs/archive.md").read_text()


@pytest.fixture(scope="module", name="log")
def fixture_log(tmp_path_factory):
    return write_log(tmp_path_factory.mktemp("log") / "a.lcmlog", map(event, flown(2)))


@pytest.fixture(scope="module", name="bearings")
def fixture_bearings(log) -> pd.DataFrame:
    return frames.read_log(log)


def test_a_log_as_a_frame(bearings):
    messages = flown(2)
    assert len(bearings) == len(messages)
    assert bearings["station"].to_list() == [m.station for m in messages]
    assert bearings["azimuth_rad"].to_list() == [m.azimuth_rad for m in messages]
    assert list(bearings["camera_ecef_m"][5]) == messages[5].camera_ecef_m
    first = pd.Timestamp(messages[0].utime, unit="us", tz="UTC")
    assert bearings["time"][0] == first


def test_damage_is_left_out_and_another_kind_is_empty(tmp_path, bearings):
    events = [event(flown(1)[0]), (1, "OLS_BEARING_alfa", b"rubbish")]
    log = write_log(tmp_path / "a.lcmlog", events)
    assert len(frames.read_log(log)) == 1
    assert len(frames.read_log(log, "target")) == 0
    with pytest.raises(ValueError, match="kind targets: not one of bearing"):
        frames.read_log(log, "targets")
    with pytest.raises(ValueError, match="nowhere.lcmlog"):
        frames.read_log(tmp_path / "nowhere.lcmlog")


def test_an_archive_as_a_frame(tmp_path, bearings):
    archive = archived(tmp_path, flown(2))
    all_of_it = frames.read_archive(archive, REGION, "2026-06-01", "2026-06-02")
    assert sorted(all_of_it["utime"]) == sorted(bearings["utime"])
    half = pd.Timestamp("2026-06-01T01:00")
    before = frames.read_archive(archive, REGION, "2026-06-01", half)
    assert before["time"].max() < half.tz_localize("UTC")
    assert 0 < len(before) < len(all_of_it)
    assert len(frames.read_archive(archive, "elsewhere", "2026-06-01", half)) == 0


def test_positions_from_a_frame(bearings):
    fixes = frames.locate(bearings)
    assert fixes["utime"].is_monotonic_increasing
    assert fixes["object"].nunique() == 4
    ups = np.array([flights.FRAME.to_enu(p)[2] for p in fixes["position_ecef_m"]])
    off_m = np.minimum(abs(ups - 140.0), abs(ups - 85.0))
    assert off_m.max() < 0.5
    assert (fixes["up_sd_m"] > 0.0).all() and fixes["up_sd_m"].max() < 1.0


def test_a_choice_of_rows_and_of_the_estimator(bearings):
    one = bearings[bearings["track_id"] == 1]
    config = ols.OfflineConfig(estimator="least-squares")
    fixes = frames.locate(one, config, separate=False)
    assert len(fixes) > 100 and set(fixes["object"]) == {1}
    three = frames.locate(one[one["station"] != "delta"], config, separate=False)
    assert three["stations_used"].max() == 3


def test_no_bearings_no_positions(bearings):
    assert len(frames.locate(bearings[:0])) == 0


def test_a_missing_column_is_named(bearings):
    with pytest.raises(ValueError, match="no column belief, camera_ecef_m"):
        frames.bearings_of(bearings.drop(columns=["belief", "camera_ecef_m"]))
    spoilt = bearings[:2].copy()
    spoilt["camera_ecef_m"] = [[1.0, 2.0], [1.0, 2.0]]
    with pytest.raises(ValueError, match="column camera_ecef_m: each row must have three"):
        frames.bearings_of(spoilt)


def test_the_documents_example_works(tmp_path, monkeypatch):
    archived(tmp_path, flown(2))
    monkeypatch.chdir(tmp_path)
    (code,) = re.findall(r"^```python\n(.*?)^```", DOCUMENT, flags=re.M | re.S)
    found: dict = {}
    exec(code, found)  # noqa: S102 (our own document)
    assert found["fixes"]["object"].nunique() == 2
    assert found["fixes"]["stations_used"].max() == 3
