"""The documents: every link leads somewhere; troubleshooting.md knows what the sources can say."""

import fnmatch
import re
import shutil
import sys
from pathlib import Path

import pytest
from conftest import finished

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "conditions"))
import table  # noqa: E402

TROUBLESHOOTING = ROOT / "docs/troubleshooting.md"
SOURCES = sorted(
    p
    for folder in ("base", "bridge", "central", "cue", "edge")
    for p in (ROOT / folder).rglob("*.cpp")
)

# ---- links ---------------------------------------------------------------------------------------

LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")


def documents(root: Path) -> list[Path]:
    return sorted([*root.glob("*.md"), *(root / "docs").glob("*.md")])


def anchors(document: Path) -> set[str]:
    headings = re.findall(r"^#+ (.*)$", document.read_text(), flags=re.M)
    return {re.sub(r"[^\w\- ]", "", h.lower()).replace(" ", "-") for h in headings}


def broken_links(root: Path) -> list[str]:
    broken = []
    for document in documents(root):
        for link in LINK.findall(
            re.sub(r"^```.*?^```", "", document.read_text(), flags=re.M | re.S)
        ):
            if re.match(r"[a-z]+:", link):
                continue
            path, _, anchor = link.partition("#")
            target = document.parent / path if path else document
            inside = root.resolve() in [target.resolve(), *target.resolve().parents]
            if not inside or not target.is_file():
                broken.append(f"{document.relative_to(root)}: {link}")
            elif anchor and anchor not in anchors(target):
                broken.append(f"{document.relative_to(root)}: {link}: no such heading")
    return broken


def test_every_link_leads_somewhere():
    assert broken_links(ROOT) == []


# ---- paths -------------------------------------------------------------------------------------

# `sim/world/trajectory.*`; of one folder the next name may stand alone: `trajectory_file.*`.
PATH = re.compile(r"`([\w./*-]+)`")
FOLDERS = {p.name for p in ROOT.iterdir() if p.is_dir() and p.name[0] != "."} - {"build", "out"}


def files_of(root: Path) -> set[str]:
    """Names of the files in the project's own folders."""
    return {path.name for folder in FOLDERS for path in (root / folder).rglob("*")}


def missing_paths(text: str) -> list[str]:
    """Paths in backticks of which the tree has none."""
    missing = []
    names = files_of(ROOT)
    for path in dict.fromkeys(PATH.findall(text)):
        first, inner, _ = path.partition("/")
        if inner and first in FOLDERS:
            found = any(ROOT.glob(path.rstrip("/")))
        elif not inner and re.fullmatch(r"[a-z][\w-]*\.(\*|h|cpp|py|ts|tsx|toml|lcm)", path):
            found = any(fnmatch.fnmatch(name, path) for name in names)
        else:
            continue
        if not found:
            missing.append(path)
    return missing


def test_the_paths_of_the_architecture_exist():
    text = (ROOT / "docs/architecture.md").read_text()
    assert len(PATH.findall(text)) > 100
    assert missing_paths(text) == []


def test_a_path_that_is_gone_is_found():
    assert missing_paths(
        "`edge/messages/messages.*` `edge/gone.*` `slew_planner.*` `gone_too.cpp`"
    ) == [
        "edge/gone.*",
        "gone_too.cpp",
    ]


# ---- where documents are installed ---------------------------------------------------------------


@pytest.fixture(name="installed", scope="module")
def fixture_installed(tmp_path_factory) -> Path:
    """share/doc/ols as cmake/OlsInstall.cmake makes it, without a build: of the files alone."""
    tree, usr = tmp_path_factory.mktemp("tree") / "ols", tmp_path_factory.mktemp("usr")
    left_out = shutil.ignore_patterns("build", ".git", "out", "__pycache__", "tests")
    shutil.copytree(ROOT, tree, ignore=left_out, symlinks=True)
    rules = (tree / "cmake/OlsInstall.cmake").read_text()
    (tree / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.22)\nproject(documents NONE)\n"
        + re.sub(r"(install\(TARGETS|add_dependencies\()[^)]*\)", "", rules)
    )
    for step in (("-S", tree, "-B", tree / "b"), ("--install", tree / "b", "--prefix", usr)):
        done = finished("cmake", *step)
        assert done.returncode == 0, done.stderr
    return usr / "share/doc/ols"


def test_every_link_leads_somewhere_once_installed(installed):
    assert len(documents(installed)) > 5
    assert broken_links(installed) == []


def test_a_unit_names_a_document_that_is_installed(installed):
    missing = [
        f"{unit.name}: {name}"
        for unit in (ROOT / "systemd/units").iterdir()
        for name in re.findall(r"file:/usr/share/doc/ols/(\S+)", unit.read_text())
        if not (installed / name).is_file()
    ]
    assert missing == []


def test_sources_name_documents_that_exist():
    missing = [
        f"{path.relative_to(ROOT)}: {name}"
        for folder in FOLDERS - {"docs"}
        for path in (ROOT / folder).rglob("*")
        if path.is_file() and b"\0" not in path.read_bytes()[:1000]
        for name in re.findall(r"\bdocs/[\w-]+\.md", path.read_text(errors="ignore"))
        if not (ROOT / name).is_file()
    ]
    assert missing == []


# ---- what the sources can say --------------------------------------------------------------------


def raised() -> set[str]:
    """The ids of the alarms that a line of the sources raises."""
    everywhere = [*SOURCES, *(ROOT / "console").rglob("*.cpp")]
    return {i for path in everywhere for i in re.findall(r"\balarm::(\w+)\b", path.read_text())}


def listed(headings: str) -> list[str]:
    """What stands in backticks in the first column of the tables below these headings."""
    found: list[str] = []
    for section in re.split(r"^#+ ", TROUBLESHOOTING.read_text(), flags=re.M):
        if re.match(headings, section):
            for row in re.findall(r"^\| (`.*?) \|", section, flags=re.M):
                found += re.findall(r"`([^`]+)`", row)
    return found


def test_every_alarm_of_the_table_is_raised():
    assert raised() == {name for row in table.alarms(table.table()) for name in row["says"]}


def test_no_alarm_is_raised_in_words_of_its_own():
    own = re.compile(r'\balarms\.push_back\((?:std::string\()?"(?!and ).*')
    found = [line for path in SOURCES for line in own.findall(path.read_text())]
    assert found == []


def test_every_alarm_has_its_words_in_two_languages():
    rows = table.alarms(table.table())
    ids = [name for row in rows for name in row["says"]]
    assert sorted(ids) == sorted(set(ids))
    assert {row["severity"] for row in rows} == {"urgent", "warning", "notice"}
    for row in rows:
        parameters = set()
        for english, german in row["says"].values():
            names = [name for name, _ in table.PARAMETER.findall(english)]
            assert names == [name for name, _ in table.PARAMETER.findall(german)], english
            assert german != english
            parameters |= set(names)
        assert set(row.get("subject", [])) <= parameters, row["says"]
        assert bool(row["meaning"][0]) == bool(row["meaning"][1]), row["says"]
        assert all(row["action"]), row["says"]


def test_troubleshooting_has_the_rows_of_the_table():
    document = TROUBLESHOOTING.read_text()
    assert table.of_the_documents(document) == document, "run conditions/table.py docs"


def reasons_of_the_sources() -> set[str]:
    """What to_string() makes of reasons, and why a message is refused before it is a command."""
    found: set[str] = set()
    for path in SOURCES:
        source = path.read_text()
        for body in re.findall(
            r"to_string\(\w*(?:Refusal|Error|Solution|Distrust) \w+\) \{(.*?)^\}",
            source,
            flags=re.M | re.S,
        ):
            found |= set(re.findall(r'return "([^"]+)";', body))
        found |= set(re.findall(r'\brefuse\((?:kind, |"\w+", )?"(\w+)"\)', source))
    return found - {"none", "ok", "unknown"}


def counters_of_the_sources() -> set[str]:
    found: set[str] = set()
    for path in SOURCES:
        source = path.read_text()
        for inside in re.findall(r"\b(?:counters_?|all)\[(.*?)\]", source, flags=re.S):
            if "+" not in inside:
                found |= set(re.findall(r'"(\w+)"', inside))
        for block in re.findall(
            r"counters = \{(.*?)\};|const char\* name\s*:\s*\{(.*?)\}", source, flags=re.S
        ):
            found |= set(re.findall(r'"([a-z]\w+)"', "".join(block)))
    return {name for name in found if not name.endswith("_")}


def test_reasons_are_those_of_the_sources():
    assert len(reasons_of_the_sources()) > 20
    reasons, sources = set(listed("Refusal")), "".join(path.read_text() for path in SOURCES)
    assert reasons_of_the_sources() <= reasons
    assert {reason for reason in reasons if f'"{reason}"' not in sources} == set()


def test_counters_are_those_of_the_sources():
    assert len(counters_of_the_sources()) > 20
    assert set(listed("Counter")) == counters_of_the_sources()
