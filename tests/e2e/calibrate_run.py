"""A simulated site's files, and ols-calibrate on them."""

import json
import os
from pathlib import Path

import numpy as np
from conftest import BIN, finished
from ols_calibration import cases

SEED = 20260120
PREDICT = "pan_counts,tilt_counts,approach_pan,approach_tilt,x_px,y_px,utime_us\n"


class Run:
    """A simulated site's files in a folder, and ols-calibrate on them."""

    def __init__(self, folder, build=cases.rtk_landmarks):
        self.folder = folder
        self.site = build(np.random.default_rng(SEED))
        self.one = self.site.stations[0]
        self.output = folder / "out"
        self.arguments = self.site.write(folder, PREDICT + "1000,2000,1,-1,600,500,0\n")

    def lines(self, name):
        return (self.folder / name).read_text().splitlines()

    def change(self, name, line, old, new):
        """In one line of a file, counted from 1."""
        lines = self.lines(name)
        assert old in lines[line - 1]
        lines[line - 1] = lines[line - 1].replace(old, new, 1)
        (self.folder / name).write_text("\n".join(lines) + "\n")

    def observations(self):
        return [json.loads(line) for line in self.lines("observations.jsonl")]

    def observe(self, observations):
        lines = (json.dumps(one) + "\n" for one in observations)
        (self.folder / "observations.jsonl").write_text("".join(lines))

    def adjust(self, *more):
        return finished(
            BIN / "ols-calibrate", "adjust", *self.arguments, "--output", self.output, *more
        )

    def adjusted(self, *more):
        """With results: 0, or 1 and each bad finding said."""
        done = self.adjust(*more)
        assert done.returncode in (0, 1), done.stderr
        bad = [
            finding["sentence"]
            for station in self.report()["stations"]
            for finding in station["acceptance"]["findings"]
            if finding["judgement"] == "bad"
        ]
        assert done.returncode == (1 if bad else 0), done.stderr
        for sentence in bad:
            assert sentence in done.stderr
        return done

    def refused(self, *more):
        """What is said of it; nothing is written."""
        existed = os.path.exists(self.output)
        done = self.adjust(*more)
        assert done.returncode == 2
        assert os.path.exists(self.output) == existed
        return done.stderr

    def report(self):
        return json.loads(Path(self.output, "report.json").read_text())

    def rejected(self):
        return [group["name"] for group in self.report()["groups"] if group.get("rejected")]
