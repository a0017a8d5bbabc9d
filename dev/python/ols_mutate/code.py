"""C++ text: what is code in it, and what of that is in the body of a function. Relies on
clang-format's blanks."""

import re
from collections.abc import Iterator

NOT_CODE = re.compile(
    r"""
    //[^\n]*
    | /\*.*?\*/
    | (?<![\w])(?:u8|[uUL])?R"(?P<end>[^(\s]*)\(.*?\)(?P=end)"
    | "(?:\\.|[^"\\\n])*"
    | (?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'
    | ^[ ]*\#(?:\\\n|[^\n])*
    """,
    re.VERBOSE | re.DOTALL | re.MULTILINE,
)
CONTAINER = re.compile(r"\b(namespace|class|struct|union|enum|extern)\b")
RETURNS_BOOL = re.compile(r"\bbool\s+[\w:]+\s*$")


def masked(text: str) -> str:
    """The same text with blanks for comments, literals of text and directives, as long as before.
    The quotes of a literal stay."""

    def blank(match: re.Match) -> str:
        found = match.group()
        blanks = re.sub(r"[^\n]", " ", found)
        return found[0] + blanks[1:-1] + found[-1] if found[0] in "\"'" else blanks

    return NOT_CODE.sub(blank, text)


def without_templates(code: str) -> str:
    """Blanks for what stands in the brackets of a template: `block<3, 3>` is not a comparison."""
    result = list(code)
    for start in (match.end() for match in re.finditer(r"(?:\w|\btemplate )<(?=[\w:(])", code)):
        end = closing(code, start - 1, "<", ">")
        # An arrow or a comparison in it would be a misreading.
        if end is not None and not re.search(r"[;{]|->| [<>]", code[start:end]):
            for i in range(start - 1, end + 1):
                result[i] = " " if result[i] != "\n" else "\n"
    return "".join(result)


def closing(code: str, start: int, opener: str, closer: str) -> int | None:
    """Where the bracket that opens at `start` closes."""
    depth = 0
    for i in range(start, len(code)):
        if code[i] == opener:
            depth += 1
        elif code[i] == closer:
            depth -= 1
            if depth == 0:
                return i
    return None


def bodies(code: str) -> Iterator[tuple[int, int, bool]]:
    """Start and end of each function's body in masked code, and whether the function returns bool.
    The initialisers of a constructor belong to its body."""
    start = i = 0
    while i < len(code):
        if code[i] in ";}":
            start = i + 1
        elif code[i] == "{":
            kind = opened(code[start:i])
            end = closing(code, i, "{", "}")
            if end is None:
                return
            if kind == "function":
                end = past_initialisers(code, end)
                yield i, end, returns_bool(code[start:i])
            if kind != "container":
                i = end
            start = i + 1
        i += 1


def opened(head: str) -> str:
    """What a brace opens outside of functions, by the text before it."""
    outer = outside_of_brackets(head)
    if "(" in outer and "=" not in re.sub(r"\boperator\S+", "", outer):
        return "function"
    if CONTAINER.search(outer) and "=" not in outer:
        return "container"
    return "values"


def outside_of_brackets(text: str) -> str:
    """Without what stands in round brackets, which themselves stay."""
    result, depth = [], 0
    for letter in text:
        depth -= letter == ")"
        if depth == 0:
            result.append(letter)
        depth += letter == "("
    return "".join(result)


def past_initialisers(code: str, end: int) -> int:
    """The end of the body, where the brace that ends at `end` may be a constructor's initialiser:
    another, or the body, follows."""
    following = re.compile(r"\s*(?:,\s*[\w:]+\s*(?:\([^{}]*\)\s*,?\s*[\w:]*\s*)*)?\{")
    while match := following.match(code, end + 1):
        after = closing(code, match.end() - 1, "{", "}")
        if after is None:
            return end
        end = after
    return end


def returns_bool(head: str) -> bool:
    return bool(RETURNS_BOOL.search(head.split("(")[0]))
