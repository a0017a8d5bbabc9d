"""The catalogue of the journal: it explains every kind of event, and systemd can read it."""

import re
import shutil
from pathlib import Path

import pytest
from conftest import finished

ROOT = Path(__file__).resolve().parents[2]
CATALOGUE = ROOT / "systemd/ols.catalog"
HEADER = (ROOT / "base/journal/event_ids.h").read_text()
IDS = dict(re.findall(r'Id (k\w+) = "([0-9a-f]{32})";', HEADER))
FIELDS = {"MESSAGE", "SYSLOG_IDENTIFIER"}
FIELDS |= {"OLS_STATION", "OLS_DEVICE", "OLS_REASON", "OLS_ACTION"}


def entries() -> dict[str, str]:
    parts = re.split(r"^-- (\w{32})$", CATALOGUE.read_text(), flags=re.M)[1:]
    return dict(zip(parts[::2], parts[1::2], strict=True))


def test_every_id_is_one_of_its_own():
    assert len(IDS) == HEADER.count("constexpr Id") > 15
    assert len(set(IDS.values())) == len(IDS)


def test_the_catalogue_has_the_ids_of_the_header_and_no_others():
    listed = re.findall(r"^-- (.*)$", CATALOGUE.read_text(), flags=re.M)
    assert sorted(listed) == sorted(IDS.values())


def test_an_entry_says_what_it_is_and_where_more_stands():
    form = r"\nSubject: \S.*\nDefined-By: OLS\nDocumentation: file:/usr/share/doc/ols/(\S+)\n\n *\S"
    for name, number in IDS.items():
        found = re.match(form, entries()[number])
        assert found, name
        assert (ROOT / found[1]).is_file(), name
        assert set(re.findall(r"@(\w+)@", entries()[number])) <= FIELDS, name


def test_every_kind_is_written_somewhere():
    code = "".join(
        path.read_text()
        for folder in ("base", "bridge", "central", "console", "cue", "edge", "export", "tools")
        for path in (ROOT / folder).rglob("*.cpp")
    )
    scripts = (ROOT / "systemd/ols-station-restart").read_text()
    unused = [n for n in IDS if not re.search(rf"event::{n}\b", code) and IDS[n] not in scripts]
    assert unused == []


def test_the_document_has_every_kind():
    text = (ROOT / "docs/fleet.md").read_text()
    assert sorted(re.findall(r"`([0-9a-f]{32})`", text)) == sorted(IDS.values())


@pytest.mark.skipif(shutil.which("journalctl") is None, reason="no journalctl")
def test_systemd_reads_the_catalogue(tmp_path):
    folder = tmp_path / "usr/lib/systemd/catalog"
    folder.mkdir(parents=True)
    (tmp_path / "var/lib/systemd/catalog").mkdir(parents=True)
    shutil.copy(CATALOGUE, folder)

    def journalctl(word):
        done = finished("journalctl", f"--root={tmp_path}", word)
        assert done.returncode == 0, done.stderr
        return done

    assert journalctl("--update-catalog").stderr == ""
    read = [line.split()[0] for line in journalctl("--list-catalog").stdout.splitlines()]
    assert sorted(read) == sorted(IDS.values())
