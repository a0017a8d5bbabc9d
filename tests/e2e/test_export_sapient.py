"""SAPIENT as others' bindings read it, checked by others' rules of the standard; receivers that
refuse, give tasks, complain, and die."""

import itertools
import math
import time

import pytest
from export_site import (
    HEIGHT_M,
    LATITUDE_DEG,
    LONGITUDE_DEG,
    Exporter,
    Publisher,
    output,
    received,
    target,
    udp_receiver,
    wait,
)
from sapient_site import OBJECT, Receiver, check, framed

pytestmark = pytest.mark.usefixtures("network")
METRES = math.radians(1.0) * 6.371e6  # a degree of a great circle


def sapient(receiver, **keys):
    return output("hub", "sapient", f"tcp://127.0.0.1:{receiver.port}", **keys)


def test_a_site_is_a_node_that_keeps_to_the_standard(tmp_path):
    receiver, publisher = Receiver(), Publisher()
    with Exporter(tmp_path, sapient(receiver), "[sapient]\nstatus_s = 1.0\n"):
        publisher.until(
            lambda: (
                len(receiver.of("detection_report")) > 2 and len(receiver.of("status_report")) > 2
            ),
            "detections and reports of state",
        )
    for heard in receiver.heard:
        check(heard.message)
    assert [heard.message.WhichOneof("content") for heard in receiver.heard].count(
        "registration"
    ) == 1
    registration = receiver.heard[0].message.registration
    assert registration.icd_version == "BSI Flex 335 v2.0"
    assert registration.status_definition.status_interval.value == 1.0
    state = receiver.reports()[-1].status_report
    place = state.node_location
    assert (place.y, place.x, place.z) == (47.4, 13.2, 600.0)
    assert state.status[0].status_value.startswith("alfa: tracking")


def test_a_target_is_where_it_is(tmp_path):
    receiver, publisher = Receiver(), Publisher()
    with Exporter(tmp_path, sapient(receiver)):
        publisher.until(lambda: receiver.of("detection_report"), "a detection")
    report = receiver.of("detection_report")[0].message.detection_report
    place = report.location
    assert place.y == pytest.approx(LATITUDE_DEG, abs=1e-8)
    assert place.x == pytest.approx(LONGITUDE_DEG, abs=1e-8)
    assert place.z == pytest.approx(HEIGHT_M, abs=0.005)
    assert (place.coordinate_system, place.datum) == (1, 1)  # degrees and metres, the ellipsoid
    assert place.y_error * METRES == pytest.approx(3.0, rel=0.01)
    assert place.x_error * METRES * math.cos(math.radians(LATITUDE_DEG)) == pytest.approx(
        2.0, rel=0.01
    )
    assert place.z_error == 5.0
    told = {one.type: one.value for one in report.track_info}
    covariance = [float(value) for value in told["ols.covariance_enu_m2"].split()]
    assert covariance == [4.0, 1.0, 0.5, 9.0, -0.5, 25.0]
    assert report.id == "OLS 7"


def test_times_are_those_that_receivers_take(tmp_path):
    """As Apex has it: detections of one node are of one instant or 0.08 s apart, and in order."""
    receiver, publisher = Receiver(), Publisher()
    begin_us = now_us = time.time_ns() // 1000
    with Exporter(tmp_path, sapient(receiver, rate_hz=10.0)):
        publisher.until(lambda: receiver.of("status_report"), "a report")

        def many():
            nonlocal now_us
            now_us = time.time_ns() // 1000
            publisher.publish(*(target(i, now_us - 7_000 * (i % 9)) for i in range(1, 21)))
            return len(receiver.of("detection_report")) >= 400

        publisher.until(many, "20 targets, each 20 times")
    detections = receiver.of("detection_report")
    stamps = [heard.stamp_s() for heard in detections]
    gaps = [b - a for a, b in itertools.pairwise(stamps)]
    assert all(gap == 0.0 or gap >= 0.08 for gap in gaps)
    assert all(
        1e-6 * begin_us - 0.1 < heard.stamp_s() < heard.at_s + 0.1 for heard in receiver.heard
    )
    assert len({heard.message.detection_report.object_id for heard in detections}) >= 20
    reports = [heard.message.detection_report.report_id for heard in detections]
    assert len(set(reports)) == len(reports)


def test_a_node_that_goes_says_so_last(tmp_path):
    receiver, publisher = Receiver(), Publisher()
    with Exporter(tmp_path, sapient(receiver)):
        publisher.until(lambda: receiver.of("detection_report"), "a detection")
    wait(lambda: receiver.reports(goodbye=True), "the goodbye")
    last = receiver.heard[-1].message
    assert last == receiver.reports(goodbye=True)[-1]
    check(last)
    assert len(receiver.reports(goodbye=True)) == 1


def test_names_stay_over_a_restart(tmp_path):
    receiver, publisher = Receiver(), Publisher()
    names = set()
    for _ in range(2):
        receiver.heard.clear()
        with Exporter(tmp_path, sapient(receiver)):
            publisher.until(lambda: receiver.of("detection_report"), "a detection")
        message = receiver.of("detection_report")[0].message
        names.add((message.node_id, message.detection_report.object_id))
    assert len(names) == 1


def test_nothing_is_sent_before_the_acknowledgement(tmp_path):
    silent, publisher = Receiver(answer=None), Publisher()
    other, port = udp_receiver()
    outputs = sapient(silent) + output("other", "cot", f"udp://127.0.0.1:{port}")
    with Exporter(tmp_path, outputs) as exporter:
        publisher.until(
            lambda: "does not acknowledge" in exporter.output("hub").get("trouble", ""),
            "the silence is said",
        )
        publisher.until(lambda: received(other), "what the other output sends meanwhile")
    assert {heard.message.WhichOneof("content") for heard in silent.heard} == {"registration"}


def test_a_task_is_refused(tmp_path):
    receiver, publisher = Receiver(), Publisher()
    with Exporter(tmp_path, sapient(receiver)):
        publisher.until(lambda: receiver.of("status_report"), "a report")
        task = receiver.to_node()
        task.task.task_id, task.task.control = OBJECT, 1
        task.task.command.request = "Stop"
        alert = receiver.to_node()
        alert.alert.alert_id = OBJECT
        receiver.say(alert)
        receiver.say(task)
        publisher.until(lambda: receiver.of("task_ack"), "an answer")
    answer = receiver.of("task_ack")[0].message
    check(answer)
    assert answer.destination_id == task.node_id
    assert (answer.task_ack.task_id, answer.task_ack.task_status) == (OBJECT, 2)  # rejected
    assert answer.task_ack.reason


def test_a_receiver_that_dies_is_found_again(tmp_path):
    receiver, publisher = Receiver(), Publisher()
    with Exporter(tmp_path, sapient(receiver)) as exporter:
        publisher.until(lambda: receiver.of("detection_report"), "a detection")
        receiver.end_connections()
        receiver.heard.clear()
        publisher.until(lambda: receiver.of("detection_report"), "detections again")
        publisher.until(lambda: exporter.output("hub")["failures"] == 1, "it is counted")
    kinds = [heard.message.WhichOneof("content") for heard in receiver.heard]
    assert kinds[0] == "registration" and kinds.count("registration") == 1


def test_a_flood_of_tasks_ends_the_connection_for_a_moment(tmp_path):
    """Each answer waits for a receiver that reads slowly: more than a few at once are not owed."""
    receiver, publisher = Receiver(), Publisher()
    with Exporter(tmp_path, sapient(receiver)) as exporter:
        publisher.until(lambda: receiver.of("detection_report"), "a detection")
        task = receiver.to_node()
        task.task.task_id, task.task.control = OBJECT, 1
        task.task.command.request = "Stop"
        receiver.connections[-1].sendall(framed(task) * 20)
        publisher.until(lambda: exporter.output("hub").get("failures") == 1, "it is counted")
        receiver.heard.clear()
        publisher.until(lambda: receiver.of("detection_report"), "detections again")
