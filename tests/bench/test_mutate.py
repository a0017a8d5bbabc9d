"""tools/mutate: where code is changed, which mutants are chosen, what tests them, what it tells."""

import os
import select

import pytest
from ols_mutate import code, covering, report
from ols_mutate.bench import Processes
from ols_mutate.sites import chosen_order, sites

HEAD = "#include <a.h>\nnamespace ols {\n"


def body(*lines: str, head: str = "double f(double a, double b)") -> str:
    return HEAD + head + " {\n" + "".join(f"  {line}\n" for line in lines) + "}\n}\n"


def found(*lines: str, **head: str) -> set[tuple[str, str]]:
    """The line after each change, and the kind of it."""
    text = body(*lines, **head)
    return {(site.changed_line(text), site.kind) for site in sites("x.cpp", text)}


ONE_LINE = [
    ("return a + b;", "return a - b;", "arithmetic +"),
    ("return a && b;", "return a || b;", "logic &&"),
    ("return a == b;", "return a != b;", "equality =="),
    ("a *= b;", "a /= b;", "arithmetic *="),
    ("return std::min(a, b);", "return std::max(a, b);", "word min"),
    ("return std::sin(a);", "return std::cos(a);", "word sin"),
    ("x = true;", "x = false;", "word true"),
    ("++a;", "--a;", "step ++"),
    ("if (!x) y = a;", "if (x) y = a;", "negation"),
    ("x = 0;", "x = 1;", "number"),
    ("x = 7;", "x = 8;", "number"),
    ("x = 0.0;", "x = 1.0;", "number"),
    ("x = 1e6;", "x = 2000000.0;", "number"),
    ("x = 0.5F;", "x = 1.0F;", "number"),
    ("x = 2U;", "x = 3U;", "number"),
    ("x = 1'000;", "x = 1001;", "number"),
    ("add(a, g(b));", ";", "call"),
    ("if (x) one->list[i].push_back({a, b});", "if (x) ;", "call"),
]


@pytest.mark.parametrize(("line", "changed", "kind"), ONE_LINE)
def test_each_thing_becomes_another(line, changed, kind):
    assert found(line) == {(changed, kind)}


def test_a_comparison_moves_its_boundary_or_turns_round():
    assert found("return a < b;") == {
        ("return a <= b;", "boundary <"),
        ("return a > b;", "direction <"),
    }


@pytest.mark.parametrize(
    "line",
    [
        *(f"x = {number};" for number in ("1e-9", "0x80", "017", "1'0s")),
        # Neither statement that is a call nor operator.
        "Thing thing(a); const Thing other(a); x = add(a); return add(a);",
        "x.block<3, 3>(a, b) = y; std::vector<Place> list; T* p = &a;",
        "x = -a; auto f = [&](T&& t) -> int { return t; };",
        "std::array<std::pair<int, double>, 4> pairs;",
        # Comments, texts, directives; a text that is put together.
        "x = a;  // a + b",
        "/* a + b; f(a); */",
        'y = "a + 1 \\" + 2";',
        "z = '+';",
        'raw = R"(a + b " c)";',
        "#define X 3 + 4",
        'x = "a" + y + "b";',
        # What no test sees.
        "list.reserve(a + 1);",
        "static_assert(4 == sizeof(int));",
        "spdlog::warn(word, a + b);",
        "char text[32];",
    ],
)
def test_some_things_stay(line):
    assert found(line) == set()


def test_a_call_of_several_lines_is_one():
    text = body("add(a,", "    b);", "x = a;")
    (site,) = sites("x.cpp", text)
    assert site.changed(text) == body(";", "x = a;")


def test_only_a_function_of_bool_returns_the_opposite():
    assert found("return x;", head="bool C::is(int y) const") == {("return !(x);", "return")}
    assert found("return x;", head="int C::is(bool y) const") == set()


def test_a_comparison_beside_a_template_is_one():
    assert ("if (static_cast<int>(a) <= b) x = a;", "boundary <") in found(
        "if (static_cast<int>(a) < b) x = a;"
    )


def test_outside_of_functions_nothing_is_changed():
    text = HEAD + (
        "constexpr double kLeast = 3.0 + 4.0;\n"
        "const std::array<int, 2> kTable = {1, 2};\n"
        "struct Config { double rate = 5.0; };\n"
        "enum class Kind { kOne = 1 };\n"
        "int declared(int a = 3);\n"
        "}\n"
    )
    assert sites("x.cpp", text) == []


@pytest.mark.parametrize(
    "head",
    [
        "C::C(int a) : a_{a}, b_(a), c_{}",
        "bool operator==(const A& a, const A& b)",
        "template <typename T>\nT f(T a)",
        "static std::optional<double> f(const std::vector<int>& a)",
    ],
)
def test_every_shape_of_function_has_a_body(head):
    text = body("a += b;", head=head)
    assert [site.kind for site in sites("x.cpp", text)] == ["arithmetic +="]


def test_a_class_holds_functions_and_is_none():
    text = HEAD + "class C {\n public:\n  int f() { return a + b; }\n  int d_ = 3 + 4;\n};\n}\n"
    assert [(site.line, site.kind) for site in sites("x.cpp", text)] == [(5, "arithmetic +")]


def test_masked_code_is_as_long_as_the_text():
    text = body('x = "a\\"b" + \'"\';  // c', '/* d\n e */ y = R"z(1)"2)z";')
    assert len(code.masked(text)) == len(text)
    assert code.masked(text).count("\n") == text.count("\n")


def test_the_end_of_a_quoted_character_is_not_the_start_of_another():
    assert found("x = 'a' + b - 'c';") == {
        ("x = 'a' - b - 'c';", "arithmetic +"),
        ("x = 'a' + b + 'c';", "arithmetic -"),
    }


LINES = [f"x{i} = a + b * {i};" for i in range(40)]


def test_another_edit_does_not_change_which_others_are_chosen():
    before = chosen_order(sites("x.cpp", body(*LINES)), 1)
    edited = body("int later = 0;", *LINES[:20], "y = c - d;", *LINES[20:])
    after = chosen_order(sites("x.cpp", edited), 1)
    new = ("int later = 0;", "y = c - d;")
    assert [site.key() for site in after if site.text not in new] == [s.key() for s in before]


def test_the_seed_decides_the_order():
    all_sites = sites("x.cpp", body(*LINES))
    orders = [[site.key() for site in chosen_order(all_sites, seed)] for seed in (1, 1, 2)]
    assert orders[0] == orders[1] != orders[2]
    assert sorted(orders[0]) == sorted(orders[2])
    assert orders[0] != [site.key() for site in all_sites]


def test_equal_lines_are_told_apart():
    same = sites("x.cpp", body("x = a + b + c;", "x = a + b + c;"))
    assert [site.occurrence for site in same] == [0, 1, 2, 3]
    assert len({site.name() for site in same}) == 4


def target(name, kind, folder, sources, needs=()):
    return {
        "id": name,
        "name": name,
        "type": kind,
        "paths": {"source": folder},
        "sources": [{"path": one} for one in sources],
        "dependencies": [{"id": one} for one in needs],
        "artifacts": [{"path": f"out/{name}"}],
    }


MODEL = covering.model_of(
    [
        target("geo", "SHARED_LIBRARY", "geometry", ["geometry/a.cpp", "geometry/b.cpp"]),
        target("sim", "SHARED_LIBRARY", "sim", ["sim/s.cpp"], ["geo"]),
        *(
            target(name, "EXECUTABLE", folder, [f"{folder}/{test}_test.cpp"], ["geo"])
            for name, folder, test in (
                ("geo_b", "tests/unit/geometry", "b"),
                ("geo_a", "tests/unit/geometry", "a"),
                ("far", "tests/unit/central", "c"),
                ("sim_test", "tests/unit/sim", "s"),
                ("oracle", "tests/oracle", "o"),
                ("ols-fusion", "central/app", "main"),
            )
        ),
        target("other", "EXECUTABLE", "tests/unit/geometry", ["tests/unit/geometry/x_test.cpp"]),
        target("ols-golden-replay", "EXECUTABLE", "tests/golden", ["replay.cpp"], ["geo"]),
    ]
)


def covered_by(folders, seconds=None):
    covers = covering.covering(MODEL, "geometry/a.cpp", folders, seconds or {})
    return [program.name for program in covers]


def test_the_unit_test_comes_first_then_its_folder_then_others_then_goldens():
    assert covered_by(["geometry", "central"], {"far": 2.0, "oracle": 1.0}) == [
        *("geo_a", "geo_b", "oracle", "far", "golden two_drones")
    ]


def test_the_quicker_of_two_comes_first():
    assert covered_by(["central", "geometry"], {"far": 1.0, "oracle": 2.0})[2] == "far"


def test_the_tests_of_folders_that_were_not_asked_for_are_not_run():
    assert covered_by(["geometry"]) == ["geo_a", "geo_b", "oracle", "golden two_drones"]


def test_the_suites_of_a_test_source():
    text = (
        "TEST(Plain, A) {}\nTEST_F(Fixture, B) {}\nTEST(Plain, C) {}\n"
        "TEST_P(Values, D) {}\nINSTANTIATE_TEST_SUITE_P(All, Values,\n    testing::Bool());\n"
    )
    assert covering.suites(text) == "All/Values.*:Fixture.*:Plain.*:Values.*"


def judged(file, outcome, by=""):
    text = body("return a + b;")
    (site,) = sites(file, text)
    return report.Judged(site, outcome, by, site.changed_line(text))


JUDGED = [
    judged("base/x.cpp", report.SURVIVED),
    judged("base/trust/y.cpp", report.KILLED, "test_trust T.T"),
    judged("base/x.cpp", report.NOT_VIABLE),
    judged("base/x.cpp", report.KILLED, "test_base B.B"),
]


def test_the_table_counts_by_the_narrowest_folder():
    rows = [line.split() for line in report.table(JUDGED, ["base", "base/trust"]).splitlines()[1:]]
    assert rows == [
        ["base", "2", "1", "1", "50.0", "1"],
        ["base/trust", "1", "1", "0", "0.0", "0"],
        ["all", "3", "2", "1", "33.3", "1"],
    ]


def test_the_share_of_survivors_is_of_those_that_compile():
    assert report.survivors_percent(JUDGED) == pytest.approx(100 / 3)
    assert report.survivors_percent([]) == 0.0


def test_a_survivor_is_shown_with_its_line_before_and_after():
    assert JUDGED[0].line().splitlines() == [
        "survived   base/x.cpp:4 (arithmetic +)",
        "    - return a + b;",
        "    + return a - b;",
    ]
    assert JUDGED[1].line() == "killed     base/trust/y.cpp:4 (arithmetic +) by test_trust T.T"


def test_a_program_that_hangs_is_ended_with_what_it_has_started(tmp_path):
    held = tmp_path / "held"
    os.mkfifo(held)
    reader = os.open(held, os.O_RDONLY | os.O_NONBLOCK)
    done = Processes().run(["sh", "-c", f"(echo begun; sleep 1000) >{held} & wait"], 0.2)
    assert done.code is None
    said = b""
    while True:  # to the end, which comes when nobody holds it any more
        assert select.select([reader], [], [], 60.0)[0], "what it has started goes on"
        part = os.read(reader, 100)
        if not part:
            break
        said += part
    assert said == b"begun\n"


def test_a_program_that_is_busy_for_too_long_is_ended():
    done = Processes().run(["sh", "-c", "while :; do :; done"], 1.0)
    assert done.code is None


def test_how_a_program_ended_is_known_and_what_it_said():
    done = Processes().run(["sh", "-c", "echo out $WORD; echo err >&2; exit 3"], 60.0, WORD="a")
    assert (done.code, done.output) == (3, "out a\nerr\n")
