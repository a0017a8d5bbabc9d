"""The packages on fresh hosts: see tools/package-test."""

import argparse
import sys
import time
from pathlib import Path

import versions
from evaluate import bearing_gap_s, target_ids
from hosts import Host, make_network
from site_of_packages import (
    answers,
    has_state,
    install,
    order,
    set_up_centre,
    set_up_station,
    start_devices,
    track,
)

CENTRE = ("common", "central", "console", "tools")
STATION = ("common", "station", "sim")  # with the simulator: it stands for the devices
CRASHES = "#!/bin/sh\nkill -SEGV $$\n"
REFUSES = "#!/bin/sh\necho 'ols-station: /etc/ols/alfa.toml:3: id: is refused' >&2\nexit 2\n"


class Report:
    def __init__(self):
        self.passed = True

    def row(self, measure, found, limit, unit=" s"):
        ok = found <= limit
        self.passed &= ok
        text = f"{'ok  ' if ok else 'FAIL'}  {measure:66}  <= {limit:g}{unit}  {found:.1f}{unit}"
        print(text, flush=True)

    def holds(self, measure, ok, found=""):
        self.passed &= ok
        print(f"{'ok  ' if ok else 'FAIL'}  {measure:66}  {found}", flush=True)


def timed(action):
    start_s = time.monotonic()
    value = action()
    return time.monotonic() - start_s, value


def pid_of(station):
    return station.says("systemctl", "show", "-P", "MainPID", f"ols-station@{station.name}").strip()


def version_of(host):
    return host.says("dpkg-query", "--show", "--showformat=${Version}", "ols-station")


def configuration_of(host):
    return {
        path.name: path.read_bytes()
        for folder in ("etc/ols", "etc/credstore")
        for path in sorted((host.root / folder).iterdir())
    }


def set_up(report, packages, centre, stations):
    took_s, _ = timed(lambda: install(centre, packages(CENTRE)))
    setup_s, invitation = timed(lambda: set_up_centre(centre))
    report.row("fresh Debian to a running centre", took_s + setup_s, 180.0)
    for station in stations:
        took_s, _ = timed(lambda: install(station, packages(STATION)))  # noqa: B023
        start_devices(station)
        setup_s, _ = timed(lambda: set_up_station(station, centre, invitation))  # noqa: B023
        what = f"fresh Debian to {station.name} enrolled and obeying, with its devices"
        report.row(what, took_s + setup_s, 180.0)


def update_while_it_tracks(report, packages, centre, alfa, bravo, folder):
    for station in (alfa, bravo):
        track(centre, station.name)
    before, process = configuration_of(alfa), pid_of(alfa)
    start_us = time.time_ns() // 1000
    install(alfa, versions.reversioned(packages(STATION), "0.1.1", folder))
    alfa.wait("the update to wait", lambda: "is at work" in restart_says(alfa))
    report.holds("a station at work goes on with its program", pid_of(alfa) == process)
    stop_us = time.time_ns() // 1000
    order(centre, "alfa", "stop")
    alfa.wait("the restart", lambda: pid_of(alfa) not in (process, "0"))
    took_s, _ = timed(lambda: centre.wait("alfa", lambda: answers(centre, "alfa")))
    report.row("the upgraded station is back", took_s, 10.0)
    report.holds("its configuration is kept", configuration_of(alfa) == before)
    report.holds("bravo tracks", has_state(centre, "bravo", "tracking"))
    end_us = time.time_ns() // 1000
    log = centre.root / "var/log/ols"
    report.row(
        "longest gap in bravo's bearings", bearing_gap_s(log, "bravo", start_us, end_us), 1.0
    )
    ids = target_ids(log, start_us, stop_us)
    report.holds("the target kept its number while alfa was updated", len(ids) == 1, str(ids))


def restart_says(host):
    return host.says("journalctl", "--no-pager", "-o", "cat", "-u", "ols-station-restart")


def bad_updates(report, packages, centre, stations, folder):
    """All at once: they take five minutes each. The last one's computer is started again while its
    update is watched, and its time counts from there."""
    alfa, bravo, charlie = stations
    order(centre, "bravo", "stop")
    start_s = dict.fromkeys(stations, time.monotonic())
    cases = (
        (alfa, "0.1.2", CRASHES, "0.1.1"),
        (bravo, "0.1.3", REFUSES, "0.1.0"),
        (charlie, "0.1.4", CRASHES, "0.1.0"),
    )
    for station, version, program, _ in cases:
        install(station, versions.reversioned(packages(STATION), version, folder, program))
    charlie.wait("its restart", lambda: "restarting" in restart_says(charlie))
    start_s[charlie] = time.monotonic()
    charlie.start_again()
    report.holds(
        "the watch goes on when the computer was started again",
        charlie.wait("its watch", lambda: "started again" in restart_says(charlie)),
    )
    waiting = list(cases)
    while waiting and time.monotonic() - start_s[charlie] < 500.0:
        for case in list(waiting):
            station, version, _, good = case
            if version_of(station) != good or answers(centre, station.name) is None:
                continue
            waiting.remove(case)
            what = f"{station.name}, {version}: back on {good} without a person"
            report.row(what, time.monotonic() - start_s[station], 360.0)
            refused = station.says("cat", "/etc/apt/preferences.d/ols-taken-back")
            report.holds(
                "and apt does not install it again", f"Pin: version {version}\n" in refused
            )
        time.sleep(0.5)
    for station, version, _, _ in waiting:
        report.holds(f"{station.name}: back from {version}", False, restart_says(station))


def purge(report, host):
    host.run("apt-get", "purge", "-y", "-q", "ols-common")
    states = ("--state=active,activating", "--type=service,timer")
    runs = host.says("systemctl", "list-units", "--plain", "--no-legend", *states, "ols-*")
    report.holds(f"{host.name}: nothing runs on when its packages are purged", not runs, runs)
    wants = host.root / "etc/systemd/system/multi-user.target.wants"
    links = [path.name for path in wants.glob("ols-*")]
    report.holds("and nothing would start again with them", not links, str(links))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("packages", type=Path)
    parser.add_argument("--skip-bad-updates", action="store_true")
    options = parser.parse_args()
    work = Path("build/package-test").resolve()
    work.mkdir(parents=True, exist_ok=True)

    def packages(names):
        return [next(options.packages.resolve().glob(f"ols-{name}_*.deb")) for name in names]

    report, hosts = Report(), []
    make_network()
    try:
        print("== four fresh hosts", flush=True)
        for number, name in ((1, "centre"), (11, "alfa"), (12, "bravo"), (13, "charlie")):
            hosts.append(Host(name, number, work / "rootfs", work))
        centre, alfa, bravo, charlie = hosts
        set_up(report, packages, centre, (alfa, bravo, charlie))
        update_while_it_tracks(report, packages, centre, alfa, bravo, work)
        if not options.skip_bad_updates:
            bad_updates(report, packages, centre, (alfa, bravo, charlie), work)
        for host in hosts:
            purge(report, host)
    finally:
        for host in hosts:
            text = host.says("journalctl", "--no-pager", "-o", "short-precise")
            (work / f"{host.name}.txt").write_text(text)
            host.end()
    return 0 if report.passed else 1


if __name__ == "__main__":
    sys.exit(main())
