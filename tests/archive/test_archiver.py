"""ols-archive: whole messages, each once, whatever comes in and however often."""

import json
import math
import random
import re
from pathlib import Path

import ols_msg
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from archive_site import REGION, ROOT, SEED, event, filled, flip_a_byte, flown, write_log
from ols_archive import partitions, upsert
from ols_archive.__main__ import main as ols_archive
from ols_archive.kinds import BY_NAME, ENVELOPE, KINDS, columns_of, schema_of, values_of
from ols_archive.message_types import list_of
from ols_archive.partitions import Damaged, Hour, file_of, hours_of, read

START_US = 1_780_272_000_000_000
HOUR_US = 3_600_000_000


def run(folder: Path, *logs: Path, code: int = 0, options: tuple[str, ...] = ()) -> dict:
    report = folder / "report.json"
    words = [str(folder / "archive"), "--region", REGION, "--report", str(report)]
    assert ols_archive([*words, *options, *map(str, logs)]) == code
    return json.loads(report.read_text())


def rows(folder: Path, kind: str = "bearing") -> list[dict]:
    root = folder / "archive"
    found = [read(file_of(root, kind, hour)) for hour in hours_of(root, kind)]
    return pa.concat_tables(found).to_pylist() if found else []


def files(folder: Path) -> dict[Path, tuple[bytes, int]]:
    """What is in them, and which they are: a file that is written again is another one."""
    return {
        path: (path.read_bytes(), path.stat().st_ino)
        for path in (folder / "archive").rglob("*.parquet")
    }


def bearings(count: int, step_us: int = 1_000_000) -> list:
    messages = flown(1)[:count]
    for number, message in enumerate(messages):
        message.utime = START_US + number * step_us
    return messages


def same(one, other) -> bool:
    """NaN is the same as NaN."""
    if isinstance(one, list | tuple):
        return len(one) == len(other) and all(map(same, one, other))
    if isinstance(one, float) and math.isnan(one):
        return math.isnan(other)
    return one == other


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
def test_a_message_comes_back_whole(tmp_path, kind):
    message = filled(kind.type(), random.Random(SEED), START_US + 1)
    channel = kind.channel + (message.station if kind.of_station else "")
    run(tmp_path, write_log(tmp_path / "a.lcmlog", [(START_US + 9, channel, message.encode())]))
    (row,) = rows(tmp_path, kind.name)
    assert (row["channel"], row["recorded_utime"]) == (channel, START_US + 9)
    got = [row[name] for name in message.__slots__]
    assert same(got, list(values_of(message)))


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.name)
def test_columns_are_those_of_the_definition_and_say_what_they_are(kind):
    names = [field.name for field in columns_of(kind)]
    assert names == [field.name for field in ENVELOPE] + kind.type.__slots__
    if kind.name == "bearing":
        described = schema_of(kind).field("azimuth_rad").metadata[b"description"]
        assert described == b"[rad] 0..2 pi, clockwise from true north"
        assert schema_of(kind).field("camera_ecef_m").type == list_of(pa.float64(), 3)
    if kind.name == "fusion_status":
        assert schema_of(kind).field("bias_rad").type == list_of(list_of(pa.float64(), 2))


def test_every_message_with_a_sequence_is_archived_or_a_picture():
    """A new message is not forgotten."""
    pictures = {"preview_t", "frame_part_t", "procedure_t", "video_frame_t"}
    asked = {"frame_request_t", "procedure_answer_t"}  # of a procedure, whose result is a file
    own = {"trust_list_t", "site_settings_t"}  # files, kept by their own signature
    known = {kind.message for kind in KINDS} | pictures | asked | own
    defined = {
        path.stem
        for path in (ROOT / "lcmtypes").glob("*.lcm")
        if re.search(r"^\s*int64_t\s+sequence;", path.read_text(), flags=re.M)
    }
    assert defined - known == set()


def test_running_twice_adds_nothing_and_writes_nothing(tmp_path):
    log = write_log(tmp_path / "a.lcmlog", map(event, flown(2)))
    first = run(tmp_path, log)
    before = files(tmp_path)
    again = run(tmp_path, log, log)
    assert first["counts"]["added"] == len(rows(tmp_path)) == len(flown(2))
    assert again["counts"]["added"] == 0
    assert again["counts"]["repeated"] == 2 * first["counts"]["added"]
    assert files(tmp_path) == before


def test_the_order_of_logs_does_not_matter(tmp_path):
    messages = flown(2)
    contents = []
    for name, parts in (("one", (messages,)), ("two", (messages[300:], messages[:500]))):
        folder = tmp_path / name
        folder.mkdir()
        for number, part in enumerate(parts):
            run(folder, write_log(folder / f"{number}.lcmlog", map(event, part)))
        contents.append([data for _, (data, _) in sorted(files(folder).items())])
    assert contents[0] == contents[1]


def test_a_message_is_in_the_hour_of_its_own_stamp(tmp_path):
    first, second = bearings(2)
    first.utime, second.utime = START_US + HOUR_US - 1, START_US + HOUR_US
    late_us = START_US + 5 * HOUR_US
    events = [(late_us, *event(message)[1:]) for message in (second, first)]
    run(tmp_path, write_log(tmp_path / "a.lcmlog", events))
    archive = tmp_path / "archive"
    hours = [Hour(REGION, START_US), Hour(REGION, START_US + HOUR_US)]
    assert hours_of(archive, "bearing") == hours
    path = archive / "bearing/region=brno/day=2026-06-01/hour=0/bearing.parquet"
    assert read(path)["utime"].to_pylist() == [first.utime]


def test_one_key_with_two_contents_is_named_and_the_first_stays(tmp_path):
    true, forged = bearings(1)[0], bearings(1)[0]
    forged.azimuth_rad += 0.1
    run(tmp_path, write_log(tmp_path / "a.lcmlog", [event(true)]))
    told = run(tmp_path, write_log(tmp_path / "b.lcmlog", [event(forged)]), code=1)
    assert told["counts"]["contradictions"] == 1
    assert told["named"]["contradictions"] == ["bearing of brno 2026-06-01T00"]
    assert [row["azimuth_rad"] for row in rows(tmp_path)] == [true.azimuth_rad]


def test_the_same_sequence_of_another_boot_or_station_is_another_message(tmp_path):
    one, other_boot, other_station = (bearings(1)[0] for _ in range(3))
    other_boot.boot_id += 1
    other_station.station = "bravo"
    events = map(event, (one, other_boot, other_station))
    assert run(tmp_path, write_log(tmp_path / "a.lcmlog", events))["counts"]["added"] == 3


def test_damage_in_a_log_is_named_and_counted_and_hides_nothing(tmp_path):
    good = bearings(4)
    early = bearings(1)[0]
    early.utime = -1
    events = [
        event(good[0]),
        (START_US, "OLS_BEARING_alfa", good[0].encode()[:-3]),
        (START_US, "OLS_BEARING_alfa", good[0].encode() + b"x"),
        (START_US, "OLS_BEARING_zulu", good[0].encode()),
        (START_US, "OLS_BEARING_alfa", early.encode()),
        (START_US, "OLS_STATUS_alfa", b""),
        event(good[1]),
        (START_US, "OLS_PREVIEW_alfa", b"picture"),
        event(good[2]),
    ]
    log = write_log(tmp_path / "a.lcmlog", events)
    whole = log.read_bytes()
    second = whole.index(b"OLS_BEARING_zulu") - 28
    log.write_bytes(whole[:second] + b"garbage" + whole[second:] + whole[:50])
    other = tmp_path / "passwd"
    other.write_text("root:x:0:0:root\n")
    told = run(tmp_path, log, tmp_path / "no.lcmlog", other, code=1)
    assert told["counts"] == {
        "added": 3,
        "repeated": 0,
        "undecodable": 3,
        "other_station": 1,
        "time_out_of_range": 1,
        "not_archived": 1,
        "garbage_bytes": 57,
        "cut_off": 1,
        "unreadable": 2,
    }
    assert told["named"]["other_station"][0].endswith("OLS_BEARING_zulu")
    damage = f"57 bytes of the log are damaged, the first is byte {second}; the end is cut off"
    assert told["named"]["cut_off"] == [f"{log}: {damage}"]
    assert "no.lcmlog" in told["named"]["unreadable"][0]
    assert "passwd: is no LCM log" in told["named"]["unreadable"][1]
    assert [row["utime"] for row in rows(tmp_path)] == [m.utime for m in good[:3]]


def test_not_a_number_is_archived_as_it_is(tmp_path):
    (message,) = bearings(1)
    message.azimuth_rad, message.belief = math.nan, math.inf
    run(tmp_path, write_log(tmp_path / "a.lcmlog", [event(message)]))
    (row,) = rows(tmp_path)
    assert math.isnan(row["azimuth_rad"]) and row["belief"] == math.inf


@pytest.mark.parametrize("harm", [flip_a_byte, lambda path: path.write_bytes(b"PAR1")])
def test_a_damaged_file_is_kept_beside_and_made_again_from_the_log(tmp_path, harm):
    log = write_log(tmp_path / "a.lcmlog", map(event, flown(1)))
    run(tmp_path, log)
    ((path, (before, _)),) = files(tmp_path).items()
    harm(path)
    harmed = path.read_bytes()
    with pytest.raises(Damaged, match="bearing.parquet"):
        read(path)
    told = run(tmp_path, log, code=1)
    aside = path.with_name("bearing.parquet.damaged")
    assert told["counts"]["damaged_files"] == 1
    assert told["named"]["damaged_files"] == [f"set aside: {aside}"]
    assert aside.read_bytes() == harmed
    assert path.read_bytes() == before


def of_other_lists(table: pa.Table) -> pa.Table:
    """As other programs write what has so many elements."""
    place = table.column_names.index("camera_ecef_m")
    loose = pa.array(table["camera_ecef_m"].to_pylist(), list_of(pa.float64()))
    return table.set_column(place, "camera_ecef_m", loose)


def of_another_type(table: pa.Table) -> pa.Table:
    place = table.column_names.index("azimuth_rad")
    return table.set_column(place, "azimuth_rad", pa.array(["x"] * len(table)))


def of_another_key(table: pa.Table) -> pa.Table:
    place = table.column_names.index("sequence")
    return table.set_column(place, "sequence", pa.array([[1]] * len(table)))


def without_channels(table: pa.Table) -> pa.Table:
    place = table.column_names.index("channel")
    return table.set_column(place, "channel", pa.nulls(len(table), pa.string()))


def without_keys(table: pa.Table) -> pa.Table:
    return table.drop_columns(["boot_id"])


def with_a_name_twice(table: pa.Table) -> pa.Table:
    one = pa.array([1] * len(table))
    return table.append_column("former", one).append_column("former", one)


@pytest.mark.parametrize(
    "change",
    [
        *(of_other_lists, of_another_type, of_another_key, without_channels, without_keys),
        with_a_name_twice,
    ],
)
def test_a_foreign_file_is_kept_beside_and_made_again_from_the_log(tmp_path, change):
    """It can be read, but is not of these messages."""
    log = write_log(tmp_path / "a.lcmlog", map(event, flown(1)))
    run(tmp_path, log)
    ((path, (before, _)),) = files(tmp_path).items()
    pq.write_table(change(read(path)), path)
    told = run(tmp_path, log, code=1)
    aside = path.with_name("bearing.parquet.damaged")
    assert told["named"]["damaged_files"] == [f"set aside: {aside}"]
    assert aside.exists()
    assert path.read_bytes() == before


def test_a_file_is_replaced_whole_or_not_at_all(tmp_path, monkeypatch):
    run(tmp_path, write_log(tmp_path / "a.lcmlog", map(event, bearings(3))))
    before = files(tmp_path)

    def full(*_, **__):
        raise OSError("No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(partitions.os, "fsync", full)
        run(tmp_path, write_log(tmp_path / "b.lcmlog", map(event, bearings(9))), code=2)
    assert files(tmp_path) == before
    assert list((tmp_path / "archive").rglob("*.partial")) == []
    run(tmp_path, tmp_path / "b.lcmlog")
    assert len(rows(tmp_path)) == 9


def test_a_message_of_an_older_version_stays(tmp_path):
    """A file with fewer columns, and one that a newer version has dropped."""
    run(tmp_path, write_log(tmp_path / "a.lcmlog", map(event, bearings(1))))
    ((path, _),) = files(tmp_path).items()
    old = read(path).drop_columns(["clock_error_s"])
    old = old.append_column("former", pa.array([7]))
    partitions.write(path, old, {})
    run(tmp_path, write_log(tmp_path / "b.lcmlog", map(event, bearings(2))))
    first, second = rows(tmp_path)
    assert (first["former"], first["clock_error_s"]) == (7, None)
    assert (second["former"], second["clock_error_s"]) == (None, 5e-4)


def test_what_is_merged_is_by_key_alone():
    """The older row stays, a repetition is told from a contradiction, the result is by time."""
    kind = BY_NAME["bearing"]

    def table(*messages):
        from ols_archive.archiver import digest_of
        from ols_archive.kinds import table_of

        return table_of(
            kind,
            [
                (f"OLS_BEARING_{m.station}", 0, None, digest_of(m.encode(), b""), *values_of(m))
                for m in messages
            ],
        )

    a, b, c = bearings(3)
    changed = bearings(3)[1]
    changed.belief = 0.1
    result, merged = upsert.merge(table(c, b), table(a, c, changed))
    assert result["utime"].to_pylist() == [a.utime, b.utime, c.utime]
    assert result["belief"].to_pylist() == [0.9, 0.9, 0.9]
    assert (merged.added, merged.repeated, merged.contradictions) == (1, 1, 1)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["a"], "--region"),
        (["a", "--region", "../b", "x.lcmlog"], "--region ../b"),
        (["a", "--region", "b"], "logs, --live or --stream"),
        (["a", "--region", "b", "x.lcmlog", "--live", "udpm://"], "logs, --live or --stream"),
        (["a", "--region", "b", "--live", "udpm://", "--flush-s", "0"], "--flush-s"),
    ],
)
def test_wrong_options_are_named(words, told, capsys):
    with pytest.raises(SystemExit) as ended:
        ols_archive(words)
    assert ended.value.code == 2
    assert told in capsys.readouterr().err


def test_the_document_lists_every_kind_and_what_the_archive_adds():
    text = (ROOT / "docs/archive.md").read_text()
    for kind in KINDS:
        assert f"| `{kind.name}` | `{kind.channel}" in text, kind.name
    for field in ENVELOPE:
        assert f"| `{field.name}` |" in text, field.name
    assert ols_msg.bearing_t.__slots__ == [
        name for name in re.findall(r"^\| `(\w+)` \| ", section(text, "bearing"), flags=re.M)
    ]


def section(text: str, name: str) -> str:
    return re.search(rf"^### `{name}`\n(.*?)(?=^#)", text, flags=re.M | re.S)[1]
