"""The console's page in the eyes of the TypeScript compiler; the bundler only strips the types."""

import importlib.machinery
import importlib.util
import json
import os
import re
import subprocess
from pathlib import Path

import pytest
from conftest import finished
from test_docs import listed

ROOT = Path(__file__).resolve().parents[2]
COMPILER = ROOT / "build/page-libraries/node_modules/typescript"
MOST_LINES = 60  # a screen

pytestmark = pytest.mark.skipif(
    not COMPILER.exists(), reason="build/page-libraries is missing: tools/fetch-page-libraries"
)


def node(*arguments: str | Path) -> str:
    done = finished("node", *arguments)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def longer_than_a_screen(sources: list[Path]) -> list[str]:
    """The page's outermost functions, each with what stands within it."""
    read = node(Path(__file__).with_name("page_functions.mjs"), COMPILER, *sources)
    functions = [json.loads(line) for line in read.splitlines()]
    return [
        f"{one['path']}:{one['line']} {one['name']}"
        for one in functions
        if one["end"] - one["line"] >= MOST_LINES
    ]


def test_the_types_of_the_page_fit():
    node(COMPILER / "bin/tsc", "-p", ROOT / "console/page")


def test_functions_of_the_page_fit_on_a_screen():
    assert longer_than_a_screen(sorted((ROOT / "console/page/src").glob("*.ts*"))) == []


def test_a_function_that_is_longer_is_found(tmp_path):
    source = tmp_path / "long.ts"
    source.write_text("const f = () => {\n" + "  g();\n" * MOST_LINES + "};\n")
    assert longer_than_a_screen([source]) == [f"{source}:1 f"]


# ---- what programs say, in both languages --------------------------------------------------------


def page_build():
    loader = importlib.machinery.SourceFileLoader("page_build", str(ROOT / "console/page/build"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("page_build", loader))
    loader.exec_module(module)
    return module


@pytest.fixture(name="conditions", scope="module")
def fixture_conditions() -> dict:
    return page_build().conditions()


def test_every_alarm_has_a_severity_and_german_words(conditions):
    known = {text for row in conditions["alarms"] for text in row["text"]}
    missing = set(listed("Alarm(?!s of the bridge)")) - known
    assert missing == set()
    own = {"no status any more", "the fusion has fallen silent"}
    assert known - set(listed("Alarm")) == own, "an alarm that no program has any more"
    assert {row["severity"] for row in conditions["alarms"]} == {"urgent", "warning", "notice"}
    for row in conditions["alarms"]:
        for english, german in row["text"].items():
            assert german != english and german.count("…") == english.count("…"), english
        for english, german in (row["meaning"], row["action"]):
            assert bool(english) == bool(german), row["text"]


def refusals_of_the_sources() -> set[str]:
    """What the console and the stations answer to a person, as far as it stands in the sources."""
    found = set()
    outcome = (ROOT / "command/outcome.cpp").read_text()
    found |= set(re.findall(r'^ +\{"\w+", "([^"]+)"\},$', outcome, flags=re.M))
    found |= set(re.findall(r'Outcome\{false, "([^"]+)"\}', outcome))
    for path in (ROOT / "console").glob("*.cpp"):
        source = re.sub(r'"\s+"', "", path.read_text())
        found |= set(re.findall(r'"refused: ([^"]+)"', source)) - {""}
        found |= set(re.findall(r'Outcome\{false, "([^"]+)"\}', source))
    admission = (ROOT / "central/admission/bearing_check.cpp").read_text()
    found |= set(re.findall(r'"(a bearing refused: [^"]+|bearings refused: [^"]+)"', admission))
    return found


def test_every_refusal_has_german_words(conditions):
    refusals = refusals_of_the_sources()
    assert len(refusals) > 45
    assert refusals - set(conditions["phrases"]) == set()


def test_every_reason_of_a_refused_command_is_a_sentence():
    words = re.findall(r'^ +\{"(\w+)", "', (ROOT / "command/outcome.cpp").read_text(), flags=re.M)
    explained = {"recorder", "frame_service"}  # by the station's last error
    assert set(listed("Refusals of commands")) - set(words) == explained


@pytest.fixture(name="page_says", scope="module")
def fixture_page_says(conditions, tmp_path_factory):
    """Calls the page's own pure functions, in German: page_says("inWords", [[arguments], ...])."""
    folder = tmp_path_factory.mktemp("page")
    (folder / "conditions.json").write_text(json.dumps(conditions))
    script, source = folder / "said.ts", ROOT / "console/page/src"
    script.write_text(
        "globalThis.document = { documentElement: {} };\n"
        f'import {{ conditionOf, inWords }} from "{source}/conditions";\n'
        f'import {{ gridName, inMetres }} from "{source}/format";\n'
        f'import {{ sidesOf }} from "{source}/labels";\n'
        f'import {{ setLanguage }} from "{source}/words";\n'
        'setLanguage("de");\n'
        "const sides = (names, before) => [...sidesOf(names, new Map(before))];\n"
        "const known = { conditionOf, inWords, gridName, inMetres, sides };\n"
        "const [name, calls] = process.argv.slice(2);\n"
        "console.log(JSON.stringify(JSON.parse(calls).map((call) => known[name](...call))));\n"
    )
    bundled = folder / "said.cjs"
    command = ["esbuild", script, "--bundle", "--format=cjs", f"--outfile={bundled}"]
    environment = {**os.environ, "NODE_PATH": str(folder)}
    subprocess.run([str(part) for part in command], check=True, env=environment, timeout=60)
    return lambda name, calls: json.loads(node(bundled, name, json.dumps(calls)))


def test_sentences_with_their_numbers_in_german(page_says):
    sentences = {
        "ptu: supply voltage low (11 V)": "Schwenkeinheit: Versorgungsspannung niedrig (11 V)",
        "gnss: 12.3 m from the survey: set up the station again": (
            "GNSS: 12.3 m neben der Vermessung: Station neu aufstellen"
        ),
        "ptu: halted, no reply": "Schwenkeinheit: angehalten, keine Antwort",
        "refused: operator 2 has control for 41 s more; take over first": (
            "abgelehnt: Bediener 2 steuert noch 41 s; zuerst übernehmen"
        ),
        "designate refused: that picture is too old; try again on the one of now": (
            "designate abgelehnt: dieses Bild ist zu alt; noch einmal auf dem jetzigen"
        ),
        "station alfa: bearings refused: stamped ahead of the others; check its clock": (
            "Station alfa: Peilungen abgelehnt: den anderen voraus gestempelt; Uhr prüfen"
        ),
        "what nobody knows": "what nobody knows",
    }
    assert page_says("inWords", [[text] for text in sentences]) == list(sentences.values())


def test_an_alarm_says_in_german_how_grave_it_is_and_what_to_do(page_says):
    alarms = [["camera: no frames for 3.0 s"], ["gpio: emergency stop pressed"], ["on fire"]]
    camera, stop, unknown = page_says("conditionOf", alarms)
    assert (camera["severity"], camera["action"][:12]) == ("urgent", "Strom, Kabel")
    assert (stop["meaning"], stop["action"]) == ("", "siehe die Alarme der Station")
    assert unknown == {"severity": "warning", "meaning": "", "action": ""}


# ---- names on the map ----------------------------------------------------------------------------


def test_neighbouring_lines_of_the_grid_have_different_names(page_says):
    steps = (1000, 100, 10, 5, 2, 1)
    calls = [[616_430 + k * step, step] for step in steps for k in (0, 1)]
    names = page_says("gridName", calls)
    assert all(a != b for a, b in zip(names[::2], names[1::2], strict=True)), names
    assert names[:2] + names[-1:] == ["616", "617", "616.431"]
    assert page_says("inMetres", [["1000 mm"], ["500 mm"]]) == ["1 m", "0.5 m"]


def test_names_near_one_another_do_not_cover_each_other(page_says):
    def name(which, x, y):
        return {"id": which, "at": [x, y], "width": 60}

    far = [name("a", 0, 0), name("b", 500, 0)]
    near = [name("a", 0, 0), name("b", 30, 0)]
    crowd = [name(str(k), 0, 0) for k in range(5)]
    found = page_says("sides", [[far, []], [near, []], [crowd, []], [far, [["a", "left"]]]])
    assert found[0] == [["a", "right"], ["b", "right"]]
    assert dict(found[1]) == {"a": "left", "b": "right"}, "each away from the other's point"
    assert [side for _, side in found[2]][-1] is None, "no room: rather none than one on another"
    assert dict(found[3])["a"] == "left", "it does not change sides without need"
