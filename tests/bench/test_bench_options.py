"""What may be asked of tools/bench tracking."""

import pytest

pytest.importorskip("cv2", reason="tools/install-benchmarks")

from ols_bench.__main__ import names_in, seed_places, seeds_in
from ols_bench.clips import BadInput
from ols_bench.variants import KINDS


def test_names_and_seeds_are_lists():
    assert names_in("erased, covered", KINDS, "--variants") == ["erased", "covered"]
    assert names_in("", KINDS, "--variants") == []
    assert seeds_in("3,1") == [3, 1]


@pytest.mark.parametrize("text", ["", "a", "1,1", "-1", "1.5"])
def test_seeds_that_are_none_are_refused(text):
    with pytest.raises(BadInput, match="--seeds"):
        seeds_in(text)


def test_unknown_kinds_are_refused_by_name():
    with pytest.raises(BadInput, match="--variants: blurred"):
        names_in("erased,blurred", KINDS, "--variants")


def test_what_is_not_random_runs_once():
    assert seed_places("ours (full)", [3, 1]) == {3: None, 1: 1}
    assert seed_places("CSRT", [3, 1]) == {3: None}
