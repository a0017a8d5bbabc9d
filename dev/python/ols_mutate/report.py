"""What became of the mutants, for people and as JSON. Pure."""

from collections import Counter
from dataclasses import dataclass
from pathlib import PurePath

from .sites import Site

SURVIVED, KILLED, NOT_VIABLE = "survived", "killed", "not viable"


@dataclass(frozen=True)
class Judged:
    site: Site
    outcome: str
    by: str = ""  # which test killed it
    line_after: str = ""

    def line(self) -> str:
        place = f"{self.site.file}:{self.site.line} ({self.site.kind})"
        text = f"{self.outcome:<10} {place}" + (f" by {self.by}" if self.by else "")
        if self.outcome == SURVIVED:
            text += f"\n    - {self.site.text.strip()}\n    + {self.line_after}"
        return text

    def as_json(self) -> dict:
        return {
            "mutant": self.site.name(),
            "file": self.site.file,
            "line": self.site.line,
            "kind": self.site.kind,
            "occurrence": self.site.occurrence,
            "before": self.site.text.strip(),
            "after": self.line_after,
            "outcome": self.outcome,
            "by": self.by,
        }


def folder_of(file: str, folders: list[str]) -> str:
    """The narrowest of the folders."""
    holding = [one for one in folders if PurePath(file).is_relative_to(one)]
    return max(holding, key=len)


def share(survived: int, judged: int) -> float:
    return 100.0 * survived / judged if judged else 0.0


def survivors_percent(judged: list[Judged]) -> float:
    """Of those that compile."""
    counts = Counter(one.outcome for one in judged)
    return share(counts[SURVIVED], counts[SURVIVED] + counts[KILLED])


def table(judged: list[Judged], folders: list[str]) -> str:
    rows = [("folder", "mutants", "killed", "survived", "survived %", "not viable")]
    for folder in [*folders, "all"]:
        own = [one for one in judged if folder in ("all", folder_of(one.site.file, folders))]
        counts = Counter(one.outcome for one in own)
        viable = counts[SURVIVED] + counts[KILLED]
        numbers = (viable, counts[KILLED], counts[SURVIVED])
        percent = f"{survivors_percent(own):.1f}" if viable else "-"
        rows.append((folder, *map(str, numbers), percent, str(counts[NOT_VIABLE])))
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return "\n".join(aligned(row, widths) for row in rows)


def aligned(row: tuple[str, ...], widths: list[int]) -> str:
    """The first cell to the left, the others to the right."""
    cells = [cell.rjust(width) for cell, width in zip(row, widths, strict=True)]
    return "  ".join([row[0].ljust(widths[0]), *cells[1:]])
