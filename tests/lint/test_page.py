"""The console's page in the eyes of the TypeScript compiler; the bundler only strips the types."""

import json
import os
import re
import subprocess
from pathlib import Path

import pytest
from conftest import finished
from test_docs import listed, table

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


@pytest.fixture(name="conditions", scope="module")
def fixture_conditions() -> dict:
    return table.of_the_page()


def test_every_sentence_of_the_table_is_said_by_a_program(conditions):
    sources = [path.read_text() for f in ("console", "wire") for path in (ROOT / f).rglob("*.cpp")]
    for kind in table.SAID:
        call = re.compile(rf"\b{kind[:-1]}::(\w+)\(")
        assert {name for s in sources for name in call.findall(s)} == set(conditions[kind])
    assert not [source for source in sources if '"refused: ' in source]


def test_every_reason_is_a_sentence_in_two_languages(conditions):
    known = conditions["reasons"]
    assert set(reasons()) <= set(known)
    for file, of in {
        "bridge/passage": "bridge_",
        "cue/reading": "cue_",
        "base/trust/verifier": "distrusted_",
    }.items():
        source = (ROOT / f"{file}.cpp").read_text()
        body = re.search(r"to_string\(\w+ \w+\) \{(.*?)^\}", source, flags=re.M | re.S)[1]
        found = set(re.findall(r'return "(\w+)";', body)) - {"unknown"}
        assert {of + reason for reason in found} - set(known) == set(), file
    for one in [*known.values(), *conditions["outcomes"].values(), *conditions["notes"].values()]:
        assert all(one) and one[0] != one[1], one
        assert re.findall(r"\{\w+\}", one[0]) == re.findall(r"\{\w+\}", one[1]), one


@pytest.fixture(name="page_says", scope="module")
def fixture_page_says(conditions, tmp_path_factory):
    """Calls the page's own pure functions, in German: page_says("inWords", [[arguments], ...])."""
    folder = tmp_path_factory.mktemp("page")
    (folder / "conditions.json").write_text(json.dumps(conditions))
    script, source = folder / "said.ts", ROOT / "console/page/src"
    script.write_text(
        "globalThis.document = { documentElement: {} };\n"
        "globalThis.localStorage = { getItem: () => null, setItem: () => {} };\n"
        f"import {{ conditionInWords, conditionOf, inWords, nameInWords }}"
        f' from "{source}/conditions";\n'
        f'import {{ gridName, inMetres }} from "{source}/format";\n'
        f'import {{ sidesOf }} from "{source}/labels";\n'
        f'import {{ runsOf }} from "{source}/heights";\n'
        f'import {{ measures, ringName, roundStep }} from "{source}/measures";\n'
        f'import {{ setLanguage }} from "{source}/words";\n'
        'setLanguage("de");\n'
        "const sides = (names, before, over) => [...sidesOf(names, new Map(before), over)];\n"
        "const rings = (units, least_m) => {\n"
        "  measures.units = units;\n"
        "  const step_m = roundStep(least_m);\n"
        "  return [step_m >= least_m - 1e-6, ringName(step_m, 1), ringName(step_m, 3)];\n"
        "};\n"
        "const known = { conditionInWords, conditionOf, inWords, nameInWords, gridName, inMetres,\n"
        "  sides, rings, runsOf };\n"
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
        "gnss: 12.3 m from the survey for 6 min: set up the station again": (
            "GNSS: 12.3 m neben der Vermessung, seit 6 min: Station neu aufstellen"
        ),
        "designate refused: that picture is too old; try again on the current one": (
            "designate abgelehnt: dieses Bild ist zu alt; noch einmal auf dem jetzigen"
        ),
        "station alfa: bearings refused: stamped ahead of the others; check its clock": (
            "Station alfa: Peilungen abgelehnt: den anderen voraus gestempelt; Uhr prüfen"
        ),
        "what nobody knows": "what nobody knows",
    }
    assert page_says("inWords", [[text] for text in sentences]) == list(sentences.values())


# Whose texts the page shows, as far as a person on it would read them.
SPOKEN = (
    *("calibration/procedure/*.cpp", "tools/calibrate/awaited_picture.cpp"),
    *("tools/calibrate/view_stage.cpp", "calibration/acceptance.cpp", "calibration/calibrate.cpp"),
    *("tools/calibrate/adjust_command.cpp", "calibration/contradiction_cause.cpp"),
    *(f"calibration/pictures/{one}.cpp" for one in ("cross_finding", "landmark_snap")),
    *(f"calibration/pictures/{one}.cpp" for one in ("level_lines", "ruler_reading", "sun_disc")),
    *(
        "edge/camera/camera_*.cpp",
        "edge/camera/picture.cpp",
        "edge/camera/*/*.cpp",
        "edge/mount/**/*.cpp",
        "edge/clock/clock_watch.cpp",
        "edge/calibration/ca*_watch.cpp",
        "edge/calibration/check_record.cpp",
        "edge/calibration/[dv]*.cpp",
        "edge/calibration/reference_views.cpp",
        "edge/gpio/*.cpp",
    ),
    *("edge/lens/*.cpp", "edge/ptu/*.cpp", "edge/recorder/*.cpp", "edge/sensors/**/*.cpp"),
    *(
        "edge/serial/*.cpp",
        "edge/device/*.cpp",
        "edge/messages/messages_bus.cpp",
        "edge/frames/frame_service.cpp",
    ),
    *(
        "edge/station/persisted_station_state.cpp",
        "edge/process/host_monitor.cpp",
        "edge/process/kept_pose.cpp",
    ),
)
UNSPOKEN_FILES = (
    "config|settings|_file|store|preconditions|codec|_kind|discovery|service_address|soap_request"
)
# Written to files, to the journal or to the terminal, or thrown where no page is.
UNSPOKEN = re.compile(
    r"remark\(.*?\);|invalid_argument\(\s*\"--.*?\);|config::|_section\(|write_to_journal\(.*?\);"
    r"|R\"\(.*?\)\"|#include.*|//.*|static_assert.*",
    flags=re.S,
)

# The same, in the midst of what is spoken.
TOLD_ELSEWHERE = {
    *("a procedure without stages", "it stands", "degrees high", "not a span of time"),
    *("below 10 the refraction is not known well enough", "the unit cannot look there"),
    *("the unit cannot look there, or not beside it", "the picture beside it is missing"),
    "must be sha256// and the 44 characters of the key's hash",
    *("up (1-sigma", "deg: the stored view is not recognised"),
}


def spoken_words() -> dict[str, str]:
    """Every piece of a sentence in these sources -> its file; numbers and names stand outside."""
    found = {}
    for path in (path for pattern in SPOKEN for path in ROOT.glob(pattern)):
        if re.search(UNSPOKEN_FILES, path.name):
            continue
        source = re.sub(r"#include.*|//.*", "", path.read_text())
        source = re.sub(r'"\s*\n\s*"', "", re.sub(UNSPOKEN, "", source))
        for literal in re.findall(r'"((?:[^"\\\n]|\\.)*)"', source):
            if " ! " in literal:  # a pipeline of GStreamer
                continue
            for piece in re.split(r"%[-+ 0-9.]*[lz]?[a-z]|%%|\\.", literal):
                piece = piece.strip(" .,;:()'\"?!`")
                if re.search(r"[a-z]{2,} [a-z(]+", piece) and piece not in TOLD_ELSEWHERE:
                    found[piece] = path.name
    return found


def test_everything_that_is_said_on_the_page_has_german_words(conditions):
    english = "\n".join([text for row in conditions["alarms"] for text, _ in row["says"].values()])
    english += "\n" + "\n".join(conditions["phrases"])
    missing = {words: name for words, name in spoken_words().items() if words not in english}
    assert missing == {}


def english_in(german: list[str], conditions: dict) -> set[str]:
    """Words of these texts that are English and not German, as far as the page's own texts tell."""
    says = [pair for row in conditions["alarms"] for pair in row["says"].values()]
    pairs = [[re.sub(r"\{\w+\}", "…", text) for text in pair] for pair in says]
    for part in ("phrases", "words", "names"):
        pairs += conditions[part].items()
    words = re.compile(r"[A-Za-zÄÖÜäöüß]{3,}")
    known = {word for _, text in pairs for word in words.findall(text)}
    foreign = {word for text, _ in pairs for word in words.findall(text.replace("_", " "))} - known
    return {word for text in german for word in words.findall(text.replace("_", " "))} & foreign


def test_every_counter_and_reading_has_a_german_name(conditions, page_says):
    names = set(listed("Counters")) - {"seconds_STATE", "entered_STATE"}
    names -= {"COMMAND_accepted", "COMMAND_refused", "protobuf_warnings"}
    names -= set(re.findall("`([^`]+)`", fusion_counters()))  # they are not on the page
    names |= {f"{what}_{one}" for what in ("refused", "messages_refused") for one in reasons()}
    names |= {f"frames_refused_{one}" for one in listed("Refusals of images")}
    names |= {f"bus_distrusted_{one}" for one in listed("Refusals of messages without")}
    for path in (ROOT / "edge").rglob("*.cpp"):
        names |= set(re.findall(r'readings\["(\w+)"\]', path.read_text()))
        for block in re.findall(r"readings = \{(.*?)\};", path.read_text(), flags=re.S):
            names |= set(re.findall(r'\{"(\w+)"', block))
    assert len(names) > 150
    german = dict(zip(names, page_says("nameInWords", [[one] for one in names]), strict=True))
    assert {one for one, said in german.items() if "_" in said or said == one} == set()
    assert english_in(list(german.values()), conditions) == set()


def fusion_counters() -> str:
    return (ROOT / "docs/troubleshooting.md").read_text().split("\nOf the fusion:\n")[-1]


def reasons() -> list[str]:
    return listed("Refusals of commands")


def test_a_guided_calibration_speaks_german(conditions, page_says):
    sentences = {
        "tower: back to the first, to close the round; spire would leave 3.0″ (tower 4.0″)": (
            "tower: zurück zur ersten, um die Runde zu schließen; spire ließe 3.0″ (tower 4.0″)"
        ),
        "Not measured: the nearer ruler: no ruler is there": (
            "Nicht gemessen: der nähere Maßstab: dort ist kein Maßstab"
        ),
        "  BAD  landmark 'spire', first and last sighting: 59.00″, at most 12.00″": (
            "  SCHLECHT  Landmarke 'spire', erste und letzte Anvisierung: 59.00″, höchstens 12.00″"
        ),
        "the observations contradict each other: at least as many of them disagree as agree: "
        "landmark 'a', landmark 'b'; against landmark 'c'; all agree if landmarks 'a' and 'c' were "
        "exchanged": (
            "die Beobachtungen widersprechen sich: mindestens so viele stimmen nicht überein wie "
            "übereinstimmen: Landmarke 'a', Landmarke 'b'; gegen Landmarke 'c'; alle stimmen "
            "überein, wenn die Landmarken 'a' und 'c' vertauscht sind"
        ),
        "the observations contradict each other: landmark 'a', landmark 'b' disagree with the "
        "others; all agree if station 'alfa' stood 0.40 m to the east, 0.60 m to the south and "
        "0.01 m lower: is its position surveyed right?": (
            "die Beobachtungen widersprechen sich: Landmarke 'a', Landmarke 'b' stimmen nicht mit "
            "den anderen überein; alle stimmen überein, wenn Station 'alfa' woanders steht: 0.40 m "
            "nach Osten, 0.60 m nach Süden und 0.01 m tiefer: ist ihre Position richtig vermessen?"
        ),
        "the observations contradict each other: all others agree without star 'a', or without "
        "star 'b'; all agree if the tripod of station 'alfa' was turned, or the unit lost its "
        "counts, by +0.050 deg of pan before the sighting of 'spire' in line 12": (
            "die Beobachtungen widersprechen sich: alle anderen stimmen überein ohne Stern 'a', "
            "oder ohne Stern 'b'; alle stimmen überein, wenn das Stativ der Station 'alfa' "
            "gedreht wurde oder die Einheit sich verzählt hat, um +0.050 ° in Schwenk, bevor "
            "'spire' in Zeile 12 anvisiert wurde"
        ),
        "the clock: a mistake that would be found: 260.00″, at most 30.00″: unchecked": (
            "die Uhr: ein Irrtum, der gefunden würde: 260.00″, höchstens 30.00″: nicht geprüft"
        ),
        "  BAD  the clock: 2.05 s fast against everything else, 4.20 sigma": (
            "  SCHLECHT  die Uhr: geht gegen alles andere um 2.05 s vor, 4.20 Sigma"
        ),
        "RED: calibration: pan is 3 motor steps off its counts: home the unit": (
            "ROT: Kalibrierung: Schwenk ist 3 Motorschritte neben ihrer Zählung: Referenzfahrt"
        ),
    }
    german = page_says("inWords", [[text] for text in sentences])
    assert german == list(sentences.values())
    assert english_in(german, conditions) == set()


def test_what_stands_in_alarms_and_errors_is_german_too(conditions, page_says):
    texts = [
        "stop: state before the restart is unknown (/var/lib/ols/alfa.persisted: is damaged: wrong "
        "checksum): check it, then ols-ctl alfa release",
        "ptu: no serial port: /dev/ttyUSB0 cannot be opened",
        "ptu: halted, no plausible position: positions that contradict each other",
        "inclinometer: /dev/ttyUSB1 has vanished, tilt kept",
        "gnss: no gpsd at localhost:2947: Connection refused",
        "calibration: not checked for 26.0 h: the unit does not come to its reference views",
        "recorder: RECORD refused: the event lies in the future",
        "gpio: stop unreadable, taken as pressed: cannot be read",
        "camera: frame refused: wrong size",
        "video: cannot listen on 127.0.0.1:7790: Address already in use",
        "cue tak.a: too far from every station",
        "OLS_BEARING_a: the message is damaged, or of another version",
    ]
    german = page_says("inWords", [[text] for text in texts])
    assert english_in(german, conditions) == set()
    assert all(said != text for said, text in zip(german, texts, strict=True))


def test_a_condition_is_german_by_its_id_whatever_its_sentence(page_says):
    def alarm(identifier: str, **parameters: str) -> list[dict]:
        return [{"id": identifier, "text": "in other words", "parameters": parameters}]

    alarms = {
        "Schwenkeinheit: angehalten, keine Antwort": alarm("ptu_halted", why="no reply"),
        "Kalibrierung: Schwenk ist 3 Motorschritte neben ihrer Zählung: Referenzfahrt": alarm(
            "steps_lost", axis="pan", steps="3"
        ),
        "Kamera: lehnt ab: Gain: keine Berechtigung": alarm(
            "camera_refuses", feature="Gain", detail="Permission denied"
        ),
        "Befehle: 3 slews abgelehnt in 10 s: er kam zu spät; Uhren vergleichen": alarm(
            "commands_refused", count="3", what="slews", seconds="10", reason="stale"
        ),
        "Vertrauen: Nachrichten nicht geglaubt: 3 ohne Unterschrift, 1 über der erlaubten Rate; "
        "die letzte: A": alarm("messages_not_believed", reasons="3 unsigned, 1 rate", last="A"),
        "abgelehnt: der Umriss schneidet sich": alarm(
            "area_is_wrong", why="polygon crosses itself"
        ),
        "abgelehnt: Bediener 2 steuert noch 41 s; zuerst übernehmen": alarm(
            "others_control", who="operator 2", seconds="41"
        ),
        "abgelehnt: es wird nicht aufgezeichnet: das Ereignis liegt in der Zukunft": alarm(
            "order_refused", reason="recorder", detail="the event lies in the future"
        ),
        "nennt Ziel 7 grau": alarm("calls_target", target="7", label="grau"),
        "abgelehnt: of_a_later_version": alarm("order_refused", reason="of_a_later_version"),
        "in other words": alarm("of_a_later_version"),
    }
    assert page_says("conditionInWords", list(alarms.values())) == list(alarms)


def test_an_alarm_says_in_german_how_grave_it_is_and_what_to_do(page_says):
    alarms = [["camera_no_frames"], ["gpio_stop_pressed"], ["on fire"]]
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


def test_a_name_is_not_written_below_what_covers_the_map(page_says):
    name, panel = {"id": "a", "at": [0, 0], "width": 60}, [10, -50, 300, 100]
    (found,) = page_says("sides", [[[name], [], [panel]]])
    assert found == [["a", "left"]]


def test_rings_are_round_in_the_chosen_units(page_says):
    calls = {
        ("m_s", 130): ("200 m", "600 m"),
        ("km_h", 900): ("1 km", "3 km"),
        ("nautical", 100): ("500 ft", "1500 ft"),
        ("nautical", 1524): ("5000 ft", "15000 ft"),
        ("nautical", 1600): ("1 NM", "3 NM"),
        ("nautical", 9000): ("5 NM", "15 NM"),
    }
    found = page_says("rings", [list(call) for call in calls])
    assert found == [[True, first, third] for first, third in calls.values()]


def test_a_trail_is_cut_where_its_colour_changes_and_nowhere_else(page_says):
    trail = [[0.0, 0.0, height] for height in (0, 4, 8, 40, 44, 8)]
    (runs,) = page_says("runsOf", [[trail, [0, 60], 6]])
    assert [run["step"] for run in runs] == [0, 2, 4, 2]
    assert [len(run["places"]) for run in runs] == [3, 2, 2, 2]
    for before, after in zip(runs, runs[1:], strict=False):
        assert before["places"][-1] == after["places"][0]
