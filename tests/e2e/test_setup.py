"""ols-setup from answers: a centre and a station that joins it by one command on each side, with a
simulated PTU on its line, or an ONVIF camera that is found; what a person has changed outlasts the
next run."""

import numpy as np
import pytest
from conftest import BIN, ROOT, finished, wait
from helpers import Listener
from ols_demo.bus import LIVE_URL
from ols_demo.site import Site
from PIL import Image

CENTRE = """\
role = "centre"
site = "airfield"
root = "{root}"
"""
STATION = """\
role = "station"
invitation = "{invitation}"
serial = ["/nonexistent/line", "{line}"]
[station]
id = "alfa"
lcm_url = "{url}"
state_folder = "{state}"
[station.pose]
latitude_deg = 49.2266
longitude_deg = 16.5969
height_m = 310.0
heading_deg = 45.0
[station.calibration.sd]
heading_deg = 0.5
mount_deg = 0.1
[station.camera]
device = "127.0.0.99"
[station.lens]
fx_px = 13333.3
fy_px = 13333.3
"""


def run(program, *words, status=0, typed=None, folder=None):
    done = finished(BIN / program, *words, input=typed, cwd=folder)
    assert done.returncode == status, done.stdout + done.stderr
    return done.stdout + done.stderr


def set_up(folder, answers, status=0):
    file = folder.parent / f"{folder.name}-answers.toml"
    file.write_text(answers)
    words = ("--root", folder, "--answers", file)
    return run("ols-setup", *words, status=status, folder=folder.parent)


@pytest.fixture
def centre(tmp_path):
    """Its folder, the root's file, and its invitation."""
    folder, root = tmp_path / "centre", tmp_path / "root.key"
    for program in ("fusion", "console"):
        (folder / "usr/bin").mkdir(parents=True, exist_ok=True)
        (folder / "usr/bin" / f"ols-{program}").touch()
    said = set_up(folder, CENTRE.format(root=root))
    return folder, root, said.split('invitation = "')[1].split('"')[0]


@pytest.fixture
def ptu(tmp_path):
    """A unit on a line."""
    line = tmp_path / "ptu"
    with Site(tmp_path / "ptu-logs") as site:
        site.start("ptu", [str(BIN / "ols-sim-ptu"), "--link", str(line), "--no-home"])
        wait(lambda: site.check() or line.exists(), "a line")
        yield line


@pytest.fixture
def ptz(network, tmp_path):
    """The password of an ONVIF camera that answers who looks for cameras."""
    sim = [str(BIN / "ols-sim"), "--scenario", str(ROOT / "sim/scenarios/onvif.toml")]
    sim += ["--lcm-url", LIVE_URL, "--directory", str(tmp_path / "lines")]
    with Site(tmp_path / "sim-logs") as site:
        site.start_and_wait("ols-sim", sim, "ready")
        yield (tmp_path / "lines/alfa.password").read_text().strip()


def assert_is_a_picture(file, size):
    picture = Image.open(file)
    assert picture.size == size
    assert np.std(picture) > 5.0


def test_an_onvif_camera_is_found_and_becomes_camera_and_mount(tmp_path, centre, ptz):
    tripod = tmp_path / "alfa"
    secret = tripod / "etc/ols/ptz.password"
    secret.parent.mkdir(parents=True)
    login = 'user = "admin"\npassword_file = "/etc/ols/ptz.password"\n'
    answers = answers_of(tmp_path, centre, "/nonexistent").replace(
        'device = "127.0.0.99"', 'kind = "rtsp"'
    )
    answers += f'[station.mount]\nkind = "onvif"\n{login}'
    secret.write_text("wrong\n")
    assert "user or password refused" in set_up(tripod, answers, status=2)
    assert not (tripod / "etc/ols/alfa.toml").exists()
    secret.write_text(ptz + "\n")
    said = set_up(tripod, answers)
    assert "http://127.0.0.11:8080/onvif/device_service, stream main: H264, 640 x 480" in said
    config = tripod / "etc/ols/alfa.toml"
    assert 'url = "rtsp://127.0.0.11:8554/video"' in config.read_text()
    run("ols-station", "--config", config, "--check-config")
    assert ptz not in said + config.read_text()
    assert f"picture of the camera, 640 x 480: {tmp_path}/alfa-camera.jpg" in said
    assert_is_a_picture(tmp_path / "alfa-camera.jpg", (640, 480))


def test_a_person_picks_an_onvif_camera_and_types_its_password(tmp_path, centre, ptz):
    tripod = tmp_path / "alfa"
    typed = ["station", "lo", "none", centre[2], "alfa", "49.2", "16.6", "310", "45", "0.5", "0.1"]
    typed += ["900", "900"]
    # The camera that is picked first is not the one that is meant.
    typed += ["1", "2", "2", "admin", "wrong", "admin", ptz, "1"]
    said = run("ols-setup", "--root", tripod, typed="\n".join(typed) + "\n", folder=tmp_path)
    assert "user or password refused" in said
    assert 'kind = "onvif"' in (tripod / "etc/ols/alfa.toml").read_text()
    secret = tripod / "etc/ols/alfa.camera-password"
    assert secret.read_text().strip() == ptz
    assert secret.stat().st_mode & 0o777 == 0o640


def test_a_telescope_mount_behind_an_indi_server_is_found(network, tmp_path, centre):
    tripod = tmp_path / "alfa"
    answers = answers_of(tmp_path, centre, "/nonexistent")
    answers += '[station.mount]\nkind = "indi"\nport = 7751\naxes = "altazimuth"\n'
    assert "no INDI mount answers" in set_up(tripod, answers, status=2)
    server = ["indiserver", "-p", "7751", "-u", str(tmp_path / "pipe"), "indi_simulator_telescope"]
    with Site(tmp_path / "indi-logs") as site:
        site.start("indiserver", server, {"HOME": str(tmp_path)})
        telescope = ("indi_getprop", "-1", "-t", "1", "-p", "7751", "*.DRIVER_INFO.DRIVER_NAME")
        wait(lambda: "Telescope" in finished(*telescope).stdout, "the telescope")
        said = set_up(tripod, answers)
    assert "mount: Telescope Simulator at localhost:7751" in said
    config = tripod / "etc/ols/alfa.toml"
    assert 'device = "Telescope Simulator"' in config.read_text()
    run("ols-station", "--config", config, "--check-config")


def answers_of(tmp_path, centre, line):
    (tmp_path / "state").mkdir(exist_ok=True)
    return STATION.format(invitation=centre[2], line=line, url=LIVE_URL, state=tmp_path / "state")


def test_a_station_joins_by_one_command_on_each_side(network, tmp_path, centre, ptu):
    folder, root, _ = centre
    tripod = tmp_path / "alfa"
    said = set_up(tripod, answers_of(tmp_path, centre, ptu))
    config = tripod / "etc/ols/alfa.toml"
    assert f'device = "{ptu}"' in config.read_text()
    assert 'mode = "require"' in config.read_text()
    run("ols-station", "--config", config, "--check-config")

    def credentials(host, name):
        """As systemd hands a key over."""
        where = tmp_path / f"credentials-{name}"
        where.mkdir()
        (where / "ols-key").write_bytes((host / f"etc/credstore/ols-{name}.key").read_bytes())
        (where / "ols-key").chmod(0o400)
        return {"CREDENTIALS_DIRECTORY": str(where), "OLS_TRUST": "", "STATE_DIRECTORY": ""}

    # The tripod has no trust list: it learns it from the centre.
    alone = {**credentials(tripod, "alfa"), "OLS_KEYS": ""}
    listed = {**credentials(folder, "fusion"), "OLS_KEYS": str(folder / "etc/ols")}
    listener = Listener()

    def says(words):
        status = listener.observer.status.get("alfa")
        return status is not None and any(words in alarm for alarm in status.alarm)

    with Site(tmp_path / "logs") as site:
        station = [str(BIN / "ols-station"), "--config", str(config)]
        site.start_and_wait("alfa", station, "ready", alone)
        listener.wait(lambda: says("trust: no trust list yet"), "that it waits for the list")
        fusion = [str(BIN / "ols-fusion"), "--config", str(folder / "etc/ols/fusion.toml")]
        site.start_and_wait("fusion", [*fusion, "--lcm-url", LIVE_URL], "ready", listed)
        listener.wait(
            lambda: says("trust: the key of this program, alfa, is not in"), "that it has the list"
        )
        public = said.split("--public ")[1].split()[0]
        trust = folder / "etc/ols/trust.toml"
        run("ols-key", "enrol", "alfa", "--root", root, "--list", trust, "--public", public)
        listener.wait(lambda: not says("trust: "), "that it is enrolled")
        site.check()


def statements(text):
    return [line for line in text.splitlines() if line and not line.startswith("#")]


def test_a_receiver_keeps_the_time_from_the_first_boot(tmp_path, centre):
    tripod, answers = tmp_path / "alfa", answers_of(tmp_path, centre, "/nonexistent")
    answers = 'gnss = "/dev/ols/gnss"\n' + answers + '[station.ptu]\ndevice = "/dev/ols/ptu"\n'
    assert "gpsd.service" in set_up(tripod, answers)
    assert 'DEVICES="/dev/ols/gnss"' in (tripod / "etc/default/gpsd").read_text()
    chrony = tripod / "etc/chrony/conf.d/ols-gnss.conf"
    example = (ROOT / "systemd/examples/chrony-gnss.conf").read_text()
    assert statements(chrony.read_text()) == statements(example)
    measured = chrony.read_text().replace("offset 0.1", "offset 0.137")
    chrony.write_text(measured)
    set_up(tripod, answers)
    assert chrony.read_text() == measured


def test_a_bad_answer_is_named_and_nothing_is_written(tmp_path, centre):
    tripod = tmp_path / "alfa"
    good = answers_of(tmp_path, centre, "/nonexistent")
    said = set_up(tripod, good.replace("= 45.0", "= 450"), status=2)
    assert "alfa-answers.toml:12: station.pose.heading_deg" in said
    assert len(said.splitlines()) == 1
    assert not tripod.exists()
    # Nothing answers on these lines.
    said = set_up(tripod, good, status=2)
    assert "station.mount.device" in said


def test_a_station_comes_back_from_its_backup(tmp_path, centre):
    tripod, other = tmp_path / "alfa", tmp_path / "new"
    answers = answers_of(tmp_path, centre, "/nonexistent")
    set_up(tripod, answers + '[station.ptu]\ndevice = "/dev/ols/ptu"\n')
    other.mkdir()
    run("ols-setup", "--root", tripod, "--backup", tmp_path / "alfa.backup")
    run("ols-setup", "--root", other, "--restore", tmp_path / "alfa.backup")
    for name in ("etc/ols/alfa.toml", "etc/credstore/ols-alfa.key"):
        assert (other / name).read_bytes() == (tripod / name).read_bytes()
