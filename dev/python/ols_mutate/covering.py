"""Which library a source belongs to, and which test programs cover it. From what CMake says of its
targets (the file API's codemodel); pure."""

import re
from dataclasses import dataclass, field
from pathlib import PurePath

SUITE = re.compile(r"^TEST(?:_F|_P)?\(\s*(\w+)\s*,", re.MULTILINE)
INSTANCES = re.compile(r"^INSTANTIATE_TEST_SUITE_P\(\s*(\w*)\s*,\s*(\w+)\s*,", re.MULTILINE)


@dataclass(frozen=True)
class Program:
    """A program that tests."""

    name: str
    folder: str  # of its sources
    sources: frozenset[str]
    libraries: frozenset[str]
    path: str  # of what is built, in the build's folder
    golden: str = ""  # it makes this golden; else it is one of GoogleTest


@dataclass
class Model:
    """What is built from what."""

    library_of: dict[str, str] = field(default_factory=dict)  # by the library's sources
    paths: dict[str, str] = field(default_factory=dict)  # of the built libraries, by their names
    programs: list[Program] = field(default_factory=list)


# The programs that make the goldens that need no simulated site.
GOLDENS = {
    "ols-golden-replay": ("two_drones",),
    "ols-golden-paper-mode": ("paper_mode",),
    "ols-fuse": ("offline_filter", "offline_smooth", "offline_least_squares", "offline_paper"),
}


def model_of(targets: list[dict]) -> Model:
    model = Model()
    names = {target["id"]: target["name"] for target in targets}
    for target in targets:
        sources = frozenset(source["path"] for source in target.get("sources", ()))
        folder = target["paths"]["source"]
        if target["type"] == "SHARED_LIBRARY":
            model.library_of |= dict.fromkeys(sources, target["name"])
            model.paths[target["name"]] = target["artifacts"][0]["path"]
        elif target["type"] == "EXECUTABLE":
            libraries = frozenset(names[one["id"]] for one in target.get("dependencies", ()))
            path = target["artifacts"][0]["path"]
            goldens = GOLDENS.get(target["name"], ())
            if folder.startswith(("tests/unit", "tests/oracle")):
                goldens = ("",)
            for golden in goldens:
                name = f"golden {golden}" if golden else target["name"]
                model.programs.append(Program(name, folder, sources, libraries, path, golden))
    return model


def mirror(source: str) -> str:
    """The unit test of a source."""
    return f"tests/unit/{PurePath(source).with_suffix('')}_test.cpp"


def distance(source: str, program: Program) -> int:
    """How far a test program is from a source: 0 has its unit test, 1 is of its folder, 2 of
    another one, 3 compares results."""
    if program.golden:
        return 3
    if mirror(source) in program.sources:
        return 0
    top = f"tests/unit/{PurePath(source).parent}"
    near = any(PurePath(one).is_relative_to(top) for one in program.sources)
    return 1 if near else 2


def covering(
    model: Model, source: str, folders: list[str], seconds: dict[str, float]
) -> list[Program]:
    """The test programs of `folders` that link the source's library: the nearest first, then those
    that take the least time."""
    library = model.library_of[source]
    found = [
        program
        for program in model.programs
        if library in program.libraries and is_of(program, folders)
    ]
    return sorted(found, key=lambda one: (distance(source, one), seconds.get(one.name, 0.0)))


def is_of(program: Program, folders: list[str]) -> bool:
    """Whether it tests one of the folders."""
    if not program.folder.startswith("tests/unit"):
        return True
    return any(
        PurePath(one).is_relative_to(f"tests/unit/{folder}")
        for one in program.sources
        for folder in folders
    )


def suites(test: str) -> str:
    """GoogleTest's filter for the tests in a source."""
    plain = {f"{name}.*" for name in SUITE.findall(test)}
    instances = {f"{prefix}/{name}.*" for prefix, name in INSTANCES.findall(test)}
    return ":".join(sorted(plain | instances))
