#!/usr/bin/env python3
"""The table of conditions, and what is made of it.

table.py docs          writes the tables of alarms in docs/troubleshooting.md anew
"""

import re
import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
TROUBLESHOOTING = HERE.parent / "docs/troubleshooting.md"
PARAMETER = re.compile(r"\{(\w+)(?::([^}]*))?\}")


def table() -> dict:
    return tomllib.loads((HERE / "conditions.toml").read_text())


def alarms(of: dict) -> list[dict]:
    return [alarm for group in of["group"] for alarm in group["alarm"]]


def shown(sentence: str) -> str:
    """With … for what differs from one time to the next."""
    return PARAMETER.sub("…", sentence)


def plain(markdown: str) -> str:
    return re.sub(r"\*([^*]+)\*", r"\1", re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", markdown))


def of_the_page() -> dict:
    """What programs say: how grave, and in both languages what it means and what to do."""
    whole = table()
    rows = []
    for alarm in alarms(whole):
        text = {shown(english): shown(german) for english, german in alarm["says"].values()}
        both = {key: [plain(alarm[key][0]), alarm[key][1]] for key in ("meaning", "action")}
        rows.append({"severity": alarm["severity"], "text": text, **both})
    return {"alarms": rows, **{part: whole[part] for part in ("phrases", "words", "names")}}


def of_the_documents(document: str) -> str:
    """The document with the rows of the table below each group's heading."""
    for group in table()["group"]:
        rows = []
        for alarm in group["alarm"]:
            texts = ", ".join(f"`{shown(english)}`" for english, _ in alarm["says"].values())
            cells = (texts, alarm["meaning"][0], alarm["action"][0])
            rows.append("| " + " | ".join(cells).replace("|  |", "| |") + " |\n")
        above = rf"(^## Alarms of {re.escape(group['of'])}\n(?:(?!^## ).*\n)*?\|---.*\n)(?:\|.*\n)*"
        new = "".join(rows)
        document = re.sub(above, lambda found, new=new: found[1] + new, document, flags=re.M)
    return document


def main() -> int:
    if sys.argv[1:] != ["docs"]:
        print(__doc__, file=sys.stderr)
        return 2
    TROUBLESHOOTING.write_text(of_the_documents(TROUBLESHOOTING.read_text()))
    return 0


if __name__ == "__main__":
    sys.exit(main())
