"""The wheel, installed into an environment in which nothing of the tree is."""

import ast
import os
import re
import site
import subprocess
import sys
import zipfile
from pathlib import Path

import ols
import ols_msg
import pytest
from archive_site import REGION, ROOT, event, flown, write_log
from conftest import finished

BUILT = Path(ols.__file__).parents[1]


def run(*command, **options) -> subprocess.CompletedProcess:
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    return finished(*command, env=clean | options)


@pytest.fixture(scope="module", name="wheel")
def fixture_wheel(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    done = run(ROOT / "tools/build-wheel", "--only", folder, OLS_PYTHON=str(BUILT))
    assert done.returncode == 0, done.stderr
    (path,) = folder.glob("ols-*.whl")
    return path


@pytest.fixture(scope="module", name="installed")
def fixture_installed(wheel, tmp_path_factory) -> Path:
    """Its programs. Packages of others come from the tests' environment: there is no network."""
    folder = tmp_path_factory.mktemp("clean")
    assert run(sys.executable, "-m", "venv", folder).returncode == 0
    python = folder / "bin/python"
    pip = ("-m", "pip", "install", "--no-index", "--no-deps", "--disable-pip-version-check")
    done = run(python, *pip, wheel)
    assert done.returncode == 0, done.stderr
    (packages,) = folder.glob("lib/python*/site-packages")
    (packages / "others.pth").write_text("\n".join(site.getsitepackages()))
    return folder / "bin"


def test_the_module_computes_and_is_the_wheels(installed):
    code = "import ols, ols.frames, ols_msg; print(ols.__file__, ols.__version__, ols.REFUSALS[-1])"
    done = run(installed / "python", "-I", "-c", code)
    assert done.returncode == 0, done.stderr
    path, version, refusal = done.stdout.split()
    assert path.startswith(str(installed.parent))
    assert (version, refusal) == (ols.__version__, "refused_not_finite")


def test_its_programs_work(installed, tmp_path):
    log = write_log(tmp_path / "a.lcmlog", map(event, flown(1)))
    done = run(installed / "ols-archive", tmp_path / "archive", "--region", REGION, log)
    assert done.returncode == 0, done.stderr
    assert f"{len(flown(1))} added" in done.stderr
    done = run(installed / "ols-batch", "--help")
    assert done.returncode == 0 and "--warm-up-s" in done.stdout


@pytest.mark.parametrize("program", ["ols_archive", "ols_batch"])
def test_programs_say_what_they_do_and_need_without_the_extra(program, tmp_path):
    (tmp_path / "archive/bearing").mkdir(parents=True)
    bare = "import sys; sys.modules.update(pyarrow=None, dask=None, distributed=None)"
    main = f"{bare}; import {program}.__main__ as it; sys.exit(it.main())"
    done = run(sys.executable, "-c", main, "--help", PYTHONPATH=str(BUILT))
    assert done.returncode == 0 and "exit code" in done.stdout.lower(), done.stderr
    folders = (tmp_path / "archive", tmp_path / "other")
    words = (*folders, *(["--region", "brno"] if program == "ols_archive" else []))
    done = run(sys.executable, "-c", main, *words, PYTHONPATH=str(BUILT))
    assert done.returncode == 2 and done.stderr.count("\n") == 1, done.stderr
    assert "install ols[archive]" in done.stderr


@pytest.mark.parametrize("package", ["pandas", "pyarrow"])
def test_frames_name_the_extra_that_they_need(package):
    code = f"import sys; sys.modules['{package}'] = None; import ols.frames"
    done = run(sys.executable, "-c", code, PYTHONPATH=str(BUILT))
    assert done.stderr.endswith("install ols[archive]\n"), done.stderr


def test_its_help_lists_classes_and_type_checkers_know_them(wheel):
    code = "import ols, pydoc; print(pydoc.plain(pydoc.render_doc(ols)))"
    told = run(sys.executable, "-c", code, PYTHONPATH=str(BUILT)).stdout
    for name in ("class Bearings", "class LogReader", "ecef_from_geodetic(", "REFUSALS"):
        assert name in told, name
    with zipfile.ZipFile(wheel) as archive:
        stub = archive.read("ols/_core.pyi").decode()
        assert "ols/py.typed" in archive.namelist()
    ast.parse(stub)
    for name in ols._core.__all__:
        assert re.search(rf"^(class|def) {name}\b|^{name}\b", stub, re.M), name


def test_it_says_what_it_is_and_needs(wheel):
    with zipfile.ZipFile(wheel) as archive:
        (name,) = (name for name in archive.namelist() if name.endswith("/METADATA"))
        told = archive.read(name).decode()
        listed = archive.namelist()
    assert f"Version: {ols.__version__}" in told
    for line in (ROOT / "requirements-archive.txt").read_text().split():
        least = re.sub(r"==(\d+)\..*", r">=\1", line)
        assert f"Requires-Dist: {least}; extra == 'archive'" in told.replace('"', "'")
    assert "==" not in re.sub("extra ==", "", told.split("\n\n")[0])
    assert f"ols_lcmtypes/{ols_msg.bearing_t.__name__}.lcm" in listed
    assert "-cp3" in wheel.name and "linux" in wheel.name
