"""Style of the benchmarks' plots."""

import matplotlib

matplotlib.use("Agg")

from matplotlib import pyplot  # noqa: E402

INK, FAINT, GRID = "#222222", "#6b6b6b", "#e4e4e4"
OURS, PAPER, TRUTH, BOUND = "#0b6fb8", "#d9822b", "#1a9850", "#b3261e"
COLOURS = {
    "ours (full)": OURS,
    "ours (paper)": PAPER,
    "CSRT": "#7b3294",
    "MIL": "#4d9221",
    "KCF": "#8c6d31",
    "MOSSE": "#8a8a8a",
}

pyplot.rcParams.update(
    {
        "figure.dpi": 130,
        "figure.facecolor": "white",
        "font.size": 10,
        "axes.edgecolor": FAINT,
        "axes.labelcolor": INK,
        "axes.titlesize": 11,
        "axes.titleweight": "bold",
        "axes.titlelocation": "left",
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "axes.axisbelow": True,
        "grid.color": GRID,
        "xtick.color": FAINT,
        "ytick.color": FAINT,
        "legend.edgecolor": "white",
        "legend.framealpha": 0.85,
        "lines.linewidth": 1.6,
    }
)
