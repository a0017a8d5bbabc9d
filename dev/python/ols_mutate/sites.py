"""Where C++ code can be changed, and to what. Pure: text in, sites out."""

import hashlib
import re
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from .code import bodies, closing, masked, without_templates

# Of a symbol that stands between blanks, as clang-format writes a binary operator.
SYMBOLS = {
    "+": {"arithmetic": "-"},
    "-": {"arithmetic": "+"},
    "*": {"arithmetic": "/"},
    "/": {"arithmetic": "*"},
    "+=": {"arithmetic": "-="},
    "-=": {"arithmetic": "+="},
    "*=": {"arithmetic": "/="},
    "/=": {"arithmetic": "*="},
    "<": {"boundary": "<=", "direction": ">"},
    "<=": {"boundary": "<", "direction": ">="},
    ">": {"boundary": ">=", "direction": "<"},
    ">=": {"boundary": ">", "direction": "<="},
    "==": {"equality": "!="},
    "!=": {"equality": "=="},
    "&&": {"logic": "||"},
    "||": {"logic": "&&"},
}
WORDS = {
    "min": "max",
    "max": "min",
    "sin": "cos",
    "cos": "sin",
    "floor": "ceil",
    "ceil": "floor",
    "true": "false",
    "false": "true",
}
SYMBOL = re.compile(r"(?<=[ \n])(?:[-+*/]=?|[<>]=?|[=!]=|&&|\|\|)(?=[ \n])")
WORD = re.compile(r"\bstd::(?P<call>min|max|sin|cos|floor|ceil)\(|\b(?P<value>true|false)\b")
STEP = re.compile(r"\+\+|--")
NEGATION = re.compile(r"(?<=[ (!\n])!(?=[\w(:])")
NUMBER = re.compile(
    r"(?<![\w.'])(?:\d[\d']*\.?[\d']*(?:[eE][-+]?\d+)?)(?P<suffix>[a-zA-Z]*)(?![\w.'])"
)
CALL = re.compile(r"(?<=[;{})])\s+(?P<call>[\w:]+(?:(?:\.|->)\w+|\[\w+\])*)\(")
RETURN = re.compile(r"\breturn (?P<value>[^;{}]+);")
NOT_CALLED = {"if", "for", "while", "switch", "return", "catch", "assert", "static_assert"}
# What no test can see, or is not meant to: the words of a log, room that is set aside, checks at
# compile time.
UNSEEN = re.compile(
    r"\b(?:spdlog::|std::cerr|static_assert|assert\()|\breserve\(|\bshrink_to_fit\(|\bchar \w+\["
)
# A smaller constant guards a division or ends an iteration: twice as much of it is no other result.
SMALLEST = 1e-6


@dataclass(frozen=True)
class Site:
    """One change of one place."""

    file: str
    start: int  # in the file's text
    before: str
    after: str
    kind: str
    line: int  # from 1
    text: str  # of the line
    occurrence: int  # of this change among those of equal lines of the file

    def key(self) -> str:
        """Stays what it is when other lines change."""
        return "\n".join((self.file, self.text.strip(), str(self.occurrence), self.kind))

    def name(self) -> str:
        return hashlib.sha256(self.key().encode()).hexdigest()[:12]

    def changed(self, text: str) -> str:
        return text[: self.start] + self.after + text[self.start + len(self.before) :]

    def changed_line(self, text: str) -> str:
        """How the line reads then: the first of them, if what is removed is longer than it."""
        begin = text.rfind("\n", 0, self.start) + 1
        changed = self.changed(text)
        end = changed.find("\n", self.start)
        return changed[begin:end].strip()


Change = tuple[int, str, str, str]  # start, before, after, kind


def sites(file: str, text: str) -> list[Site]:
    """All of a source."""
    code = without_templates(masked(text))
    lines = text.split("\n")
    seen: Counter[tuple[str, str]] = Counter()
    found = []
    for start, before, after, kind in sorted(changes(code, text)):
        number = text.count("\n", 0, start)
        line = lines[number].strip()
        found.append(Site(file, start, before, after, kind, number + 1, line, seen[line, kind]))
        seen[line, kind] += 1
    return found


def changes(code: str, text: str) -> Iterator[Change]:
    for begin, end, returns_bool in bodies(code):
        for finder in FINDERS:
            for change in finder(code, begin, end):
                if not is_unseen(code, change[0]):
                    yield change
        if returns_bool:
            yield from returns(code, text, begin, end)


def is_unseen(code: str, place: int) -> bool:
    """Whether the statement at `place` is one whose change no test sees."""
    begin = max(code.rfind(mark, 0, place) for mark in ";{}") + 1
    end = code.find(";", place)
    return bool(UNSEEN.search(code[begin : end if end >= 0 else len(code)]))


def symbols(code: str, begin: int, end: int) -> Iterator[Change]:
    for match in SYMBOL.finditer(code, begin, end):
        symbol = match.group()
        near = code[: match.start()].rstrip()[-1:] + code[match.end() :].lstrip()[:1]
        if '"' in near:
            continue  # text that is put together
        for kind, after in SYMBOLS[symbol].items():
            yield match.start(), symbol, after, f"{kind} {symbol}"


def words(code: str, begin: int, end: int) -> Iterator[Change]:
    for match in WORD.finditer(code, begin, end):
        group = match.lastgroup or ""
        word = match[group]
        yield match.start(group), word, WORDS[word], f"word {word}"


def steps(code: str, begin: int, end: int) -> Iterator[Change]:
    for match in STEP.finditer(code, begin, end):
        other = {"++": "--", "--": "++"}[match.group()]
        yield match.start(), match.group(), other, f"step {match.group()}"


def negations(code: str, begin: int, end: int) -> Iterator[Change]:
    for match in NEGATION.finditer(code, begin, end):
        yield match.start(), "!", "", "negation"


def numbers(code: str, begin: int, end: int) -> Iterator[Change]:
    for match in NUMBER.finditer(code, begin, end):
        after = other_number(match.group(), match["suffix"])
        if after is not None:
            yield match.start(), match.group(), after, "number"


def other_number(literal: str, suffix: str) -> str | None:
    digits = literal.removesuffix(suffix).replace("'", "")
    if digits.isdigit():
        if suffix.strip("uUlLzZ") or (len(digits) > 1 and digits[0] == "0"):
            return None
        return f"{int(digits) + 1}{suffix}"
    if suffix.strip("fF"):
        return None
    value = float(digits)
    if value == 0:
        return f"1.0{suffix}"
    return f"{2 * value!r}{suffix}" if value >= SMALLEST else None


def calls(code: str, begin: int, end: int) -> Iterator[Change]:
    """Statements that are one call and nothing else."""
    for match in CALL.finditer(code, begin, end):
        closed = closing(code, match.end() - 1, "(", ")")
        if match["call"] in NOT_CALLED or closed is None or code[closed + 1 : closed + 2] != ";":
            continue
        yield match.start("call"), code[match.start("call") : closed + 1], "", "call"


def returns(code: str, text: str, begin: int, end: int) -> Iterator[Change]:
    """The opposite of what a function of bool returns."""
    for match in RETURN.finditer(code, begin, end):
        value = text[match.start("value") : match.end("value")]
        if value not in ("true", "false"):
            yield match.start("value"), value, f"!({value})", "return"


FINDERS = (symbols, words, steps, negations, numbers, calls)


def chosen_order(found: Iterable[Site], seed: int) -> list[Site]:
    """As if drawn one after the other: where a site stands among the others depends on the seed
    and on itself, not on which others there are."""

    def rank(site: Site) -> bytes:
        return hashlib.sha256(f"{seed}\n{site.key()}".encode()).digest()

    return sorted(found, key=rank)
