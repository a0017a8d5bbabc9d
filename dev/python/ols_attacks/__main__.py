"""Attacks a live simulated site that requires signatures: forged, replayed, mis-addressed and
stale commands, by other roles and to other boots; bearings of invented stations and in real
names, hostile values, statuses, a recording, a flood. Each at the greatest rate that the bus
carries. Prints what was sent, what became of it, and how well the site tracked meanwhile;
out/attacks/attacks.json has the same. On a machine that does nothing else; the load before is
printed.
"""

import argparse
import json
import math
import multiprocessing
import os
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from ols_bench import markdown
from ols_bench.processes import datagrams_dropped, resident_bytes
from ols_demo.__main__ import Run
from ols_demo.site import Site, SiteError, bring_up_loopback
from ols_demo.wiring import Wiring, add_site_options

from ols_attacks.attacks import Attack, Known, all_attacks, stolen_key
from ols_attacks.sender import send
from ols_attacks.watch import Watch

ROOT = Path(__file__).resolve().parents[3]
ITSELF_S = 60.0  # until the site must be itself again
ENOUGH = 0.8  # of the fixes a second that there were before
MOST_ERROR = 1.05  # of that without an attack
LATEST_S = 5.0  # after an attack: itself again
SETTLE_S = 1.5  # at most, for what waits in queues after an attack
HEADINGS = (
    *("attack", "sent", "1/s", "refused, by reason", "dropped", "lost track of", "obeyed"),
    *("not tracking", "false targets", "fixes/s", "error m", "offset px"),
    *("bearing ms p50, p99", "target ms p50, p99", "fusion MB", "itself after s"),
)


def arguments(words: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="tools/bench attacks", description=__doc__)
    parser.add_argument("--seconds", type=float, default=10.0, help="of each attack [s]")
    parser.add_argument("--most", type=float, default=100_000.0, help="messages a second")
    parser.add_argument("--names", type=int, default=100_000, help="invented names")
    parser.add_argument("--only", help="attacks whose name has this in it")
    add_site_options(parser, "fig7", "attacks")
    parser.add_argument("--patience", type=float, default=90.0, help="until all track [s]")
    options = parser.parse_args(words)
    options.headless = True
    return options


class Bench:
    """A tracking site, and what is done to it."""

    def __init__(self, options: argparse.Namespace, site: Site, wiring: Wiring):
        self._options, self._site = options, site
        self.stations = wiring.tracking_stations
        self.watch = Watch(wiring.keys["OLS_KEYS"], self.stations)
        self._keys = wiring.keys["OLS_KEYS"]
        self.usual: dict[str, Any] = {}

    def _pid(self, victim: str) -> int:
        name = "ols-fusion" if victim == "fusion" else f"ols-station-{victim}"
        return self._site.processes[name].pid

    def memory(self) -> dict[str, float]:
        return {name: resident_bytes(self._pid(name)) / 1e6 for name in ("fusion", *self.stations)}

    def calm(self, name: str) -> dict[str, Any]:
        self.watch.begin()
        self.watch.handle(self._options.seconds)
        return {"attack": name, **self.watch.figures(), "memory_mb": self.memory()}

    def known(self) -> Known:
        heard = self.watch.eavesdropped()
        return Known(self._keys, self.stations, heard, self._options.names, self._options.seconds)

    def suffered(self, make: Callable[[Known], Attack]) -> list[dict[str, Any]]:
        """None if it is not among the wanted ones."""
        attack = make(self.known())
        if self._options.only and self._options.only not in attack.name:
            return []
        print(f"{attack.name}: {len(attack.messages)} messages, again and again", flush=True)
        return [self.suffer(attack)]

    def suffer(self, attack: Attack) -> dict[str, Any]:
        pid, watch = self._pid(attack.victim), self.watch
        before, lost, obeyed = (
            watch.counted(attack.victim),
            datagrams_dropped(pid),
            watch.obeyed(),
        )
        sent = self._while_attacked(attack, pid)
        row = {"attack": attack.name, "sent": sent, **watch.figures()}
        if not attack.may_be_believed:  # else that name is silent until its key is revoked
            row["itself_after_s"] = self._until_itself(time.monotonic())
        end = time.monotonic() + SETTLE_S
        while True:
            after = watch.counted(attack.victim)
            row["refused"] = {
                reason: int(count - before.get(reason, 0.0))
                for reason, count in after.items()
                if count > before.get(reason, 0.0)
            }
            row["dropped"] = datagrams_dropped(pid) - lost
            if sum(row["refused"].values()) + row["dropped"] >= sent or time.monotonic() > end:
                break
        # What the kernel drops is others' too: some fewer than none may remain.
        row["lost_track_of"] = sent - sum(row["refused"].values()) - row["dropped"]
        if attack.may_be_believed:
            row["believed"] = row.pop("lost_track_of")
        row["obeyed"] = int(watch.obeyed() - obeyed)
        row["rate_hz"] = sent / self._options.seconds
        row["memory_mb"] = self.memory()
        self._site.check()
        return row

    def _while_attacked(self, attack: Attack, pid: int) -> int:
        context = multiprocessing.get_context("forkserver")
        context.set_forkserver_preload(["ols_attacks.sender"])
        report = context.Queue()
        # An attack at a rate of its own keeps it; the others go as fast as the bus carries.
        most = min(attack.most_hz, self._options.most)
        words = (attack.messages, self._options.seconds, most, attack.most_hz, pid, report)
        sender = context.Process(target=send, args=words, daemon=True)
        sender.start()
        # What came while it was made must not count as late.
        while report.empty():
            self.watch.handle(0.02)
        report.get()  # it begins
        self.watch.begin()
        while sender.is_alive():
            self.watch.handle(0.2)
        sender.join()
        if sender.exitcode != 0:
            raise SiteError(f"the sender ended with status {sender.exitcode}")
        return report.get()

    def _until_itself(self, over: float) -> float | None:
        """None: not within ITSELF_S."""
        watch = self.watch
        while time.monotonic() < over + ITSELF_S:
            if watch.follows() and watch.fix_rate_hz() >= ENOUGH * self.usual["fixes_hz"]:
                return time.monotonic() - over
            watch.handle(0.1)
        return None


def shown(value: float | None, decimals: int) -> str:
    return "–" if value is None else f"{value:.{decimals}f}"


def pair_ms(pair: list[float] | None) -> str:
    return "–" if pair is None else f"{1e3 * pair[0]:.0f}, {1e3 * pair[1]:.0f}"


def table(rows: list[dict[str, Any]]) -> str:
    lines = []
    for row in rows:
        refused = ", ".join(f"{count} {reason}" for reason, count in row.get("refused", {}).items())
        attacked = [
            *(str(row.get("sent", "")), f"{row['rate_hz']:.0f}" if "rate_hz" in row else ""),
            *(refused, *(str(row.get(n, "")) for n in ("dropped", "lost_track_of", "obeyed"))),
        ]
        again = shown(row["itself_after_s"], 1) if "itself_after_s" in row else ""
        figures = [
            *(str(row["away"]), str(row["false_targets"]), shown(row["fixes_hz"], 1)),
            *(shown(row["error_m"], 3), shown(row["offset_px"], 1)),
            *(pair_ms(row["bearing_s"]), pair_ms(row["target_s"])),
            *(f"{row['memory_mb']['fusion']:.1f}", again),
        ]
        lines.append([row["attack"], *attacked, *figures])
    return markdown.table(HEADINGS, lines)


def falls_short(rows: list[dict[str, Any]]) -> list[str]:
    """In what an attacked site is worse than it may be. It says something only on a machine whose
    processors the attacker does not share with the site, and of attacks of some length."""
    calm = [row for row in rows if "sent" not in row]
    usual_m = max((row["error_m"] for row in calm if row["error_m"] is not None), default=math.nan)
    lines = []
    for row in rows:
        if "sent" not in row:
            continue
        if "believed" in row:  # one station of several is gone
            if row["fixes_hz"] < ENOUGH * calm[0]["fixes_hz"]:
                lines.append(f"{row['attack']}: {row['fixes_hz']:.1f} fixes a second")
            continue
        found = {
            f"{row['away']} statuses of stations that do not track": row["away"] > 0,
            f"error {shown(row['error_m'], 3)} m, {usual_m:.3f} m without": row["error_m"] is None
            or row["error_m"] > MOST_ERROR * usual_m,
            "itself again too late": row["itself_after_s"] is None
            or row["itself_after_s"] > LATEST_S,
        }
        lines += [f"{row['attack']}: {what}" for what, is_so in found.items() if is_so]
    return lines


def run(options: argparse.Namespace) -> list[dict[str, Any]]:
    wiring = Wiring(options.bin, options.scenario, options.seed, options.output, signed=True)
    rows = []
    bring_up_loopback(wiring.prepare())
    with Site(options.output / "logs") as site:
        wiring.start(site, log=False)
        person = Run(options, wiring.keys["OLS_KEYS"])
        person.designate(site, wiring.tracking_stations)
        del person  # nobody commands from now on
        bench = Bench(options, site, wiring)
        bench.watch.handle(3.0)
        bench.usual = bench.calm("none, before")
        rows.append(bench.usual)
        for make in all_attacks(options.names):
            rows += bench.suffered(make)
        rows.append(bench.calm("none, after"))
        rows += bench.suffered(stolen_key)
    return rows


def main(words: list[str] | None = None) -> int:
    options = arguments(words)
    options.output.mkdir(parents=True, exist_ok=True)
    load = os.getloadavg()[0]
    print(f"load before: {load:.2f}")
    try:
        rows = run(options)
    except SiteError as error:
        print(f"tools/bench attacks: {error}", file=sys.stderr)
        return 1
    (options.output / "attacks.json").write_text(
        json.dumps({"load": load, "processors": os.cpu_count(), "rows": rows}, indent=1) + "\n"
    )
    text = table(rows)
    (options.output / "attacks.md").write_text(text + "\n")
    print(text)
    for name, before in rows[0]["memory_mb"].items():
        print(f"memory of {name}: {before:.1f} MB before, {rows[-1]['memory_mb'][name]:.1f} after")
    for line in falls_short(rows):
        print(f"falls short: {line}")
    bad = [
        row["attack"]
        for row in rows
        if row["false_targets"] or row.get("obeyed") or row.get("lost_track_of", 0) > 0
    ]
    if bad:
        print("an attack moved something, or was lost track of:", ", ".join(bad))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
