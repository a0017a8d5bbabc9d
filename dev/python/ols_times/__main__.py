"""tools/test --times: builds the preset `times` from nothing, runs the tests and prints where the
time goes. The arguments are the command of pytest. All rows are in build/times/times.json."""

import argparse
import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from itertools import chain
from pathlib import Path

from ols_times import sums
from ols_times.measure import measured
from ols_times.sums import Row

ROOT = Path(__file__).resolve().parents[3]
BUILD = ROOT / "build/times"
NOTES = """
processor_s: with the processes that a command waited for. wall_s: commands overlap.
Headers and templates: clang's wall time, and the share of it in which clang had a processor.
What took less than half a millisecond counts for what is around it. with_nested_s: processor time
with the headers or instances within.
Tests: with their fixtures. A process counts for the test that waits for its end.
"""


class Runner:
    def __init__(self) -> None:
        self.failed: list[str] = []

    def run(self, name: str, command: list, **options) -> Row:
        print(f"== {name}", flush=True)
        status, spent = measured([str(word) for word in command], **{"cwd": ROOT, **options})
        if status != 0:
            self.failed.append(name)
        return {"name": name, **spent}


def records(log: Path) -> list[Row]:
    return [json.loads(line) for line in log.read_text().splitlines()] if log.exists() else []


def traces(commands: list[Row]) -> Iterator[tuple[dict, float]]:
    """Of each compilation, with its processor time by wall time."""
    for command in commands:
        trace = (BUILD / command["name"]).with_suffix(".json")
        if trace.exists():
            yield json.loads(trace.read_bytes()), command["processor_s"] / command["wall_s"]


def build(runner: Runner, only: list[str]) -> dict[str, list[Row]]:
    shutil.rmtree(BUILD, ignore_errors=True)
    targets = ["--target", *only] if only else []
    steps = [
        runner.run("configure", ["cmake", "--preset", "times"]),
        runner.run("build", ["cmake", "--build", BUILD, *targets]),
    ]
    if runner.failed:
        sys.exit(1)
    commands = records(BUILD / "commands.jsonl")
    links = sums.link_targets((BUILD / "build.ninja").read_text())
    headers = (sums.headers(trace, str(ROOT), share) for trace, share in traces(commands))
    templates = (sums.templates(trace, share) for trace, share in traces(commands))
    return {
        "steps": steps,
        "targets": sums.targets(commands, links, steps[-1]),
        "headers": sums.by_name(chain.from_iterable(headers)),
        "templates": sums.by_name(chain.from_iterable(templates)),
    }


def unit_tests(runner: Runner) -> tuple[list[Row], list[Row]]:
    """The programs of ctest, one by one, and the tests within."""
    listed = subprocess.run(
        ["ctest", "--test-dir", BUILD, "--show-only=json-v1"], stdout=subprocess.PIPE, check=True
    )
    programs, tests = [], []
    for name, command, folder in sums.ctest_programs(json.loads(listed.stdout)):
        if shutil.which(command[0]):
            report = BUILD / "reports" / f"{name}.json"
            env = {**os.environ, "GTEST_OUTPUT": f"json:{report}"}
            programs.append(runner.run(name, command, cwd=folder, env=env))
            if report.exists():
                tests += sums.googletests(name, json.loads(report.read_text()))
    return programs, tests


def pytest(runner: Runner, command: list[str]) -> tuple[Row, list[Row]]:
    """The whole, and its tests."""
    log = BUILD / "tests.jsonl"
    env = {
        **os.environ,
        "PYTHONPATH": f"{BUILD / 'python'}:{ROOT / 'dev/python'}",
        "OLS_BIN": str(BUILD / "bin"),
        "OLS_BUILD": str(BUILD),
        "OLS_TIMES_LOG": str(log),
    }
    whole = runner.run("pytest", [*command, "-p", "ols_times.pytest_plugin"], env=env)
    return whole, records(log)


def main() -> int:
    parser = argparse.ArgumentParser(prog="tools/test --times", description=__doc__)
    parser.add_argument("--target", action="append", default=[], help="build only this")
    parser.add_argument("pytest", nargs=argparse.REMAINDER, help="command")
    options = parser.parse_args()
    runner = Runner()
    tables = build(runner, options.target)
    programs, tests = unit_tests(runner)
    whole, python_tests = pytest(runner, options.pytest)
    tables["steps"] += [sums.total("unit tests", programs), whole]
    tables |= {"unit test programs": programs, "pytest modules": sums.modules(python_tests)}
    tables["tests"] = tests + [one for one in python_tests if "::" in one["name"]]
    tables = {title: sums.ranked(title, rows) for title, rows in tables.items()}
    (BUILD / "times.json").write_text(json.dumps(tables, indent=1))
    print(NOTES, *(sums.table(title, rows) for title, rows in tables.items() if rows), sep="\n")
    if runner.failed:
        print(f"failed: {', '.join(runner.failed)}", file=sys.stderr)
    return 1 if runner.failed else 0


if __name__ == "__main__":
    sys.exit(main())
