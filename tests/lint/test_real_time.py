"""The modules that share the cores (tests/conftest.py): a name that is misspelt or gone would leave
a module among the others without a word."""

from pathlib import Path

from conftest import REAL_TIME

E2E = Path(__file__).resolve().parents[1] / "e2e"


def test_every_module_in_real_time_exists():
    assert [name for name in REAL_TIME if not (E2E / name).is_file()] == []


def test_none_is_named_twice():
    assert len(set(REAL_TIME)) == len(REAL_TIME)
