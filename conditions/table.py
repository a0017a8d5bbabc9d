#!/usr/bin/env python3
"""The table of conditions, and what is made of it.

table.py docs          writes the tables of alarms in docs/troubleshooting.md anew
"""

import json
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


HEADER = """// Made by conditions/table.py: what each alarm says. Pure.
#pragma once

#include <cstdint>
#include <string>

namespace ols::alarm {

%s
}  // namespace ols::alarm
"""
SOURCE = """// Made by conditions/table.py.
#include "conditions/alarms.h"

#include <array>
#include <cstdio>

#include "conditions/alarm.h"

namespace ols {
namespace {

std::string number(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

constexpr std::array<AlarmSentence, %d> kSentences{{
%s}};

}  // namespace

std::span<const AlarmSentence> alarm_sentences() { return kSentences; }

namespace alarm {

%s
}  // namespace alarm
}  // namespace ols
"""


def declared(name: str, sentence: str) -> str:
    types = {None: "const std::string&", "d": "std::int64_t"}
    parameters = PARAMETER.findall(sentence)
    listed = [f"{types.get(how or None, 'double')} {what}" for what, how in parameters]
    return f"std::string {name}({', '.join(listed)})"


def defined(name: str, sentence: str) -> str:
    parts, at = [], 0
    for found in PARAMETER.finditer(sentence):
        parts.append(json.dumps(sentence[at : found.start()]))
        what, how = found.groups()
        told = {None: what, "d": f"std::to_string({what})"}
        parts.append(told.get(how, f'number("%{how}", {what})'))
        at = found.end()
    parts.append(json.dumps(sentence[at:]))
    return f"{declared(name, sentence)} {{ return std::string({parts[0]}){more(parts[1:])}; }}\n"


def more(parts: list[str]) -> str:
    return "".join(f" + {part}" for part in parts if part != '""')


def of_the_programs() -> tuple[str, str]:
    """alarms.h and alarms.cpp. A sentence with more words is looked for first."""
    rows = [(row, *said) for row in alarms(table()) for said in row["says"].items()]
    rows.sort(key=lambda one: -len(PARAMETER.sub("", one[2][0])))
    sentences = ""
    for row, name, (english, _) in rows:
        subject = f" {' '.join(row['subject'])} " if "subject" in row else ""
        named = PARAMETER.sub(r"{\1}", english)
        sentences += f"    {{{', '.join(json.dumps(one) for one in (name, named, subject))}}},\n"
    header = "".join(f"{declared(name, english)};\n" for _, name, (english, _) in rows)
    source = "".join(defined(name, english) for _, name, (english, _) in rows)
    return HEADER % header, SOURCE % (len(rows), sentences, source)


def main() -> int:
    match sys.argv[1:]:
        case ["docs"]:
            TROUBLESHOOTING.write_text(of_the_documents(TROUBLESHOOTING.read_text()))
        case ["cpp", folder]:
            Path(folder).mkdir(parents=True, exist_ok=True)
            for name, text in zip(("alarms.h", "alarms.cpp"), of_the_programs(), strict=True):
                (Path(folder) / name).write_text(text)
        case _:
            print(__doc__, file=sys.stderr)
            return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
