"""Runs the paper's experiments in the simulation, and writes docs/accuracy.md's figures and tables.

tools/accuracy-report [--runs DIR] [--seeds N] [--jobs N]
"""

import argparse
import os
import subprocess
from pathlib import Path

import numpy as np
from ols_bench.markdown import table

from ols_accuracy import plan, run_plots, theory_plots
from ols_accuracy.document import DOCUMENT, PICTURES, beside, metres, replace_part
from ols_accuracy.runs import (
    EACH_OTHER,
    KINDS,
    LANDMARKS,
    PROGRAMS,
    RANDOM,
    ROOT,
    SOURCES,
    WALK,
    Run,
    budget_run,
    horizontal,
    left_out,
    make_all,
    mean_bound,
    mean_error,
    picture_run,
)

PAPER_TABLE = Path(__file__).with_name("table1.csv")
EXAMPLE_SITE = Path(__file__).with_name("example_site.csv")
BUDGET_TARGETS = ["pillar1", "tree1", "mast", WALK]
BUDGET_SOURCES = ["none", *SOURCES, "all"]
KIND_NAMES = {
    RANDOM: "random errors only",
    LANDMARKS: "all errors, headings from landmarks",
    EACH_OTHER: "all errors, stations aimed at each other",
}
PAPER_WALK_MEAN_M, PAPER_WALK_GREATEST_M = 6.25, 13.35


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], prog="accuracy-report")
    parser.add_argument("--runs", type=Path, default=ROOT / "build/accuracy", help="kept runs")
    parser.add_argument("--seeds", type=int, default=3, help="of the landmarks, with images")
    parser.add_argument("--walk-seeds", type=int, default=1, help="of the walk, with images")
    parser.add_argument("--budget-seeds", type=int, default=40, help="of the runs without images")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument(
        "--kept-only", action="store_true", help="make no run; a dash where one is missing"
    )
    return parser.parse_args()


def seeds_of(count: int) -> range:
    return range(1, count + 1)


def precision(folder: Path, command: str, *options: object) -> Path:
    output = folder / f"{command}.csv"
    line = [PROGRAMS / "ols-precision", command, "--output", output, *options]
    subprocess.run([str(part) for part in line], check=True)
    return output


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
    rows = []
    for name, r in ratios.items():
        off = 100 * np.abs(r - 1)
        cells = [f"{off.max():.1f} %", f"{off.mean():.1f} %", f"{100 * (r.mean() - 1):+.1f} %"]
        rows.append([name, *cells])
    header = ["distance from", "worst row", "mean of the rows' differences", "mean of the ratios"]
    replace_part("estimates", table(header, rows))
    return paper


def static(folder: Path, seeds: range, paper: dict[str, np.ndarray]) -> None:
    rows = []
    for i, target in enumerate(paper["object"]):
        row = {"object": target}
        for key in ("distance_m", "paper_measured_m", "paper_estimated_m"):
            row[key] = float(paper[key][i])
        for kind in KINDS:
            runs = [picture_run(folder, kind, target, seed) for seed in seeds]
            row[kind], row[f"{kind}_bound"] = mean_error(runs), mean_bound(runs)
        rows.append(row)
    run_plots.figure9(rows, PICTURES / "figure9.svg")
    header = ["object", "distance", "paper, estimated", "paper, measured"]
    header += ["random only", "landmarks", "each other"]
    body = [
        [row["object"], f"{row['distance_m']:.0f}"]
        + [metres(row[f"paper_{key}_m"]) for key in ("estimated", "measured")]
        + [beside(row[f"{kind}_bound"], row[kind]) for kind in KINDS]
        for row in rows
    ]
    replace_part("static", table(header, body))


def walk_row(name: str, runs: list[Run]) -> list[str]:
    """Over all fixes, and over those at which both stations were on the target."""
    errors = [horizontal(run.errors_enu()) for run in runs]
    shares, flags = zip(*(run.frames_on_target() for run in runs), strict=True)
    on = np.hstack([e[f] for e, f in zip(errors, flags, strict=True)])
    return [
        name,
        *(metres(value) for value in (np.hstack(errors).mean(), max(e.max() for e in errors))),
        *(metres(value) for value in (on.mean(), on.max())),
        f"{100 * np.mean(shares):.0f} %",
    ]


def walk(folder: Path, seeds: range) -> None:
    content = plan.scenario("walk")
    runs = {kind: [picture_run(folder, kind, WALK, seed) for seed in seeds] for kind in KINDS}
    made = {kind: [run for run in each if run.made()] for kind, each in runs.items()}
    made = {kind: each for kind, each in made.items() if each}
    first = {kind: each[0] for kind, each in made.items()}
    run_plots.figure10(first, plan.site(content), PICTURES / "figure10.png")
    rows = [["the paper", str(PAPER_WALK_MEAN_M), str(PAPER_WALK_GREATEST_M), "", "", ""]]
    rows += [walk_row(KIND_NAMES[kind], each) for kind, each in made.items()]
    header = ["", "mean", "greatest", "mean, on the target", "greatest, on the target"]
    replace_part("walk", table([*header, "frames on the target"], rows))


def budget_runs(folder: Path, seeds: range) -> list[Run]:
    """Seed by seed, so that a report of fewer can be made when it is interrupted."""
    return [
        budget_run(folder, stationing, source, target, seed)
        for seed in seeds
        for stationing in (LANDMARKS, EACH_OTHER)
        for source in BUDGET_SOURCES
        for target in BUDGET_TARGETS
    ]


def budget_basis(folder: Path, seeds: range) -> str:
    runs = [run for run in budget_runs(folder, seeds) if run.made()]
    out = left_out(runs)
    basis = f"Metres, root mean square over {len(seeds)} seeds, {len(runs)} runs."
    if not out:
        return basis
    where = {f"{run.target or WALK} (seed {run.seed})" for run in out}
    return (
        f"{basis} {len(out)} of them have no fix of both stations, because the filter has set one "
        f"aside for good; they are not in the tables: {', '.join(sorted(where))}."
    )


def budget_rows(folder: Path, stationing: str, seeds: range) -> list[dict]:
    names = {"none": "pixels, operator's box, encoders", "all": "all together"}
    rows = []
    for source in BUDGET_SOURCES:
        row = {"source": names.get(source, source)}
        for target in BUDGET_TARGETS:
            runs = [budget_run(folder, stationing, source, target, seed) for seed in seeds]
            row[target] = mean_bound(runs), mean_error(runs), mean_error(runs, "fixes_paper")
        rows.append(row)
    return rows


def budget(folder: Path, seeds: range, paper: dict[str, np.ndarray]) -> None:
    replace_part("budget basis", budget_basis(folder, seeds))
    rows = {kind: budget_rows(folder, kind, seeds) for kind in (LANDMARKS, EACH_OTHER)}
    run_plots.budget(rows, BUDGET_TARGETS, PICTURES / "budget.svg")
    header = ["source alone", *(f"{t}" for t in BUDGET_TARGETS)]
    known = [list(paper["object"]).index(t) for t in BUDGET_TARGETS if t != WALK]
    printed = {
        key: [metres(paper[f"paper_{key}_m"][i]) for i in known]
        for key in ("estimated", "measured")
    }
    grid = plan.grid_north_cost_m(plan.scenario("table1"), BUDGET_TARGETS[:-1])
    for kind, each in rows.items():
        body = [["the paper, estimated (random, p = 4 px)", *printed["estimated"], ""]]
        body += [[row["source"], *(beside(*row[t]) for t in BUDGET_TARGETS)] for row in each]
        body.append(
            ["the paper, measured (all)", *printed["measured"], f"{PAPER_WALK_MEAN_M} (mean)"]
        )
        if kind == EACH_OTHER:
            body.append(["UTM's grid north for true north", *map(metres, grid), ""])
        replace_part(f"budget {kind}", table(header, body))


def all_runs(folder: Path, arguments: argparse.Namespace, objects: list[str]) -> list[Run]:
    """With images, then without; seed by seed."""
    runs = [picture_run(folder, k, WALK, s) for s in seeds_of(arguments.walk_seeds) for k in KINDS]
    runs += [
        picture_run(folder, kind, target, seed)
        for seed in seeds_of(arguments.seeds)
        for target in objects
        for kind in KINDS
    ]
    return runs + budget_runs(folder, seeds_of(arguments.budget_seeds))


def main() -> None:
    arguments = parse_arguments()
    folder = arguments.runs.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    PICTURES.mkdir(exist_ok=True)
    paper = theory(folder)
    if not arguments.kept_only:
        make_all(all_runs(folder, arguments, list(paper["object"])), arguments.jobs)
    static(folder, seeds_of(arguments.seeds), paper)
    walk(folder, seeds_of(arguments.walk_seeds))
    budget(folder, seeds_of(arguments.budget_seeds), paper)
    print(f"written: {DOCUMENT} and {PICTURES}")


if __name__ == "__main__":
    main()
