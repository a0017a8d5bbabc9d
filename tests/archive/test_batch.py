"""ols-batch: the fixes of an uncut run, each once, whatever happens to workers and files."""

import collections
import dataclasses
import json
import math
import os
import shutil
import signal
from pathlib import Path

import lcm
import numpy as np
import ols
import ols_msg
import pytest
from archive_site import HOURS, REGION, archived, flip_a_byte, flown
from batch_site import ALL, fixes, here, hour, results
from conftest import GOLDEN_LOG
from ols_archive.__main__ import main as ols_archive
from ols_archive.kinds import KINDS
from ols_archive.partitions import Hour, file_of, hours_of, locked, metadata, read
from ols_batch import plan as planner
from ols_batch import run as runner
from ols_batch.__main__ import exit_code, instant_us
from ols_batch.__main__ import main as ols_batch
from ols_batch.plan import Settings, plan
from ols_batch.run import Report
from ols_batch.task import FIXES, estimate, stretches
from ols_bench import flights
from ols_bench.uncut import compare, uncut_fixes

pytest_plugins = ["batch_fixtures"]
pytestmark = pytest.mark.usefixtures("loopback")
# Dask asks /proc for its workers.
HAS_PROC = os.readlink("/proc/self") == str(os.getpid())
with_workers = pytest.mark.skipif(not HAS_PROC, reason="/proc is another namespace's: tools/test")
HOUR_US = 3_600_000_000


def inodes(output: Path) -> dict[Path, int]:
    return {path: path.stat().st_ino for path in output.rglob("fixes.parquet")}


def test_fixes_are_those_of_an_uncut_run(done):
    compared = compare(uncut_fixes(done.archive), done.output, flights.START_US + 1_800_000_000)
    assert compared.is_same
    assert compared.identical == compared.rows > 1000
    assert compared.uncut_objects == compared.batch_targets == 2 * HOURS


def test_without_a_warm_up_they_are_not(done, tmp_path):
    """That the comparison can fail: a flight is seen from the border on."""
    cut = dataclasses.replace(done, output=tmp_path, warm_up_s=0.0, run_out_s=0.0)
    here(cut)
    runner.identities.join(cut.output)
    compared = compare(uncut_fixes(cut.archive), cut.output, flights.START_US)
    assert compared.identical < compared.rows
    assert compared.batch_targets > compared.uncut_objects


def test_a_log_of_former_messages_is_archived_and_fused(tmp_path):
    archive = tmp_path / "archive"
    assert ols_archive([str(archive), "--region", REGION, str(GOLDEN_LOG)]) == 0
    recorded = collections.Counter(e.channel for e in lcm.EventLog(str(GOLDEN_LOG), "r"))
    for kind in KINDS:
        rows = sum(
            read(file_of(archive, kind.name, h)).num_rows for h in hours_of(archive, kind.name)
        )
        assert rows == sum(n for channel, n in recorded.items() if kind.is_on(channel)), kind.name
    (hour_of_log,) = hours_of(archive, "target")
    target = read(file_of(archive, "target", hour_of_log)).to_pylist()[-1]
    assert (target["object_class"], target["size_m"]) == (ols_msg.target_t.CLASS_UNKNOWN, 0.0)
    output = tmp_path / "out"
    here(Settings(archive, output))
    assert read(file_of(output, "fixes", hour_of_log)).num_rows > 10


def test_what_was_seen_before_a_silence_changes_nothing(done, tmp_path):
    at = hour(2)
    alone = [m for m in flown() if at.start_us <= m.utime < at.end_us]
    settings = Settings(archived(tmp_path, alone), tmp_path / "out")
    here(settings)
    assert fixes(settings.output, 2) == fixes(done.output, 2)


def test_a_silence_is_a_minute():
    times = np.array([0, 1, 59_999_999, 119_999_999, 120_000_000])
    assert stretches(times) == [slice(0, 3), slice(3, 5)]
    assert stretches(times[:1]) == [slice(0, 1)]


def test_an_hour_has_its_own_fixes_alone(done):
    for number in range(HOURS):
        times = [row["utime"] for row in fixes(done.output, number)]
        assert hour(number).start_us <= min(times) and max(times) < hour(number).end_us
        assert times == sorted(times)
    assert read(file_of(done.output, "fixes", hour(0))).schema.equals(FIXES)


def test_positions_are_near_the_drones(done):
    """0.3 mrad of heading at 300 m."""
    for row in fixes(done.output, 1):
        place = flights.FRAME.to_enu(row["position_ecef_m"])
        assert min(abs(place[2] - up) for up in (140.0, 85.0)) < 0.5
        assert abs(row["height_m"] - 310.0 - place[2]) < 0.1


def test_a_target_keeps_its_name_across_the_border(done):
    table = read(done.output / "identities.parquet").to_pylist()
    named = {(row["hour"], row["target"]) for row in table}
    across = {target for at, target in named if at == 1 and target.startswith("brno-2026-06-01T00")}
    assert across == {"brno-2026-06-01T00-1", "brno-2026-06-01T00-2"}
    assert sum(row["fixes"] for row in table) == sum(len(fixes(done.output, n)) for n in range(5))
    assert len({row["target"] for row in table}) == 2 * HOURS


@with_workers
def test_workers_that_are_killed_lose_and_double_nothing(done, tmp_path, monkeypatch):
    settings = dataclasses.replace(done, output=tmp_path / "out")
    monkeypatch.setattr(runner, "estimate", estimate_or_die)
    report = runner.run(settings, 2, with_plots=False)
    assert len(list(tmp_path.rglob("*.died"))) == 2
    assert (report.done, report.failed, report.targets) == (HOURS, {}, 2 * HOURS)
    assert results(settings.output) == results(done.output)
    assert list(tmp_path.rglob("*.partial")) == []


def estimate_or_die(settings, at, fingerprint):
    """In a worker: the first one that gets one of two hours is killed while it writes."""
    mark = settings.output / f"{at.hour}.died"
    if at.hour in (1, 3) and not mark.exists():
        path = file_of(settings.output, "fixes", at)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.with_name(f"{path.name}.{os.getpid()}.partial").write_bytes(b"PAR1")
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return estimate(settings, at, fingerprint)


@with_workers
def test_what_a_task_tells_comes_by_the_network(done, tmp_path, monkeypatch):
    """A worker's files may not be seen here yet, as on NFS."""
    settings = dataclasses.replace(done, output=tmp_path / "out")
    monkeypatch.setattr(runner, "estimate", estimate_unseen)
    report = runner.run(settings, 1, with_plots=False)
    assert (report.done, report.failed, report.bearings) == (HOURS, {}, len(flown()))


def estimate_unseen(settings, at, fingerprint):
    result = estimate(settings, at, fingerprint)
    file_of(settings.output, "fixes", at).unlink()
    return result


def test_a_rerun_skips_everything_and_knows_what_was_done(done, monkeypatch):
    before = inodes(done.output), results(done.output)

    def no_workers(*_):
        raise AssertionError("there is nothing to do")

    monkeypatch.setattr(runner, "workers", no_workers)
    report = runner.run(done, 2, with_plots=False)
    assert (report.done, report.skipped) == (0, HOURS)
    assert report.bearings == len(flown()) and report.fixes == sum(
        len(fixes(done.output, n)) for n in range(5)
    )
    assert (inodes(done.output), results(done.output)) == before


def test_any_order_gives_the_same_bytes(done, tmp_path):
    settings = dataclasses.replace(done, output=tmp_path)
    for at, fingerprint in reversed(plan(settings, None, *ALL).to_do):
        estimate(settings, at, fingerprint)
    runner.identities.join(tmp_path)
    assert results(tmp_path) == results(done.output)


def test_a_late_message_makes_just_the_hours_that_read_it_again(own):
    late = flown()[0]
    late.utime, late.sequence = hour(2).start_us + 1, 10**6
    archived(own.archive.parent, [late], "late.lcmlog")
    # The hour before reads it as its run-out, the one after as its warm-up.
    assert [at for at, _ in plan(own, None, *ALL).to_do] == [hour(1), hour(2), hour(3)]


@pytest.mark.parametrize(
    "changed", [{"estimator": "paper"}, {"warm_up_s": 600.0}, {"smooth": True}]
)
def test_other_options_make_all_again(own, changed):
    assert len(plan(dataclasses.replace(own, **changed), None, *ALL).to_do) == HOURS


@with_workers
def test_a_damaged_hour_is_named_and_the_others_are_done(own, done):
    path = file_of(own.archive, "bearing", hour(2))
    whole = path.read_bytes()
    shutil.rmtree(own.output)
    flip_a_byte(path)
    report = runner.run(own, 1, with_plots=False)
    assert list(report.failed) == [str(hour(2))]
    assert list(report.damaged) and all(str(path) in text for text in report.damaged)
    assert hours_of(own.output, "fixes") == [hour(n) for n in (0, 1, 3, 4)]
    unharmed = [n for n in (0, 4) if fixes(own.output, n) == fixes(done.output, n)]
    assert unharmed == [0, 4]
    path.write_bytes(whole)
    assert runner.run(own, 1, with_plots=False).failed == {}
    assert results(own.output) == results(done.output)


def test_another_build_makes_all_again(own, tmp_path, monkeypatch):
    """Whose version is the same."""
    build = tmp_path / "_core.so"
    build.write_bytes(Path(ols._core.__file__).read_bytes() + b"\0")
    monkeypatch.setattr(ols._core, "__file__", str(build))
    other = Settings(own.archive, own.output)
    assert len(plan(other, None, *ALL).to_do) == HOURS
    with pytest.raises(RuntimeError, match="another build"):
        estimate(own, *plan(other, None, *ALL).to_do[0])


def change_a_part(monkeypatch, module, name: str) -> None:
    """As if the program's file of this name were another one."""
    digest_of = module.digest_of

    def digest(path: str) -> str:
        return "other" if Path(path).name == name else digest_of(path)

    monkeypatch.setattr(module, "digest_of", digest)


@pytest.mark.parametrize(
    "name", ["plan.py", "task.py", "kinds.py", "message_types.py", "partitions.py"]
)
def test_another_program_makes_all_again(own, monkeypatch, name):
    change_a_part(monkeypatch, planner, name)
    assert len(plan(Settings(own.archive, own.output), None, *ALL).to_do) == HOURS


def test_another_way_to_join_joins_again(own, monkeypatch):
    path = own.output / "identities.parquet"
    before = metadata(path)["made"]
    runner.identities.join(own.output)
    assert metadata(path)["made"] == before
    change_a_part(monkeypatch, runner.identities, "identities.py")
    runner.identities.join(own.output)
    assert metadata(path)["made"] != before


def spoilt(**fields) -> "flights.ols_msg.bearing_t":
    """A bearing in the middle of a flight with other values in some fields."""
    message = flown()[500]
    message.utime, message.sequence = message.utime + 7, 10**6
    for name, value in fields.items():
        setattr(message, name, value)
    return message


@pytest.mark.parametrize(
    ("fields", "reason"),
    [
        ({"azimuth_rad": math.nan}, "refused_not_finite"),
        ({"camera_ecef_m": [math.nan] * 3}, "refused_not_finite"),
        ({"elevation_rad": 4.0}, "refused_out_of_range"),
        ({"covariance_white_rad2": [0.0, 0.0, 0.0]}, "refused_covariance"),
        ({"belief": 0.01}, "unused_low_belief"),
    ],
)
def test_a_bad_bearing_is_counted_by_reason_and_changes_nothing(own, done, fields, reason):
    message = spoilt(**fields)
    archived(own.archive.parent, [message], "bad.lcmlog")
    at = Hour.of(REGION, message.utime)
    (result,) = (estimate(own, *one) for one in plan(own, None, *ALL).to_do if one[0] == at)
    assert result.unused[reason] == 1
    number = (at.start_us - flights.START_US) // HOUR_US
    assert fixes(own.output, number) == fixes(done.output, number)


def test_an_hour_without_a_position_is_done_too(tmp_path):
    alone = [message for message in flown(1) if message.station == "alfa"]
    settings = Settings(archived(tmp_path, alone), tmp_path / "out")
    (result,) = here(settings)
    assert (result.fixes, result.bearings) == (0, len(alone))
    assert plan(settings, None, *ALL).to_do == []
    assert runner.identities.join(settings.output).targets == 0


@pytest.mark.parametrize("estimator", ["least-squares", "paper"])
def test_the_other_estimators_work(done, tmp_path, estimator):
    settings = dataclasses.replace(done, output=tmp_path, estimator=estimator)
    assert all(result.fixes > 100 for result in here(settings))


@with_workers
def test_one_command_from_the_archive_to_fixes_and_plots(done, tmp_path, capfd):
    output = tmp_path / "out"
    words = [str(done.archive), str(output), "--workers", "1", "--to", "2026-06-01T02:00"]
    assert ols_batch(words) == 0
    report = json.loads((output / "report.json").read_text())
    assert (report["done"], report["targets"]) == (2, 4)
    assert [Path(name).name for name in report["plots"]] == ["brno-tracks.png", "brno-hours.png"]
    assert all(Path(name).read_bytes().startswith(b"\x89PNG") for name in report["plots"])
    told = capfd.readouterr()
    assert "2 of 2 hours, 0 skipped, 0 failed" in told.err
    assert "hours     2 done" in told.out


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["nowhere", "out"], "no archive with bearings"),
        (["ARCHIVE", "ARCHIVE"], "the same folder"),
        (["ARCHIVE", "out", "--warm-up-s", "nan"], "--warm-up-s"),
        (["ARCHIVE", "out", "--workers", "0"], "--workers"),
        (["ARCHIVE", "out", "--from", "June"], "--from"),
        (["ARCHIVE", "out", "--smooth", "--estimator", "paper"], "--smooth"),
    ],
)
def test_wrong_options_are_named(archive, words, told, capsys):
    with pytest.raises(SystemExit) as ended:
        ols_batch([word.replace("ARCHIVE", str(archive)) for word in words])
    assert ended.value.code == 2
    assert told in capsys.readouterr().err


def test_two_runs_do_not_write_into_one_result(done, capsys):
    with locked(done.output):
        assert ols_batch([str(done.archive), str(done.output), "--no-plots"]) == 2
    assert f"{done.output}: another process writes there" in capsys.readouterr().err


def test_nothing_found_is_no_success(done, tmp_path, capsys):
    words = [str(done.archive), str(tmp_path / "out"), "--region", "elsewhere", "--no-plots"]
    assert ols_batch(words) == 2
    assert f"{done.archive}: no hour with bearings is chosen" in capsys.readouterr().err
    assert exit_code(Report(done=3)) == 1
    assert exit_code(Report(done=3, fixes=1)) == 0


def test_times_are_utc_unless_they_say_otherwise():
    assert instant_us("2026-06-01") == flights.START_US
    assert instant_us("2026-06-01T02:00+02:00") == flights.START_US
