"""The simulated ONVIF PTZ camera, by independent clients: onvif-zeep and onvif-python, each with
its own WSDL files."""

import base64
import json
import math
import os
import re
import sys
import tarfile
from datetime import UTC, datetime, timedelta
from pathlib import Path
from urllib.parse import quote

import ols_msg
import pytest
import requests
from conftest import BIN, ROOT, finished, wait
from helpers import Listener
from ols_demo.bus import LIVE_URL
from ols_demo.site import Site
from onvif import ONVIFCamera, ONVIFError
from requests.auth import HTTPDigestAuth

ADDRESS, PORT, USER = "127.0.0.11", 8080, "admin"
ONVIF_PYTHON = ROOT / "build/onvif-python"  # by tools/install-dependencies
FULL_DEG = 170.0  # of pan, at -1 of the generic space


@pytest.fixture(scope="module")
def password(network, tmp_path_factory):
    folder = tmp_path_factory.mktemp("onvif")
    command = [str(BIN / "ols-sim"), "--scenario", str(ROOT / "sim/scenarios/onvif.toml")]
    command += ["--lcm-url", LIVE_URL, "--directory", str(folder / "lines")]
    with Site(folder / "logs") as running:
        running.start_and_wait("ols-sim", command, "ready")
        yield (folder / "lines/alfa.password").read_text().strip()
        running.check()


@pytest.fixture
def ptz(password):
    return steered(ONVIFCamera(ADDRESS, PORT, USER, password))


def steered(camera):
    return camera.create_ptz_service(), camera.create_media_service().GetProfiles()[0].token


def pan_tilt(x, y):
    return {"PanTilt": {"x": x, "y": y}}


def position(ptz):
    service, profile = ptz
    status = service.GetStatus({"ProfileToken": profile})
    if status.MoveStatus.PanTilt != "IDLE":
        return None
    return status.Position.PanTilt.x, status.Position.PanTilt.y


def rests_at(ptz, x, y, near=0.006):
    wait(lambda: position(ptz) == pytest.approx((x, y), abs=near), f"it rests at {x}, {y}")


def command(kind, duration_s, value=float("nan")):
    fault = ols_msg.sim_fault_t()
    fault.station, fault.kind, fault.duration_s, fault.value = "alfa", kind, duration_s, value
    Listener().publish("OLS_SIM_FAULT", fault.encode())


def test_it_tells_what_it_is(password):
    camera = ONVIFCamera(ADDRESS, PORT, USER, password)
    assert camera.devicemgmt.GetDeviceInformation().SerialNumber == "alfa"
    spaces = [s.Namespace for s in camera.devicemgmt.GetServices({"IncludeCapability": False})]
    assert "http://www.onvif.org/ver20/ptz/wsdl" in spaces
    media = camera.create_media_service()
    (profile,) = media.GetProfiles()
    assert profile.VideoEncoderConfiguration.Resolution.Width == 640
    transport = {"Stream": "RTP-Unicast", "Transport": {"Protocol": "RTSP"}}
    uri = media.GetStreamUri({"StreamSetup": transport, "ProfileToken": profile.token})
    assert uri.Uri == f"rtsp://{ADDRESS}:8554/video"
    ptz = camera.create_ptz_service()
    (node,) = ptz.GetNodes()
    assert node.SupportedPTZSpaces.AbsolutePanTiltPositionSpace[0].XRange.Min == -1
    (configuration,) = ptz.GetConfigurations()
    assert configuration.NodeToken == node.token
    assert configuration.token == profile.PTZConfiguration.token
    options = ptz.GetConfigurationOptions({"ConfigurationToken": configuration.token})
    assert options.PTZTimeout.Max == timedelta(seconds=60)
    assert configuration.DefaultPTZTimeout == timedelta(seconds=5)


def test_it_moves_as_told(ptz):
    truths = []
    listener = Listener()
    listener.bus.lcm.subscribe(
        "OLS_SIM_PTU_alfa", lambda _, d: truths.append(ols_msg.truth_ptu_t.decode(d))
    )
    service, profile = ptz
    service.AbsoluteMove({"ProfileToken": profile, "Position": pan_tilt(0.1, -0.3)})
    rests_at(ptz, 0.1, -0.3)
    truths.clear()
    listener.wait(lambda: truths, "the truth")
    assert truths[-1].pan_rad[-1] == pytest.approx(math.radians(-0.1 * FULL_DEG), abs=0.01)
    service.RelativeMove({"ProfileToken": profile, "Translation": pan_tilt(-0.1, 0.1)})
    rests_at(ptz, 0.0, -0.2)
    short = {"ProfileToken": profile, "Velocity": pan_tilt(1, 0), "Timeout": timedelta(seconds=0.5)}
    service.ContinuousMove(short)
    rests_at(ptz, 0.5 * 60 / FULL_DEG, -0.2)
    service.ContinuousMove(
        {"ProfileToken": profile, "Velocity": pan_tilt(-0.05, 0), "Timeout": timedelta(seconds=60)}
    )
    service.Stop({"ProfileToken": profile, "PanTilt": True})
    # Its status is as old as its positions: still, then moving, then still.
    wait(lambda: (position(ptz) or (-1.0, 0.0))[0] > -0.9, "rest, long before its limit")


def test_it_refuses_strangers_and_what_it_cannot(ptz, password):
    for wrong in ("", "wrong"):
        with pytest.raises(ONVIFError, match="not authorized"):
            ONVIFCamera(ADDRESS, PORT, USER, wrong).devicemgmt.GetDeviceInformation()
    service, profile = ptz
    with pytest.raises(ONVIFError, match="out of bounds"):
        service.AbsoluteMove({"ProfileToken": profile, "Position": pan_tilt(1.5, 0)})
    with pytest.raises(ONVIFError, match="ProfileToken"):
        service.GetStatus({"ProfileToken": "other"})


def test_it_takes_http_digest(password):
    text = (
        '<e:Envelope xmlns:e="http://www.w3.org/2003/05/soap-envelope"><e:Body>'
        '<GetStatus xmlns="http://www.onvif.org/ver20/ptz/wsdl"><ProfileToken>main</ProfileToken>'
        "</GetStatus></e:Body></e:Envelope>"
    )

    def status(client):
        return client.post(f"http://{ADDRESS}:{PORT}/onvif/ptz_service", data=text).status_code

    for secret, expected in ((password, 200), ("wrong", 401)):
        with requests.Session() as client:
            client.auth = HTTPDigestAuth(USER, secret)
            assert [status(client) for _ in range(3)] == 3 * [expected]
    assert status(requests) == 401


def test_faults_are_commanded(password):
    command("ptz-clock-off", 1e6, 3600.0)
    camera = ONVIFCamera(ADDRESS, PORT, USER, password, adjust_time=True)
    wait(lambda: offset_s(camera) > 3000, "its wrong clock")
    with pytest.raises(ONVIFError, match="not authorized"):
        steered(ONVIFCamera(ADDRESS, PORT, USER, password))
    steered(ONVIFCamera(ADDRESS, PORT, USER, password, adjust_time=True))
    command("all", 0.0)
    wait(lambda: offset_s(camera) < 3000, "its right clock")
    command("ptz-connection-lost", 1e6)
    wait(lambda: not reachable(), "its connections to be lost")
    command("all", 0.0)
    wait(reachable, "its connections")


def test_another_client_understands_it_also_by_media2(password):
    client = [sys.executable, ROOT / "tests/e2e/onvif_python_client.py"]
    search = {**os.environ, "PYTHONPATH": str(ONVIF_PYTHON)}
    done = finished(*client, ADDRESS, PORT, USER, password, env=search)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout) == {
        "model": "Simulated PTZ",
        "tokens": ["main", "main"],
        "encodings": ["H264", "H264"],
        "width": 640,
        "ptz": True,
        "stream": f"rtsp://{ADDRESS}:8554/video",
        "goes": True,
    }


def configured(folder, secret):
    """The configuration of a station with this camera, whose password is in `secret`."""
    words = ["--scenario", ROOT / "sim/scenarios/onvif.toml", "--lcm-url", LIVE_URL]
    words += ["--directory", folder / "lines", "--write-configs", folder / "config"]
    finished(BIN / "ols-sim", *words, "--state-folder", folder / "state", check=True)
    config = folder / "config/alfa.toml"
    text, changed = re.subn(
        r'password_file = ".*"', f'password_file = "{secret}"', config.read_text()
    )
    assert changed == 2
    config.write_text(text)
    return config


def everything_said(folder, config):
    """By all processes' command lines, and by the doctor's words and bundle."""
    words = [file.read_bytes() for file in Path("/proc").glob("[0-9]*/cmdline")]
    bundle = folder / "bundle.tar.gz"
    doctor = [BIN / "ols-doctor", "--json", "--config", config, "--bundle", bundle]
    told = finished(*doctor)
    words += [told.stdout.encode(), told.stderr.encode()]
    with tarfile.open(bundle) as files:
        words += [part.read() for one in files if (part := files.extractfile(one)) is not None]
    return words


def test_a_password_is_only_in_its_file(password, tmp_path):
    """Neither a wrong one nor the right one is in logs, messages, files, reports, command lines."""
    secret, wrong = tmp_path / "camera-password", "falsch/0815%geheim"
    secret.write_text(wrong + "\n")
    config, said, listener = configured(tmp_path, secret), [], Listener()
    listener.bus.lcm.subscribe(".*", lambda _, data: said.append(bytes(data)))

    def devices_say(words):
        return all(words in listener.device("alfa", name)[1] for name in ("camera", "ptu"))

    def devices_are(state):
        return all(listener.device("alfa", name)[0] == state for name in ("camera", "ptu"))

    with Site(tmp_path / "logs") as running:
        running.start_and_wait("alfa", [str(BIN / "ols-station"), "--config", config], "ready")
        listener.wait_for_status("alfa")
        listener.wait(lambda: devices_say("user or password"), "that both refuse the login")
        said += everything_said(tmp_path, config)
        secret.write_text(password + "\n")
        listener.wait(
            lambda: devices_are(ols_msg.station_status_t.DEVICE_OK), "that both take the login"
        )
        said += everything_said(tmp_path, config)
    said += [file.read_bytes() for file in tmp_path.rglob("*") if file.is_file() and file != secret]
    assert len(said) > 100
    for one in (wrong, password):
        login = base64.b64encode(f"{USER}:{one}".encode())  # as HTTP's method Basic has it
        for form in (one.encode(), quote(one, safe="").encode(), login):
            assert not [words for words in said if form in words]


def offset_s(camera):
    told = camera.devicemgmt.GetSystemDateAndTime().UTCDateTime
    at = datetime(
        *(told.Date.Year, told.Date.Month, told.Date.Day),
        *(told.Time.Hour, told.Time.Minute, told.Time.Second),
        tzinfo=UTC,
    )
    return (at - datetime.now(UTC)).total_seconds()


def reachable():
    try:
        requests.post(f"http://{ADDRESS}:{PORT}/onvif/device_service", timeout=5)
    except requests.ConnectionError:
        return False
    return True
