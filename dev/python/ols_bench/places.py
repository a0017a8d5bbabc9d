"""Where a tracker's results are kept, and its times."""

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ols_bench.clips import Clip


@dataclass
class Places:
    """Where a tracker's results of one clip are written."""

    boxes: Path
    times: Path

    def complete(self) -> bool:
        return self.boxes.exists() and self.times.exists()


def places_of(
    output: Path, tracker: str, folder: str, clip: Clip, seed: int | None = None
) -> Places:
    """Made so that a folder below `boxes` is one that a scorer reads. The first seed of a run is
    not named."""
    name = tracker.replace("(", "").replace(")", "").replace(" ", "_")
    name += f"_seed_{seed}" if seed is not None else ""
    places = Places(
        output / "boxes" / name / folder / f"{clip.name}.csv",
        output / "times" / name / folder / f"{clip.name}.csv",
    )
    places.boxes.parent.mkdir(parents=True, exist_ok=True)
    places.times.parent.mkdir(parents=True, exist_ok=True)
    return places


def read_times(path: Path) -> dict[str, np.ndarray]:
    """Milliseconds by column."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    names = [key for key in (rows[0] if rows else {}) if key != "frame"]
    return {name: np.array([float(row[name]) for row in rows]) for name in names}
