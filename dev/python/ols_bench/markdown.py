"""Tables in Markdown."""

from collections.abc import Iterable, Sequence


def row(cells: Iterable[str]) -> str:
    return "| " + " | ".join(cell.replace("|", r"\|") for cell in cells) + " |"


def table(columns: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """The first column to the left, the others to the right."""
    rule = "|---" + "|---:" * (len(columns) - 1) + "|"
    return "\n".join([row(columns), rule, *map(row, rows)])
