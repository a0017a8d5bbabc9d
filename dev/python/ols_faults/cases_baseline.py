"""The site without any fault, as reference."""

from ols_faults import measure, mutations
from ols_faults.case import Outcome, case
from ols_faults.evidence import Evidence
from ols_faults.judges import judge_angles, judge_goes_on, judge_motion, judge_target
from ols_faults.session import Session

JUDGED_S = 10.0


def judge(evidence: Evidence, outcome: Outcome) -> None:
    window = evidence["window"]
    judge_target(evidence, outcome, window, 10.0)
    arrivals = measure.target_arrivals_us(evidence.heard, *window)
    middle_us = sum(window) // 2
    measured = measure.longest_gap_s(arrivals, *window)
    broken_by = mutations.targets_lost((middle_us, middle_us + 700_000))
    outcome.at_most("longest time without a target", measured, 0.5, "s", broken_by=broken_by)
    for station in evidence.stations:
        judge_goes_on(evidence, outcome, station, window, 10.0)
        judge_motion(evidence, outcome, station, window)
        judge_angles(evidence, outcome, station, window, JUDGED_S)


@case("no-fault", "none", "everything works; published sigmas are consistent", judge)
def no_fault(session: Session, evidence: Evidence) -> None:
    evidence["window"] = session.run(JUDGED_S)
