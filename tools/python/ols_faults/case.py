"""What a case of the fault run is, and what came of it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ols_faults.session import Session


@dataclass
class Check:
    """One thing that was measured, and the limit that it is held against."""

    what: str
    measured: str
    limit: str
    passed: bool


@dataclass
class Outcome:
    """Everything measured in one case."""

    checks: list[Check] = field(default_factory=list)
    recovery_s: float | None = None  # from the fault's end (or the restart) to normal work
    seconds: float = 0.0  # the case took
    error: str = ""  # the case itself could not go on

    @property
    def passed(self) -> bool:
        return not self.error and bool(self.checks) and all(check.passed for check in self.checks)

    def at_most(self, what: str, value: float | None, limit: float, unit: str = "") -> None:
        passed = value is not None and bool(math.isfinite(value) and value <= limit)
        self.checks.append(Check(what, figure(value, unit), f"<= {limit:g} {unit}".strip(), passed))

    def at_least(self, what: str, value: float | None, limit: float, unit: str = "") -> None:
        passed = value is not None and bool(math.isfinite(value) and value >= limit)
        self.checks.append(Check(what, figure(value, unit), f">= {limit:g} {unit}".strip(), passed))

    def holds(self, what: str, passed: bool, measured: str = "") -> None:
        self.checks.append(
            Check(what, measured or ("yes" if passed else "no"), "yes", bool(passed))
        )

    def recovered(self, what: str, seconds: float | None, limit_s: float) -> None:
        """The recovery time of the table, and a check that it came at all and in time."""
        self.recovery_s = seconds
        self.at_most(what, seconds, limit_s, "s")


def figure(value: float | None, unit: str) -> str:
    if value is None or not math.isfinite(value):
        return "never" if unit == "s" else "none"
    return f"{value:.3g} {unit}".strip()


@dataclass(frozen=True)
class Case:
    name: str
    fault: str  # what is done
    criterion: str  # what must happen
    run: Callable[[Session, Outcome], None]


CASES: dict[str, Case] = {}


def case(name: str, fault: str, criterion: str) -> Any:
    """Registers the function as a case; cases run in the order in which they are registered."""

    def register(run: Callable[[Session, Outcome], None]) -> Callable[[Session, Outcome], None]:
        CASES[name] = Case(name, fault, criterion, run)
        return run

    return register
