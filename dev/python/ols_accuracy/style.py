"""One look for all figures."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
from matplotlib.figure import Figure
from PIL import Image

PAPER, OURS, RANDOM_COLOUR, TRUTH, STATION = "#d9822b", "#0b6fb8", "#3a9d5d", "#222222", "#b3261e"
MAP = "viridis_r"

plt.rcParams.update(
    {
        "font.size": 10,
        "axes.titlesize": 11,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.grid": True,
        "grid.alpha": 0.25,
        "legend.frameon": False,
        "figure.constrained_layout.use": True,
        "svg.hashsalt": "ols",
    }
)


def save(figure: Figure, path: Path) -> None:
    """A palette makes small files; no date makes the same file twice."""
    metadata = {"Date": None} if path.suffix == ".svg" else {"Software": None}
    figure.savefig(path, dpi=100, metadata=metadata)
    plt.close(figure)
    if path.suffix == ".png":
        with Image.open(path) as picture:
            small = picture.convert("RGB").quantize(192, dither=Image.Dither.NONE)
        small.save(path, optimize=True)
