"""ols-batch with files that are damaged, missing or foreign: named, made again, and the rest is
done."""

import dataclasses
import shutil

import pyarrow as pa
import pytest
from archive_site import HOURS, flip_a_byte
from batch_site import ALL, hour, results
from ols_archive.partitions import Damaged, file_of, read, write
from ols_batch import run as runner
from ols_batch.plan import plan
from ols_batch.task import FIXES, estimate

pytest_plugins = ["batch_fixtures"]
pytestmark = pytest.mark.usefixtures("loopback")


def see_it_made_again(own, done):
    """The one hour that is spoilt, and nothing else."""
    (to_do,) = plan(own, None, *ALL).to_do
    assert to_do[0] == hour(1)
    estimate(own, *to_do)
    runner.identities.join(own.output)
    assert results(own.output) == results(done.output)


def test_a_damaged_result_is_made_again(own, done):
    flip = file_of(own.output, "fixes", hour(1))
    flip.write_bytes(flip.read_bytes()[:-9])
    see_it_made_again(own, done)


@pytest.mark.parametrize("kind", ["fixes", "seam"])
def test_damage_inside_a_result_is_found_and_mended(own, done, kind):
    """The end of the file, which names it, is whole."""
    flip_a_byte(file_of(own.output, kind, hour(1)))
    with pytest.raises(Damaged):
        read(file_of(own.output, kind, hour(1)))
    see_it_made_again(own, done)


@pytest.mark.parametrize("kind", ["fixes", "seam"])
def test_a_result_with_a_missing_part_is_made_again(own, kind):
    file_of(own.output, kind, hour(1)).unlink()
    assert [at for at, _ in plan(own, None, *ALL).to_do] == [hour(1)]


def test_parts_of_two_results_are_none(own, tmp_path):
    other = dataclasses.replace(own, output=tmp_path / "other", estimator="paper")
    (one,) = (one for one in plan(other, None, *ALL).to_do if one[0] == hour(1))
    estimate(other, *one)
    shutil.copy(file_of(other.output, "seam", hour(1)), file_of(own.output, "seam", hour(1)))
    assert [at for at, _ in plan(own, None, *ALL).to_do] == [hour(1)]


FOREIGN = {
    "no_message": pa.table({"utime": [1]}),
    "other_types": pa.table({name: ["x"] for name in FIXES.names}),
}


@pytest.mark.parametrize("name", FOREIGN)
def test_a_foreign_file_in_a_result_is_named_and_ends_nothing(own, name):
    path = file_of(own.output, "fixes", hour(20))
    write(path, FOREIGN[name], {"kind": "x", "result": '{"objects": []}', "content": "c"})
    report = runner.run(own, 2)
    assert [text for text in report.damaged if str(path) in text]
    assert report.targets == 2 * HOURS and len(report.plots) == 2


def test_a_foreign_seam_is_named(own):
    path = file_of(own.output, "seam", hour(1))
    write(path, pa.table({"border_us": [1]}), {})
    (output := own.output / "identities.parquet").unlink()
    joined = runner.identities.join(own.output)
    assert any(str(path) in text for text in joined.damaged) and output.exists()


def test_targets_that_a_damaged_seam_has_split_are_joined_when_it_is_mended(own, done):
    path = file_of(own.output, "seam", hour(1))
    whole = path.read_bytes()
    write(path, pa.table({"border_us": [1]}), {})
    (own.output / "identities.parquet").unlink()
    assert runner.identities.join(own.output).targets > 2 * HOURS
    path.write_bytes(whole)
    assert runner.identities.join(own.output).targets == 2 * HOURS
    assert results(own.output) == results(done.output)


def test_an_hour_that_has_moved_is_joined_as_another_one(own):
    for kind in ("fixes", "seam"):
        to = file_of(own.output, kind, hour(20))
        to.parent.mkdir(parents=True)
        file_of(own.output, kind, hour(HOURS - 1)).rename(to)
    runner.identities.join(own.output)
    hours = set(read(own.output / "identities.parquet")["hour"].to_pylist())
    assert hours == {0, 1, 2, 3, 20}


def without_a_column(table: pa.Table) -> pa.Table:
    return table.drop_columns(["azimuth_rad"])


def of_another_type(table: pa.Table) -> pa.Table:
    place = table.column_names.index("boot_id")
    return table.set_column(place, "boot_id", pa.array(["x"] * len(table)))


def without_values(table: pa.Table) -> pa.Table:
    place = table.column_names.index("camera_ecef_m")
    return table.set_column(place, "camera_ecef_m", pa.nulls(len(table), table.schema.types[place]))


@pytest.mark.parametrize("change", [without_a_column, of_another_type, without_values])
def test_a_foreign_file_in_the_archive_is_named(own, change):
    path = file_of(own.archive, "bearing", hour(2))
    write(path, change(read(path)), {"content": "c"})
    shutil.rmtree(own.output)
    made = {}
    for at, fingerprint in plan(own, None, *ALL).to_do:
        if at == hour(2):
            with pytest.raises(Damaged, match=str(path)):
                estimate(own, at, fingerprint)
        else:
            made[at] = estimate(own, at, fingerprint)
    # The hour before reads half a minute of it, in which there may be nothing.
    assert hour(3) in {at for at, one in made.items() if one.damaged} <= {hour(1), hour(3)}
