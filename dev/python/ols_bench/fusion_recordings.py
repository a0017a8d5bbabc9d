"""See tools/bench fusion-recordings: the filter beside least squares, at the same instants.

Each folder holds stations.csv, bearings.csv (as ols-fuse reads them) and truth.csv (utime_us,
latitude_deg, longitude_deg, height_m, phase: only `test` is judged). Fixes between two epochs of
the truth that are less than half a second apart are compared with the straight line between them.
"""

import argparse
import csv
import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import ols
from ols_demo.places import geodetic

GAP_US = 500_000
# Errors are alike for some seconds: a ratio is as sure as so many independent pieces make it.
BLOCK_US = 3_000_000
LEAST_BLOCKS = 10
MOST_RATIO = 1.02
OPTIONS = {
    "least squares": ["--estimator", "least-squares"],
    "filter": [],
    "smoothed": ["--smooth"],
}
SD_COLUMNS = ("east_sd_m", "north_sd_m", "up_sd_m")


def rows_of(path):
    with Path(path).open(newline="") as file:
        return list(csv.DictReader(file))


def ecef(row):
    place = geodetic(*(float(row[key]) for key in ("latitude_deg", "longitude_deg", "height_m")))
    return ols.ecef_from_geodetic(place), place


def bearings_of(folder, stations, scratch):
    """The recording's bearings, or those of some of its stations."""
    if not stations:
        return folder / "bearings.csv"
    path = scratch / "bearings.csv"
    with (folder / "bearings.csv").open() as source, path.open("w") as some:
        header = next(source)
        column = header.strip().split(",").index("station")
        some.write(header)
        some.writelines(line for line in source if line.split(",")[column] in stations)
    return path


def fixes_of(program, folder, bearings, options, scratch):
    output = scratch / "fixes.csv"
    output.unlink(missing_ok=True)
    files = ["--stations", folder / "stations.csv", "--bearings", bearings, "--output", output]
    subprocess.run([program, *map(str, files), *options], check=True, stderr=subprocess.DEVNULL)
    return rows_of(output)


def errors_of(folder, fixes):
    """By instant: the error in east, north, up at the target [m], and its stated 1-sigma."""
    truth = sorted(rows_of(folder / "truth.csv"), key=lambda row: int(row["utime_us"]))
    times = np.array([int(row["utime_us"]) for row in truth])
    points = [ecef(row) for row in truth]
    judged = [row["phase"] == "test" for row in truth]
    errors = {}
    for fix in fixes:
        utime_us = int(fix["utime_us"])
        after = min(int(np.searchsorted(times, utime_us)), len(times) - 1)
        before = after if times[after] == utime_us else max(after - 1, 0)
        inside = times[before] <= utime_us <= times[after]
        if not inside or times[after] - times[before] >= GAP_US:
            continue
        if not (judged[before] and judged[after]):
            continue
        share = (utime_us - times[before]) / max(times[after] - times[before], 1)
        true = (1.0 - share) * points[before][0] + share * points[after][0]
        off = np.array(
            ols.LocalFrame(points[before][1]).to_enu(points[before][0] + ecef(fix)[0] - true)
        )
        errors[utime_us] = (off, np.array([float(fix[column]) for column in SD_COLUMNS]))
    return errors


def figures_of(errors, instants):
    off = np.array([errors[instant][0] for instant in instants])
    sd = np.array([errors[instant][1] for instant in instants])
    size = np.linalg.norm(off, axis=1)
    sizes = (np.median(size), math.sqrt((size**2).mean()), np.percentile(size, 95))
    return np.array(sizes), ((off / sd) ** 2).mean(0)


def ratio_interval(own, reference, instants, draws=1000):
    """Of the ratios of median, RMS and 95 %: their 95 % interval (2 x 3), by a block bootstrap.

    Both are drawn at the same instants. H. R. Kuensch, "The jackknife and the bootstrap for general
    stationary observations", Annals of Statistics 17(3), 1989.
    """
    times = np.array(instants)
    first = np.searchsorted(times, np.arange(times[0], times[-1] + 1, BLOCK_US))
    blocks = [block for block in np.split(np.arange(len(times)), first[1:]) if len(block) > 0]
    random = np.random.default_rng(1)
    ratios = []
    for _ in range(draws):
        drawn = np.concatenate([blocks[i] for i in random.integers(len(blocks), size=len(blocks))])
        some = [instants[i] for i in drawn]
        ratios.append(figures_of(own, some)[0] / figures_of(reference, some)[0])
    return np.percentile(ratios, [2.5, 97.5], axis=0), len(blocks)


def steps_of_truth(folder, errors):
    """Where the truth's height steps and the fixes' does not: (time, error before, after) [us, m].

    Between neighbouring epochs of the truth, beyond 5 cm and far beyond what is usual.
    """
    instants = np.array(sorted(errors))
    up_m = np.array([errors[instant][0][2] for instant in instants])
    epochs = np.array(sorted(int(row["utime_us"]) for row in rows_of(folder / "truth.csv")))
    next_fix = np.clip(np.searchsorted(instants, epochs), 1, len(instants) - 1)
    is_near = instants[next_fix] - instants[next_fix - 1] < GAP_US // 5
    at_m = np.interp(epochs, instants, up_m)
    is_step = is_near[1:] & is_near[:-1] & (np.diff(epochs) < GAP_US)
    change_m = np.abs(np.diff(at_m))
    is_step &= change_m > max(0.05, 10.0 * np.median(change_m[is_step]))
    return [(int(epochs[i]), at_m[i], at_m[i + 1]) for i in np.flatnonzero(is_step)]


def report_steps(folder, errors):
    for utime_us, before_m, after_m in steps_of_truth(folder, errors):
        print(
            f"  after {utime_us} the truth steps by {before_m - after_m:+.3f} m of height:"
            f" error {before_m:+.3f}, then {after_m:+.3f} m"
        )


def report(program, folder, options):
    stations, smooth = options.stations, options.smooth
    with tempfile.TemporaryDirectory() as scratch:
        bearings = bearings_of(folder, stations, Path(scratch))
        errors = {
            name: errors_of(folder, fixes_of(program, folder, bearings, options, Path(scratch)))
            for name, options in OPTIONS.items()
            if smooth or name != "smoothed"
        }
    left_out = options.without or (0, 0)
    instants = sorted(set.intersection(*map(set, errors.values())))
    instants = [instant for instant in instants if not left_out[0] <= instant < left_out[1]]
    print(
        f"{folder.name}{' of ' + ','.join(stations) if stations else ''}: {len(instants)} instants"
    )
    if not instants:
        return True
    reference, _ = figures_of(errors["least squares"], instants)
    good = True
    for name, own in errors.items():
        sizes, nees = figures_of(own, instants)
        shown = "".join(f"{size:9.3f}" for size in sizes) + " m  ratio"
        shown += "".join(f"{ratio:6.2f}" for ratio in sizes / reference)
        print(f"  {name:14s}{shown}  NEES" + "".join(f"{value:6.2f}" for value in nees))
        if name != "least squares":
            (low, high), blocks = ratio_interval(own, errors["least squares"], instants)
            told = blocks >= LEAST_BLOCKS
            worse = told and name == "filter" and bool((low > MOST_RATIO).any())
            good &= not worse
            between = "  ".join(f"{a:.2f} to {b:.2f}" for a, b in zip(low, high, strict=True))
            known = f"ratios between {between}" if told else "too short for an interval"
            print(f"    {known} (pieces: {blocks}){'  SURELY WORSE' if worse else ''}")
    if options.steps:
        report_steps(folder, {instant: errors["filter"][instant] for instant in instants})
    return good


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--fuse", default="build/release/bin/ols-fuse", help="the program")
    parser.add_argument("--stations", default="", help="some of the stations only, as 0,3")
    parser.add_argument("--smooth", action="store_true", help="the smoothed filter, too")
    parser.add_argument(
        "--without", type=int, nargs=2, metavar="UTIME", help="leave out from .. to [us]"
    )
    parser.add_argument(
        "--steps",
        action="store_true",
        help="where the truth's height steps and the filter's does not",
    )
    parser.add_argument("folders", nargs="+", type=Path)
    options = parser.parse_args()
    options.stations = [name for name in options.stations.split(",") if name]
    print("median, RMS, 95 % of the error; its ratio to least squares; NEES of east, north, up")
    good = [report(options.fuse, folder, options) for folder in options.folders]
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
