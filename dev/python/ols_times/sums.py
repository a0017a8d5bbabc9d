"""Sums of times, by target, header, template, program and test. No clock and no file."""

import os.path
import re
from collections.abc import Iterable, Mapping

from ols_bench import markdown

Row = dict[str, str | float | None]
SUMMED = ("times", "processor_s", "wall_s")
# Else by processor_s.
RANKED_BY = {"headers": "with_nested_s", "templates": "with_nested_s", "tests": "wall_s"}
# An operator's name has brackets that open no template arguments.
BRACKET = re.compile(r"operator(?:<=>|<<=?|>>=?|->\*?|<=?|>=?)|->|<|>")


def by_name(records: Iterable[Mapping]) -> list[Row]:
    """One row for each name."""
    rows: dict[str, Row] = {}
    for record in records:
        row = rows.setdefault(record["name"], {"name": record["name"]})
        for key, value in {"times": 1, **record}.items():
            if key != "name":
                row[key] = row.get(key, 0) + value
    return list(rows.values())


def link_targets(build_ninja: str) -> dict[str, str]:
    """The target of each linked file, from CMake's build.ninja."""
    link = re.compile(
        r"^build (\S+)[^:\n]*: \w+_LINKER__(\S+)_(?:Release|Debug|RelWithDebInfo)?\s", re.M
    )
    return dict(link.findall(build_ninja))


def target_of(output: str, links: Mapping[str, str]) -> str:
    folder = re.search(r"CMakeFiles/([^/]+)\.dir/", output)
    return folder[1] if folder else links.get(output, output)


def targets(commands: Iterable[Row], links: Mapping[str, str], build: Row) -> list[Row]:
    """One row for each target, and one for the rest of the build."""
    rows = by_name({**one, "name": target_of(one["name"], links)} for one in commands)
    measured = sum(row["processor_s"] for row in rows)
    rest = {"name": "(archives, generated files, the measurement itself)"}
    return [*rows, rest | {"processor_s": build["processor_s"] - measured}]


def template_name(instance: str) -> str:
    """Without arguments: `std::vector<int>::push_back` is `std::vector::push_back`."""
    kept, depth, end = [], 0, 0
    for match in BRACKET.finditer(instance):
        if depth == 0:
            kept.append(instance[end : match.start()])
        end = match.end()
        if match[0] == "<":
            depth += 1
        elif match[0] == ">":
            depth = max(depth - 1, 0)
        elif depth == 0:
            kept.append(match[0])
    return "".join(kept) + ("" if depth else instance[end:])


def header_name(path: str, root: str) -> str:
    return os.path.normpath(path).removeprefix(f"{root}/").removeprefix("/usr/include/")


def spans(trace: Mapping, events: set[str]) -> list[tuple[float, float, str]]:
    """Begin [s], duration [s] and detail of the named events of clang's -ftime-trace."""
    return [
        (event["ts"] / 1e6, event["dur"] / 1e6, event["args"]["detail"])
        for event in trace["traceEvents"]
        if event["name"] in events and event["ph"] == "X"
    ]


def nested(spans: Iterable[tuple[float, float, str]], processor_share: float) -> list[Row]:
    """Rows without the times of the spans within; `with_nested_s` (processor) includes them."""
    rows: list[Row] = []
    open_rows: list[tuple[float, Row]] = []
    for begin, duration, name in sorted(spans, key=lambda span: (span[0], -span[1])):
        while open_rows and open_rows[-1][0] <= begin:
            open_rows.pop()
        if open_rows:
            open_rows[-1][1]["wall_s"] -= duration
        outermost = all(row["name"] != name for _, row in open_rows)
        with_nested_s = duration * processor_share if outermost else 0.0
        rows.append({"name": name, "wall_s": duration, "with_nested_s": with_nested_s})
        open_rows.append((begin + duration, rows[-1]))
    return [{**row, "processor_s": row["wall_s"] * processor_share} for row in rows]


def headers(trace: Mapping, root: str, processor_share: float) -> list[Row]:
    named = [(*times, header_name(path, root)) for *times, path in spans(trace, {"Source"})]
    sources = (".cpp", ".cxx", ".cc")
    return nested((one for one in named if not one[2].endswith(sources)), processor_share)


def templates(trace: Mapping, processor_share: float) -> list[Row]:
    kinds = {"InstantiateClass", "InstantiateFunction"}
    named = [(*times, template_name(name)) for *times, name in spans(trace, kinds)]
    return nested(named, processor_share)


def googletests(program: str, report: Mapping) -> list[Row]:
    """The wall time of each test in GoogleTest's JSON; its processor time is unknown."""
    return [
        {"name": f"{program}: {suite['name']}.{test['name']}", "wall_s": float(test["time"][:-1])}
        for suite in report["testsuites"]
        for test in suite["testsuite"]
    ]


def modules(tests: Iterable[Row]) -> list[Row]:
    return by_name({**test, "name": test["name"].partition("::")[0]} for test in tests)


def ctest_programs(listed: Mapping) -> list[tuple[str, list[str], str]]:
    """Name, command and folder of the tests in ctest's JSON; those that others need come first."""
    programs = []
    for test in listed["tests"]:
        properties = {one["name"]: one["value"] for one in test["properties"]}
        if "command" in test:
            program = (test["name"], test["command"], properties["WORKING_DIRECTORY"])
            programs.append(("FIXTURES_SETUP" not in properties, program))
    return [program for _, program in sorted(programs, key=lambda one: one[0])]


def total(name: str, rows: Iterable[Row]) -> Row:
    keys = [key for key in SUMMED if any(key in row for row in rows)]
    return {"name": name, **{key: sum(row.get(key, 0) for row in rows) for key in keys}}


def ranked(title: str, rows: Iterable[Row]) -> list[Row]:
    key = RANKED_BY.get(title, "processor_s")
    return sorted(rows, key=lambda row: row.get(key, 0), reverse=True)


def table(title: str, rows: list[Row], top: int = 30) -> str:
    """Markdown: the first rows, and the total of all."""
    keys = [key for key in (*SUMMED, "with_nested_s") if any(key in row for row in rows)]
    digits = {key: 0 if key == "times" else 2 for key in keys}
    lines = [
        [row["name"], *(f"{row[key]:.{digits[key]}f}" if key in row else "" for key in keys)]
        for row in [*rows[:top], total(f"total of {len(rows)}", rows)]
    ]
    return f"## {title}\n\n{markdown.table(['name', *keys], lines)}\n"
