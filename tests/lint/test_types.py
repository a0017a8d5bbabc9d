"""A type is defined once.

Two types of one name in one program break the one-definition rule, and no linker says so.
"""

import re
from collections import defaultdict

from test_includes import sources

NOT_CODE = re.compile(r"""//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"|'\\?.'""", re.S)
OPENING = re.compile(
    r"\bnamespace\s*(?P<space>[\w:]*)\s*\{"
    r"|\b(?:class|struct|union|enum(?:\s+(?:class|struct))?)\s+(?P<type>\w+(?:::\w+)*)"
    r"(?:\s+final)?\s*(?::(?!:)[^;{}()]*)?\{"
    r"|[{}]"
)


def types(text: str) -> list[str]:
    """Full names of the types that are defined in namespaces; one in an unnamed namespace, in a
    function or in another type does not count."""
    found: list[str] = []
    scopes: list[str] = []  # of each open brace the namespace; empty if it is anything else
    for token in OPENING.finditer(NOT_CODE.sub("", text)):
        if token[0] == "}":
            scopes.pop()
            continue
        if token["type"] and all(scopes):
            found.append("::".join([*scopes, token["type"]]))
        scopes.append(token["space"] or "")
    assert not scopes, "braces that do not match"
    return found


def test_a_type_is_defined_once():
    files: dict[str, set[str]] = defaultdict(set)
    for name, text in sources().items():
        for one in types(text):
            files[one].add(name)
    assert len(files) > 1000
    assert {one: where for one, where in files.items() if len(where) > 1} == {}


def test_the_types_of_a_source_are_found():
    text = """
    namespace n::m { struct View { struct Row { int x; }; };  // struct No {
    template <class T> class Pair final : public Base<T> { void f() { struct Local {}; } }; }
    namespace { struct View {}; }
    struct View;
    enum class Kind : int { kOne };
    """
    assert types(text) == ["n::m::View", "n::m::Pair", "Kind"]
