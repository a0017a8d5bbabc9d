"""tools/test --times: what a build and its tests took, summed."""

import json
import subprocess
import sys

import pytest
from ols_times import measure, sums

BUILD_NINJA = """\
rule CXX_EXECUTABLE_LINKER__ols-fuse_Release
build base/libols_base.a: CXX_STATIC_LIBRARY_LINKER__ols_base_Release base/a.o
build bin/ols-fuse: CXX_EXECUTABLE_LINKER__ols-fuse_Release a.o b.o | base/libols_base.a
build python/ols/_core.so python/x: CXX_MODULE_LIBRARY_LINKER__ols_python_Release a.o
build base/a.o: CXX_COMPILER__ols_base_Release a.cpp
"""
LINKS = {
    "base/libols_base.a": "ols_base",
    "bin/ols-fuse": "ols-fuse",
    "python/ols/_core.so": "ols_python",
}


def row(name: str, processor_s: float, wall_s: float, **others: float) -> sums.Row:
    return {"name": name, "processor_s": processor_s, "wall_s": wall_s, **others}


def trace(*events: tuple[str, int, int, str]) -> dict:
    keys = ("name", "ts", "dur", "detail")
    described = [dict(zip(keys, event, strict=True)) for event in events]
    return {
        "traceEvents": [
            {"ph": "X", "args": {"detail": one.pop("detail")}, **one} for one in described
        ]
        + [{"ph": "M", "name": "process_name", "args": {"name": "clang"}}]
    }


def test_a_target_is_the_sum_of_its_objects_and_its_link():
    assert sums.link_targets(BUILD_NINJA) == LINKS
    commands = [
        row("dev/CMakeFiles/ols-fuse.dir/Unity/unity_0_cxx.cxx.o", 3.0, 4.0),
        row("base/CMakeFiles/ols_base.dir/a.cpp.o", 1.0, 1.5),
        row("bin/ols-fuse", 0.5, 0.5),
    ]
    fuse, base, rest = sums.targets(commands, LINKS, row("build", 5.0, 3.0))
    assert fuse == row("ols-fuse", 3.5, 4.5, times=2)
    assert base == row("ols_base", 1.0, 1.5, times=1)
    assert rest["processor_s"] == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("instance", "name"),
    [
        ("std::vector<int>", "std::vector"),
        ("std::map<int, std::vector<int>>::find<long>", "std::map::find"),
        ("Eigen::operator<<<double>", "Eigen::operator<<"),
        ("std::operator<=><char, 3>", "std::operator<=>"),
        ("P<(A->b)>::operator->", "P::operator->"),
        ("std::sort", "std::sort"),
    ],
)
def test_instances_of_a_template_share_its_name(instance, name):
    assert sums.template_name(instance) == name


def test_headers_are_counted_without_and_with_what_they_include():
    """a.cpp and b.cpp of one unity source include x.h, which includes y.h and itself."""
    source = trace(
        ("Source", 0, 9_000_000, "/root/geometry/a.cpp"),
        ("Source", 1_000_000, 8_000_000, "/root/geometry/x.h"),
        ("Source", 2_000_000, 1_000_000, "/usr/include/c++/12/../12/y.h"),
        ("Source", 4_000_000, 2_000_000, "/root/geometry/x.h"),
        ("Source", 9_000_000, 1_000_000, "/usr/include/c++/12/y.h"),
        ("ParseClass", 4_000_000, 1_000_000, "X"),
    )
    x, y = sums.by_name(sums.headers(source, "/root", processor_share=0.5))
    assert x == row("geometry/x.h", 3.5, 7.0, with_nested_s=4.0, times=2)
    assert y == row("c++/12/y.h", 1.0, 2.0, with_nested_s=1.0, times=2)


def test_templates_are_classes_and_functions():
    source = trace(
        ("InstantiateFunction", 0, 3_000_000, "f<int>"),
        ("InstantiateClass", 1_000_000, 1_000_000, "std::vector<int>"),
        ("InstantiateClass", 5_000_000, 1_000_000, "std::vector<std::vector<int>>"),
    )
    f, vector = sums.by_name(sums.templates(source, processor_share=1.0))
    assert f == row("f", 2.0, 2.0, with_nested_s=3.0, times=1)
    assert vector == row("std::vector", 2.0, 2.0, with_nested_s=2.0, times=2)


def test_reports_of_googletest():
    case = {"name": "Joins/2", "time": "1.25s", "classname": "All/Rays"}
    report = {"testsuites": [{"name": "All/Rays", "time": "1.25s", "testsuite": [case]}]}
    assert sums.googletests("test_rays", report) == [
        {"name": "test_rays: All/Rays.Joins/2", "wall_s": 1.25}
    ]


def test_programs_that_others_need_run_first():
    folder = {"name": "WORKING_DIRECTORY", "value": "/b"}
    listed = {
        "tests": [
            {"name": "one", "command": ["/b/one", "-v"], "properties": [folder]},
            {"name": "not_built", "properties": [folder]},
            {
                "name": "seeds",
                "command": ["/b/seeds"],
                "properties": [{"name": "FIXTURES_SETUP", "value": ["seeds"]}, folder],
            },
        ]
    }
    assert sums.ctest_programs(listed) == [
        ("seeds", ["/b/seeds"], "/b"),
        ("one", ["/b/one", "-v"], "/b"),
    ]


def test_a_module_is_the_sum_of_its_tests():
    tests = [row("(collection)", 1, 2), row("t/a.py::x", 1, 2), row("t/a.py::y[a::b]", 2, 3)]
    collection, module = sums.modules(tests)
    assert collection["name"] == "(collection)"
    assert module == row("t/a.py", 3, 5, times=2)


def test_a_table_has_the_largest_rows_and_the_total_of_all():
    rows = [{"name": "a", "wall_s": 1.0}, row("b", 0.5, 3.0), {"name": "c|d", "wall_s": 2.0}]
    assert sums.table("tests", sums.ranked("tests", rows), top=2).splitlines() == [
        "## tests",
        "",
        "| name | processor_s | wall_s |",
        "|---|---:|---:|",
        "| b | 0.50 | 3.00 |",
        r"| c\|d |  | 2.00 |",
        "| total of 3 | 0.50 | 6.00 |",
    ]


def test_the_launcher_records_what_its_command_took_and_returns_its_status(tmp_path):
    log = tmp_path / "commands.jsonl"
    work = "sum(range(3_000_000)); raise SystemExit(3)"
    command = [measure.__file__, log, sys.executable, "-c", work, "-o", "a.o"]
    assert subprocess.run(command, check=False).returncode == 3
    recorded = json.loads(log.read_text())
    assert recorded["name"] == "a.o"
    assert recorded["processor_s"] > 0 and recorded["wall_s"] > 0
