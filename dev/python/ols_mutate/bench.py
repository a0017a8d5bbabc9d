"""The build that mutants are tested in (preset mutants). Its libraries are shared: a changed source
that is loaded before them replaces the functions of the original one. Nothing is linked again, and
no file of the tree or of the build is changed."""

import contextlib
import json
import math
import os
import re
import shlex
import signal
import subprocess
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from .covering import Model, Program, mirror, model_of, suites
from .sites import Site

ROOT = Path(__file__).resolve().parents[3]
BUILD = ROOT / "build/mutants"
QUERY = BUILD / ".cmake/api/v1/query/client-ols-mutate/codemodel-v2"
PYTHON = ROOT / "build/venv/bin/python"
# A mutant may ask for any amount of memory, or write for ever.
LIMITS = ("prlimit", "--as=8000000000", "--fsize=1000000000", "--core=0")
# A program's limit is of processor time, which other load does not use up. One that waits for ever
# uses none: it has this many times as long by the clock.
CLOCK_OF_PROCESSOR = 10.0
COMPILE_LIMIT_S = 600.0
FAILED = re.compile(r"^\[  FAILED  \] ([\w/]+\.[\w/]+)", re.MULTILINE)
BEGUN = re.compile(r"^\[ RUN      \] ([\w/.]+)", re.MULTILINE)


class CannotWork(Exception):
    """Why there is nothing to judge mutants with."""


@dataclass(frozen=True)
class Ended:
    """How a program ended: its exit code, or None when its time was over."""

    code: int | None
    output: str


class Processes:
    """Runs one after the other, or side by side from several threads; ends what still runs."""

    def __init__(self) -> None:
        self.running: set[subprocess.Popen] = set()
        self.over = False

    def run(self, command: list[str], limit_s: float, **environment: str) -> Ended:
        whole_s = math.ceil(limit_s)
        command = [*LIMITS, f"--cpu={whole_s}:{whole_s + 1}", *command]
        with tempfile.TemporaryDirectory(prefix="ols-mutate-") as folder:
            path = Path(folder) / "output"
            with path.open("wb") as output:
                clock_s = CLOCK_OF_PROCESSOR * limit_s
                code = self._wait(command, clock_s, output, environment | {"TMPDIR": folder})
            return Ended(code, path.read_text(errors="replace"))

    def show(self, command: list[str]) -> int | None:
        """Its exit code; its output is ours."""
        return self._wait(command, None, None, {})

    def _wait(
        self,
        command: list[str],
        limit_s: float | None,
        output: IO[bytes] | None,
        environment: dict[str, str],
    ) -> int | None:
        process = subprocess.Popen(
            command,
            cwd=ROOT,
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
            env=os.environ | environment,
            start_new_session=True,
        )
        self.running.add(process)
        try:
            if self.over:
                raise KeyboardInterrupt
            code = process.wait(limit_s)
            return None if code == -signal.SIGXCPU else code
        except subprocess.TimeoutExpired:
            return None
        finally:
            end(process)
            self.running.discard(process)

    def end_all(self) -> None:
        self.over = True
        for process in list(self.running):
            end(process)


def end(process: subprocess.Popen) -> None:
    """And those that it started."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


def configured() -> Model:
    QUERY.parent.mkdir(parents=True, exist_ok=True)
    QUERY.touch()
    done = subprocess.run(
        ["cmake", "--preset", "mutants"], cwd=ROOT, capture_output=True, text=True, check=False
    )
    if done.returncode != 0:
        raise CannotWork(f"cmake --preset mutants: {done.stderr.strip()}")
    reply = BUILD / ".cmake/api/v1/reply"
    codemodel = json.loads(max(reply.glob("codemodel-v2-*.json")).read_text())
    targets = codemodel["configurations"][0]["targets"]
    return model_of([json.loads((reply / one["jsonFile"]).read_text()) for one in targets])


def build(programs: list[Program], processes: Processes, jobs: int) -> None:
    targets = sorted({program.path for program in programs})
    command = ["cmake", "--build", str(BUILD), "-j", str(jobs), "--target", *targets]
    if processes.show(command) != 0:
        raise CannotWork("the unchanged code does not build")


class Bench:
    """Compiles mutants and runs test programs on them."""

    def __init__(self, model: Model, processes: Processes) -> None:
        self.model = model
        self.processes = processes
        self.compilers = compile_commands()

    def compiled(self, site: Site, folder: Path) -> Path | None:
        """The mutant as something to load; None if it does not compile."""
        source = folder / Path(site.file).name
        source.write_text(site.changed((ROOT / site.file).read_text()))
        loaded = folder / "mutant.so"
        name = self.model.library_of[site.file]
        library = BUILD / self.model.paths[name]
        command = [
            *self.compilers[name],
            *("-w", "-shared", "-iquote", str((ROOT / site.file).parent)),
            *(str(source), "-o", str(loaded)),
            # So that it can be loaded into a program that does not have the library, too: one that
            # starts the program under test.
            *("-Wl,--no-as-needed", str(library), f"-Wl,-rpath,{library.parent}"),
        ]
        done = self.processes.run(command, COMPILE_LIMIT_S)
        return loaded if done.code == 0 else None

    def test(
        self, program: Program, limit_s: float, loaded: Path | None, only: str = ""
    ) -> str | None:
        """What fails; None when all is well."""
        environment = {"LD_PRELOAD": str(loaded)} if loaded else {}
        if program.golden:
            command = [str(PYTHON), "tests/golden", program.golden]
            return self._golden(command, limit_s, environment)
        command = [str(BUILD / program.path), "--gtest_fail_fast", "--gtest_color=no"]
        command += [f"--gtest_filter={only}"] if only else []
        done = self.processes.run(command, limit_s, **environment)
        if done.code == 0:
            return None
        failed, begun = FAILED.findall(done.output), BEGUN.findall(done.output)
        what = failed[0] if failed else begun[-1] if begun else "its start"
        why = " (time-out)" if done.code is None else "" if failed else " (crash)"
        return f"{program.name} {what}{why}"

    def _golden(self, command: list[str], limit_s: float, environment: dict) -> str | None:
        done = self.processes.run(command, limit_s, OLS_BUILD=str(BUILD), **environment)
        if done.code == 0:
            return None
        return f"{' '.join(command[1:])}{' (time-out)' if done.code is None else ''}"

    def seconds(self, program: Program) -> float:
        """Of the unchanged code, which must pass."""
        before = time.monotonic()
        failure = self.test(program, 600.0, None)
        if failure:
            raise CannotWork(f"unchanged code fails: {failure}")
        return time.monotonic() - before


def compile_commands() -> dict[str, list[str]]:
    """How to compile a source of each library."""
    found: dict[str, list[str]] = {}
    for entry in json.loads((BUILD / "compile_commands.json").read_text()):
        words = shlex.split(entry["command"])
        output = words.index("-o")
        match = re.search(r"CMakeFiles/(\w+)\.dir/", words[output + 1])
        if match:
            source = words.index("-c")
            found[match[1]] = words[:output] + words[output + 2 : source]
    return found


def mirrored_suites(source: str) -> str:
    path = ROOT / mirror(source)
    return suites(path.read_text()) if path.is_file() else ""
