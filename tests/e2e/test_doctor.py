"""ols-doctor beside real processes: nothing attached, devices without a station, a running site."""

import json
import math
import os
import re
import shutil
import subprocess
import tarfile
import tomllib
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import ols_msg
import pytest
from conftest import BIN, SCENARIO, finished
from helpers import Listener, at_frame_rate
from ols_demo.bus import LIVE_URL
from ols_demo.operator import Operator
from ols_demo.site import Site

OK, WARNINGS, FAILURES = 0, 1, 2


class Diagnosis:
    def __init__(self, *arguments, **environment):
        done = finished(BIN / "ols-doctor", "--json", *arguments, env={**os.environ, **environment})
        self.status, self.stderr = done.returncode, done.stderr
        answer = json.loads(done.stdout)
        self.verdict, self.findings = answer["verdict"], answer["findings"]

    def of(self, subject):
        return [f for f in self.findings if f["what"].startswith(subject + ":")]

    def failures(self):
        return {f["what"].split(":")[0] for f in self.findings if f["verdict"] == "FAIL"}


def with_a_fixed_camera(scenario):
    """delta stands still and looks at a drone that hardly moves."""
    text = scenario.read_text()
    text, hovers = re.subn(r"(?m)^amplitude_m = .*", "amplitude_m = [4.0, 4.0, 2.0]", text)
    stands = 'id = "delta"\nfixed_pan_tilt_deg = [0.0, 11.5]\n'
    assert hovers == 1 and text.count('id = "delta"\n') == 1, scenario
    scenario.write_text(text.replace('id = "delta"\n', stands))
    return scenario


@pytest.fixture(scope="module", name="configs")
def fixture_configs(network, tmp_path_factory):
    """The stations' files of a simulated site, and the folder of its serial lines."""
    folder = tmp_path_factory.mktemp("doctor")
    scenario = with_a_fixed_camera(at_frame_rate(SCENARIO, 6.0, folder))
    command = [str(BIN / "ols-sim"), "--scenario", str(scenario), "--seed", "1"]
    command += ["--lcm-url", LIVE_URL, "--directory", str(folder / "lines")]
    (folder / "lines").mkdir()
    write = ["--write-configs", str(folder / "config"), "--state-folder", str(folder / "state")]
    subprocess.run([*command, *write], check=True)
    return command, folder


@pytest.fixture(scope="module", name="devices")
def fixture_devices(configs):
    command, folder = configs
    with Site(folder / "logs") as site:
        site.start_and_wait("ols-sim", command, "ready")
        yield site, folder


@pytest.fixture(scope="module", name="alone")
def fixture_alone(configs, tmp_path_factory):
    """Its answers where nothing is attached, asked for at once: each waits for devices."""
    _, folder = configs
    config = folder / "config" / "alfa.toml"
    wrong = folder / "wrong.toml"
    wrong.write_text("heigth_m = 1\n" + config.read_text())
    site_section, keys = Path(os.environ["OLS_KEYS"]), tmp_path_factory.mktemp("tripod")
    shutil.copy(site_section / "alfa.key", keys)
    kept = folder / "kept.toml"
    kept.write_text(config.read_text().replace(f"{folder}/state", f"{folder}/kept"))
    state = Path(tomllib.loads(kept.read_text())["state_folder"])
    state.mkdir()
    shutil.copy(site_section / "trust.toml", state / "trust-alfa.toml")
    before = {path: path.stat().st_mtime_ns for path in state.iterdir()}
    with ThreadPoolExecutor() as pool:
        answers = {
            "right": pool.submit(Diagnosis, "--config", config),
            "wrong": pool.submit(Diagnosis, "--config", wrong),
            "no list": pool.submit(Diagnosis, "--config", config, OLS_KEYS=str(keys)),
            "kept list": pool.submit(Diagnosis, "--config", kept, OLS_KEYS=str(keys)),
        }
    assert {path: path.stat().st_mtime_ns for path in state.iterdir()} == before, "only read"
    return {name: answer.result() for name, answer in answers.items()}


def test_nothing_attached(alone):
    diagnosis = alone["right"]
    assert diagnosis.status == FAILURES and diagnosis.verdict == "FAIL"
    assert {"station", "camera", "ptu"} <= diagnosis.failures()
    assert "is not there" in diagnosis.of("ptu")[0]["what"]
    for finding in diagnosis.findings:
        assert (finding["verdict"] == "ok") == (finding["advice"] == ""), finding


def test_a_tripod_reads_the_trust_list_that_its_station_has_kept(alone):
    """The centre is off."""
    assert "no trust list yet" in alone["no list"].of("signatures")[0]["what"]
    assert alone["kept list"].of("signatures")[0]["verdict"] == "ok"


def test_a_wrong_configuration_is_named(alone, tmp_path):
    assert alone["wrong"].status == FAILURES
    assert "heigth_m: unknown key" in alone["wrong"].of("configuration")[0]["what"]
    assert "correct that line" in alone["wrong"].of("configuration")[0]["advice"]
    missing = Diagnosis("--config", tmp_path / "none.toml")
    assert missing.status == FAILURES
    assert "there is no such file" in missing.of("configuration")[0]["advice"]
    folder = Diagnosis("--config", tmp_path)
    assert folder.status == FAILURES
    assert "this is a folder" in folder.of("configuration")[0]["advice"]


def test_devices_are_asked_where_no_station_runs(devices):
    site, folder = devices
    diagnosis = Diagnosis("--config", folder / "config" / "alfa.toml")
    # The scenario's receiver needs a gpsd, and there is none here.
    assert diagnosis.failures() == {"station", "gnss"}, diagnosis.findings
    assert diagnosis.of("inclinometer")[-1]["verdict"] == "ok"
    ptu = " ".join(finding["what"] for finding in diagnosis.of("ptu"))
    assert "PTU-D46" in ptu and "deg in steps of" in ptu and " V" in ptu
    assert diagnosis.of("camera")[0]["verdict"] == "ok"
    site.check()


def test_a_running_station_is_asked_and_left_alone(devices):
    site, folder = devices
    config = folder / "config" / "alfa.toml"
    command = [str(BIN / "ols-station"), "--config", str(config)]
    site.start_and_wait("station", command, "ready")
    site.start_and_wait("fusion", [str(BIN / "ols-fusion"), "--lcm-url", LIVE_URL], "ready")
    listener = Listener()

    def well():
        status = listener.observer.status.get("alfa")
        if status is None:
            return False
        states = dict(zip(status.device_name, status.device_state, strict=True))
        return states["camera"] == states["ptu"] == status.DEVICE_OK

    listener.wait(well, "camera and PTU of alfa", 60.0)
    before = listener.wait_for_status("alfa")
    bundle = folder / "bundle.tar.gz"
    asked = ("station", "camera", "ptu", "bus", "fusion")
    diagnosis = None

    def is_well():
        """A busy machine delays what its devices answer, and the doctor says so."""
        nonlocal diagnosis
        bundle.unlink(missing_ok=True)
        diagnosis = Diagnosis("--config", config, "--bundle", bundle)
        verdicts = [(subject, diagnosis.of(subject)[0]) for subject in asked]
        print([found for found in verdicts if found[1]["verdict"] != "ok"])
        return all(found["verdict"] in ("ok", "warn") for _, found in verdicts)

    listener.wait(is_well, "a diagnosis without a failure", 60.0)
    with tarfile.open(bundle) as packed:
        assert b"station    alfa, boot" in packed.extractfile("./statuses.txt").read()
    assert "alfa runs" in diagnosis.of("station")[0]["what"]
    after = listener.wait_for_status("alfa")
    assert after.boot_id == before.boot_id
    known = dict(zip(before.counter_name, before.counter_value, strict=True))
    for name in ("camera_reconnects", "ptu_port_failures"):  # as when another program has opened it
        assert listener.counter("alfa", name) == known[name]
    site.check()


def test_a_fixed_camera_is_a_station_that_never_moves(devices):
    """It sends bearings of what is designated in its view, and refuses motion in words."""
    site, folder = devices
    config = folder / "config" / "delta.toml"
    diagnosis = Diagnosis("--config", config)
    assert diagnosis.of("ptu")[0]["what"] == "ptu: fixed at pan 0.00, tilt 11.50 deg"
    assert diagnosis.of("camera")[0]["verdict"] == "ok"
    site.start_and_wait("delta", [str(BIN / "ols-station"), "--config", str(config)], "ready")
    listener, bearings = Listener(), []
    listener.bus.lcm.subscribe(
        "OLS_BEARING_delta", lambda _, data: bearings.append(ols_msg.bearing_t.decode(data))
    )
    person = Operator(listener.bus, listener.observer, seed=1)

    def followed():
        person.act({"delta"})
        return bearings and listener.observer.state("delta") == "tracking"

    listener.wait(followed, "bearings of the drone in its view", 60.0)
    moved = finished(BIN / "ols-ctl", "delta", "manual", "10", "5")
    assert moved.returncode == 1
    assert "its camera stands on a fixed mount, which does not move" in moved.stdout
    status = listener.wait_for_status("delta")
    assert status.kind == status.KIND_FIXED
    assert math.degrees(status.pan_rad) == pytest.approx(0.0)
    assert math.degrees(status.tilt_rad) == pytest.approx(11.5)
    # Of the person's order alone: the fusion leaves it alone.
    listener.wait_for_counter("delta", "refused_fixed_mount", 1)
    assert listener.counter("delta", "refused_fixed_mount") == 1
    site.check()


def test_without_a_configuration_it_says_what_to_do():
    done = finished(BIN / "ols-doctor", "--config", "/nonexistent.toml")
    assert done.returncode == FAILURES
    assert done.stdout.startswith("FAIL  configuration: /nonexistent.toml")
