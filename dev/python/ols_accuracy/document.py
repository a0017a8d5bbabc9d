"""docs/accuracy.md: what stands between its marks is written here, the words around are not."""

import re
from pathlib import Path

import numpy as np

from ols_accuracy.runs import ROOT

DOCUMENT = ROOT / "docs/accuracy.md"
PICTURES = ROOT / "docs/accuracy"


def replace_part(name: str, text: str, document: Path = DOCUMENT) -> None:
    """Between <!-- name --> and <!-- /name --> of the document."""
    content = document.read_text()
    pattern = re.compile(rf"(<!-- {name} -->\n).*?(<!-- /{name} -->)", re.S)
    if not pattern.search(content):
        raise SystemExit(f"accuracy-report: {document} has no part {name}")
    document.write_text(pattern.sub(lambda m: f"{m[1]}{text}\n{m[2]}", content))


def metres(value: float) -> str:
    """Two digits, or two decimals where that is more; a dash where nothing was measured."""
    if np.isnan(value):
        return "–"
    return (
        f"{value:.0f}" if abs(value) >= 100 else f"{value:.2g}" if value < 0.1 else f"{value:.2f}"
    )


def beside(bound: float, *measured: float) -> str:
    return f"{' / '.join(map(metres, measured))} ({metres(bound)})"
