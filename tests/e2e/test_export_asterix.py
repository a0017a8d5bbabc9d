"""ASTERIX as an independent decoder reads it, field by field within the format's resolution."""

import math
import re
import subprocess

import asterix
import ols_msg
import pytest
from conftest import finished
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

pytestmark = pytest.mark.usefixtures("network")
HEAD = '[asterix]\nsac = 25\nsic = 10\nstations = ["alfa"]\n'
FOOT_M = 0.3048


def value(item, name):
    return item[name]["val"]


def bearing():
    message = ols_msg.bearing_t()
    message.utime = target().utime
    message.schema_version = ols_msg.bearing_t.SCHEMA_VERSION
    message.station, message.belief, message.track_id = "alfa", 0.9, 3
    message.camera_ecef_m = [4200000.0, 980000.0, 4680000.0]
    message.azimuth_rad, message.elevation_rad = 2.0, 0.25
    message.covariance_white_rad2 = [1e-8, 0.0, 4e-8]
    return message


@pytest.fixture(scope="module", name="records")
def fixture_records(network, tmp_path_factory):
    """One decoded record of each category."""
    receiver, port = udp_receiver()
    publisher, found = Publisher(), {}
    folder = tmp_path_factory.mktemp("asterix")
    to = output("display", "asterix", f"udp://127.0.0.1:{port}", lines=True)
    with Exporter(folder, to + HEAD):

        def heard():
            publisher.send("OLS_BEARING_alfa", bearing())
            publisher.publish(target(object_class=ols_msg.target_t.CLASS_DRONE))
            for data in received(receiver):
                for record in asterix.parse(data):
                    if record["category"] != 62 or "I380" in record:
                        found.setdefault(record["category"], (record, data))
            return set(found) == {15, 62, 63, 65}

        # Not until(): it also publishes this target without a class, and on a busy machine the
        # output's limited rate lets only that one through.
        wait(heard, "each category")
    return found


def test_the_decoder_reads_every_octet(records):
    for record, data in records.values():
        assert record["len"] == len(data) - 3  # without category and length


def test_a_system_track(records):
    record, _ = records[62]
    assert (value(record["I010"], "SAC"), value(record["I010"], "SIC")) == (25, 10)
    assert value(record["I105"], "Lat") == pytest.approx(LATITUDE_DEG, abs=2.7e-6)
    assert value(record["I105"], "Lon") == pytest.approx(LONGITUDE_DEG, abs=2.7e-6)
    assert value(record["I130"], "Alt") * FOOT_M == pytest.approx(HEIGHT_M, abs=0.96)
    assert value(record["I040"], "TrkN") == 7
    assert (value(record["I080"], "MRH"), value(record["I080"], "SRC")) == (1, 3)
    assert value(record["I380"]["EMC"], "ECAT") == 13  # unmanned
    assert (value(record["I080"], "CNF"), value(record["I080"], "MON")) == (0, 0)

    accuracies = record["I500"]
    assert (value(accuracies["APC"], "APC_X"), value(accuracies["APC"], "APC_Y")) == (2.0, 3.0)
    assert value(accuracies["COV"], "COV_XY") == 1.0
    assert value(accuracies["AGA"], "AGA_Acc") * FOOT_M == pytest.approx(5.0, abs=0.96)


def test_a_line(records):
    record, _ = records[15]
    assert value(record["I010"], "SIC") == 11 and value(record["I161"], "TrkN") == 3
    assert value(record["I627"]["Az"], "Az") == pytest.approx(math.degrees(2.0), abs=0.0028)
    assert value(record["I628"]["El"], "El") == pytest.approx(math.degrees(0.25), abs=0.0014)
    sd_deg = math.degrees(1e-4) / math.cos(0.25)
    assert value(record["I627"]["SD_Az"], "SD_Az") == pytest.approx(sd_deg, abs=0.0004)
    assert value(record["I628"]["SD_El"], "SD_El") == pytest.approx(math.degrees(2e-4), abs=4e-4)


def test_a_sensor_and_the_service(records):
    sensor, service = records[63][0], records[65][0]
    assert (value(sensor["I050"], "SAC"), value(sensor["I050"], "SIC")) == (25, 11)
    assert value(sensor["I060"], "CON") == 0
    assert value(service["I000"], "Typ") == 1 and value(service["I040"], "NOGO") == 0


# As tshark names them: (value, half of the format's resolution).
SHOWN = {
    62: {
        "LAT, Latitude": (LATITUDE_DEG, 2.7e-6),
        "LON, Longitude": (LONGITUDE_DEG, 2.7e-6),
        "Calculated Track Geometric Altitude": (HEIGHT_M / FOOT_M, 3.2),
        "X, APC (X-Component)": (2.0, 0.0),
        "Y, APC (Y-Component)": (3.0, 0.0),
        "XY Covariance Component": (1.0, 0.0),
        "Estimated Accuracy Of Calculated Track Geometric Altitude": (5.0 / FOOT_M, 3.2),
        "VX, Velocity (X-component)": (0.0, 0.0),
        "VY, Velocity (Y-component)": (0.0, 0.0),
        "X, ATV (X-Component)": (0.0, 0.0),
        "Y, ATV (Y-Component)": (0.0, 0.0),
        "Calculated Rate of Climb/Descent": (0.0, 0.0),
    },
    15: {
        "Azimuth": (math.degrees(2.0), 0.0028),
        "Elevation": (math.degrees(0.25), 0.0014),
        "Standard Deviation of Azimuth": (math.degrees(1e-4) / math.cos(0.25), 4e-4),
        "Standard Deviation of Elevation": (math.degrees(2e-4), 4e-4),
    },
}
WORDS = {
    62: (
        "(10)",
        "Track Number: 0x0007 (7)",
        "Geometric altitude more reliable",
        "Triangulation (3)",
    ),
    15: ("(11)", "Measurement Track (2)", "Track/Plot Number: 3", "Confirmed Track (0)"),
    63: ("(11)", "CON: Operational (0)"),
    65: ("SDPS Status (1)", "NOGO: Operational (0)"),
}


def test_tshark_agrees_field_by_field(records, tmp_path):
    """The same datagrams, by a second decoder; it complains about nothing."""
    dump = tmp_path / "dump.txt"
    lines = []
    for _, data in records.values():
        lines.append("000000 " + data.hex(" ") + "\n")
    dump.write_text("\n".join(lines))
    capture = tmp_path / "capture.pcap"
    ports = ["-u", "40000,8600", "-4", "10.0.0.1,10.0.0.2"]
    subprocess.run(["text2pcap", "-q", *ports, dump, capture], check=True, capture_output=True)
    done = finished("tshark", "-r", capture, "-d", "udp.port==8600,asterix", "-V", check=True)
    for complaint in ("Malformed", "Expert Info", "Unknown"):
        assert complaint not in done.stdout.replace("Scanning Direction: Unknown", "")
    packets = re.split(r"^ASTERIX packet, Category (\d+)", done.stdout, flags=re.M)[1:]
    packets = {int(c): text for c, text in zip(packets[::2], packets[1::2], strict=True)}
    assert set(packets) == {15, 62, 63, 65}
    for category, text in packets.items():
        for words in ("0x19 (25)", *WORDS[category]):
            assert words in text, category
        numbers = dict(re.findall(r"^ +([^\[\n]+), \[[^\]]+\]: (\S+)$", text, flags=re.M))
        for name, (truth, resolution) in SHOWN.get(category, {}).items():
            assert float(numbers.pop(name)) == pytest.approx(truth, abs=resolution, rel=1e-9), name
        (time_s,) = numbers.values()
        of_day = next(
            records[category][0][i] for i in ("I070", "I145", "I030") if i in records[category][0]
        )
        assert float(time_s) == next(iter(of_day.values()))["val"], "the time of both decoders"


def test_the_last_message_of_a_track_says_so(tmp_path):
    receiver, port = udp_receiver()
    publisher = Publisher()
    to = output("display", "asterix", f"udp://127.0.0.1:{port}", stations=False)
    with Exporter(tmp_path, to):
        tracks = []

        def heard(state):
            for data in received(receiver):
                tracks.extend(r for r in asterix.parse(data) if r["category"] == 62)
            return any(state(track) for track in tracks)

        publisher.until(lambda: heard(lambda _: True), "a track")
        end = target(track_state=ols_msg.target_t.TRACK_DROPPED)
        publisher.send("OLS_TARGET", end)
        wait(lambda: heard(lambda t: "TSE" in t["I080"] and value(t["I080"], "TSE")), "its end")
