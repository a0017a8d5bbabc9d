"""The questions of docs/archive.md, asked of an archive and a result as it describes them."""

import csv
import re
from pathlib import Path

import duckdb
import pytest
from archive_site import HOURS, ROOT, archived, flown
from ols_batch import identities
from ols_batch.plan import Settings, plan
from ols_batch.task import FIXES, estimate
from ols_bench import flights

DOCUMENT = (ROOT / "docs/archive.md").read_text()
BLOCKS = re.findall(r"^```sql\n(.*?)^```", DOCUMENT, flags=re.M | re.S)


@pytest.fixture(scope="module", name="folder")
def fixture_folder(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("here")
    settings = Settings(archived(folder, flown()), folder / "result")
    for at, fingerprint in plan(settings, None, 0, 1 << 62).to_do:
        estimate(settings, at, fingerprint)
    identities.join(settings.output)
    return folder


@pytest.fixture(name="ask")
def fixture_ask(folder, monkeypatch):
    """The answer of the block with these words, as a list of dicts."""
    monkeypatch.chdir(folder)
    with duckdb.connect() as connection:
        connection.execute(BLOCKS[0])

        def ask(words: str) -> list[dict]:
            (block,) = (block for block in BLOCKS[1:] if words in block)
            answer = connection.execute(block)
            names = [column[0] for column in answer.description]
            return [dict(zip(names, row, strict=True)) for row in answer.fetchall()]

        yield ask


def test_tracks_above_100_m_near_here_in_june(ask):
    """One of the two drones of each flight is at 140 m, the other at 85 m."""
    found = ask("height_m - getvariable('height_m') > 100")
    assert len(found) == HOURS
    assert all(139.0 < row["highest_m"] < 141.0 for row in found)
    assert found[0]["target"].startswith("brno-2026-06-01T00-")
    assert found[0]["last"].hour == 1  # it crosses the border


def test_nothing_is_above_100_m_there(folder, ask, monkeypatch):
    """That the question can have another answer."""
    moved = BLOCKS[0].replace("latitude_deg = 49.2266", "latitude_deg = 49.2566")
    with duckdb.connect() as connection:
        connection.execute(moved)
        assert connection.execute(BLOCKS[1]).fetchall() == []


def test_targets_in_each_hour_of_the_day(ask):
    rows = ask("count(DISTINCT target) AS targets")
    assert [row["hour"] for row in rows] == list(range(HOURS))
    assert [row["targets"] for row in rows] == [2, 4, 2, 2, 4]  # two of the flights cross a border


def test_quality_day_by_day(ask):
    (row,) = ask("median(sqrt(position_covariance_enu_m2[1]))")
    assert row["fixes"] > 1000
    assert all(0.01 < row[name] < 1.0 for name in ("east_m", "north_m", "up_m"))


def test_gaps_in_sequences(ask, folder):
    rows = ask("AS missing")
    assert [row["station"] for row in rows] == sorted(flights.STATIONS)
    assert sum(row["there"] for row in rows) == len(flown())
    assert {row["missing"] for row in rows} == {0}


def test_a_track_as_csv(ask, folder):
    ask("TO 'track.csv'")
    rows = list(csv.DictReader((folder / "track.csv").open()))
    assert len(rows) > 100
    assert {"time", "latitude_deg", "longitude_deg", "height_m"} == set(rows[0])


def test_every_question_is_asked_here():
    asked = re.findall(r"ask\(\s*\"([^\"]+)\"", Path(__file__).read_text())
    assert [sum(words in block for words in asked) for block in BLOCKS[1:]] == [1] * len(BLOCKS[1:])


def test_the_document_has_the_columns_of_fixes():
    for name in FIXES.names:
        assert f"`{name}`" in DOCUMENT, name
    for name in identities.IDENTITIES.names:
        assert f"`{name}`" in DOCUMENT, name
