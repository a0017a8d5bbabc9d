"""Plots of ols-batch: of what is there now, drawn again only if that is something else."""

import dataclasses

import pytest
from batch_site import here
from ols_batch import identities, plots
from ols_batch import run as runner

pytest_plugins = ["batch_fixtures"]


def drawn(settings) -> dict[str, tuple[bytes, int]]:
    """By a run that has nothing else to do: what is in the plots, and which files they are."""
    report = runner.run(settings)
    assert report.skipped and not report.done
    return {one.name: (one.read_bytes(), one.stat().st_ino) for one in plots_of(settings, report)}


def plots_of(settings, report) -> list:
    found = sorted((settings.output / "plots").glob("*.png"))
    assert sorted(report.plots) == [str(path) for path in found]
    return found


def other(settings):
    """The same hours by another estimator, without plots."""
    changed = dataclasses.replace(settings, estimator="paper")
    here(changed)
    identities.join(changed.output)
    return changed


def test_they_are_drawn_once(own):
    first = drawn(own)
    assert sorted(first) == ["brno-hours.png", "brno-tracks.png"]
    assert drawn(own) == first


def test_after_a_run_without_plots_they_are_of_the_new_result(own):
    old = drawn(own)["brno-tracks.png"]
    new = drawn(other(own))["brno-tracks.png"]
    assert new[0] != old[0]


def test_what_an_interrupted_run_has_left_is_drawn_again(own, monkeypatch):
    old = drawn(own)
    changed = other(own)
    save = plots.save

    def killed(figure, path):
        save(figure, path)
        raise KeyboardInterrupt

    with monkeypatch.context() as patch, pytest.raises(KeyboardInterrupt):
        patch.setattr(plots, "save", killed)
        runner.run(changed)
    # Back to what they were of before: one of them is not.
    here(own)
    identities.join(own.output)
    again = drawn(own)
    assert {name: data for name, (data, _) in again.items()} == {
        name: data for name, (data, _) in old.items()
    }


def test_one_that_is_missing_is_drawn_again(own):
    first = drawn(own)
    (own.output / "plots" / "brno-hours.png").unlink()
    assert {name: data for name, (data, _) in drawn(own).items()} == {
        name: data for name, (data, _) in first.items()
    }
    (own.output / "plots" / "made.json").write_text("[]")
    assert len(drawn(own)) == 2


def test_those_of_damaged_files_are_drawn_each_time(own):
    """Nobody knows what they are of."""
    drawn(own)
    fixes = list((own.output / "fixes").rglob("*.parquet"))
    first = plots.draw(own.output, fixes, "")
    inodes = [path.stat().st_ino for path in first]
    assert [path.stat().st_ino for path in plots.draw(own.output, fixes, "")] != inodes
