#!/usr/bin/env python3
"""The table of conditions, and what is made of it.

table.py docs          writes the tables in docs/troubleshooting.md and docs/fleet.md anew
"""

import json
import re
import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
TROUBLESHOOTING = HERE.parent / "docs/troubleshooting.md"
FLEET = HERE.parent / "docs/fleet.md"
CELLS = ("meaning", "action")
SAID = ("outcomes", "notes")  # rows that are a sentence alone
PARAMETER = re.compile(r"\{(\w+)(?::([^}]*))?\}")


def table() -> dict:
    return tomllib.loads((HERE / "conditions.toml").read_text())


def alarms(of: dict) -> list[dict]:
    return [alarm for group in of["group"] for alarm in group["alarm"]]


def refusals(of: dict) -> dict[str, list[str]]:
    """What a person is told of each reason, in both languages."""
    return {
        group.get("of", "") + reason: both
        for group in of["refusals"]
        for row in group["rows"]
        for reason, both in row.get("says", {}).items()
    }


def named(sentence: str) -> str:
    """With the names of its parameters, without their formats."""
    return PARAMETER.sub(r"{\1}", sentence)


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
        says = {key: [named(one) for one in both] for key, both in alarm["says"].items()}
        both = {key: [plain(alarm[key][0]), alarm[key][1]] for key in ("meaning", "action")}
        rows.append({"severity": alarm["severity"], "says": says, **both})
    reasons = refusals(whole)
    said = {
        kind: {key: [named(one) for one in both] for key, both in whole[kind].items()}
        for kind in SAID
    }
    phrases = {**dict(reasons.values()), **whole["phrases"]}
    others = {name: whole[name] for name in ("words", "names")}
    return {"alarms": rows, "reasons": reasons, **said, "phrases": phrases, **others}


def of_the_documents(document: str) -> str:
    """The document with the rows of the table below each group's heading, in its next table."""
    whole = table()
    tables: dict[str, list[str]] = {}
    for group in whole["group"]:
        rows = [
            ([shown(said[0]) for said in row["says"].values()], row["meaning"][0], row["action"][0])
            for row in group["alarm"]
        ]
        tables[f"Alarms of {group['of']}"] = [in_markdown(rows)]
    for group in whole["refusals"]:
        rows = [
            ([*row.get("says", ()), *row.get("names", ())], *(row[k] for k in CELLS if k in row))
            for row in group["rows"]
        ]
        tables.setdefault(group["under"], []).append(in_markdown(rows))
    sections = re.split(r"^(?=## )", document, flags=re.M)
    for i, section in enumerate(sections):
        new = iter(tables.get(section[3:].partition("\n")[0], ()))
        filled = lambda found, new=new: found[1] + next(new, found[2])  # noqa: E731
        sections[i] = re.sub(r"^(\|---.*\n)((?:\|.*\n)*)", filled, section, flags=re.M)
    return "".join(sections)


def in_markdown(rows: list[tuple]) -> str:
    named = [(", ".join(f"`{name}`" for name in names), *cells) for names, *cells in rows]
    return "".join("| " + " | ".join(row).replace("|  |", "| |") + " |\n" for row in named)


def events() -> dict[str, dict[str, str]]:
    return tomllib.loads((HERE / "events.toml").read_text())


def of_the_fleet(document: str) -> str:
    """The document with the kinds of events in the table of their ids."""
    rows = [(f"`{one['id']}`", one["when"], one["fields"]) for one in events().values()]
    lines = "".join(f"| {' | '.join(row)} |\n" for row in rows)
    head = r"(^\| `MESSAGE_ID` .*\n\|---.*\n)(?:\|.*\n)*"
    return re.sub(head, lambda found: found[1] + lines, document, flags=re.M)


def catalogue() -> str:
    return "\n".join(
        f"-- {one['id']}\nSubject: {one['subject']}\nDefined-By: OLS\n"
        f"Documentation: file:/usr/share/doc/ols/{one['document']}\n\n{one['text']}"
        for one in events().values()
    )


EVENT_IDS = """// Made by conditions/table.py: the message id of each kind of event in the journal.
#pragma once

#include <string_view>

namespace ols::event {

using Id = std::string_view;

%s
}  // namespace ols::event
"""


def event_ids() -> str:
    ids = ((name, one["id"]) for name, one in events().items())
    return EVENT_IDS % "".join(f'inline constexpr Id k{name} = "{id}";\n' for name, id in ids)


HEADER = """// Made by conditions/table.py: a function for each alarm that raises it. Pure.
#pragma once

#include <cstdint>
#include <string>

#include "conditions/alarm.h"

namespace ols::alarm {

%s
}  // namespace ols::alarm
"""
SOURCE = """// Made by conditions/table.py.
#include "conditions/alarms.h"

#include <array>
#include <cstdio>
#include <map>

#include "conditions/alarm_rows.h"
#include "conditions/sayings.h"

namespace ols {
namespace {

std::string number(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

constexpr std::array<AlarmRow, %d> kRows{{
%s}};

}  // namespace

std::span<const AlarmRow> alarm_rows() { return kRows; }

std::string_view refusal_sentence(std::string_view reason) {
  static const std::map<std::string_view, std::string_view> kRefusals{
%s  };
  const auto known = kRefusals.find(reason);
  return known == kRefusals.end() ? std::string_view() : known->second;
}

namespace alarm {

%s
}  // namespace alarm

%s}  // namespace ols
"""
SAYINGS = """\
// Made by conditions/table.py: what comes of an order that is not carried out, and what the
// console's history says. Pure.
#pragma once

#include <cstdint>
#include <string>

#include "conditions/refusal.h"

namespace ols {

%s}  // namespace ols
"""


def declared(name: str, sentence: str) -> str:
    types = {None: "const std::string&", "d": "std::int64_t"}
    parameters = PARAMETER.findall(sentence)
    listed = [f"{types.get(how or None, 'double')} {what}" for what, how in parameters]
    return f"Alarm {name}({', '.join(listed)})"


def defined(name: str, sentence: str) -> str:
    given = []
    for what, how in PARAMETER.findall(sentence):
        value = {"": what, "d": f"std::to_string({what})"}.get(how, f'number("%{how}", {what})')
        given.append(f'{{"{what}", {value}}}')
    return f'{declared(name, sentence)} {{ return raise("{name}", {{{", ".join(given)}}}); }}\n'


def of_the_programs() -> dict[str, str]:
    """The files of the build, by their names."""
    rows = [(row, *said) for row in alarms(table()) for said in row["says"].items()]
    cells = ""
    for row, name, (english, _) in rows:
        subject = f" {' '.join(row['subject'])} " if "subject" in row else ""
        action = plain(row["action"][0]).replace("`", "")
        one = (name, named(english), subject, row["severity"], action)
        cells += f"    {{{', '.join(json.dumps(cell) for cell in one)}}},\n"
    sayings, says = "", ""
    for kind in SAID:
        said = {name: english for name, (english, _) in table()[kind].items()}
        for name, english in said.items():
            cells += f'    {{"{name}", {json.dumps(named(english))}, "", "notice", ""}},\n'
        space = f"namespace {kind[:-1]} {{\n\n%s\n}}  // namespace {kind[:-1]}\n\n"
        sayings += space % "".join(f"{declared(*one)};\n" for one in said.items())
        says += space % "".join(defined(*one) for one in said.items())
    header = "".join(f"{declared(name, english)};\n" for _, name, (english, _) in rows)
    source = "".join(defined(name, english) for _, name, (english, _) in rows)
    refused = "".join(
        f"      {{{json.dumps(reason)}, {json.dumps(says[0])}}},\n"
        for reason, says in refusals(table()).items()
    )
    return {
        "alarms.h": HEADER % header,
        "alarms.cpp": SOURCE % (cells.count("\n"), cells, refused, source, says),
        "sayings.h": SAYINGS % sayings,
        "event_ids.h": event_ids(),
        "ols.catalog": catalogue(),
    }


def main() -> int:
    match sys.argv[1:]:
        case ["docs"]:
            TROUBLESHOOTING.write_text(of_the_documents(TROUBLESHOOTING.read_text()))
            FLEET.write_text(of_the_fleet(FLEET.read_text()))
        case ["cpp", folder]:
            Path(folder).mkdir(parents=True, exist_ok=True)
            for name, text in of_the_programs().items():
                path = Path(folder) / name
                if not path.exists() or path.read_text() != text:
                    path.write_text(text)
        case _:
            print(__doc__, file=sys.stderr)
            return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
