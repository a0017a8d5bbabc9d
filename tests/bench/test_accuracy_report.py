"""tools/accuracy-report: its runs, the reading of them, and the document that they make."""

import csv
import json
import re
import subprocess
import sys

import numpy as np
import pytest
from ols_accuracy import document, plot, run_plots, theory_plots
from ols_accuracy.__main__ import budget_basis
from ols_accuracy.runs import (
    EACH_OTHER,
    KINDS,
    LANDMARKS,
    PROGRAMS,
    RANDOM,
    ROOT,
    SOURCES,
    STAYING,
    WALK,
    budget_run,
    left_out,
    make_all,
    mean_bound,
    mean_error,
    picture_run,
    usable,
)

TABLE1 = ROOT / "dev/python/ols_accuracy/table1.csv"


def without(run):
    command = run.command()
    return (
        set(command[command.index("--without") + 1].split(",")) if "--without" in command else set()
    )


def test_a_source_alone_switches_all_others_off(tmp_path):
    everything = {error for errors in SOURCES.values() for error in errors}
    for source, errors in SOURCES.items():
        run = budget_run(tmp_path, LANDMARKS, source, "mast", 1)
        assert without(run) == everything - set(errors)
        assert "--pixels" in run.command()
    assert without(budget_run(tmp_path, LANDMARKS, "none", "mast", 1)) == everything
    assert without(budget_run(tmp_path, LANDMARKS, "all", "mast", 1)) == set()


def test_pictures_are_of_the_named_experiment(tmp_path):
    assert without(picture_run(tmp_path, RANDOM, "mast", 1)) == set(STAYING)
    run = picture_run(tmp_path, EACH_OTHER, WALK, 1)
    assert run.scenario == "walk" and run.seconds > 120 and "--pixels" not in run.command()
    assert EACH_OTHER in run.command() and without(run) == set()


def test_runs_are_made_once_and_read(tmp_path):
    runs = [budget_run(tmp_path, LANDMARKS, "all", "pillar3", seed) for seed in (1, 2)]
    assert np.isnan(mean_error(runs)) and np.isnan(mean_bound(runs))
    make_all(runs, 2)
    assert 0.02 < mean_error(runs) < 3.0
    assert 0.1 < mean_bound(runs) < 1.0
    before = (runs[0].folder / "summary.json").stat().st_mtime_ns
    make_all(runs, 1)
    assert (runs[0].folder / "summary.json").stat().st_mtime_ns == before


def test_the_mean_is_over_runs_and_horizontal(tmp_path):
    runs = [budget_run(tmp_path, LANDMARKS, "all", "mast", seed) for seed in (1, 2)]
    for run, east, bound in zip(runs, (3.0, 5.0), (1.0, 7.0), strict=True):
        run.folder.mkdir(parents=True)
        (run.folder / "summary.json").write_text(json.dumps({"crb_horizontal_rmse_m": bound}))
        rows = "error_east_m,error_north_m,error_up_m\n" + f"{east},4,100\n" * 3
        (run.folder / "fixes.csv").write_text(rows)
    assert mean_error(runs) == pytest.approx(np.sqrt((25 + 41) / 2))
    assert mean_bound(runs) == pytest.approx(5.0)


def test_a_run_without_a_bound_is_left_out_and_told(tmp_path):
    runs = [budget_run(tmp_path, LANDMARKS, "all", "mast", seed) for seed in (1, 2, 3)]
    for run, bound in zip(runs[:2], (2.0, None), strict=True):
        run.folder.mkdir(parents=True)
        (run.folder / "summary.json").write_text(json.dumps({"crb_horizontal_rmse_m": bound}))
        (run.folder / "fixes.csv").write_text("error_east_m,error_north_m,error_up_m\n3,4,0\n")
    assert usable(runs) == runs[:1] and left_out(runs) == runs[1:2]
    assert mean_error(runs) == pytest.approx(5.0) and mean_bound(runs) == 2.0
    assert "1 of them" in budget_basis(tmp_path, range(1, 4))
    assert "mast (seed 2)" in budget_basis(tmp_path, range(1, 4))


def test_a_frame_counts_where_the_target_itself_is_tracked(tmp_path):
    run = budget_run(tmp_path, LANDMARKS, "all", WALK, 1)
    run.folder.mkdir(parents=True)
    frames = [
        ("west", 1.0, "tracking", 9, 9),
        ("west", 2.0, "tracking", 11, 0),  # beside its box
        ("west", 3.0, "tracking", -4, -4),
        ("east", 1.1, "tracking", 0, 0),
        ("east", 2.1, "tracking", 0, 0),
        ("east", 3.1, "coasting", "", ""),
    ]
    header = "station,time_s,state,error_x_px,error_y_px,width_px,height_px\n"
    rows = "".join(f"{','.join(map(str, row))},20,20\n" for row in frames)
    (run.folder / "frames.csv").write_text(header + rows)
    times = "".join(f"{1_700_000_000_000_000 + int(1e6 * t)}\n" for t in (1.2, 2.2, 3.2))
    (run.folder / "fixes.csv").write_text("utime_us\n" + times)
    share, by_all = run.frames_on_target()
    assert share == pytest.approx(4 / 6)
    assert by_all.tolist() == [True, False, False]


def test_only_what_is_between_the_marks_is_replaced(tmp_path):
    path = tmp_path / "document.md"
    path.write_text("a\n<!-- part -->\nold\n<!-- /part -->\nb\n")
    document.replace_part("part", "new\nlines", path)
    assert path.read_text() == "a\n<!-- part -->\nnew\nlines\n<!-- /part -->\nb\n"
    with pytest.raises(SystemExit, match="has no part other"):
        document.replace_part("other", "", path)


def test_metres_have_two_digits_and_nothing_is_a_dash():
    shown = [document.metres(value) for value in (0.0123, 0.456, 12.345, 233.4, np.nan)]
    assert shown == ["0.012", "0.46", "12.35", "233", "–"]


def part(name):
    content = document.DOCUMENT.read_text()
    lines = re.search(rf"<!-- {name} -->\n(.*?)<!-- /{name} -->", content, re.S)[1].splitlines()
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def test_every_run_of_the_document_was_made():
    objects = [row["object"] for row in csv.DictReader(TABLE1.open())]
    assert [row[0] for row in part("static")] == objects
    assert len(part("walk")) == 1 + len(KINDS)
    parts = ("static", "walk", f"budget {LANDMARKS}", f"budget {EACH_OTHER}")
    assert not any("–" in cell for name in parts for row in part(name) for cell in row)


def test_the_documents_estimates_are_what_the_theory_gives(tmp_path):
    output = tmp_path / "table.csv"
    command = [PROGRAMS / "ols-precision", "table", "--input", TABLE1, "--output", output]
    subprocess.run(command, check=True)
    table = theory_plots.columns(output)
    difference = np.abs(table["estimated_m"] / table["paper_estimated_m"] - 1)
    printed = part("estimates")[0]
    assert printed[1] == f"{100 * difference.max():.1f} %"
    assert printed[2] == f"{100 * difference.mean():.1f} %"


def colours(picture):
    image = run_plots.plt.imread(picture)
    return len(np.unique(image.reshape(-1, image.shape[2]), axis=0))


@pytest.mark.parametrize(
    ("kind", "options"),
    [
        ("figure3", ["--steps", "12"]),
        ("figure4", ["--steps", "20"]),
        ("table", ["--input", str(TABLE1)]),
        ("map", ["--stations", str(TABLE1.with_name("example_site.csv")), "--cells", "8"]),
    ],
)
def test_precision_has_a_picture(tmp_path, kind, options):
    source, picture = tmp_path / "source.csv", tmp_path / "picture.png"
    program = str(PROGRAMS / "ols-precision")
    subprocess.run([program, kind, *options, "--output", str(source)], check=True)
    command = [sys.executable, "-m", "ols_accuracy.plot", kind, str(source), str(picture)]
    subprocess.run(command, check=True)
    assert colours(picture) > 20


def test_what_cannot_be_plotted_is_said_in_words(tmp_path, monkeypatch):
    picture, table, none = (tmp_path / name for name in ("picture.png", "table.csv", "none.csv"))

    def said(kind, source, *more):
        words = ["precision-plot", kind, str(source), str(picture), *map(str, more)]
        monkeypatch.setattr(sys, "argv", words)
        with pytest.raises(SystemExit) as ended:
            plot.main()
        return ended.value.code

    table.write_text("x_m,y_m\n1,2\n")
    assert said("figure3", table) == (
        f"precision-plot: {table}: has no column base_m: not what `ols-precision figure3` writes"
    )
    table.write_text("")
    assert f"{table}: has no row" in said("map", table)
    table.write_bytes(bytes(range(256)))
    assert f"{table}: cannot be drawn" in said("map", table)
    assert said("map", none) == f"precision-plot: {none}: No such file or directory"
    table.write_text(
        "above_stations_m,latitude_deg,longitude_deg,horizontal_m,up_sd_m\n1,2,3,4,5\n"
    )
    stations = tmp_path / "stations.csv"
    for text, what in (
        ("station,latitude_deg\na,1\n", "has no column longitude_deg"),
        (
            "station,latitude_deg,longitude_deg\na,1,x\n",
            "column longitude_deg has a word",
        ),
    ):
        stations.write_text(text)
        told = said("map", table, "--stations", stations)
        assert told == f"precision-plot: {stations}: {what}"
