"""See tools/mutate."""

import argparse
import json
import signal
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path, PurePath

from . import bench
from .bench import ROOT, Bench, CannotWork, Processes, mirrored_suites
from .covering import Model, Program, covering, distance
from .report import KILLED, NOT_VIABLE, SURVIVED, Judged, survivors_percent, table
from .sites import Site, chosen_order, sites

FOLDERS = (
    *("geometry", "central", "edge/tracker", "edge/ptu", "base", "base/trust", "calibration"),
    "wire",
)
LEAST_LIMIT_S = 10.0
LIMIT_OF_USUAL = 5.0


class Judge:
    """Runs the covering tests on mutants, the nearest test first."""

    def __init__(self, model: Model, work: Bench, options: argparse.Namespace) -> None:
        self.model = model
        self.bench = work
        self.folders = options.folders
        self.near = options.near
        self.usual_s: dict[str, float] = {}

    def covering(self, source: str) -> list[Program]:
        found = covering(self.model, source, self.folders, self.usual_s)
        return [one for one in found if not self.near or distance(source, one) < 2]

    def measure(self, files: list[str]) -> None:
        """How long each test program takes with the unchanged code."""
        programs = {program.name: program for file in files for program in self.covering(file)}
        for name, program in sorted(programs.items()):
            self.usual_s[name] = self.bench.seconds(program)
            say(f"unchanged  {name} passes")

    def judge(self, site: Site) -> Judged:
        after = site.changed_line((ROOT / site.file).read_text())
        with tempfile.TemporaryDirectory(prefix="ols-mutant-") as folder:
            loaded = self.bench.compiled(site, Path(folder))
            if loaded is None:
                return Judged(site, NOT_VIABLE, line_after=after)
            for failure in self._failures(site.file, loaded):
                return Judged(site, KILLED, failure, after)
        return Judged(site, SURVIVED, line_after=after)

    def _failures(self, source: str, loaded: Path) -> Iterator[str]:
        for program in self.covering(source):
            limit_s = max(LEAST_LIMIT_S, LIMIT_OF_USUAL * self.usual_s[program.name])
            only = mirrored_suites(source) if distance(source, program) == 0 else ""
            if only and (failure := self.bench.test(program, limit_s, loaded, only)):
                yield failure
            if failure := self.bench.test(program, limit_s, loaded):
                yield failure


def say(line: str) -> None:
    print(line, flush=True)


def sources(folders: list[str], model: Model | None) -> list[str]:
    """Those of libraries: what a program's main wires is tested end to end."""
    command = ["git", "ls-files", "--", *(f"{folder}/*.cpp" for folder in folders)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True)
    files = sorted(set(done.stdout.split()))
    return [one for one in files if model is None or one in model.library_of]


def all_sites(files: list[str]) -> list[Site]:
    return [site for file in files for site in sites(file, (ROOT / file).read_text())]


def judged_mutants(
    candidates: list[Site], wanted: int, judge: Judge, jobs: int
) -> Iterator[Judged]:
    """In the order of the candidates, until as many as wanted compile."""
    pool = ThreadPoolExecutor(jobs)
    try:
        while wanted > 0 and candidates:
            batch, candidates = candidates[:wanted], candidates[wanted:]
            for judged in pool.map(judge.judge, batch):
                wanted -= judged.outcome != NOT_VIABLE
                yield judged
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def survivors_of(path: Path) -> set[str]:
    rows = json.loads(path.read_text())["mutants"]
    return {row["mutant"] for row in rows if row["outcome"] == SURVIVED}


def options() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="tools/mutate", description="See tools/mutate --help.")
    parser.add_argument("wanted", type=int, metavar="N", help="mutants")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--in", dest="folders", nargs="+", default=list(FOLDERS))
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--near", action="store_true")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--most", type=float, default=100.0, metavar="PERCENT")
    parser.add_argument("--report", type=Path, metavar="FILE.json")
    parser.add_argument("--again", type=Path, metavar="FILE.json")
    chosen = parser.parse_args()
    chosen.folders = [str(PurePath(folder)) for folder in chosen.folders]
    return chosen


def show(candidates: list[Site]) -> None:
    for site in candidates:
        after = site.changed_line((ROOT / site.file).read_text())
        say(f"{site.file}:{site.line} ({site.kind})\n    - {site.text}\n    + {after}")


def chosen_sites(chosen: argparse.Namespace, model: Model) -> list[Site]:
    candidates = chosen_order(all_sites(sources(chosen.folders, model)), chosen.seed)
    if chosen.again:
        again = survivors_of(chosen.again)
        candidates = [site for site in candidates if site.name() in again]
    return candidates


def run(chosen: argparse.Namespace, processes: Processes) -> int:
    model = bench.configured()
    candidates = chosen_sites(chosen, model)
    if chosen.list:
        show(candidates[: chosen.wanted])
        return 0
    files = sorted({site.file for site in candidates})
    if not files:
        raise CannotWork(f"nothing to change in {' '.join(chosen.folders)}")
    judge = Judge(model, Bench(model, processes), chosen)
    programs = [one for file in files for one in judge.covering(file)]
    bench.build(programs, processes, chosen.jobs)
    judge.measure(files)
    judged = []
    for one in judged_mutants(candidates, chosen.wanted, judge, chosen.jobs):
        say(one.line())
        judged.append(one)
        if chosen.report:
            write_report(chosen, judged)
    print("\n" + table(judged, chosen.folders))
    return 1 if survivors_percent(judged) > chosen.most else 0


def write_report(chosen: argparse.Namespace, judged: list[Judged]) -> None:
    rows = [one.as_json() for one in judged]
    content = {"seed": chosen.seed, "folders": chosen.folders, "mutants": rows}
    chosen.report.write_text(json.dumps(content, indent=1) + "\n")


def main() -> int:
    processes = Processes()
    # SIGINT too: what a script starts with & ignores it, and then so would the test programs.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.default_int_handler)
    try:
        return run(options(), processes)
    except CannotWork as failure:
        print(f"tools/mutate: {failure}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    finally:
        processes.end_all()


if __name__ == "__main__":
    sys.exit(main())
