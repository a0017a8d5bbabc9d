"""Sizes at which a class, a function or a file has more than one subject.

A class has functions besides its constructors. A struct without any is a record: its members are
values that belong together, such as a message or a configuration, and they are not counted.
"""

import limits
import pytest

MOST_MEMBERS = 15
MOST_LINES = 400
MOST_FUNCTION_LINES = 60
# Name of a class or a file -> why it may be larger.
EXCEPTIONS: dict[str, str] = {}
EVERYWHERE = (*limits.FOLDERS, "tests")
WRITTEN = [
    *limits.sources(EVERYWHERE),
    *limits.python_sources(EVERYWHERE),
    *limits.page_sources(),
]
TAGS = limits.declared(limits.sources())
CLASSES = limits.classes(TAGS)


def too_large(classes: dict[str, limits.Class]) -> list[str]:
    return [
        f"{name} has {one.members} data members ({one.header})"
        for name, one in classes.items()
        if one.functions > 0 and one.members > MOST_MEMBERS and name not in EXCEPTIONS
    ]


def in_several_files(classes: dict[str, limits.Class]) -> list[str]:
    return [
        f"{name} is defined in {sorted(one.bodies)}"
        for name, one in classes.items()
        if len(one.bodies) > 1 and name not in EXCEPTIONS
    ]


def test_no_class_has_too_many_members():
    assert too_large(CLASSES) == []


def test_a_class_has_one_cpp():
    assert in_several_files(CLASSES) == []


def test_a_type_is_defined_once():
    """Two of one name in one program break the one-definition rule, and no linker says so."""
    twice = {name: files for name, files in limits.definitions(TAGS).items() if len(files) > 1}
    assert twice == {}


def test_two_of_one_name_are_found(tmp_path):
    for name in ("a.h", "b.h"):
        (tmp_path / name).write_text("namespace n { struct View { int x; }; }")
    found = limits.definitions(limits.declared(sorted(tmp_path.iterdir())))
    assert len(found["n::View"]) == 2


def test_the_counts_are_those_of_the_sources(tmp_path):
    (tmp_path / "a.h").write_text(
        "namespace n { class A { public: void f(); void g(); private: int x_ = 0, y_ = 0; }; }"
        "struct Record { int a; int b; };"
    )
    (tmp_path / "a.cpp").write_text("namespace n { void A::f() {} }")
    (tmp_path / "b.cpp").write_text("namespace n { void A::g() {} }")
    tags = limits.declared(sorted(tmp_path.iterdir()))
    found = limits.classes(tags)
    assert found["n::A"].members == 2
    assert found["Record"].functions == 0
    assert in_several_files(found) == [
        f"n::A is defined in {[str(tmp_path / 'a.cpp'), str(tmp_path / 'b.cpp')]}"
    ]
    found["n::A"].members = MOST_MEMBERS + 1
    assert len(too_large(found)) == 1


@pytest.mark.parametrize("path", WRITTEN, ids=limits.relative)
def test_no_file_is_too_long(path):
    lines = path.read_text().count("\n")
    assert lines <= MOST_LINES or limits.relative(path) in EXCEPTIONS, f"{lines} lines"


def too_long(tags: list[dict]) -> list[str]:
    return [
        f"{place} has {lines} lines"
        for place, lines in limits.function_lines(tags)
        if lines > MOST_FUNCTION_LINES
    ]


def test_no_function_is_too_long():
    assert too_long(limits.declared([path for path in WRITTEN if ".ts" not in path.suffix])) == []


needs_page_compiler = pytest.mark.skipif(
    not limits.PAGE_COMPILER.exists(),
    reason="build/page-libraries is missing: tools/fetch-page-libraries",
)


@needs_page_compiler
def test_no_function_of_the_page_is_too_long():
    assert too_long(limits.declared_by_page(limits.page_sources())) == []


def in_page(*values):
    return pytest.param(limits.declared_by_page, *values, marks=needs_page_compiler)


@pytest.mark.parametrize(
    ("declared", "name", "head", "line", "tail"),
    [
        (limits.declared, "a.cpp", "void f() {", "  g();", "}"),
        (limits.declared, "a.py", "def f():", "    g()", ""),
        in_page("a.ts", "export async function f() {", "  g();", "}"),
        in_page("a.ts", "const f = async (x: number): Promise<void> => {", "  g();", "};"),
        in_page("a.tsx", "const f = ({ x }: Props) => (", "  <p onClick={() => g()}>{x}</p>", ");"),
        in_page("a.ts", "class A { private readonly f = () => {", "  g();", "}; }"),
        in_page("a.ts", "class A { get f(): number {", "  g();", "} }"),
    ],
)
def test_a_long_function_is_found(tmp_path, declared, name, head, line, tail):
    path = tmp_path / name
    most = MOST_FUNCTION_LINES - 1 - bool(tail)
    for lines, found in (
        (most, []),
        (most + 1, [f"{path}:1 f has {MOST_FUNCTION_LINES + 1} lines"]),
    ):
        path.write_text("\n".join([head, *[line] * lines, *[tail] * bool(tail)]) + "\n")
        assert too_long(declared([path])) == found


@needs_page_compiler
def test_a_function_of_the_page_has_the_lines_of_those_within_it(tmp_path):
    path = tmp_path / "a.tsx"
    path.write_text(
        "function Eye() {\n  const move = () => {\n    g();\n  };\n  return <p />;\n}\n"
        "class A {\n  constructor() {\n    g();\n  }\n  f = {\n    g() {},\n  };\n}\n"
        "list.map((one) => {\n  g(one);\n});\n"
        "declare function h(): void;\n"
    )
    found = limits.function_lines(limits.declared_by_page([path]))
    assert found == [
        (f"{path}:1 Eye", 6),
        (f"{path}:8 constructor", 3),
        (f"{path}:12 g", 1),
        (f"{path}:15 unnamed", 3),
    ]


def test_exceptions_are_few_and_needed():
    assert len(EXCEPTIONS) <= 5
    names = {*CLASSES, *map(limits.relative, WRITTEN)}
    assert set(EXCEPTIONS) <= names
