"""Which processes make a site, and with which configuration."""

import argparse
import json
import os
import re
import shutil
import subprocess
import tomllib
from pathlib import Path
from urllib.parse import urlsplit

from ols_demo.bus import LIVE_URL
from ols_demo.keys import make_keys
from ols_demo.site import Site, SiteError

GPSD = shutil.which("gpsd", path=os.environ["PATH"] + ":/usr/sbin")


def scenario_file(name: str) -> Path:
    return Path(__file__).resolve().parents[3] / f"sim/scenarios/{name}.toml"


def add_site_options(parser: argparse.ArgumentParser, scenario: str, output: str) -> None:
    """What every program that runs a simulated site is asked for."""
    root = Path(__file__).resolve().parents[3]
    file = scenario_file(scenario)
    parser.add_argument("--scenario", type=Path, default=file, help="TOML file")
    parser.add_argument("--seed", type=int, default=1, help="of the simulated errors")
    parser.add_argument("--output", type=Path, default=root / "out" / output, help="folder")
    parser.add_argument("--bin", type=Path, default=root / "build/release/bin", help="programs")


def camera_address(config: Path) -> str:
    """Of the simulated camera in a station's configuration."""
    camera = tomllib.loads(config.read_text())["camera"]
    return camera["device"] if "device" in camera else urlsplit(camera["url"]).hostname


class Wiring:
    """The processes of a scenario: simulator, stations, fusion, logger."""

    def __init__(
        self,
        binaries: Path,
        scenario: Path,
        seed: int,
        output: Path,
        signed: bool = False,
        unattended: bool = False,
    ):
        """signed: all processes sign, by keys that are made for this run, and require it of the
        others. Else as the environment says. unattended: what detectors find leads stations, and a
        drone is an alarm."""
        self._unattended = unattended
        self._bin, self._scenario = binaries.resolve(), scenario.resolve()
        self._seed, self._signed = seed, signed
        self.keys: dict[str, str] = {}  # the environment of all processes
        self._output = output.resolve()
        self.configs: dict[str, Path] = {}
        self.log = self._output / "run.lcmlog"

    @property
    def stations(self) -> list[str]:
        return sorted(self.configs)

    @property
    def tracking_stations(self) -> list[str]:
        """All but those that a person drives."""
        kinds = {name: tomllib.loads(path.read_text()) for name, path in self.configs.items()}
        return sorted(n for n, config in kinds.items() if config.get("kind") != "overview")

    def _sim(self, *options: str) -> list[str]:
        return [
            str(self._bin / "ols-sim"),
            *("--scenario", str(self._scenario)),
            *("--seed", str(self._seed)),
            *("--lcm-url", LIVE_URL),
            *("--directory", str(self._output / "lines")),
            *options,
        ]

    def prepare(self) -> list[str]:
        """Writes the stations' configurations; returns the addresses that the cameras need."""
        folder = self._output / "config"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.rmtree(self._output / "logs", ignore_errors=True)
        state = self._output / "state"
        shutil.rmtree(state, ignore_errors=True)
        folder.mkdir(parents=True)
        (self._output / "lines").mkdir(exist_ok=True)
        self.log.unlink(missing_ok=True)
        write = self._sim("--write-configs", str(folder), "--state-folder", str(state))
        done = subprocess.run(write, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SiteError(done.stderr.strip() or "ols-sim failed")
        self.configs = {path.stem: path for path in sorted(folder.glob("*.toml"))}
        if self._signed:
            keys = self._output / "keys"
            shutil.rmtree(keys, ignore_errors=True)
            self.keys = make_keys(self._bin, keys, self.stations)
        return [camera_address(path) for path in self.configs.values()]

    def start(self, site: Site, log: bool = True) -> None:
        """Everything up, the log running; raises SiteError when something does not come up."""
        print(f"starting simulator, {len(self.configs)} stations, fusion and logger", flush=True)
        if log:
            self.start_log(site)
        self.start_simulator(site)
        self._start_gpsds(site)
        self.start_fusion(site)
        for name in self.configs:
            self.start_station(site, name)

    def start_simulator(self, site: Site) -> None:
        site.start_and_wait("ols-sim", self._sim(), "ready", self.keys)

    def start_log(self, site: Site) -> None:
        """Into a file of its own each time."""
        path, number = self.log, 1
        while path.exists():
            path, number = self.log.with_stem(f"{self.log.stem}-{number}"), number + 1
        site.start("lcm-logger", ["lcm-logger", "--lcm-url", LIVE_URL, "--quiet", str(path)])

    def start_fusion(self, site: Site, url: str = LIVE_URL, name: str = "ols-fusion") -> None:
        command = [str(self._bin / "ols-fusion"), "--lcm-url", url]
        if self._unattended:
            config = self._output / "fusion.toml"
            config.write_text('[handover]\nmode = "automatic"\nclasses = ["unknown", "drone"]\n')
            command += ["--config", str(config)]
        site.start_and_wait(name, command, "ready", self.keys)

    def start_station(
        self, site: Site, name: str, environment: dict[str, str] | None = None
    ) -> None:
        command = [str(self._bin / "ols-station"), "--config", str(self.configs[name])]
        environment = {**self.keys, **(environment or {})}
        site.start_and_wait(f"ols-station-{name}", command, "ready", environment)

    def start_console(
        self, site: Site, socket: int | None = None, port: int = 0, replay: Path | None = None
    ) -> str:
        """The console's address. `socket`: a listening one that it is to serve (doorway.py).
        `replay`: a log that it shows instead of the bus."""
        command = [str(self._bin / "ols-console"), "--lcm-url", LIVE_URL]
        command += ["--replay", str(replay)] if replay else []
        if self._unattended:
            command += ["--config", str(self._watched_site())]
        command += ["--users", str(self._output / "console-users")]
        if socket is None:
            command += ["--port", str(port)]
            site.start_and_wait("ols-console", command, "ready", self.keys)
        else:
            # As systemd hands a socket over: descriptor 3, for this very process.
            hand_over = f'exec 3<&{socket} && LISTEN_PID=$$ LISTEN_FDS=1 exec "$@"'
            command = ["/bin/sh", "-c", hand_over, "sh", *command]
            site.start_and_wait("ols-console", command, "ready", self.keys, keep=(socket,))
        said = (site.logs / "ols-console.log").read_text()
        return re.findall(r"ready: (\S+)", said)[-1]

    def _watched_site(self) -> Path:
        """The console's configuration, with an area around the stations that is for drones."""
        folder, config = self._output / "incidents", self._output / "console.toml"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        poses = [tomllib.loads(path.read_text())["pose"] for path in self.configs.values()]
        south, north = (f(p["latitude_deg"] for p in poses) for f in (min, max))
        west, east = (f(p["longitude_deg"] for p in poses) for f in (min, max))
        heights = [p["height_m"] for p in poses]
        area = {
            "name": "site",
            "polygon": [[west, south], [east, south], [east, north], [west, north]],
            "lowest_m": min(heights) - 50,
            "highest_m": max(heights) + 1000,
            "classes": ["drone"],
            "from": "00:00",
            "to": "00:00",
        }
        (folder / "areas.json").write_text(json.dumps({"version": 1, "areas": [area]}))
        config.write_text(f"[incidents]\nfolder = {json.dumps(str(folder))}\n")
        return config

    def program(self, name: str) -> str:
        return str(self._bin / name)

    def _start_gpsds(self, site: Site) -> None:
        if GPSD is None:
            print("gpsd is not installed: the stations have no GNSS receivers", flush=True)
            return
        for name, config in self.configs.items():
            gnss = tomllib.loads(config.read_text()).get("gnss")
            if gnss:
                site.start(f"gpsd-{name}", self.gpsd_command(name, gnss["port"]))

    def gpsd_command(self, station: str, port: int) -> list[str]:
        """One for each receiver, at a fixed speed: it need not hunt for it. It has shared memory
        of its own, because it leaves segments behind."""
        line = str(self._output / "lines" / f"{station}.gnss")
        options = ["-N", "-n", "-b", "-s", "38400", "-f", "8N1", "-S", str(port), line]
        return ["unshare", "--ipc", str(GPSD), *options]
