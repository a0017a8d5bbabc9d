"""Plots the output of ols-precision: tools/precision-plot."""

import argparse
import csv
import sys
import warnings
from pathlib import Path

from ols_accuracy import land_plots, theory_plots

PLAIN = {
    "figure3": theory_plots.figure3,
    "figure4": theory_plots.figure4,
    "table": theory_plots.table1,
    "vertical": land_plots.vertical,
}
MAPS = {"map": theory_plots.site_map, "coverage": land_plots.coverage}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, prog="precision-plot")
    parser.add_argument("kind", choices=[*PLAIN, *MAPS])
    parser.add_argument("source", type=Path, help="CSV that `ols-precision KIND` has written")
    parser.add_argument("picture", type=Path, help="PNG or SVG to write")
    parser.add_argument(
        "--stations", type=Path, help="stations.csv, drawn into a map or a coverage"
    )
    arguments = parser.parse_args()
    if arguments.picture.suffix not in (".png", ".svg"):
        parser.error(f"{arguments.picture}: must end in .png or .svg")
    warnings.simplefilter("ignore")  # of numpy, of numbers that cannot be drawn: said below
    try:
        if arguments.kind in MAPS:
            MAPS[arguments.kind](arguments.source, arguments.picture, arguments.stations)
        else:
            PLAIN[arguments.kind](arguments.source, arguments.picture)
    except OSError as problem:
        sys.exit(f"precision-plot: {problem.filename}: {problem.strerror}")
    except theory_plots.BadTable as problem:
        is_source = problem.path == arguments.source
        whose = f": not what `ols-precision {arguments.kind}` writes" if is_source else ""
        sys.exit(f"precision-plot: {problem}{whose}")
    except (TypeError, ValueError, csv.Error):
        sys.exit(
            f"precision-plot: {arguments.source}: cannot be drawn: not what "
            f"`ols-precision {arguments.kind}` writes"
        )


if __name__ == "__main__":
    main()
