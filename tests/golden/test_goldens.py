"""The goldens hold, and a difference is told."""

import csv

import goldens
import pytest

NAMES = [golden.name for golden in goldens.GOLDENS]


@pytest.mark.parametrize("golden", goldens.GOLDENS, ids=NAMES)
def test_nothing_has_changed(golden, tmp_path):
    golden.run(tmp_path)
    found = goldens.differences(golden, tmp_path)
    assert not found, "\n".join(
        [f"{len(found)} rows differ; the first:", *found[:5], "wanted? tools/goldens --help"]
    )


@pytest.fixture(name="fixes")
def fixture_fixes():
    return goldens.rows_of(goldens.FOLDER / "offline_filter" / "fixes.csv")


def test_a_centimetre_is_found_and_told(fixes):
    now = [dict(row) for row in fixes]
    now[7]["latitude_deg"] = repr(float(now[7]["latitude_deg"]) + 1e-7)
    (line,) = goldens.file_differences("fixes.csv", fixes, now)
    assert f"utime_us {fixes[7]['utime_us']}" in line
    assert "latitude_deg was" in line and "(by " in line


def test_what_another_processor_rounds_is_no_difference(fixes):
    now = [dict(row) for row in fixes]
    now[7]["height_m"] = repr(float(now[7]["height_m"]) * (1 + 0.5 * goldens.TOLERANCE))
    assert goldens.file_differences("fixes.csv", fixes, now) == []


@pytest.mark.parametrize(
    ("column", "value"), [("target", "other"), ("utime_us", "1"), ("height_m", "nan")]
)
def test_an_exact_column_must_be_equal(fixes, column, value):
    now = [dict(row) for row in fixes]
    now[3][column] = value
    assert len(goldens.file_differences("fixes.csv", fixes, now)) == 1


def test_a_missing_row_is_a_difference(fixes):
    assert "rows, now" in goldens.file_differences("fixes.csv", fixes, fixes[:-1])[0]


def test_accepting_makes_them_the_same(fixes, tmp_path, monkeypatch):
    monkeypatch.setattr(goldens, "FOLDER", tmp_path / "goldens")
    (tmp_path / "goldens").mkdir()
    output = tmp_path / "output"
    output.mkdir()
    with (output / "fixes.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, fixes[0])
        writer.writeheader()
        writer.writerows(fixes)
    golden = goldens.Golden("one", ("fixes.csv",), ())
    goldens.accept(golden, output)
    assert goldens.differences(golden, output) == []


def count(counter, value):
    return {"of": "fusion", "counter": counter, "value": value}


def test_a_count_must_be_equal_however_large():
    was, now = [count("bearings", "1000000")], [count("bearings", "1000001")]
    assert len(goldens.file_differences("counters.csv", was, now)) == 1


def test_a_counter_that_is_not_kept_was_zero_and_one_that_has_gone_is_missed():
    was = goldens.kept("counters.csv", [count("late", "0"), count("bearings", "7")])
    assert was == [count("bearings", "7")]
    now = [count("late", "1"), count("bearings", "7")]
    assert "late: value was 0, is 1" in differences_of(was, now)[0]
    assert "2 rows, now 1" in differences_of(was, now[:1])[-1]


def differences_of(was, now):
    return goldens.file_differences("counters.csv", goldens.with_zeros(was, now), now)


def test_a_new_column_is_a_difference(fixes):
    now = [{**row, "more": "1"} for row in fixes]
    assert "column more is new" in goldens.file_differences("fixes.csv", fixes, now)[0]
