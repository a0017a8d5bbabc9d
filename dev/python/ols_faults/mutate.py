"""tools/fault-run --mutate: shows that every check can fail.

Each case is done once. Then its evidence is altered, once for each of its checks, in the way in
which a broken product (or a fault that was not done) would have altered it, and judged again: that
check must fail. A check that names no such mutation, or that still passes, fails the command.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path

from ols_bench import markdown

from ols_faults.case import CASES, Case, Check, judged
from ols_faults.evidence import Evidence


@dataclass(frozen=True)
class Trial:
    """The outcome of one mutation of one check."""

    case: str
    check: str
    mutation: str
    verdict: str  # empty: it failed, as it must
    measured: str = ""  # under the mutation

    @property
    def failed_as_it_must(self) -> bool:
        return not self.verdict


def try_check(case: Case, evidence: Evidence, check: Check) -> Trial:
    if check.broken_by is None:
        return Trial(case.name, check.what, "-", "no mutation is named")
    what = check.broken_by.what
    if not check.passed:
        return Trial(case.name, check.what, what, "fails without it", check.measured)
    altered = evidence.copy()
    try:
        check.broken_by.alter(altered)
        again = judged(case, altered)
    except Exception as error:  # a judge that stumbles has not judged
        return Trial(case.name, check.what, what, f"{type(error).__name__}: {error}")
    found = [c for c in again.checks if c.what == check.what]
    if len(found) != 1:
        return Trial(case.name, check.what, what, "the check is gone")
    verdict = "still passes" if found[0].passed else ""
    return Trial(case.name, check.what, what, verdict, found[0].measured)


def try_case(case: Case, evidence: Evidence) -> Iterator[Trial]:
    checks = judged(case, evidence).checks
    for what, times in Counter(check.what for check in checks).items():
        if times > 1:
            yield Trial(case.name, what, "-", "several checks have this name")
    for check in checks:
        yield try_check(case, evidence, check)


def try_all(names: list[str], evidences: dict[str, Evidence]) -> list[Trial]:
    """The results of the named cases; a case without evidence, because unfinished, fails."""
    trials = []
    for name in names:
        if name in evidences:
            trials += try_case(CASES[name], evidences[name])
        else:
            trials.append(Trial(name, "(all)", "-", "the case was not done to its end"))
    return trials


def table(trials: list[Trial]) -> str:
    columns = ["case", "check", "mutation", "measured with it", "failed as it must"]
    said = ["yes" if t.failed_as_it_must else f"**NO**: {t.verdict}" for t in trials]
    rows = [
        (t.case, t.check, t.mutation, t.measured, how) for t, how in zip(trials, said, strict=True)
    ]
    return markdown.table(columns, rows)


def write(folder: Path, trials: list[Trial]) -> Path:
    good = sum(trial.failed_as_it_must for trial in trials)
    text = f"# Mutations\n\n{good} of {len(trials)} checks failed as they must\n\n{table(trials)}\n"
    (folder / "mutations.md").write_text(text)
    result = [asdict(trial) for trial in trials]
    (folder / "mutations.json").write_text(json.dumps(result, indent=1) + "\n")
    return folder / "mutations.md"
