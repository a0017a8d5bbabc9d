"""How well ols-calibrate finds simulated instruments, and what it tells of itself.

For each case: the systematic error that is left, RMS of an axis over pan -150..150 and elevation
-5..30 degrees, and the told one over it.
"""

import argparse
import csv
import json
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

from .cases import CASES
from .model import ARCSEC, azimuth_elevation

ROOT = Path(__file__).resolve().parents[3]
NOT_WITHIN_LIMITS = 1  # of ols-calibrate: there are results, and a finding is bad
HORIZON_COUNTS = 3 / 360 * 112000
COLUMNS = "pan_counts,tilt_counts,approach_pan,approach_tilt,x_px,y_px,utime_us,station"


def volume(site, rng):
    """Rows to predict: (station, counts, approach, pixel)."""
    rows = []
    for one in site.stations:
        for pan in np.linspace(-150, 150, 13):
            for tilt in np.linspace(-5, 30, 6):
                counts = np.round(np.array([pan, tilt]) / 360 * 112000)
                rows.append((one, counts, rng.choice([-1, 1], 2), rng.uniform([0, 0], [1279, 959])))
    return rows


def predict_text(rows):
    lines = [COLUMNS]
    for one, counts, approach, pixel in rows:
        cells = [*counts, *approach, *pixel]
        lines.append(",".join(f"{cell:.6f}".rstrip("0").rstrip(".") for cell in cells))
        lines[-1] += f",0,{one.name}"
    return "\n".join(lines) + "\n"


def errors_of(rows, path):
    """(station, errors [cross-elevation, elevation], told 2x2) of each row, in radians."""
    with path.open() as file:
        for (one, counts, approach, pixel), row in zip(rows, csv.DictReader(file), strict=True):
            azimuth, elevation = azimuth_elevation(
                one.unit.look(one.unit.shafts(*counts, approach), pixel)
            )
            off = np.radians(float(row["azimuth_deg"])) - azimuth
            across = ((off + np.pi) % (2 * np.pi) - np.pi) * np.cos(elevation)
            up = np.radians(float(row["elevation_deg"])) - elevation
            cross, both, own = (
                float(row[key]) * np.radians(1) ** 2
                for key in ("cross_cross_deg2", "cross_elevation_deg2", "elevation_elevation_deg2")
            )
            yield one.name, np.array([across, up]), np.array([[cross, both], [both, own]])


def accepted_stars(report, true_names):
    """Of the detections that were accepted as a star: of the right one, of another one, of none."""
    counted = {"right": 0, "exchanged": 0, "false": 0}
    for row in report["residuals"]:
        if row["kind"] != "star" or row["rejected"]:
            continue
        truth = true_names[row["line"] - 1]
        if truth is None:
            counted["false"] += 1
        else:
            counted["right" if row["reference"] in truth else "exchanged"] += 1
    return counted


def measure(figure, rows, folder):
    """(actual squared, told squared) of one run, or whether the bad landmark was named."""
    report = json.loads((folder / "report.json").read_text())
    if figure == "named":
        rejected = [g["name"] for g in report["groups"] if g.get("rejected")]
        return rejected == ["landmark0"]
    if figure == "identified":
        return accepted_stars(report, rows[0][0].true_names)
    if figure == "offset":
        [found] = [
            one
            for one in report["stations"][0]["parameters"]
            if one["parameter"] == "exposure_offset_s"
        ]
        off = found["value"] - rows[0][0].unit.values["exposure_offset_s"]
        # Milliseconds: the table divides by an arc second.
        return (1e3 * ARCSEC * off) ** 2, (1e3 * ARCSEC * found["sd"]) ** 2
    if figure in rows[0][0].angles:
        [found] = [one for one in report["rectification"] if one["angle"] == figure]
        off = np.radians(found["value_deg"]) - rows[0][0].angles[figure]
        return off**2, (found["sd_arcsec"] * ARCSEC) ** 2
    errors = list(errors_of(rows, folder / "predictions.csv"))
    if figure == "systematic":
        actual = np.mean([error @ error / 2 for _, error, _ in errors])
        return actual, np.mean([np.trace(told) / 2 for _, _, told in errors])
    # The mean azimuth of the horizon, of each station.
    across = {}
    for (one, counts, _, _), (_, error, _) in zip(rows, errors, strict=True):
        if abs(counts[1]) < HORIZON_COUNTS:
            across.setdefault(one.name, []).append(error[0])
    means = [np.mean(one) for one in across.values()]
    if figure == "difference":
        told = report["heading_differences"][0]["sd_arcsec"] * ARCSEC
        return (means[0] - means[1]) ** 2, told**2
    return means[0] ** 2, (report["stations"][0]["mean_azimuth_sd_arcsec"] * ARCSEC) ** 2


def adjusted(program, site, folder, rows):
    """What the program says if it refuses; the results are in the folder's `out`."""
    for one in site.stations:
        if one.workshop is None:
            continue
        workshop = folder / f"{one.name}-workshop"
        workshop.mkdir()
        if failure := adjusted(program, one.workshop, workshop, []):
            return failure
    arguments = site.write(folder, predict_text(rows or volume(site, site.rng)))
    command = [program, "adjust", *arguments, "--output", folder / "out"]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=False)
    has_results = done.returncode in (0, NOT_WITHIN_LIMITS)
    return None if has_results else done.stderr.strip().splitlines()[-1]


def run(program, build, figure, seed):
    rng = np.random.default_rng(seed)
    with tempfile.TemporaryDirectory(prefix="ols-calibration-") as name:
        folder = Path(name)
        site = build(rng)
        rows = volume(site, rng)
        return adjusted(program, site, folder, rows) or measure(figure, rows, folder / "out")


def identification(row, identified):
    """What was not identified is a failure, and not a wrong one."""
    row["named"] = len(identified) / row["runs"]
    # Two stars exchanged, and false detections that were taken for stars.
    row |= {key: sum(r[key] for r in identified) for key in ("right", "exchanged", "false")}
    row["ok"] = row["named"] >= 0.95 and row["exchanged"] == 0 and row["false"] == 0
    return row


def judged(figure, limit, results):
    failures = [r for r in results if isinstance(r, str)]
    good = [r for r in results if not isinstance(r, str)]
    row = {"runs": len(results), "failed": len(failures), "limit": limit}
    if failures:
        row["failure"] = failures[0]
    if figure == "identified":
        return identification(row, good)
    if figure == "named":
        return row | {"named": sum(good) / len(results), "ok": sum(good) >= 0.95 * len(results)}
    if not good:
        return row | {"ok": False}
    actual, told = np.sqrt(np.mean(np.array(good), axis=0)) / ARCSEC
    # Of the root of the mean over the instruments drawn.
    error = np.std(np.array(good)[:, 0]) / np.sqrt(len(good)) / (2 * actual * ARCSEC) / ARCSEC
    ratio = told / actual
    ok = not failures and actual <= limit and 0.8 <= ratio <= 1.3
    row |= {"actual": actual, "standard_error": error, "told": told}
    return row | {"ratio": ratio, "ok": bool(ok)}


def shown(name, row):
    if "named" in row:
        figures = f"{100 * row['named']:12.0f} % named"
        if "false" in row:
            figures += f", {row['exchanged']} exchanged, {row['false']} false of {row['right']}"
    elif "actual" in row:
        unit, digits = (" ms", 3) if "[ms]" in name else ("″", 1)
        figures = (
            f"{row['actual']:8.{digits + 1}f}{unit} ±{row['standard_error']:.{digits + 1}f}"
            f" (≤ {row['limit']:g}{unit}) {row['ratio']:8.2f}"
        )
    else:
        figures = " " * 20
    note = f"   {row['failed']} failed: {row['failure']}" if row["failed"] else ""
    return f"{name:44} {figures:32} {'ok' if row['ok'] else 'MISSED'}{note}"


def write_site(arguments):
    """The files of the first case that is asked for, and the command that reads them."""
    name = next(name for name in CASES if (arguments.case or "") in name)
    arguments.write.mkdir(parents=True)
    rng = np.random.default_rng(arguments.seed)
    site = CASES[name][0](rng)
    command = site.write(arguments.write, predict_text(volume(site, rng)))
    print("ols-calibrate adjust", *command, "--output", arguments.write / "calibration")


def parser_of(doc):
    parser = argparse.ArgumentParser(description=doc.splitlines()[0])
    parser.add_argument("--instruments", type=int, default=40, help="of each case")
    parser.add_argument("--seed", type=int, default=1, help="of the first")
    parser.add_argument("--case", help="only those whose name contains this")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    return parser


def main():
    parser = parser_of(__doc__)
    parser.add_argument("--program", type=Path, default=ROOT / "build/release/bin/ols-calibrate")
    parser.add_argument("--report", type=Path, help="write the figures as JSON")
    parser.add_argument("--write", type=Path, help="only write one site's files into this folder")
    arguments = parser.parse_args()
    if arguments.write:
        write_site(arguments)
        return
    seeds = range(arguments.seed, arguments.seed + arguments.instruments)
    title = f"case, seeds {seeds[0]}..{seeds[-1]}"
    print(f"{title:44} {'actual':>9} {'told/actual':>20}")
    table = {}
    for name, (build, limit, figure) in CASES.items():
        if arguments.case and arguments.case not in name:
            continue
        with ThreadPoolExecutor(arguments.jobs) as pool:
            results = list(
                pool.map(lambda s, b=build, f=figure: run(arguments.program, b, f, s), seeds)
            )
        table[name] = judged(figure, limit, results)
        print(shown(name, table[name]), flush=True)
    if arguments.report:
        arguments.report.write_text(json.dumps(table, indent=2, default=float) + "\n")
    sys.exit(0 if all(row["ok"] for row in table.values()) else 1)


if __name__ == "__main__":
    main()
