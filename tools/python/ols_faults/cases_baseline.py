"""The site without any fault: what the others are compared with."""

from ols_faults import measure
from ols_faults.case import Outcome, case
from ols_faults.judges import judge_angles, judge_motion
from ols_faults.session import Session

JUDGED_S = 10.0


@case("no-fault", "none", "everything works; published sigmas are honest")
def no_fault(session: Session, outcome: Outcome) -> None:
    window = session.run(JUDGED_S)
    error = measure.target_error_m(session.heard, *window)
    outcome.at_most("RMS error", error, 2.0, "m")
    arrivals = measure.target_arrivals_us(session.heard, *window)
    gap = measure.longest_gap_s(arrivals, *window)
    outcome.at_most("longest time without a target", gap, 1.0, "s")
    for station in session.stations:
        judge_motion(session, outcome, station, window)
        judge_angles(session, outcome, station, window)
