"""A simulated tripod that is calibrated: its simulator, its station, the command, and a person at
a console who sees the procedure's pictures and answers over the bus."""

import io
import subprocess
import time
import tomllib

import numpy as np
import ols
import ols_msg
from conftest import BIN, ROOT, finished
from helpers import Listener, addressed, at_frame_rate
from ols_demo.places import geodetic
from ols_demo.wiring import Wiring
from PIL import Image

SCENARIO = ROOT / "sim/scenarios/calibration.toml"
DEADLINE_S = 150.0
AGAIN_S = 3.0
FRAMES_HZ = 8.0
SIGNS = ("spire", "mast", "gable", "chimney")  # enough for a short test


def references(path, names=SIGNS, scenario=SCENARIO):
    """Where a surveyor has measured the signs."""
    scenario = tomllib.loads(scenario.read_text())
    site = scenario["site"]
    origin = geodetic(site["latitude_deg"], site["longitude_deg"], site["height_m"])
    place_of = {
        mark["id"]: ols.geodetic_from_ecef(
            ols.LocalFrame(origin).to_ecef(np.array(mark["position_enu_m"]))
        )
        for mark in scenario["mark"]
    }
    rows = ["landmark,latitude_deg,longitude_deg,height_m,sd_m"]
    rows += [
        f"{name},{np.degrees(place_of[name].latitude_rad):.10f},"
        f"{np.degrees(place_of[name].longitude_rad):.10f},{place_of[name].height_m:.4f},0.02"
        for name in names
    ]
    path.write_text("\n".join(rows) + "\n")
    return path


class Tripod:
    """Simulator and station, and the command that calibrates it."""

    def __init__(self, folder, site, scenario=SCENARIO, seed=5, station="alfa"):
        self.folder, self.station = folder, station
        self.wiring = Wiring(BIN, at_frame_rate(scenario, FRAMES_HZ, folder), seed, folder)
        self.wiring.prepare()
        self.wiring.start_simulator(site)
        self.wiring.start_station(site, station)
        self.config = self.wiring.configs[station]
        self.store = folder / "calibrations"
        self.listener = Listener()
        self.listener.bus.lcm.subscribe(f"OLS_PROCEDURE_{station}", self._procedure)
        self.state, self.begun_us = None, 0
        self.answered = 0
        self.sequence = int(time.time())

    def _procedure(self, _channel, data):
        state = ols_msg.procedure_t.decode(data)
        if state.utime >= self.begun_us:  # not what has waited since an earlier procedure
            self.state = state

    def ready(self):
        """Camera and unit work, and a picture has come."""

        def works():
            status = self.listener.observer.status.get(self.station)
            if status is None or status.image_width_px == 0 or not np.isfinite(status.pan_rad):
                return False
            state = dict(zip(status.device_name, status.device_state, strict=True))
            return state["camera"] == state["ptu"] == ols_msg.station_status_t.DEVICE_OK

        self.listener.wait(works, "camera and unit")

    def command(self, name, *options):
        # Without a sun in the scenery it is overcast, whatever the time of day.
        sun = ["--overcast"] if name == "field" else []
        return [
            *(str(BIN / "ols-calibrate"), name, "--station", str(self.config)),
            *("--state", str(self.store), *sun, *map(str, options)),
        ]

    def run(self, name, *options, deadline_s=DEADLINE_S):
        return finished(*self.command(name, *options), timeout=deadline_s, stdin=subprocess.DEVNULL)

    def release(self):
        """What a procedure that was killed has left under manual operation."""
        done = finished(BIN / "ols-ctl", self.station, "release")
        assert done.returncode == 0, done.stdout + done.stderr

    def begin(self, name, *options):
        self.state, self.answered = None, 0
        self.begun_us = time.time_ns() // 1000
        self.log = self.folder / f"{name}.out"
        with open(self.log, "ab") as out:
            return subprocess.Popen(
                self.command(name, *options),
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=subprocess.STDOUT,
            )

    def answer(self, choice, pixel=None):
        self.answered = self.state.question
        self.given = {
            "question": self.state.question,
            "choice": choice,
            "has_pixel": pixel is not None,
            "pixel_px": list(pixel) if pixel is not None else [0.0, 0.0],
        }
        self.send_answer()

    def send_answer(self):
        self.sequence += 1
        message = addressed(ols_msg.procedure_answer_t(), self.station, self.sequence)
        for name, value in self.given.items():
            setattr(message, name, value)
        self.answered_s = time.monotonic()
        self.listener.publish(f"OLS_PROCEDURE_ANSWER_{self.station}", message.encode())

    def is_asking(self):
        """Whether a question stands that was not answered yet. A datagram can be lost: a person
        gives an answer again while its question stands."""
        asking = ols_msg.procedure_t.STATE_ASKING
        state = self.state
        if state is None or state.state != asking:
            return False
        if state.question == self.answered and time.monotonic() > self.answered_s + AGAIN_S:
            self.send_answer()
        return state.question > self.answered

    def see_sign(self):
        """Where a person sees the sign in the picture: the whitest spot; None: it is not there."""
        picture = np.asarray(Image.open(io.BytesIO(bytes(self.state.jpeg))), dtype=float)
        white = picture > 0.93 * 255
        if white.sum() < 3:
            return None
        rows, columns = np.nonzero(white)
        return np.array([np.median(columns), np.median(rows)]) / self.state.scale

    def point_and_confirm(self):
        """Answers one question about a sign: points at it, then confirms the crosshair."""
        sign = self.see_sign()
        assert sign is not None, self.state.text
        crosshair = np.array(self.state.crosshair_px)
        right = self.state.has_crosshair and np.linalg.norm(crosshair - sign) < 3.0
        self.answer("confirm" if right else "point", None if right else sign)

    def operate(self, process, decide, deadline_s=DEADLINE_S):
        """A person at a console, until the procedure ends; `decide` answers the result."""

        def over():
            if self.is_asking():
                if "accept" in self.state.choice or "keep" in self.state.choice:
                    self.answer(decide(self.state))
                else:
                    self.point_and_confirm()
            return process.poll() is not None

        try:
            self.listener.wait(over, "the end of the procedure", deadline_s)
        except AssertionError:
            print(f"{self.state.step}: {self.state.text!r}\n{self.log.read_text()}")
            process.kill()
            process.wait()
            raise
        return process.returncode
