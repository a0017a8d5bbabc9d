"""The fault run's own checks: that a check which cannot fail is found, and that what is done to
the evidence is what a broken product would have done. No site runs here."""

import struct
from types import SimpleNamespace

import numpy as np
import ols
import ols_msg
import pytest
from ols_demo.places import geodetic
from ols_demo.recording import Recording
from ols_faults import __main__ as fault_run
from ols_faults import fragments, mutate, mutations, pursuit, wire
from ols_faults.case import CASES, Case, judged
from ols_faults.evidence import Evidence, heard, part

STATION = "alfa"
STATUS = f"OLS_STATUS_{STATION}"


def evidence_with(**facts):
    return Evidence(Recording(), [STATION], {"ended": [], **facts})


def trials_of(judge, evidence=None):
    case = Case("made-up", "nothing", "everything", lambda *_: None, judge)
    found = list(mutate.try_case(case, evidence or evidence_with(seconds=1.0)))
    return {trial.check: trial for trial in found}


def slower(seconds):
    return mutations.fact(f"it takes {seconds:g} s", "seconds", seconds)


def test_a_check_that_fails_under_its_mutation_is_well():
    def judge(evidence, outcome):
        outcome.at_most("in time", evidence["seconds"], 2.0, "s", broken_by=slower(3.0))

    trial = trials_of(judge)["in time"]
    assert trial.failed_as_it_must
    assert trial.measured == "3 s"


def in_time(outcome, seconds, limit, broken_by):
    outcome.at_most("in time", seconds, limit, "s", broken_by=broken_by)


@pytest.mark.parametrize(
    ("judge", "verdict"),
    [
        (lambda e, o: o.holds("in time", True), "no mutation is named"),
        # A limit that follows what it limits.
        (lambda e, o: in_time(o, e["seconds"], 2 * e["seconds"], slower(100.0)), "still passes"),
        (lambda e, o: in_time(o, e["seconds"], 0.5, slower(3.0)), "fails without it"),
        (lambda e, o: in_time(o, 1.0 / e["seconds"], 2.0, slower(0.0)), "ZeroDivisionError"),
        (
            lambda e, o: e["seconds"] < 2.0 and in_time(o, e["seconds"], 2.0, slower(3.0)),
            "the check is gone",
        ),
    ],
)
def test_a_check_that_cannot_fail_or_fails_otherwise_is_reported(judge, verdict):
    trial = trials_of(judge)["in time"]
    assert not trial.failed_as_it_must
    assert verdict in trial.verdict


def test_two_checks_of_one_name_are_reported():
    def judge(evidence, outcome):
        for _ in range(2):
            outcome.at_most("in time", evidence["seconds"], 2.0, broken_by=slower(3.0))

    case = Case("made-up", "", "", lambda *_: None, judge)
    found = list(mutate.try_case(case, evidence_with(seconds=1.0)))
    assert "several checks have this name" in [trial.verdict for trial in found]


def test_the_command_fails_for_one_check_and_for_a_case_that_was_not_done(tmp_path, monkeypatch):
    def good(evidence, outcome):
        outcome.at_most("in time", evidence["seconds"], 2.0, broken_by=slower(3.0))

    def useless(evidence, outcome):
        outcome.holds("it works", True)

    for name, judge in (("good", good), ("useless", useless)):
        monkeypatch.setitem(CASES, name, Case(name, "", "", lambda *_: None, judge))
    evidence = evidence_with(seconds=1.0)
    assert fault_run.mutate(tmp_path, ["good"], {"good": evidence})
    assert not fault_run.mutate(tmp_path, ["useless"], {"useless": evidence})
    assert "no mutation is named" in (tmp_path / "mutations.md").read_text()
    assert not fault_run.mutate(tmp_path, ["good"], {})
    assert not fault_run.mutate(tmp_path, [], {})


def test_every_case_fails_when_a_process_ends_by_itself():
    case = Case("made-up", "", "", lambda *_: None, lambda evidence, outcome: None)
    assert judged(case, evidence_with()).passed
    assert not judged(case, evidence_with(ended=["ols-fusion"])).passed


# What is done to the evidence.


def hear(recording, channel, message, at_us):
    recording.receive(channel, message, at_us)


def statuses(count):
    recording = Recording()
    for i in range(count):
        status = ols_msg.station_status_t()
        status.station, status.state = STATION, ols_msg.station_status_t.STATE_TRACKING
        status.devices, status.device_name, status.device_state = 1, ["ptu"], [3]
        status.device_text = ["no reply"]
        status.alarms, status.alarm = 1, ["ptu: halted, no reply"]
        status.counters, status.counter_name, status.counter_value = 1, ["ptu_timeouts"], [i]
        hear(recording, STATUS, status, i * 500_000)
    return recording


def test_altered_evidence_leaves_the_first_one_alone():
    evidence = Evidence(statuses(10), [STATION], {"ended": []})
    copy = evidence.copy()
    mutations.says_nothing(STATION, (0, 2_000_000)).alter(copy)
    mutations.without_counter(STATUS, "ptu_timeouts").alter(copy)
    said = [bool(status.alarm) for status, _ in heard(copy.heard, STATUS)]
    assert said == [False] * 5 + [True] * 5
    assert all(status.counter_value == [0.0] for status in copy.heard.statuses[STATION])
    assert all(status.alarm for status in evidence.heard.statuses[STATION])
    assert [s.counter_value[0] for s in evidence.heard.statuses[STATION]] == list(range(10))


def test_a_share_is_lost_evenly_and_arrivals_go_along():
    evidence = Evidence(statuses(100), [STATION], {"ended": []})
    mutations.lost("", STATUS, share=0.78).alter(evidence)
    kept = list(heard(evidence.heard, STATUS))
    assert len(kept) == 22
    assert all(status.counter_value[0] * 500_000 == at for status, at in kept)


def test_a_part_is_what_arrived_in_between():
    piece = part(statuses(10), 1_000_000, 2_500_000)
    assert [at for _, at in heard(piece, STATUS)] == [1_000_000, 1_500_000, 2_000_000, 2_500_000]


# Motion, judged by the true target.


HOME = geodetic(49.2266, 16.5969, 310.0)
STEP_S = 0.0025
SECONDS = 6.0


def flight(pan_deg):
    """A target that crosses in front of a station which looks north, and a PTU whose pan is
    pan_deg(times, needed); (recording, window)."""
    frame = ols.LocalFrame(HOME)
    recording = Recording()
    times = np.arange(0.0, SECONDS, STEP_S)
    velocity = np.array([15.0, 0.0, 0.0])

    def place(t):
        return np.array([-45.0, 250.0, 60.0]) + velocity * t

    for i in range(round(SECONDS * 25) + 1):
        truth = SimpleNamespace(
            target_id=0,
            utime=i * 40_000,
            position_ecef_m=frame.to_ecef(place(i * 0.04)),
            velocity_ecef_m_s=(frame.to_ecef(place(1.0)) - frame.to_ecef(place(0.0))),
        )
        hear(recording, "OLS_SIM_TRUTH", truth, truth.utime)
    camera = frame.to_ecef(np.zeros(3))
    status = SimpleNamespace(station=STATION, camera_ecef_m=camera, heading_rad=0.0)
    hear(recording, STATUS, status, 0)
    enu = np.array([place(t) for t in times])
    needed = -np.degrees(np.arctan2(enu[:, 0], enu[:, 1]))
    tilt = np.degrees(np.arctan2(enu[:, 2], np.hypot(enu[:, 0], enu[:, 1])))
    pan = pan_deg(times, needed)
    for first in range(0, len(times), 12):
        span = slice(first, first + 12)
        message = SimpleNamespace(
            utime=round(times[first] * 1e6),
            station=STATION,
            interval_s=STEP_S,
            samples=len(times[span]),
            pan_rad=np.radians(pan[span]),
            tilt_rad=np.radians(tilt[span]),
        )
        hear(recording, f"OLS_SIM_PTU_{STATION}", message, message.utime)
    return recording, (200_000, round(SECONDS * 1e6) - 200_000)


def follows(times, needed):
    return needed


def closes_in(times, needed):
    return needed + 20.0 * np.exp(-3.0 * times)


def stands(times, needed):
    return np.full_like(times, needed[0])


def lags_and_leaps(times, needed):
    return np.where(times < 3.0, needed - 0.2, needed + np.clip(40.0 * (times - 3.0), 0.0, 6.0))


def wrong_way(times, needed):
    return needed - 10.0 * times


@pytest.mark.parametrize("motion", [follows, closes_in, stands])
def test_following_standing_and_closing_in_are_no_excess(motion):
    recording, window = flight(motion)
    assert pursuit.excess_deg_s(recording, STATION, *window) < 0.5


@pytest.mark.parametrize(("motion", "least"), [(lags_and_leaps, 25.0), (wrong_way, 5.0)])
def test_motion_that_nobody_asked_for_is_excess(motion, least):
    recording, window = flight(motion)
    assert pursuit.excess_deg_s(recording, STATION, *window) > least


def test_swings_that_are_put_in_are_seen():
    recording, window = flight(follows)
    evidence = Evidence(recording, [STATION], {"ended": []})
    swinging, pushed = evidence.copy(), evidence.copy()
    mutations.swings(STATION, window, 46.0).alter(swinging)
    assert pursuit.excess_deg_s(swinging.heard, STATION, *window) > 10.0
    assert pursuit.acceleration_deg_s2(recording, STATION, *window) < 5.0
    mutations.jerks(STATION, window, 170.0).alter(pushed)
    assert pursuit.acceleration_deg_s2(pushed.heard, STATION, *window) > 100.0


# The bus as bare datagrams.


@pytest.mark.parametrize("station", ["alfa", "a-much-longer-name"])
def test_a_stop_is_told_from_other_commands_by_its_bytes(station):
    message = ols_msg.ptu_command_t()
    message.station, channel = station, f"OLS_PTU_{station}".encode()
    message.command = ols_msg.ptu_command_t.COMMAND_STOP
    assert wire.is_stop(channel, message.encode())
    assert not wire.is_stop(channel, message.encode()[:-1])
    message.command = ols_msg.ptu_command_t.COMMAND_POINT
    assert not wire.is_stop(channel, message.encode())


def test_the_two_datagrams_are_those_that_ended_a_site():
    first, second = fragments.pair("OLS_STATUS_x", 7)
    header = struct.Struct(">IIIIHH")
    assert header.unpack(first[:20]) == (0x4C433033, 7, 100, 0, 0, 3)
    assert first[20:] == b"OLS_STATUS_x\0AAAA"
    assert header.unpack(second[:20]) == (0x4C433033, 7, 100, 0xFFFFFF00, 1, 3)
    assert len(second) == 20 + 272


def test_near_relatives_have_other_sequences_and_fit_a_datagram():
    groups = list(fragments.relatives("OLS_STATUS_x", 100))
    sequences = [struct.unpack(">I", group[0][4:8])[0] for group in groups]
    assert len(set(sequences)) == len(sequences) > 50
    loose = list(fragments.malformed("OLS_STATUS_x", 1))
    assert set(range(8)) <= {len(datagram) for datagram in loose}
    assert max(len(d) for group in [*groups, loose] for d in group) < 65507
