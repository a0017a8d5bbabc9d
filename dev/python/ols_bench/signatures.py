"""Measures what signatures cost a whole site: the demo's, in turn with and without them, from
exposure to published target. On a machine that does nothing else; the load before is printed.
"""

import argparse
import multiprocessing
import os
import tempfile
from pathlib import Path
from typing import Any

import numpy as np
from ols_demo import evaluate, recording
from ols_demo.__main__ import PATIENCE_S, Run
from ols_demo.site import Site, bring_up_loopback
from ols_demo.wiring import Wiring

ROOT = Path(__file__).resolve().parents[3]
SETTLE_S = 3.0  # not judged


def measure(options: argparse.Namespace, signed: bool) -> dict[str, Any]:
    """A run of the demo's site, in a process of its own: what evaluate.report says of it."""
    os.environ.update({} if signed else {"OLS_TRUST": "off"})
    with tempfile.TemporaryDirectory() as folder:
        output = Path(folder)
        wiring = Wiring(options.bin, options.scenario, options.seed, output, signed=signed)
        bring_up_loopback(wiring.prepare())
        with Site(output / "logs") as site:
            wiring.start(site)
            run = Run(options, wiring.keys.get("OLS_KEYS"))
            run.designate(site, wiring.tracking_stations)
            begin_us, end_us = run.watch(site)
        window = (begin_us + round(1e6 * SETTLE_S), end_us)
        return evaluate.report(recording.read(wiring.log), window)


def row(signed: bool, result: dict[str, Any]) -> str:
    latency = result["latency"]
    return (
        f"{'signed' if signed else 'unsigned':9s} {result['fixes']:6d} {result['rmse_m']:8.3f} "
        f"{1e3 * latency['p50_s']:8.1f} {1e3 * latency['p95_s']:8.1f}"
    )


def main() -> int:
    parser = argparse.ArgumentParser(prog="tools/bench signatures")
    parser.add_argument("--runs", type=int, default=5, help="of each")
    parser.add_argument("--seconds", type=float, default=23.0, help="of each run [s]")
    parser.add_argument("--seed", type=int, default=1, help="of the simulated errors")
    options = parser.parse_args()
    options.headless, options.patience = True, PATIENCE_S
    options.bin = ROOT / "build/release/bin"
    options.scenario = ROOT / "sim/scenarios/fig7.toml"
    print(f"load before: {os.getloadavg()[0]:.2f}; seed {options.seed}")
    rows: dict[bool, list[str]] = {True: [], False: []}
    delays: dict[bool, list[tuple[float, float]]] = {True: [], False: []}
    for number in range(options.runs):
        for signed in (True, False) if number % 2 == 0 else (False, True):
            with multiprocessing.get_context("spawn").Pool(1) as process:
                result = process.apply(measure, (options, signed))
            rows[signed].append(row(signed, result))
            delays[signed].append((result["latency"]["p50_s"], result["latency"]["p95_s"]))
    print(f"{'':9s} {'fixes':>6s} {'RMS m':>8s} {'p50 ms':>8s} {'p95 ms':>8s}")
    print("\n".join(rows[False] + rows[True]))
    p50, p95 = np.median(delays[True], axis=0) / np.median(delays[False], axis=0)
    print(f"signed over unsigned, medians of the runs: p50 {p50:.3f}, p95 {p95:.3f}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
