"""Measures an order's answer at the console: from a click (the message that the page sends) to
the station's answer, with statuses twice a second and once a minute. On a machine that does
nothing else; the load before is printed.
"""

import argparse
import contextlib
import itertools
import json
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from conftest import BIN, wait
from console_site import Api, address_of, console_command
from helpers import station_without_devices
from ols_demo.site import Site, bring_up_loopback

from ols_bench.plain_viewer import LiveSocket

STATION = "lone"


@contextlib.contextmanager
def site(folder: Path, status_interval_s: float) -> Iterator[str]:
    """A console and a station without devices. Yields the console's address once it has heard the
    station."""
    folder.mkdir(parents=True, exist_ok=True)
    config = folder / "lone.toml"
    own = f"status_interval_s = {status_interval_s}\n"
    config.write_text(own + station_without_devices(STATION))
    with Site(folder / "logs") as started:
        console = console_command(folder / "nobody", "--port", "0")
        started.start_and_wait("console", console, "ready")
        station = [str(BIN / "ols-station"), "--config", str(config)]
        started.start_and_wait("station", station, "ready")
        address = address_of(started, "console")
        wait(lambda: Api(address).state()["stations"], "the station's first status")
        yield address


def answers(address: str, count: int) -> list[tuple[float, dict]]:
    """Of as many releases, one after the other: how long each took [s], and the answer."""
    live = LiveSocket(address)
    given = []
    for number in range(1, count + 1):
        order = {"do": "command", "number": number, "station": STATION, "command": "release"}
        begin_s = time.monotonic()
        answer = live.answer_to(order)
        given.append((time.monotonic() - begin_s, answer))
    return given


def main() -> None:
    parser = argparse.ArgumentParser(prog="tools/bench orders", description=__doc__)
    parser.add_argument("--orders", type=int, default=200)
    parser.add_argument("--status-interval", type=float, nargs="+", default=[0.5, 60.0])
    arguments = parser.parse_args()
    print("load before:", Path("/proc/loadavg").read_text().split()[0])
    bring_up_loopback([])
    with tempfile.TemporaryDirectory() as folder:
        for number, interval_s in zip(itertools.count(), arguments.status_interval):
            with site(Path(folder) / str(number), interval_s) as address:
                given = answers(address, arguments.orders)
            ms = 1e3 * np.array([took_s for took_s, _ in given])
            refused = [answer["why"] for _, answer in given if not answer["accepted"]]
            p50, p95 = np.percentile(ms, [50, 95])
            print(
                f"status interval {interval_s:g} s: {len(ms)} orders, from click to answer "
                f"p50 {p50:.1f} ms, p95 {p95:.1f} ms, most {ms.max():.1f} ms",
                json.dumps(refused[:3]) if refused else "",
            )


if __name__ == "__main__":
    main()
