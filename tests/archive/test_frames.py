"""pandas frames of logs, archives and positions."""

import re

import numpy as np
import ols
import ols.frames as frames
import pandas as pd
import pytest
from archive_site import REGION, ROOT, archived, event, flown, write_log
from ols_batch import identities
from ols_batch.plan import Settings, plan
from ols_batch.task import estimate
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


def test_damage_is_named_and_left_out_only_if_asked(tmp_path):
    events = [event(flown(1)[0]), (1, "OLS_BEARING_alfa", b"rubbish")]
    log = write_log(tmp_path / "a.lcmlog", events)
    rubbish = log.read_bytes().index(b"rubbish") - len("OLS_BEARING_alfa") - 28
    damage = f"1 message is damaged.*of OLS_BEARING_alfa, is at byte {rubbish}"
    with pytest.raises(ValueError, match=damage):
        frames.read_log(log)
    with pytest.warns(UserWarning, match=damage):
        assert len(frames.read_log(log, skip_damage=True)) == 1
    with pytest.raises(ValueError, match="a.lcmlog: has no message of kind target"):
        frames.read_log(log, "target")
    log.write_bytes(log.read_bytes()[:-5])
    with pytest.raises(ValueError, match=f"first is byte {rubbish}; the end is cut off"):
        frames.read_log(log)
    log.write_bytes(b"\x1f\x8b" + log.read_bytes())
    with pytest.raises(ValueError, match="is compressed"):
        frames.read_log(log)
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
    with pytest.raises(ValueError, match=r"in region elsewhere .* it has the regions brno"):
        frames.read_archive(archive, "elsewhere", "2026-06-01", half)
    with pytest.raises(ValueError, match="it has the hours from brno 2026-06-01T00 to"):
        frames.read_archive(archive, REGION, "2026-07-01", "2026-07-02")
    with pytest.raises(ValueError, match="it has none at all"):
        frames.read_archive(tmp_path, REGION, "2026-06-01", half)
    file = next((archive / "bearing").rglob("*.parquet"))
    file.write_bytes(file.read_bytes()[:-9])
    with pytest.raises(ValueError, match=str(file)):
        frames.read_archive(archive, REGION, "2026-06-01", "2026-06-02")


def test_positions_from_a_frame(bearings):
    fixes = frames.locate(bearings)
    assert fixes["utime"].is_monotonic_increasing
    assert fixes["object"].nunique() == 4
    ups = np.array([flights.FRAME.to_enu(p)[2] for p in fixes["position_ecef_m"]])
    off_m = np.minimum(abs(ups - 140.0), abs(ups - 85.0))
    assert off_m.max() < 0.5
    assert (fixes["up_sd_m"] > 0.0).all() and fixes["up_sd_m"].max() < 1.0


def test_fixes_of_a_batch_run_with_their_targets(tmp_path):
    settings = Settings(archived(tmp_path, flown(2)), tmp_path / "result")
    for at, fingerprint in plan(settings, None, 0, 1 << 62).to_do:
        estimate(settings, at, fingerprint)
    identities.join(settings.output)
    fixes = frames.read_fixes(settings.output, REGION)
    assert fixes["target"].notna().all() and fixes["target"].nunique() == 4
    assert fixes["target"].str.startswith(f"{REGION}-2026-06-01T0").all()
    assert fixes["utime"].is_monotonic_increasing and fixes["time"].dt.tz is not None
    late = frames.read_fixes(settings.output, begin="2026-06-01T01:00")
    assert 0 < len(late) < len(fixes)
    with pytest.raises(ValueError, match="it has the hours from brno 2026-06-01T00"):
        frames.read_fixes(settings.output, REGION, "2026-07-01")
    with pytest.raises(ValueError, match="it has none at all"):
        frames.read_fixes(tmp_path)


def test_a_choice_of_rows_and_of_the_estimator(bearings):
    one = bearings[bearings["track_id"] == 1]
    config = ols.OfflineConfig(estimator="least-squares")
    fixes = frames.locate(one, config, separate=False)
    assert len(fixes) > 100 and set(fixes["object"]) == {1}
    three = frames.locate(one[one["station"] != "delta"], config, separate=False)
    assert three["stations_used"].max() == 3


SPOILT = {
    "azimuth_rad is not within 0..2 pi: degrees?": lambda f: f.assign(
        azimuth_rad=np.degrees(f["azimuth_rad"]), elevation_rad=np.degrees(f["elevation_rad"])
    ),
    "camera_ecef_m is not near the Earth's surface: latitude, longitude and": lambda f: f.assign(
        camera_ecef_m=[[49.2, 16.6, 310.0]] * len(f)
    ),
    "in 40 rows covariance_white_rad2 has a negative variance": lambda f: f.assign(
        covariance_white_rad2=[[-1e-8, 0.0, 1e-8]] * len(f)
    ),
    "in 40 rows belief is not finite": lambda f: f.assign(belief=np.nan),
    "these seem to be seconds": lambda f: f.assign(utime=f["utime"] // 1_000_000),
    "these seem to be milliseconds": lambda f: f.assign(utime=f["utime"] // 1000),
    "these seem to be nanoseconds": lambda f: f.assign(utime=f["utime"] * 1000),
    "there are no bearings": lambda f: f[:0],
}


@pytest.mark.parametrize("told", SPOILT)
@pytest.mark.parametrize("separate", [True, False])
def test_what_gives_no_positions_is_said(bearings, told, separate):
    with pytest.raises(ValueError, match=re.escape(told)):
        frames.locate(SPOILT[told](bearings[:40]), separate=separate)


def test_why_bearings_give_no_position_is_said(bearings):
    one = bearings[(bearings["track_id"] == 1) & (bearings["station"] == "alfa")]
    with pytest.raises(ValueError, match="no position: [0-9]+ (bearing-only|too-few-rays)"):
        frames.locate(one, separate=False)


def test_some_unfit_bearings_are_named_and_the_others_used(bearings):
    frame = bearings.copy()
    frame.loc[frame.index[:3], "belief"] = np.nan
    with pytest.warns(UserWarning, match="not used: in 3 rows belief is not finite"):
        fixes = frames.locate(frame)
    assert fixes.attrs["unused"]["refused_not_finite"] == 3


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
