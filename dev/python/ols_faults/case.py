"""A case of the fault run, and its outcome.

A case is two functions: one does something to the site and notes it, the other one judges the
evidence alone. So the same evidence can be judged again after it was altered in the way
in which a broken product would have altered it: see mutate.py.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ols_faults.evidence import Evidence

if TYPE_CHECKING:
    from ols_faults.session import Session


@dataclass(frozen=True)
class Mutation:
    """A way in which the product, or the fault itself, could be broken: what would then have been
    heard and noted instead. `alter` changes a copy of the evidence, never a verdict."""

    what: str
    alter: Callable[[Evidence], None]


@dataclass
class Check:
    """A measure and its limit."""

    what: str  # its name: the same in every run
    measured: str
    limit: str
    passed: bool
    broken_by: Mutation | None = None  # with which it must fail


@dataclass
class Outcome:
    """Everything measured in one case."""

    checks: list[Check] = field(default_factory=list)
    recovery_s: float | None = None  # from the fault's end (or the restart) to normal work
    seconds: float = 0.0  # the case took
    error: str = ""  # the case itself could not continue

    @property
    def passed(self) -> bool:
        return not self.error and bool(self.checks) and all(check.passed for check in self.checks)

    def at_most(self, what: str, value: float | None, limit: float, unit="", **more) -> None:
        passed = value is not None and bool(math.isfinite(value) and value <= limit)
        self._add(what, value, f"<= {limit:.3g}", unit, passed, **more)

    def at_least(self, what: str, value: float | None, limit: float, unit="", **more) -> None:
        passed = value is not None and bool(math.isfinite(value) and value >= limit)
        self._add(what, value, f">= {limit:.3g}", unit, passed, **more)

    def holds(
        self, what: str, passed: bool, measured: str = "", *, broken_by: Mutation | None = None
    ) -> None:
        said = measured or ("yes" if passed else "no")
        self.checks.append(Check(what, said, "yes", bool(passed), broken_by))

    def recovered(self, what: str, seconds: float | None, limit_s: float, **more) -> None:
        """Adds the recovery time to the table, and checks that the recovery came in time."""
        self.recovery_s = seconds
        self.at_most(what, seconds, limit_s, "s", **more)

    def _add(
        self, what, value, limit, unit, passed, broken_by: Mutation | None = None, note: str = ""
    ) -> None:
        measured = figure(value, unit) + (f" ({note})" if note else "")
        self.checks.append(Check(what, measured, f"{limit} {unit}".strip(), passed, broken_by))


def figure(value: float | None, unit: str) -> str:
    if value is None or not math.isfinite(value):
        return "never" if unit == "s" else "none"
    return f"{value:.3g} {unit}".strip()


@dataclass(frozen=True)
class Case:
    name: str
    fault: str  # what is done
    criterion: str  # what must happen
    do: Callable[[Session, Evidence], None]
    judge: Callable[[Evidence, Outcome], None]  # pure


CASES: dict[str, Case] = {}


def case(name: str, fault: str, criterion: str, judge: Callable[[Evidence, Outcome], None]) -> Any:
    """Registers the function as a case; cases run in the order in which they are registered."""

    def register(do: Callable[[Session, Evidence], None]) -> Callable[[Session, Evidence], None]:
        CASES[name] = Case(name, fault, criterion, do, judge)
        return do

    return register


def judged(case: Case, evidence: Evidence) -> Outcome:
    """The case's own checks, and one for every case: none of our processes may end."""
    outcome = Outcome()
    case.judge(evidence, outcome)
    ended = evidence["ended"]

    def end_one(altered: Evidence) -> None:
        altered["ended"] = ["ols-fusion"]

    outcome.holds(
        "no process ended by itself",
        not ended,
        ", ".join(ended) or "yes",
        broken_by=Mutation("the fusion ends", end_one),
    )
    return outcome
