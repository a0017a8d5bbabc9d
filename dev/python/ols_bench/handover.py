"""Measures hand-overs between two regions: a target flies to and fro over their border, seen by
the stations of a site; fusions, bridges, leaf, hub and the store of owners are the real ones.
In half of the crossings whoever owns the target is killed at a random moment: its fusion, or
its fusion and its bridge. On a machine that does nothing else; a crossing takes ten seconds.
"""

import argparse
import itertools
import math
import os
import random
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import bridge_site
import lcm
import numpy as np
import ols_msg
from ols_demo.site import Site, bring_up_loopback

from ols_bench import bridge, fusion_load

STATIONS, RATE_HZ = 4, 15.0
WIDE_M, HIGH_M, CROSSING_S = 200.0, 90.0, 10.0
MARGIN_M = 60.0  # less than the default of 2 km, so that a crossing takes no minutes
CELLS = {"west": "[49.0, 16.0, 50.0, 16.6]", "east": "[49.0, 16.6, 50.0, 17.0]"}
BUSES = {"west": bridge_site.bus_url(7668), "east": bridge_site.bus_url(7669)}
RESTART_S = 1.0  # as the service manager's
MOST_GAP_S, LEAST_KEPT = 2.0, 0.99


def ownership(name: str) -> str:
    return (
        f'[ownership]\nshare = true\nname = "{name}"\ndomain = "hub"\n'
        f"cell_deg = {CELLS[name]}\nmargin_m = {MARGIN_M}\n"
    )


class Network(bridge.Network):
    def _hub(self, text: str) -> str:
        return super()._hub(text).replace('"ols.v1.r.target"', '"ols.v1.*.target"')


class Stations(fusion_load.Stations):
    def places(self, time_s: float) -> list[np.ndarray]:
        """West of the border at the even multiples of CROSSING_S, east of it at the others."""
        east_m = -WIDE_M * math.cos(math.pi * time_s / CROSSING_S)
        return [fusion_load.SITE.to_ecef(np.array([east_m, 30.0, HIGH_M]))]


class World:
    """A site, two regions, and what a receiver of targets hears."""

    def __init__(self, folder: Path, site: Site):
        self.net = Network(folder, region_tail=ownership("west"))
        self.site = site
        east = bridge_site.Bridge(
            *(folder, "east", BUSES["east"], self.net.seeds["region"], self.net.keys["region"]),
            port=4222,
            head='role = "region"\nregion = "q"\ntakes = ["r.*.*"]\ntargets = true\n',
            tail=ownership("east"),
        )
        self.bridges = {"west": self.net.region, "east": east}
        self.due: list[tuple[float, str]] = []  # when a killed one starts again
        for name in self.bridges:
            self.start_fusion(name)
        self.stations = Stations(STATIONS, 1, 1, lcm.LCM(self.net.site_url))
        self.watcher = bridge_site.Watcher(4222, "ols.v1.*.target")
        self.begin_s, self.exposure = time.time(), 0

    def start_fusion(self, name: str) -> None:
        program = str(bridge_site.BIN / "ols-fusion")
        self.site.start(f"fusion-{name}", [program, "--lcm-url", BUSES[name]])

    def kill(self, name: str, with_bridge: bool) -> None:
        process = self.site.processes.pop(f"fusion-{name}")
        process.kill()
        process.wait()
        if with_bridge:
            self.bridges[name].process.kill()
            self.bridges[name].process.wait()
        self.due.append((time.monotonic() + RESTART_S, name))

    def restart(self) -> None:
        while self.due and time.monotonic() > self.due[0][0]:
            name = self.due.pop(0)[1]
            self.start_fusion(name)
            if self.bridges[name].process.poll() is not None:
                self.bridges[name].spawn()

    def fly(self, until_s: float) -> Iterator[float]:
        """Until this time of the flight; yields it after each exposure."""
        while (time_s := self.exposure / RATE_HZ) < until_s:
            due_s = self.begin_s + time_s
            time.sleep(max(0.0, due_s - time.time()))
            for channel, data in self.stations.encoded(time_s, round(1e6 * due_s)):
                self.stations.bus.publish(channel, data)
            self.exposure += 1
            self.restart()
            yield time_s

    def heard(self) -> list[tuple[float, str, str, int, bool]]:
        """(when, of which region, region-wide id, epoch, confirmed) of each published target."""
        return [
            (
                at,
                "west" if subject == "ols.v1.r.target" else "east",
                headers["Ols-Target"],
                int(headers["Ols-Epoch"]),
                "Ols-Unconfirmed" not in headers,
            )
            for at, subject, headers, data in list(self.watcher.heard)
            if ols_msg.target_t.decode(data).solution == ols_msg.target_t.SOLUTION_OK
        ]

    def close(self) -> None:
        self.watcher.close()
        assert self.bridges["east"].stop() == 0
        self.net.close()


def cross(world: World, number: int, kill_s: float | None, with_bridge: bool) -> str:
    """Returns whom it killed."""
    killed = ""
    for time_s in world.fly((number + 1) * CROSSING_S):
        if kill_s is not None and not killed and time_s >= number * CROSSING_S + kill_s:
            killed = world.heard()[-1][1]
            world.kill(killed, with_bridge)
    return killed


def longest_gap_s(heard: list) -> float:
    return max((b[0] - a[0] for a, b in itertools.pairwise(heard)), default=0.0)


def judge(heard: list, ids: list[str], owners: list[str], crossings: int) -> bool:
    gap_s = longest_gap_s(heard)
    greatest, back = 0, 0
    publishers: dict[int, set[str]] = {}
    for _, region, _, epoch, is_confirmed in heard:
        back += is_confirmed and epoch < greatest
        greatest = max(greatest, epoch)
        publishers.setdefault(epoch, set()).add(region)
    shared = sum(len(regions) > 1 for regions in publishers.values())
    kept = sum(one == other for one, other in itertools.pairwise(ids))
    sides = sum(owner == ("west" if i % 2 == 0 else "east") for i, owner in enumerate(owners))
    print(f"longest gap {gap_s:.2f} s (at most {MOST_GAP_S:g})")
    print(
        f"two owners at one instant: {back} messages after a greater epoch, {shared} epochs of two"
    )
    print(
        f"identity kept in {kept} of {crossings}; owners: {len(publishers)}, {len(heard)} messages"
    )
    print(f"ended with the owner whose region it is in: {sides - 1} of {crossings}")
    return gap_s <= MOST_GAP_S and back == 0 and shared == 0 and kept >= LEAST_KEPT * crossings


def run(options: argparse.Namespace, world: World) -> bool:
    draw = random.Random(options.seed)
    for _ in world.fly(2 * CROSSING_S):  # tracks, and an owner
        pass
    first = len(world.heard()) - 1
    ids, owners = [world.heard()[-1][2]], [world.heard()[-1][1]]
    begin = first
    for number in range(options.crossings):
        kill_s = draw.uniform(0.0, CROSSING_S) if number % 4 < 2 else None
        killed = cross(world, number + 2, kill_s, with_bridge=number % 2 == 1)
        ids.append(world.heard()[-1][2])
        owners.append(world.heard()[-1][1])
        gap_s = longest_gap_s(world.heard()[begin:])
        begin = len(world.heard()) - 1
        what = f", killed {killed} after {kill_s:.1f} s" if killed else ""
        what += " with its bridge" if killed and number % 2 == 1 else ""
        print(f"{number + 1:3}: {owners[-1]} has it, longest gap {gap_s:.2f} s{what}")
    return judge(world.heard()[first:], ids, owners, options.crossings)


def main() -> int:
    parser = argparse.ArgumentParser(prog="tools/bench handover")
    parser.add_argument("--crossings", type=int, default=100)
    parser.add_argument("--seed", type=int, default=23)
    options = parser.parse_args()
    print(f"load before: {os.getloadavg()[0]:.2f}; seed {options.seed}")
    bring_up_loopback([])
    with tempfile.TemporaryDirectory() as folder, Site(Path(folder)) as site:
        world = World(Path(folder), site)
        try:
            is_well = run(options, world)
        finally:
            world.close()
    return 0 if is_well else 1


if __name__ == "__main__":
    raise SystemExit(main())
