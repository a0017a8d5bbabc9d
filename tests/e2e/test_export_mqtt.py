"""MQTT with mosquitto: what a broker, a subscriber and Home Assistant's discovery get."""

import json
import subprocess
import threading

import jsonschema
import pytest
from conftest import finished
from export_site import (
    CE_M,
    GEOID_M,
    HEIGHT_M,
    LATITUDE_DEG,
    MQTT_PORT,
    Broker,
    Exporter,
    Publisher,
    output,
    target,
    wait,
)
from helpers import Babbler
from ols_msg import target_t

pytestmark = pytest.mark.usefixtures("network")
TLS_PORT = 18831
NUMBER = {"type": ["number", "null"]}
TEXT = {"type": "string"}
# Flat, and nothing in it that is not here.
TARGET = {
    "type": "object",
    "additionalProperties": False,
    "required": ["id", "number", "time", "state", "latitude", "longitude", "height_ellipsoid_m"],
    "properties": {
        **dict.fromkeys(("id", "time", "class"), TEXT),
        "state": {"enum": ["tentative", "confirmed", "coasted", "ended"]},
        **dict.fromkeys(("number", "stations"), {"type": "integer"}),
        **dict.fromkeys(("latitude", "longitude"), {"type": "number"}),
        **dict.fromkeys(
            (
                *("height_ellipsoid_m", "height_above_sea_m", "gps_accuracy"),
                *("height_above_ground_m", "height_above_ground_sd_m"),
                *("ellipse_semi_major_m", "ellipse_semi_minor_m", "ellipse_azimuth_deg"),
                *("height_sd_m", "speed_m_s", "course_deg", "climb_m_s"),
                *("class_probability", "size_m"),
            ),
            NUMBER,
        ),
    },
}
DISCOVERY = {
    "type": "object",
    "required": [
        *("name", "unique_id", "default_entity_id", "state_topic", "availability_topic", "device")
    ],
    "properties": {"unique_id": {"type": "string", "pattern": "^[a-zA-Z0-9_-]+$"}},
}


class Subscriber:
    """mosquitto_sub: the newest payload of each topic."""

    def __init__(self, *login):
        command = ["mosquitto_sub", "-h", "127.0.0.1", "-p", str(MQTT_PORT), "-t", "#", *login]
        wait(lambda: finished(*command, "-E").returncode == 0, "the broker takes a subscriber")
        self.topics = {}
        self.process = subprocess.Popen(
            [*command, "-v"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
        )
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self):
        for line in self.process.stdout:
            topic, _, payload = line.rstrip("\n").partition(" ")
            self.topics[topic] = payload

    def json(self, topic):
        return json.loads(self.topics.get(topic) or "null")

    def end(self):
        self.process.kill()
        self.process.wait()


@pytest.fixture(name="broker")
def fixture_broker(tmp_path):
    broker = Broker(tmp_path)
    yield broker
    broker.kill()


@pytest.fixture(name="subscriber")
def fixture_subscriber(broker):
    subscriber = Subscriber()
    yield subscriber
    subscriber.end()


def mqtt(**keys):
    return output("home", "mqtt", f"mqtt://127.0.0.1:{MQTT_PORT}", **keys)


def test_a_target_and_its_entities(tmp_path, subscriber):
    publisher = Publisher()
    with Exporter(tmp_path, mqtt()):
        publisher.until(
            lambda: (
                (subscriber.json("ols/brno/target/1") or {}).get("state") == "confirmed"
                and subscriber.json("ols/brno/station/alfa")
                and subscriber.json("ols/brno/targets")
            ),
            "target and station",
        )
        for topic in ("ols/brno/target/1", "ols/brno/targets"):
            found = subscriber.json(topic)
            jsonschema.validate(found, TARGET)
            assert found["latitude"] == LATITUDE_DEG and found["gps_accuracy"] == CE_M
            assert found["height_ellipsoid_m"] == HEIGHT_M
            assert found["height_above_sea_m"] == pytest.approx(HEIGHT_M - GEOID_M, abs=0.02)
        configs = [t for t in subscriber.topics if t.startswith("homeassistant/")]
        assert len(configs) == 8 * 8 + 4
        for topic in configs:
            config = subscriber.json(topic)
            jsonschema.validate(config, DISCOVERY)
            assert config.get("expire_after") == (None if "device_tracker" in topic else 30)
            assert config["state_topic"] in subscriber.topics, "an entity without a state"
        assert subscriber.topics["ols/brno/status"] == "online"
        dropped = target(track_state=target_t.TRACK_DROPPED)
        publisher.send("OLS_TARGET", dropped)
        wait(lambda: subscriber.json("ols/brno/target/1") == {"state": "none"}, "a free slot")
    wait(lambda: subscriber.topics["ols/brno/status"] == "offline", "the last will")


def test_a_broker_that_dies_and_returns_is_told_everything_again(tmp_path, broker, subscriber):
    publisher = Publisher()
    with Exporter(tmp_path, mqtt()) as exporter:
        publisher.until(lambda: "ols/brno/target/1" in subscriber.topics, "a target")
        broker.kill()
        publisher.until(lambda: exporter.output("home").get("trouble"), "the trouble is said")
        broker.start()
        again = Subscriber()
        publisher.until(
            lambda: (
                (again.json("ols/brno/target/1") or {}).get("state") == "confirmed"
                and "homeassistant/sensor/brno_station_alfa_state/config" in again.topics
            ),
            "everything again",
        )
        again.end()


def test_a_wrong_password_is_refused_and_said(tmp_path):
    users, password = tmp_path / "users", tmp_path / "password"
    subprocess.run(["mosquitto_passwd", "-b", "-c", users, "ols", "right"], check=True)
    users.chmod(0o644)
    broker = Broker(tmp_path, f"allow_anonymous false\npassword_file {users}\n")
    password.write_text("wrong\n")
    publisher = Publisher()
    try:
        outputs = mqtt(user="ols", password_file=str(password))
        with Exporter(tmp_path, outputs) as exporter:
            publisher.until(
                lambda: "not authorised" in exporter.output("home").get("trouble", "").lower(),
                "the refusal",
            )
            password.write_text("right\n")
            publisher.until(lambda: exporter.output("home").get("sent"), "a log-in")
    finally:
        broker.kill()


def test_a_wrong_certificate_is_refused_and_said(tmp_path, certificates):
    """The broker has a certificate for localhost of its own authority."""
    folder, foreign = certificates["own"], certificates["foreign"]
    tls = f"listener {TLS_PORT} 0.0.0.0\ncertfile {folder}/console.pem\n"
    broker = Broker(tmp_path, f"allow_anonymous true\n{tls}keyfile {folder}/console.key\n")
    publisher = Publisher()
    outputs = ""
    for name, host, ca in (
        ("right", "localhost", folder),
        ("foreign", "localhost", foreign),
        ("name", "127.0.0.2", folder),
    ):
        to = f"mqtts://{host}:{TLS_PORT}"
        outputs += output(name, "mqtt", to, ca=str(ca / "site-ca.pem"))
    try:
        with Exporter(tmp_path, outputs) as exporter:
            publisher.until(lambda: exporter.output("right").get("sent"), "the target over TLS")
            for name in ("foreign", "name"):
                publisher.until(
                    lambda n=name: "certificate" in exporter.output(n).get("trouble", ""),
                    f"{name}: the wrong certificate is said",
                )
                assert exporter.output(name)["sent"] == 0
            assert exporter.output("right")["trouble"] == ""
    finally:
        broker.kill()


def beside(babblers):
    """Outputs to a good broker and to each of these."""
    return mqtt() + "".join(
        output(name, "mqtt", f"mqtt://127.0.0.1:{one.port}") for name, one in babblers.items()
    )


def others_go_on(publisher, subscriber):
    def time_of_target():  # none while it is over, as on a busy machine
        return (subscriber.json("ols/brno/target/1") or {}).get("time")

    publisher.until(time_of_target, "the target")
    seen = time_of_target()
    publisher.until(lambda: time_of_target() not in (None, seen), "others go on")


def test_a_broker_that_sends_rubbish_is_named_and_stops_nothing(tmp_path, broker, subscriber):
    babblers = {
        "text": Babbler(b"HTTP/1.1 400 Bad Request\r\n\r\n" * 100),
        "bytes": Babbler(bytes(range(256)) * 256),
        "zeroes": Babbler(bytes(1 << 20)),
        # It takes the log-in, and then sends a message whose length has no end.
        "endless": Babbler(b"\x20\x02\x00\x00" + b"\x30\xff\xff\xff\xff\xff" * 1000),
    }
    publisher = Publisher()
    with Exporter(tmp_path, beside(babblers)) as exporter:
        for name in babblers:
            publisher.until(
                lambda n=name: (
                    exporter.output(n).get("failures", 0) > 1 and exporter.output(n)["trouble"]
                ),
                f"{name} is named and tried again",
            )
        others_go_on(publisher, subscriber)
        assert exporter.output("home")["trouble"] == ""


def test_a_broker_that_sends_what_nobody_asked_for_or_nothing_is_left(tmp_path, broker, subscriber):
    """A message as long as MQTT has them: the library would keep all of it in memory. One that does
    not read does not answer pings."""
    longest = b"\x30\xff\xff\xff\x7f\x00\x01a"
    babblers = {
        "after": Babbler(b"\x20\x02\x00\x00" + longest + bytes(1 << 20)),
        "before": Babbler(longest + bytes(1 << 20)),
        "answer": Babbler(b"\x20\xff\xff\xff\x7f" + bytes(1 << 20)),
        "silent": Babbler(b"\x20\x02\x00\x00"),
    }
    publisher = Publisher()
    with Exporter(tmp_path, beside(babblers)) as exporter:
        for name, one in babblers.items():
            # By the log: the trouble of a status is gone with the next try.
            what = "does not answer" if name == "silent" else "sends unasked messages"
            said = f"127.0.0.1:{one.port}: {what}"
            publisher.until(lambda text=said: text in exporter.said(), f"{name} is named", 180.0)
        others_go_on(publisher, subscriber)
        assert exporter.output("home")["trouble"] == ""
