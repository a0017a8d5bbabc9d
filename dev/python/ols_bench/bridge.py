"""Measures the way from a site's bus to the region's, over ols-bridge, leaf, hub and
ols-bridge: bearings of simulated stations, from publication to the region's bus, and the
processor that each part takes. On a machine that does nothing else; the load before is printed.
"""

import argparse
import json
import os
import re
import subprocess
import tempfile
from contextlib import closing
from pathlib import Path

import bridge_site
import numpy as np
from ols_demo.site import bring_up_loopback

from ols_bench.processes import cpu_s

MOST_P99_MS = 10.0


def any_station(example: str) -> str:
    """The servers' files name two stations; here every name may be sent."""
    text = example.replace(".alfa.", ".*.")
    return re.sub(r"\n[^\n]*\.bravo\.[^\n]*", "", text)


class Network(bridge_site.Network):
    """Without the proxy by which the tests cut the link: it would be what is measured."""

    def _hub(self, text: str) -> str:
        return any_station(super()._hub(text))

    def _leaf(self, text: str) -> str:
        return any_station(super()._leaf(text)).replace(":7522", ":7422")


def measure(net: Network, options: argparse.Namespace) -> bool:
    parts = {
        "bridge of the site": net.site.process.pid,
        "leaf": net.leaf.process.pid,
        "hub": net.hub.process.pid,
        "bridge of the region": net.region.process.pid,
    }
    program = bridge_site.BIN / "ols-bench-bridge-load"
    command = [str(program), "--from", net.site_url, "--to", net.region_url]
    for name in ("stations", "rate", "seconds", "bytes"):
        command += [f"--{name}", str(getattr(options, name))]
    before = {name: cpu_s(pid) for name, pid in parts.items()}
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as load:
        sending = json.loads(load.stdout.readline())
        used = {name: cpu_s(pid) - before[name] for name, pid in parts.items()}
        delays_ms = np.array(json.loads(load.stdout.readline())["delays_ms"])
    sent, took_s = sending["sent"], sending["took_s"]
    print(f"{options.stations} stations, {options.rate:g} Hz, {options.bytes} bytes each")
    print(f"sent {sent} in {took_s:.1f} s, {sent / took_s:.0f} a second; came {len(delays_ms)}")
    p50, p95, p99 = np.percentile(delays_ms, [50, 95, 99]) if len(delays_ms) else [np.inf] * 3
    print(
        f"site's bus to region's bus: p50 {p50:.2f}, p95 {p95:.2f}, p99 {p99:.2f} ms "
        f"(at most {MOST_P99_MS:g}), longest {delays_ms.max(initial=0.0):.1f} ms"
    )
    for name, seconds in used.items():
        print(f"{name}: {seconds / took_s:.2f} of a core, {1e6 * seconds / sent:.0f} us a message")
    state = net.region.status()
    print(f"missing by the stations' own numbers: {state['missing']}, twice: {state['repeated']}")
    for name, one in (("site", net.site.status()), ("region", state)):
        print(
            f"{name}: bus {one['counters']}, refused "
            f"{sum(one['out']['refused'].values()) + sum(one['in']['refused'].values())}, "
            f"unsent {one['link']['unsent']}, displaced {one['link']['displaced']}"
        )
    return p99 <= MOST_P99_MS and len(delays_ms) == sent and state["repeated"] == 0


def main() -> int:
    parser = argparse.ArgumentParser(prog="tools/bench bridge")
    parser.add_argument("--stations", type=int, default=1000)
    parser.add_argument("--rate", type=float, default=15.0, help="[Hz] bearings of each")
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--bytes", type=int, default=400, help="of each, with its signature")
    options = parser.parse_args()
    print(f"load before: {os.getloadavg()[0]:.2f}")
    bring_up_loopback([])
    with tempfile.TemporaryDirectory() as folder, closing(Network(Path(folder))) as net:
        return 0 if measure(net, options) else 1


if __name__ == "__main__":
    raise SystemExit(main())
