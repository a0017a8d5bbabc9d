"""Measures the console with five stations that exist only as messages and video: from the
exposure to the pixels in a browser (by a number drawn into each picture), whether the overlay
is of the same frame, from a target's publication to the map, the processor for ten viewers,
first paint, size, memory with viewers coming and going. On a machine that does
nothing else; the load before is printed.
"""

import argparse
import os
import re
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from console_site import PLACES, Api, PaperSite, browser, console_command
from ols_demo.site import Site, bring_up_loopback

from ols_bench import console_live
from ols_bench.line import line
from ols_bench.paper_video import BIT_PX, BITS, CODE_Y_PX, FULL_PX, PaperVideo
from ols_bench.plain_viewer import PlainViewer
from ols_bench.processes import cpu_s, resident_bytes

ROOT = Path(__file__).resolve().parents[3]
PAGE = ROOT / "build/release/console/page/files"
STATIONS = {**PLACES, "delta": (49.229, 16.603), "echo": (49.232, 16.598)}
PATIENCE_S = 20.0

# In each frame of the browser: which frame of the video its canvas shows, whether the overlay of
# the same frame is on it, and when.
WATCHER = """(p) => {
  const seen = (window.seen = []);
  let before = -1;
  const look = () => {
    const c = document.querySelector('.eye.large canvas');
    const g = c?.getContext('2d');
    if (g && c.dataset.utimeUs) {
      const s = c.width / p.full[0];
      const row = g.getImageData(0, Math.round((p.codeY + p.bit / 2) * s), c.width, 1).data;
      let number = 0;
      for (let i = 0; i < p.bits; i++) {
        number = number * 2 + (row[4 * Math.round((100 + (i + 0.5) * p.bit) * s)] > 128 ? 1 : 0);
      }
      if (number !== before) {
        before = number;
        const [x, y] = [100 + (number * 131) % 1000, 300 + (number * 77) % 500];
        const d = g.getImageData(Math.round(x * s) - 6, Math.round(y * s) - 6, 14, 14).data;
        let marked = false;
        for (let i = 0; i < d.length; i += 4) {
          marked ||= Math.max(d[i], d[i + 1], d[i + 2]) - Math.min(d[i], d[i + 1], d[i + 2]) > 60;
        }
        const shown_ms = performance.timeOrigin + performance.now();
        seen.push([number, shown_ms, marked, Number(c.dataset.utimeUs)]);
      }
    }
    requestAnimationFrame(look);
  };
  look();
}"""


# In each frame of the browser: the newest target that the map has drawn, and when.
MAP_WATCHER = """() => {
  const seen = (window.targets = []);
  const map = document.querySelector('.map-canvas');
  const look = () => {
    const utime_us = Number(map.dataset.newestUs ?? 0);
    const shown_ms = performance.timeOrigin + performance.now();
    if (utime_us && utime_us !== seen.at(-1)?.[0]) seen.push([utime_us, shown_ms]);
    requestAnimationFrame(look);
  };
  look();
}"""


class Bench:
    """A console, and five stations of paper with video."""

    def __init__(self, site: Site, folder: Path, rate_hz: float):
        PLACES.update(STATIONS)
        self.paper = PaperSite()
        self.videos = {name: PaperVideo(name, 1.0 / rate_hz) for name in STATIONS}
        self.rate_hz = rate_hz
        for name, video in self.videos.items():
            self.paper.devices[name] = {"video": video.address}
        self.paper.start()
        site.start_and_wait("console", console_command(folder / "nobody", "--port", "0"), "ready")
        self.pid = site.processes["console"].pid
        self.address = re.findall(r"ready: (\S+)", (site.logs / "console.log").read_text())[-1]

    def focus(self, frames: int) -> None:
        """From the exposure to the pixels, and whether picture and overlay belong together."""
        with browser() as chromium:
            page = chromium.new_page(viewport={"width": 1500, "height": 900})
            page.goto(self.address)
            page.wait_for_selector(".eye.large canvas[data-utime-us]", timeout=PATIENCE_S * 1000)
            options = {"full": FULL_PX, "codeY": CODE_Y_PX, "bit": BIT_PX, "bits": BITS}
            page.evaluate(WATCHER, options)
            page.wait_for_function(
                "(n) => window.seen.length >= n", arg=frames, timeout=0, polling=500
            )
            seen = page.evaluate("window.seen")
            paint = page.evaluate(
                "performance.getEntriesByName('first-contentful-paint')[0]?.startTime"
            )
        exposed = self.videos[sorted(STATIONS)[0]].exposed_us
        known = [(n, ms, marked, utime) for n, ms, marked, utime in seen if n in exposed]
        delays = np.array([ms - exposed[n] / 1000 for n, ms, _, _ in known])
        wrong = sum(not marked or exposed[n] != utime for n, _, marked, utime in known)
        p50, p95 = np.percentile(delays, [50, 95])
        line(
            "exposure to pixels in the focus view",
            f"p50 {p50:.0f} ms, p95 {p95:.0f} ms",
            "<= 150 ms, with a camera's 16 ms more",
        )
        line("overlay of another frame than the picture", f"{wrong} of {len(known)}", "0 of 1000")
        line("first paint of the page", f"{paint:.0f} ms", "<= 1000 ms")

    def targets(self, count: int) -> None:
        """From the publication of a target to the map."""
        with browser() as chromium:
            page = chromium.new_page(viewport={"width": 1500, "height": 900})
            page.goto(self.address)
            page.wait_for_selector(
                ".map-canvas[data-newest-us]", state="attached", timeout=PATIENCE_S * 1000
            )
            page.evaluate(MAP_WATCHER)
            page.wait_for_function(
                "(n) => window.targets.length >= n", arg=count, timeout=0, polling=500
            )
            seen = page.evaluate("window.targets")
        delays = np.array([shown_ms - utime_us / 1000 for utime_us, shown_ms in seen[1:]])
        p50, p95 = np.percentile(delays, [50, 95])
        line(
            f"target published to drawn on the map, {len(delays)} of them",
            f"p50 {p50:.0f} ms, p95 {p95:.0f} ms",
            "<= 100 ms",
        )

    def size(self) -> None:
        total = sum(path.stat().st_size for path in PAGE.glob("*.gz"))
        line("the page, gzipped", f"{total / 1000:.0f} kB", "<= 700 kB without 3-D")

    def viewers(self, count: int, seconds: float) -> None:
        idle = self._cores(seconds / 2)
        viewers = [PlainViewer(self.address, list(STATIONS)) for _ in range(count)]
        for viewer in viewers:
            viewer.start()
        time.sleep(2.0)
        sent = {name: video.sent for name, video in self.videos.items()}
        cores = self._cores(seconds)
        pulled = sum(v.sent - sent[n] for n, v in self.videos.items()) / seconds / len(STATIONS)
        megabits = 8e-6 * sum(viewer.bytes for viewer in viewers) / (seconds + 2.0)
        for viewer in viewers:
            viewer.end()
        line(
            f"console's processor, {count} viewers, {len(STATIONS)} stations, {self.rate_hz:g} Hz",
            f"{cores:.2f} cores (idle {idle:.2f})",
            "<= 0.5 cores",
        )
        line("frames pulled of each station, and sent", f"{pulled:.1f} Hz, {megabits:.1f} Mb/s", "")

    def _cores(self, seconds: float) -> float:
        before, start = cpu_s(self.pid), time.monotonic()
        time.sleep(seconds)
        return (cpu_s(self.pid) - before) / (time.monotonic() - start)

    def memory(self, seconds: float) -> None:
        """Browsers come, look for half a second and go."""
        api, visits, readings = Api(self.address), 0, []
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            viewers = [PlainViewer(self.address, list(STATIONS)) for _ in range(5)]
            for viewer in viewers:
                viewer.start()
            for path in ("/", "/page.js", "/api/state"):
                api.ask(path)
            time.sleep(0.3)
            for viewer in viewers:
                viewer.end()
            visits += len(viewers)
            readings.append((time.monotonic(), resident_bytes(self.pid), visits))
        settled = np.array(readings[len(readings) // 3 :], float)
        slope = np.polyfit(settled[:, 2], settled[:, 1], 1)[0]  # a visit
        line(
            f"memory after {visits} visits in {seconds:.0f} s",
            f"{readings[-1][1] / 1e6:.1f} MB, {slope:+.0f} B a visit",
            "flat",
        )


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="tools/bench console", description=__doc__)
    parser.add_argument("--rate", type=float, default=5.0, help="of each station's video [Hz]")
    parser.add_argument("--frames", type=int, default=1000, help="that the browser is watched for")
    parser.add_argument("--targets", type=int, default=100, help="that the map is watched for")
    parser.add_argument("--viewers", type=int, default=10)
    parser.add_argument("--seconds", type=float, default=20.0, help="of the viewers' measure")
    parser.add_argument("--memory", type=float, default=60.0, help="seconds of visits")
    parser.add_argument("--only-memory", action="store_true", help="nothing but the visits")
    parser.add_argument("--live", action="store_true", help="with the demo's site instead")
    parser.add_argument("--drags", type=int, default=20, help="of a box, live")
    parser.add_argument("--seed", type=int, default=1, help="of the live site")
    return parser.parse_args()


def main() -> int:
    options = arguments()
    if options.live:
        return console_live.main(options)
    bring_up_loopback([])
    load = os.getloadavg()[0]
    with tempfile.TemporaryDirectory() as folder, Site(Path(folder) / "logs") as site:
        bench = Bench(site, Path(folder), options.rate)
        print(f"load of this computer before: {load:.1f} on {os.cpu_count()} processors")
        if not options.only_memory:
            bench.size()
            bench.viewers(options.viewers, options.seconds)
            bench.focus(options.frames)
            bench.targets(options.targets)
        bench.memory(options.memory)
        site.check()
    return 0


if __name__ == "__main__":
    sys.exit(main())
