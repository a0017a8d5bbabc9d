"""Runs the paper's experiments in the simulation, and writes docs/accuracy.md's figures and tables.

tools/accuracy-report [--runs DIR] [--seeds N] [--jobs N]
"""

import argparse
import os
import re
import subprocess
from pathlib import Path

import numpy as np
import ols

from ols_accuracy import plan, run_plots, theory_plots
from ols_accuracy.runs import (
    PROGRAMS,
    ROOT,
    Run,
    budget_run,
    horizontal,
    make_all,
    rms,
    table1_run,
    walk_run,
)

DOCUMENT = ROOT / "docs/accuracy.md"
PICTURES = ROOT / "docs/accuracy"
PAPER_TABLE = Path(__file__).with_name("table1.csv")
EXAMPLE_SITE = Path(__file__).with_name("example_site.csv")
BUDGET_TARGETS = ["pillar1", "tree1", "mast"]
BUDGET_SOURCES = ["none", "heading", "tilt", "mounting", "position", "all"]


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], prog="accuracy-report")
    parser.add_argument("--runs", type=Path, default=ROOT / "build/accuracy", help="kept runs")
    parser.add_argument("--seeds", type=int, default=3, help="of the runs with pictures")
    parser.add_argument("--budget-seeds", type=int, default=40, help="of those without")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument(
        "--kept-only", action="store_true", help="make no run; a dash where one is missing"
    )
    return parser.parse_args()


def table(header: list[str], rows: list[list[str]]) -> str:
    lines = [header, ["---"] + ["---:"] * (len(header) - 1), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def replace_part(name: str, text: str) -> None:
    """Between <!-- name --> and <!-- /name --> of the document."""
    document = DOCUMENT.read_text()
    pattern = re.compile(rf"(<!-- {name} -->\n).*?(<!-- /{name} -->)", re.S)
    if not pattern.search(document):
        raise SystemExit(f"accuracy-report: {DOCUMENT} has no part {name}")
    DOCUMENT.write_text(pattern.sub(lambda m: f"{m[1]}{text}\n{m[2]}", document))


def precision(folder: Path, command: str, *options: object) -> Path:
    output = folder / f"{command}.csv"
    line = [PROGRAMS / "ols-precision", command, "--output", output, *options]
    subprocess.run([str(part) for part in line], check=True)
    return output


def mean_error(runs: list[Run]) -> float:
    """Root mean square horizontal error [m] over the runs that are there; NaN without any."""
    values = [rms(horizontal(run.errors_enu())) for run in runs if run.made()]
    return rms(np.array(values)) if values else np.nan


def metres(value: float, form: str = ".2f") -> str:
    return "–" if np.isnan(value) else format(value, form)


def theory(folder: Path) -> dict[str, np.ndarray]:
    theory_plots.figure3(precision(folder, "figure3"), PICTURES / "figure3.png")
    theory_plots.figure4(precision(folder, "figure4"), PICTURES / "figure4.png")
    output = precision(folder, "table", "--input", PAPER_TABLE)
    theory_plots.table1(output, PICTURES / "table1.svg")
    site = precision(folder, "map", "--stations", EXAMPLE_SITE, "--heights", "60")
    theory_plots.site_map(site, PICTURES / "map.png", EXAMPLE_SITE)
    paper = theory_plots.columns(output)
    ratios = {
        "the base's centre, as printed": paper["estimated_m"] / paper["paper_estimated_m"],
        "the first camera, with sides": paper["estimated_by_side_m"] / paper["paper_estimated_m"],
    }
    rows = [
        [
            name,
            f"{100 * np.abs(r - 1).max():.1f} %",
            f"{100 * np.abs(r - 1).mean():.1f} %",
            f"{100 * (r.mean() - 1):+.1f} %",
        ]
        for name, r in ratios.items()
    ]
    header = ["distance from", "worst row", "mean of the rows' differences", "mean of the ratios"]
    replace_part("estimates", table(header, rows))
    return paper


def static(folder: Path, seeds: int, paper: dict[str, np.ndarray]) -> None:
    content = plan.scenario("table1")
    sigmas = plan.sigmas(content)
    places = {t["id"]: plan.landmark(t["trajectory"]) for t in content["target"]}
    rows = []
    for i, target in enumerate(paper["object"]):
        row = {"object": target} | {
            key: float(paper[key][i])
            for key in ("distance_m", "paper_measured_m", "paper_estimated_m")
        }
        for kind in ("random", "all"):
            runs = [table1_run(folder, kind, target, seed) for seed in range(1, seeds + 1)]
            row[f"{kind}_m"] = mean_error(runs)
        row["all_predicted_m"] = plan.predicted_m(content, places[target], sigmas)
        rows.append(row)
    run_plots.figure9(rows, PICTURES / "figure9.svg")
    keys = ["paper_estimated_m", "paper_measured_m", "random_m", "all_m", "all_predicted_m"]
    header = ["object", "distance, m", "paper est., m", "paper meas., m"]
    header += ["ours, random only, m", "ours, all, m", "predicted, m"]
    body = [
        [row["object"], f"{row['distance_m']:.0f}", *(metres(row[key]) for key in keys)]
        for row in rows
    ]
    replace_part("static", table(header, body))


def walk(folder: Path) -> None:
    site = plan.site(plan.scenario("walk"))
    runs = {kind: walk_run(folder, kind, 1) for kind in ("random", "all")}
    runs = {kind: run for kind, run in runs.items() if run.made()}
    run_plots.figure10(runs, site, PICTURES / "figure10.png")
    rows = [["the paper", "6.25", "13.35", ""]]
    for kind, run in runs.items():
        for estimator, name in (("fixes", "ours"), ("fixes_paper", "the paper's estimator")):
            errors = horizontal(run.errors_enu(estimator))
            tracking = np.mean([s["states"]["tracking"] for s in run.summary()["stations"]])
            label = f"{name}, {'all errors' if kind == 'all' else 'random errors only'}"
            rows.append(
                [label, f"{errors.mean():.2f}", f"{errors.max():.2f}", f"{100 * tracking:.1f} %"]
            )
    replace_part("walk", table(["", "mean, m", "greatest, m", "frames tracked"], rows))


def budget(folder: Path, seeds: int) -> None:
    content = plan.scenario("table1")
    sigmas = plan.sigmas(content)
    trajectories = {t["id"]: t["trajectory"] for t in content["target"]}
    names = {"none": "pixels, designation", "all": "all together"}
    rows = []
    for source in BUDGET_SOURCES:
        row = {"source": names.get(source, source)}
        for target in BUDGET_TARGETS:
            runs = [budget_run(folder, source, target, seed) for seed in range(1, seeds + 1)]
            simulated = mean_error(runs)
            place = plan.landmark(trajectories[target])
            predicted = plan.predicted_m(content, place, sigmas.alone(source))
            row[target] = {"simulated_m": simulated, "predicted_m": predicted}
        rows.append(row)
    run_plots.budget(rows, BUDGET_TARGETS, PICTURES / "budget.svg")
    body = [
        [row["source"]]
        + [
            " / ".join(metres(row[t][k], ".3g") for k in ("predicted_m", "simulated_m"))
            for t in BUDGET_TARGETS
        ]
        for row in rows
    ]
    body.append(["UTM's grid north for true north", *grid_north(content, trajectories)])
    header = ["source, predicted / simulated", *(f"{t}, m" for t in BUDGET_TARGETS)]
    replace_part("budget", table(header, body))


def grid_north(content: dict, trajectories: dict) -> list[str]:
    """What it costs to take a grid bearing for an azimuth: the whole site turns."""
    origin = plan.site(content)
    convergence_rad = ols.utm_from_geodetic(origin.origin).convergence_rad
    costs = []
    for target in BUDGET_TARGETS:
        place = origin.to_enu(ols.ecef_from_geodetic(plan.landmark(trajectories[target])))
        costs.append(f"{abs(2 * np.sin(convergence_rad / 2)) * np.hypot(*place[:2]):.3g}")
    return costs


def main() -> None:
    arguments = parse_arguments()
    folder, seeds = arguments.runs.resolve(), range(1, arguments.seeds + 1)
    folder.mkdir(parents=True, exist_ok=True)
    PICTURES.mkdir(exist_ok=True)
    paper = theory(folder)
    runs = [
        table1_run(folder, k, t, s)
        for k in ("random", "all")
        for t in paper["object"]
        for s in seeds
    ]
    runs += [walk_run(folder, kind, 1) for kind in ("random", "all")]
    runs += [
        budget_run(folder, source, target, seed)
        for source in BUDGET_SOURCES
        for target in BUDGET_TARGETS
        for seed in range(1, arguments.budget_seeds + 1)
    ]
    if not arguments.kept_only:
        make_all(runs, arguments.jobs)
    static(folder, arguments.seeds, paper)
    walk(folder)
    budget(folder, arguments.budget_seeds)
    print(f"written: {DOCUMENT} and {PICTURES}")


if __name__ == "__main__":
    main()
