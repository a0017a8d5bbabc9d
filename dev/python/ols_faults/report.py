"""The table of a fault run: Markdown to read, JSON to compare."""

import json
from pathlib import Path

from ols_bench import markdown

from ols_faults.case import CASES, Outcome


def seconds(value: float | None) -> str:
    return "-" if value is None else f"{value:.1f} s"


def verdict(outcome: Outcome) -> str:
    return "pass" if outcome.passed else "FAIL"


def details(outcome: Outcome) -> str:
    texts = [
        f"{check.what}: {check.measured}" + ("" if check.passed else f" **not {check.limit}**")
        for check in outcome.checks
    ]
    return "; ".join(texts + ([f"**{outcome.error}**"] if outcome.error else []))


def table(outcomes: dict[str, Outcome]) -> str:
    rows = []
    for name, outcome in outcomes.items():
        case = CASES[name]
        facts = [case.fault, case.criterion, details(outcome), seconds(outcome.recovery_s)]
        rows.append([name, *facts, verdict(outcome)])
    return markdown.table(["case", "fault", "must happen", "measured", "recovery", ""], rows)


def as_json(outcome: Outcome) -> dict[str, object]:
    checks = [
        {name: getattr(check, name) for name in ("what", "measured", "limit", "passed")}
        for check in outcome.checks
    ]
    rest = {name: getattr(outcome, name) for name in ("recovery_s", "seconds", "error")}
    return {"passed": outcome.passed, "checks": checks, **rest}


def write(folder: Path, about: dict[str, object], outcomes: dict[str, Outcome]) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    passed = sum(outcome.passed for outcome in outcomes.values())
    facts = ", ".join(f"{name} {value}" for name, value in about.items())
    text = f"# Fault run\n\n{facts}; {passed} of {len(outcomes)} pass\n\n{table(outcomes)}\n"
    (folder / "faults.md").write_text(text)
    result = {
        **about,
        "passed": passed,
        "cases": {
            name: {
                "fault": CASES[name].fault,
                "criterion": CASES[name].criterion,
                **as_json(outcome),
            }
            for name, outcome in outcomes.items()
        },
    }
    (folder / "faults.json").write_text(json.dumps(result, indent=1) + "\n")
    return folder / "faults.md"
