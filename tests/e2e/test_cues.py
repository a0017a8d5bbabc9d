"""Cues from outside, by every way and format, to slews of the fusion on a signed bus: allowed by an
operator, refused by name when they are bad, and no harm to anything when their source is."""

import http.server
import itertools
import json
import math
import socket
import subprocess
import threading
import time
from datetime import UTC, datetime

import lcm
import numpy as np
import ols
import ols_msg
import pytest
import takproto
from conftest import BIN, made
from ols_demo.bus import LIVE_URL, decode
from ols_demo.keys import members_of_environment
from ols_demo.places import geodetic
from ols_demo.site import Site
from sapient_site import OBJECT, detection, framed

DEADLINE_S = 60.0
STATION = (49.2, 16.6, 250.0)
CUE = (49.203, 16.601, 400.0)
RUBBISH = b"\xff\x00rubbish\n"


def ecef(latitude_deg, longitude_deg, height_m):
    return np.array(ols.ecef_from_geodetic(geodetic(latitude_deg, longitude_deg, height_m)))


def direction():
    """From the station to the cue, as a unit vector of the Earth."""
    line = ecef(*CUE) - ecef(*STATION)
    return line / np.linalg.norm(line)


def iso(seconds):
    return datetime.fromtimestamp(seconds, UTC).strftime("%Y-%m-%dT%H:%M:%S.%fZ")


def event(uid="T1"):
    now = time.time()
    return (
        f'<event version="2.0" uid="{uid}" type="a-h-A" how="m-g" time="{iso(now)}" '
        f'start="{iso(now)}" stale="{iso(now + 30.0)}"><point lat="{CUE[0]}" lon="{CUE[1]}" '
        f'hae="{CUE[2]}" ce="8" le="12"/></event>'
    ).encode()


def line():
    values = {
        "id": "J1",
        "latitude_deg": CUE[0],
        "longitude_deg": CUE[1],
        "height_m": CUE[2],
        "horizontal_sd_m": 2.0,
        "vertical_sd_m": 2.0,
    }
    return json.dumps(values).encode() + b"\n"


def aircraft(name="3c6444"):
    one = {"hex": name, "lat": CUE[0], "lon": CUE[1], "alt_geom": CUE[2] / 0.3048, "nac_p": 10}
    return json.dumps({"now": time.time(), "aircraft": [{**one, "seen_pos": 0.5}]})


def sbs():
    feet = CUE[2] / 0.3048
    return f"MSG,3,1,1,ABCDEF,1,,,,,,{feet},,,{CUE[0]},{CUE[1]},,,0,0,0,0\r\n".encode()


class Server:
    """Says the same again and again to whoever connects."""

    def __init__(self, words):
        self._words, self._connections, self.is_open = words, [], True
        self._socket = socket.create_server(("127.0.0.1", 0))
        self.port = self._socket.getsockname()[1]
        self._accepting = threading.Thread(target=self._accept, daemon=True)
        self._accepting.start()

    def _accept(self):
        while True:
            try:
                self._connections.append(self._socket.accept()[0])
            except OSError:
                return

    def speak(self):
        for connection in list(self._connections):
            try:
                connection.sendall(self._words())
            except OSError:
                self._connections.remove(connection)

    def close(self):
        self._socket.shutdown(socket.SHUT_RDWR)
        self._socket.close()
        self._accepting.join(DEADLINE_S)
        for connection in self._connections:
            connection.close()
        self._connections = []

    def open_again(self):
        self._socket = socket.create_server(("127.0.0.1", self.port))
        self._accepting = threading.Thread(target=self._accept, daemon=True)
        self._accepting.start()


class Web(http.server.BaseHTTPRequestHandler):
    def do_GET(self):  # noqa: N802
        body = aircraft("aaaaaa").encode()
        self.send_response(200 if self.path == "/data/aircraft.json" else 404)
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, *_):
        pass


class Rig:
    """A fusion, ols-cue, a station that is there and sees nothing, and the sources."""

    def __init__(self, folder, site):
        self.folder, self.site = folder, site
        self.fusion, self.slews, self.heard = None, [], []
        self.sequences = itertools.count(1)
        self.lcm = lcm.LCM(LIVE_URL)
        self.signing = members_of_environment()
        self.lcm.subscribe("OLS_(FUSION_STATUS|CUE)", self._receive)
        self.lcm.subscribe("OLS_SLEW_.+", self._receive_slew)
        self.udp = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self.ports = {name: self._free_port() for name in ("json", "cot")}
        self.tak = Server(lambda: event("TCP"))
        self.receiver = Server(sbs)
        self.radar_says = lambda: framed(detection(*CUE))
        self.radar = Server(lambda: self.radar_says())
        self.web = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Web)
        threading.Thread(target=self.web.serve_forever, daemon=True).start()
        self.file = folder / "aircraft.json"

    @staticmethod
    def _free_port():
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
            free.bind(("127.0.0.1", 0))
            return free.getsockname()[1]

    def start(self):
        inputs = {
            "json": ("json", f"udp://127.0.0.1:{self.ports['json']}", ""),
            "cot": ("cot", f"udp://127.0.0.1:{self.ports['cot']}", ""),
            "server": ("cot", f"tcp://127.0.0.1:{self.tak.port}", ""),
            "sbs": ("sbs", f"tcp://127.0.0.1:{self.receiver.port}", ""),
            "sapient": ("sapient", f"tcp://127.0.0.1:{self.radar.port}", ""),
            "file": ("aircraft-json", f"file://{self.file}", "poll_s = 0.2"),
            "web": (
                "aircraft-json",
                f"http://127.0.0.1:{self.web.server_port}/data/aircraft.json",
                "poll_s = 0.2",
            ),
        }
        text = f'lcm_url = "{LIVE_URL}"\nstatus_file = "{self.folder}/cue.json"\n'
        for name, (kind, source, more) in inputs.items():
            text += f'[[input]]\nname = "{name}"\nformat = "{kind}"\nfrom = "{source}"\n{more}\n'
        config = self.folder / "cue.toml"
        config.write_text(text)
        fusion = [str(BIN / "ols-fusion"), "--lcm-url", LIVE_URL]
        self.site.start_and_wait("fusion", fusion, "ready")
        self.site.start_and_wait("cue", [str(BIN / "ols-cue"), "--config", str(config)], "ready")

    def _receive(self, channel, data):
        message = decode(channel, data)
        if channel == "OLS_FUSION_STATUS":
            self.fusion = message
        else:
            self.heard.append(message)

    def _receive_slew(self, _channel, data):
        self.slews.append(ols_msg.slew_t.decode(data))

    def station(self):
        message = made(ols_msg.station_status_t, station="alfa", boot_id=1)
        message.sequence = next(self.sequences)
        message.state = message.STATE_IDLE
        message.position_source = message.POSE_SURVEYED
        message.camera_ecef_m = list(ecef(*STATION))
        message.field_of_view_rad = [0.1, 0.08]
        message.clock_state = ols_msg.bearing_t.CLOCK_SYNCHRONISED
        self.lcm.publish("OLS_STATUS_alfa", self.signing.sign("OLS_STATUS_alfa", message.encode()))

    def turn(self):
        """The servers and the station go on, and what has come is taken."""
        self.station()
        self.tak.speak()
        self.receiver.speak()
        self.radar.speak()
        timeout_ms = 50
        while self.lcm.handle_timeout(timeout_ms) > 0:
            timeout_ms = 0

    def until(self, condition, what, *says):
        """`says`: pairs of an input and what it is sent in each turn."""
        end = time.monotonic() + DEADLINE_S
        while True:
            for name, words in says:
                self.udp.sendto(words(), ("127.0.0.1", self.ports[name]))
            self.turn()
            if found := condition():
                return found
            assert time.monotonic() < end, f"not within {DEADLINE_S:.0f} s: {what}"

    def cue(self, name):
        """Its state in the fusion's status."""
        if self.fusion is None or name not in self.fusion.cue_id:
            return None
        return self.fusion.cue_state[self.fusion.cue_id.index(name)]

    def status(self):
        return json.loads((self.folder / "cue.json").read_text())

    def refused(self, name):
        return self.status()["inputs"][name]["refused"]

    def operator(self, *words):
        command = [str(BIN / "ols-ctl"), "--lcm-url", LIVE_URL, "fusion", *words]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as done:
            self.until(lambda: done.poll() is not None, " ".join(words), ("json", line))
            return done.returncode, done.stdout.read()


@pytest.fixture
def rig(network, tmp_path):
    with Site(tmp_path) as site:
        rig = Rig(tmp_path, site)
        rig.start()
        yield rig
        site.check()
        for name in ("cue", "fusion"):
            assert site.stop(name) == 0
        rig.web.shutdown()


STATUS = ols_msg.fusion_status_t


def test_an_operators_word_leads_a_station_to_a_cue(rig):
    rig.until(lambda: rig.cue("json.J1") == STATUS.CUE_WAITING, "it waits", ("json", line))
    assert rig.slews == []
    code, table = rig.operator("cues")
    assert code == 0 and "json.J1" in table and "waiting" in table
    assert rig.operator("allow", "json.J2") == (1, "json.J2: refused: the fusion has no such cue\n")
    assert rig.slews == []
    assert rig.operator("allow", "json.J1") == (0, "json.J1: done\n")
    rig.until(lambda: len(rig.slews) > 5, "slews", ("json", line))
    slew = rig.slews[-1]
    there = ols.R_ecef_enu(ecef(*STATION)).T @ direction()
    said = [
        math.sin(slew.azimuth_rad) * math.cos(slew.elevation_rad),
        math.cos(slew.azimuth_rad) * math.cos(slew.elevation_rad),
        math.sin(slew.elevation_rad),
    ]
    assert np.linalg.norm(np.array(said) - there) < 1e-3
    assert slew.station == "alfa" and slew.target_id == 0
    assert rig.operator("forbid", "json.J1") == (0, "json.J1: done\n")
    rig.slews.clear()
    rig.until(lambda: rig.cue("json.J1") == STATUS.CUE_FORBIDDEN, "it is forbidden", ("json", line))
    assert rig.slews == []
    rig.until(lambda: rig.cue("json.J1") is None, "a cue that nobody renews ends")


def test_an_operator_sets_the_hand_over(rig):
    assert rig.operator("handover", "automatic") == (0, "hand-over: done\n")
    code, table = rig.operator("cues")
    assert (code, table.splitlines()[0]) == (0, "hand-over: automatic")
    assert rig.operator("handover", "on")[0] != 0


def test_every_way_and_format_arrives(rig):
    rig.file.write_text(aircraft())

    def tak_protocol():
        return bytes(takproto.xml2proto(event("MESH"), takproto.TAKProtoVer.MESH))

    says = [("json", line), ("cot", event), ("cot", tak_protocol)]
    wanted = ["json.J1", "cot.T1", "cot.MESH", "server.TCP", "sbs.abcdef", "web.aaaaaa"]
    wanted += ["file.3c6444", f"sapient.{OBJECT}"]
    rig.until(lambda: all(rig.cue(name) is not None for name in wanted), "all of them", *says)
    cues = {cue.id: cue for cue in rig.heard}
    for name in wanted:
        cue = cues[name]
        assert (cue.latitude_deg, cue.longitude_deg) == pytest.approx(CUE[:2], abs=1e-9), name
        assert cue.height_m == pytest.approx(CUE[2], abs=1e-6), name
        assert abs(cue.state_utime * 1e-6 - time.time()) < DEADLINE_S, name
    assert cues["cot.T1"].horizontal_sd_m == cues["cot.MESH"].horizontal_sd_m == 8.0
    assert cues["web.aaaaaa"].horizontal_sd_m == pytest.approx(10.0 / 2.45)
    assert cues["sbs.abcdef"].vertical_sd_m == 300.0  # by pressure
    radar = cues[f"sapient.{OBJECT}"]
    assert (radar.horizontal_sd_m, radar.vertical_sd_m) == pytest.approx((11.12, 12.0), abs=0.01)


def test_rubbish_of_every_framing_is_counted_and_stops_nothing(rig):
    """What else is refused, and by which name, the unit tests of the readers say."""
    rig.radar_says = lambda: len(RUBBISH).to_bytes(4, "little") + RUBBISH
    says = [("json", lambda: RUBBISH), ("cot", lambda: b"<event" + RUBBISH)]

    def all_counted():
        if not (rig.folder / "cue.json").exists():
            return False
        return all(rig.refused(name)["malformed"] for name in ("json", "cot", "sapient"))

    rig.until(all_counted, "each is counted", *says)
    assert {cue.id for cue in rig.heard} <= {"server.TCP", "sbs.abcdef", "web.aaaaaa"}
    rig.until(lambda: rig.cue("json.J1") is not None, "a good one", ("json", line), *says)


def test_a_server_that_dies_is_found_again(rig):
    rig.until(lambda: rig.cue("server.TCP") is not None, "a cue")
    rig.tak.close()
    rig.until(lambda: rig.status()["inputs"]["server"]["trouble"], "its end is said")
    rig.until(lambda: rig.cue("server.TCP") is None, "its cue ends")
    assert rig.cue("sbs.abcdef") is not None
    rig.tak.open_again()
    rig.until(lambda: rig.cue("server.TCP") is not None, "it is back")
    rig.until(lambda: rig.status()["inputs"]["server"]["openings"] >= 2, "it is counted")
