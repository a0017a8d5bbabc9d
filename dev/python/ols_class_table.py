"""Writes central/classify/class_table.h: the densities by which a target's class is computed.

    build/release/bin/ols-bench-estimators --runs 400 --write-class-looks out/looks.csv
    build/venv/bin/python dev/python/ols_class_table.py out/looks.csv

Fits a mixture of normal distributions to the looks of each kind of object (EM, a fixed seed). The
looks are simulated without errors; dev/estimators/class_tracks.cpp has the sources of what they
are drawn from. The same looks give the same table.
"""

import csv
import sys
from pathlib import Path

import numpy as np

TARGET = Path(__file__).resolve().parents[2] / "central" / "classify" / "class_table.h"
MODES, SEED = 6, 1
LEAST_SD = np.array([0.1, 0.1, 0.1, 0.15, 0.001])
SHARE_OF_ANYTHING = 0.02
CLASSES = ["kUnknown", "kDrone", "kBird", "kAircraft", "kOther"]
# What none of the kinds explains: a wide density.
ANYTHING = (np.array([1.0, 2.0, 0.0, 1.0, 0.02]), np.array([3.0, 3.0, 2.0, 1.5, 0.05]))
HEADER = """\
// Made by dev/python/ols_class_table.py. Features: class_posterior.h, features_of().
// clang-format off
#pragma once

#include "central/classify/class_posterior.h"

namespace ols::fusion {

struct KindMode {
  double share;
  std::array<double, kFeatures> mean, sd;
};
"""


def fit(x: np.ndarray) -> list[tuple[float, np.ndarray, np.ndarray]]:
    random = np.random.default_rng(SEED)
    mean = x[random.choice(len(x), MODES, replace=False)]
    sd = np.tile(np.maximum(x.std(0), LEAST_SD), (MODES, 1))
    share = np.full(MODES, 1 / MODES)
    for _ in range(200):
        off = (x[:, None, :] - mean) / sd
        log = np.log(share) - 0.5 * (off**2).sum(2) - np.log(sd).sum(1)
        part = np.exp(log - log.max(1, keepdims=True))
        part /= part.sum(1, keepdims=True)
        weight = part.sum(0) + 1e-9
        share = np.maximum(weight / len(x), 1e-3)
        share /= share.sum()
        mean = part.T @ x / weight[:, None]
        variance = part.T @ x**2 / weight[:, None] - mean**2
        sd = np.maximum(np.sqrt(np.maximum(variance, 0)), LEAST_SD)
    return list(zip(share, mean, sd, strict=True))


def braced(values: np.ndarray) -> str:
    return "{" + ", ".join(f"{value:.4g}" for value in values) + "}"


def row(name: str, of_class: int, prior: float, modes: list) -> str:
    lines = [f"    {{{share:.4g}, {braced(mean)}, {braced(sd)}}}," for share, mean, sd in modes]
    head = f'  {{"{name}", ObjectClass::{CLASSES[of_class]}, {prior:.4g}, {{{{'
    return "\n".join([head, *lines, "  }}},"])


def main() -> None:
    kinds: dict[tuple[str, int], list[list[float]]] = {}
    with open(sys.argv[1], newline="") as file:
        for look in csv.DictReader(file):
            of = kinds.setdefault((look["kind"], int(look["class"])), [])
            of.append([float(look[f]) for f in ("size", "speed", "climb", "across", "flicker")])
    prior = (1 - SHARE_OF_ANYTHING) / len(kinds)
    rows = [row(*kind, prior, fit(np.array(looks))) for kind, looks in kinds.items()]
    anything = [(1 / MODES, *ANYTHING)] * MODES
    rows.append(row("anything", len(CLASSES) - 1, SHARE_OF_ANYTHING, anything))
    text = [
        HEADER,
        f"inline constexpr int kModes = {MODES};",
        "struct Kind {",
        "  const char* name;",
        "  ObjectClass object_class;",
        "  double prior;",
        "  std::array<KindMode, kModes> modes;",
        "};",
        "inline constexpr Kind kClassTable[] = {",
        *rows,
        "};",
        "",
        "}  // namespace ols::fusion",
        "",
    ]
    TARGET.write_text("\n".join(text))
    print(f"{TARGET}: {len(rows)} kinds")


if __name__ == "__main__":
    main()
