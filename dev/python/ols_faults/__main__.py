"""tools/fault-run: applies every fault of the table to a simulated site, and judges."""

import argparse
import os
import signal
import sys
import time
import traceback
from pathlib import Path

from ols_demo.site import Site, SiteError, bring_up_loopback
from ols_demo.wiring import Wiring, add_site_options

# Importing a module of cases registers them, in the order of the run.
from ols_faults import (  # noqa: F401
    cases_baseline,
    cases_bus,
    cases_camera,
    cases_clock,
    cases_commands,
    cases_disk,
    cases_network,
    cases_processes,
    cases_ptu,
    cases_sensors,
    cases_stop,
    cases_stop_attacked,
    configuration,
    report,
)
from ols_faults import mutate as mutation_trials
from ols_faults.case import CASES, Outcome, judged
from ols_faults.evidence import Evidence
from ols_faults.mutate import try_all
from ols_faults.session import Session


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="tools/fault-run", description=__doc__)
    parser.add_argument(
        "--only", action="append", default=[], metavar="NAME", help="this case; may be repeated"
    )
    parser.add_argument("--list", action="store_true", help="print the cases, and end")
    parser.add_argument(
        "--mutate",
        action="store_true",
        help="then alter what was heard, for each check in turn, as a broken product would have: "
        "every check must fail",
    )
    add_site_options(parser, "faults", "faults")
    options = parser.parse_args()
    unknown = set(options.only) - CASES.keys()
    if unknown:
        parser.error(f"no such case: {', '.join(sorted(unknown))}; --list names them")
    return options


def run_case(session: Session, name: str) -> tuple[Outcome, Evidence | None]:
    """The outcome, and the evidence of a completed case."""
    case = CASES[name]
    outcome, evidence = Outcome(), Evidence(session.heard, session.stations)
    start, done = time.monotonic(), None
    try:
        session.restore()
        begun_us = session.now_us()
        case.do(session, evidence)
        evidence["ended"] = session.bury()
        evidence.close(begun_us, session.now_us())
        outcome = judged(case, evidence)
        done = evidence
    except SiteError as error:
        outcome.error = str(error)
    except Exception as error:  # a case that fails in a new way must not end the run
        traceback.print_exc()
        outcome.error = f"{type(error).__name__}: {error}"
    outcome.seconds = time.monotonic() - start
    return outcome, done


def tell(outcome: Outcome) -> None:
    for check in outcome.checks:
        mark = "  " if check.passed else "! "
        print(f"  {mark}{check.what}: {check.measured} ({check.limit})", flush=True)
    seconds = f"{outcome.seconds:.0f} s"
    print(f"  {report.verdict(outcome)}, {seconds} {outcome.error}", flush=True)


def run_cases(
    options: argparse.Namespace, names: list[str]
) -> tuple[dict[str, Outcome], dict[str, Evidence]]:
    # The cases attack what stands behind the signatures: what a member of the site could do.
    os.environ["OLS_TRUST"] = "off"
    wiring = Wiring(options.bin, options.scenario, options.seed, options.output)
    bring_up_loopback(wiring.prepare())
    disk = (options.output / "disk").resolve()
    if any(name.startswith("disk-") for name in names):
        cases_disk.mount(disk)
    configuration.alter(wiring, disk)
    outcomes: dict[str, Outcome] = {}
    evidences: dict[str, Evidence] = {}
    remaining = list(names)
    # A permanently broken site fails its case; the other cases get a new one.
    while remaining:
        if wiring.log.exists():
            wiring.log.rename(wiring.log.with_stem(f"run-{len(outcomes)}"))
        with Site(options.output / "logs") as site:
            wiring.start(site)
            session = Session(wiring, site, options.seed, disk)
            while remaining:
                name = remaining.pop(0)
                print(f"{name}: {CASES[name].fault}", flush=True)
                outcomes[name], evidence = run_case(session, name)
                tell(outcomes[name])
                if evidence is not None:
                    evidences[name] = evidence
                if outcomes[name].error or not session.can_go_on():
                    break
            session.close()
    return outcomes, evidences


def mutate(folder: Path, names: list[str], evidences: dict[str, Evidence]) -> bool:
    """Whether every check of these cases failed under its mutation."""
    trials = try_all(names, evidences)
    path = mutation_trials.write(folder, trials)
    bad = [trial for trial in trials if not trial.failed_as_it_must]
    print(f"\n{mutation_trials.table(trials)}\n\ntable {path}")
    print(f"{len(trials) - len(bad)} of {len(trials)} checks failed as they must")
    return bool(trials) and not bad


def main() -> int:
    options = arguments()
    if options.list:
        for name, case in CASES.items():
            print(f"{name:22s} {case.fault}")
        return 0
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    names = [name for name in CASES if not options.only or name in options.only]
    start = time.monotonic()
    try:
        outcomes, evidences = run_cases(options, names)
    except SiteError as error:
        print(f"tools/fault-run: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130
    about = {
        "scenario": options.scenario.stem,
        "seed": options.seed,
        "seconds": round(time.monotonic() - start),
    }
    path = report.write(options.output, about, outcomes)
    print(f"\n{report.table(outcomes)}\n\ntable {path}")
    good = all(outcome.passed for outcome in outcomes.values())
    if options.mutate:
        good = mutate(options.output, names, evidences) and good
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
