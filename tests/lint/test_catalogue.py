"""The catalogue of the journal: it explains every kind of event, and systemd can read it."""

import re
import shutil
from pathlib import Path

import pytest
from conftest import finished
from test_docs import table

ROOT = Path(__file__).resolve().parents[2]
IDS = {name: one["id"] for name, one in table.events().items()}
FIELDS = {"MESSAGE", "SYSLOG_IDENTIFIER"}
FIELDS |= {"OLS_STATION", "OLS_DEVICE", "OLS_REASON", "OLS_ACTION"}


def test_every_id_is_one_of_its_own():
    assert len(IDS) > 15
    assert len(set(IDS.values())) == len(IDS)
    assert all(re.fullmatch("[0-9a-f]{32}", one) for one in IDS.values())


def test_an_entry_says_what_it_is_and_where_more_stands():
    for name, one in table.events().items():
        assert (ROOT / one["document"]).is_file(), name
        assert one["subject"] and one["text"].strip(), name
        assert set(re.findall(r"@(\w+)@", one["subject"] + one["text"])) <= FIELDS, name


def test_every_kind_is_written_somewhere():
    code = "".join(
        path.read_text()
        for folder in ("base", "bridge", "central", "console", "cue", "edge", "export", "tools")
        for path in (ROOT / folder).rglob("*.cpp")
    )
    scripts = (ROOT / "systemd/ols-station-restart").read_text()
    unused = [n for n in IDS if not re.search(rf"event::k{n}\b", code) and IDS[n] not in scripts]
    assert unused == []


def test_the_document_has_every_kind():
    document = (ROOT / "docs/fleet.md").read_text()
    assert document.count(IDS["Ready"]) == 1
    assert table.of_the_fleet(document) == document, "run conditions/table.py docs"


@pytest.mark.skipif(shutil.which("journalctl") is None, reason="no journalctl")
def test_systemd_reads_the_catalogue(tmp_path):
    folder = tmp_path / "usr/lib/systemd/catalog"
    folder.mkdir(parents=True)
    (tmp_path / "var/lib/systemd/catalog").mkdir(parents=True)
    (folder / "ols.catalog").write_text(table.catalogue())

    def journalctl(word):
        done = finished("journalctl", f"--root={tmp_path}", word)
        assert done.returncode == 0, done.stderr
        return done

    assert journalctl("--update-catalog").stderr == ""
    read = [line.split()[0] for line in journalctl("--list-catalog").stdout.splitlines()]
    assert sorted(read) == sorted(IDS.values())
