"""A site made of the packages: a centre and stations with simulated devices."""

import re
from pathlib import Path

SCENARIO = Path(__file__).resolve().parents[1] / "boot_test/scenario.toml"
CENTRE = """\
role = "centre"
interface = "host0"
site = "airfield"
root = "/root/root.key"
neighbours = ["10.7.0.11", "10.7.0.12"]
"""
# A simulated serial line is a pseudo terminal.
SIMULATED_LINE = "[Service]\nDeviceAllow=char-pts rw\n"


def install(host, packages):
    folder = host.root / "root/packages"
    folder.mkdir(exist_ok=True)
    names = []
    for package in packages:
        (folder / package.name).write_bytes(package.read_bytes())
        names.append(f"/root/packages/{package.name}")
    host.run("apt-get", "install", "-y", "-q", *names)


def set_up_centre(host):
    """Its invitation."""
    host.write("/root/answers.toml", CENTRE)
    said = host.run("ols-setup", "--answers", "/root/answers.toml", check=False).stdout
    for unit in ("fusion", "logger", "exporter", "console"):
        host.wait(f"ols-{unit}", lambda unit=unit: is_active(host, f"ols-{unit}"))
    return re.search(r'invitation = "([^"]+)"', said).group(1)


def start_devices(host):
    """Camera, PTU, inclinometer and receiver of this tripod (and of the others, which nobody uses
    here), and its configuration."""
    host.write("/root/scenario.toml", SCENARIO.read_text())
    drop_in = "/etc/systemd/system/ols-station@.service.d/simulated-line.conf"
    host.write(drop_in, SIMULATED_LINE)
    for address in ("127.0.0.11", "127.0.0.12", "127.0.0.13"):
        host.run("ip", "address", "replace", f"{address}/8", "dev", "lo")
    # The simulator's own bus, until ols-setup has said where the site's is.
    host.run("ip", "route", "replace", "224.0.0.0/4", "dev", "lo")
    host.run("chmod", "755", "/root")
    simulator = ("ols-sim", "--scenario", "/root/scenario.toml", "--directory", "/run/ols/sim")
    host.run(*simulator, "--write-configs", "/root")
    host.run("systemd-run", "--quiet", "--unit=devices", "--uid=ols", *simulator)
    host.wait("its devices", lambda: ".ptu" in host.says("ls", "/run/ols/sim"))


def answers_of(host, invitation):
    """What a person knows of this tripod. Its PTU is to be found, and which of three cameras it is
    is to be said."""
    text = (host.root / f"root/{host.name}.toml").read_text()
    text = re.sub(r"^(device|lcm_url|baud) = .*\n", "", text, flags=re.M)
    text = re.sub(r"^\[inclinometer\]\n(.+\n)*", "", text, flags=re.M)
    text = re.sub(r"^\[(.+)\]$", r"[station.\1]", text, flags=re.M)
    camera = f'[station.camera]\ndevice = "AVT-GT1290C-{host.name}"'
    text = text.replace("[station.camera]", camera)
    head = (
        f'role = "station"\ninterface = "host0"\ninvitation = "{invitation}"\n'
        f'neighbours = ["10.7.0.1"]\nserial = ["/run/ols/sim/{host.name}.ptu"]\n[station]\n'
    )
    return head + text


def set_up_station(host, centre, invitation):
    """One command on each side. Then each believes the other."""
    host.write("/root/answers.toml", answers_of(host, invitation))
    done = host.run("ols-setup", "--answers", "/root/answers.toml", check=False)
    said = re.search(r"--public ([0-9a-f]+)", done.stdout)
    if said is None:
        raise RuntimeError(f"{host.name}: ols-setup:\n{done.stdout}{done.stderr}")
    enrol = ("ols-key", "enrol", host.name, "--root", "/root/root.key")
    centre.run(*enrol, "--list", "/etc/ols/trust.toml", "--public", said.group(1))
    centre.wait(f"{host.name} to be believed", lambda: answers(centre, host.name))
    centre.wait(f"{host.name} to obey", lambda: obeys(centre, host.name, "reference-ok"))
    centre.wait(f"the devices of {host.name}", lambda: has_devices(centre, host.name))


def is_active(host, unit):
    return host.says("systemctl", "is-active", unit).strip() == "active"


def order(centre, station, *words):
    return centre.run("ols-ctl", station, *words, check=False)


def obeys(centre, station, *words):
    return order(centre, station, *words).returncode == 0


def answers(centre, station):
    """The words of its row, if it is heard and believed."""
    for line in order(centre, station, "status").stdout.splitlines():
        if line.split()[:1] == [station]:
            return line.split()
    return None


def has_state(centre, station, state):
    row = answers(centre, station)
    return row is not None and row[1] == state


def has_devices(centre, station):
    """Camera and PTU answer."""
    return re.search(rf"^{station} .* ok +ok ", order(centre, station, "status").stdout, flags=re.M)


def track(centre, station):
    """The drone hovers straight ahead at this tilt: dev/boot_test/scenario.toml."""

    def stands():
        order(centre, station, "manual", "0", "13.8")
        row = answers(centre, station)
        return row is not None and row[1] == "manual" and abs(float(row[6]) - 13.8) < 0.02

    centre.wait(f"{station} to point", stands)
    order(centre, station, "designate", "594,465,92,30")
    centre.wait(f"{station} to track", lambda: has_state(centre, station, "tracking"))
