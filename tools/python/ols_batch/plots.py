"""Pictures of what came out: where the targets flew, how high, and how many fixes there are."""

import contextlib
import json
from pathlib import Path

import duckdb
import matplotlib
import numpy as np
from ols_archive.partitions import Damaged, replaced

from ols_batch.plan import digest_of

matplotlib.use("Agg")
from matplotlib import pyplot as plt  # noqa: E402

MOST_POINTS = 50_000  # of a region
VIEW = """
CREATE VIEW fixes AS
SELECT f.*, i.target
FROM read_parquet([{fixes}], hive_partitioning = true) f
JOIN read_parquet({identities}) i USING (region, day, hour, object)
"""
POINTS = """
SELECT target, utime, latitude_deg, longitude_deg, height_m FROM (
  SELECT *, row_number() OVER (ORDER BY utime, target) AS number, count(*) OVER () AS all_of_them
  FROM fixes WHERE region = ?
) WHERE number % greatest(1, all_of_them // ?) = 0 ORDER BY target, utime
"""
HOURS = """
SELECT epoch(day) + hour * 3600, count(*) FROM fixes WHERE region = ? GROUP BY ALL ORDER BY 1
"""
METRES_PER_DEGREE = 111_320.0  # of a picture, not of a measurement


def save(figure, path: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    with replaced(path) as partial:
        figure.savefig(partial, format="png", dpi=120, metadata={"Software": None})
    plt.close(figure)


def tracks(points: dict[str, np.ndarray], region: str):
    """Plan, and height over time."""
    figure, (plan, height) = plt.subplots(1, 2, figsize=(12, 5), layout="constrained")
    north = points["latitude_deg"] - points["latitude_deg"].mean()
    east = points["longitude_deg"] - points["longitude_deg"].mean()
    east = east * np.cos(np.radians(points["latitude_deg"].mean()))
    hours = (points["utime"] - points["utime"].min()) / 3.6e9
    _, colour = np.unique(points["target"].astype(str), return_inverse=True)
    look = {"c": colour % 20, "cmap": "tab20", "s": 2, "linewidths": 0}
    plan.scatter(east * METRES_PER_DEGREE, north * METRES_PER_DEGREE, **look)
    plan.set(xlabel="east [m]", ylabel="north [m]", aspect="equal", title=f"targets of {region}")
    height.scatter(hours, points["height_m"], **look)
    height.set(xlabel="time since the first fix [h]", ylabel="height above the ellipsoid [m]")
    return figure


def counts(rows: list[tuple[float, int]], region: str):
    figure, axes = plt.subplots(figsize=(12, 3), layout="constrained")
    times = np.array([row[0] for row in rows]).astype("datetime64[s]")
    axes.bar(times, [row[1] for row in rows], width=np.timedelta64(3000, "s"))
    axes.set(ylabel="fixes in an hour", title=f"{region}, UTC")
    return figure


def quoted(path: Path) -> str:
    return "'" + str(path).replace("'", "''") + "'"


def drawn_before(note: Path, made: str) -> list[Path]:
    """The plots that are there; none if they are of something else, or not all there."""
    with contextlib.suppress(OSError, ValueError, LookupError, TypeError):
        told = json.loads(note.read_text())
        plots = [note.with_name(name) for name in told["plots"]]
        if told["made"] == made and all(plot.is_file() for plot in plots):
            return plots
    return []


def draw(output: Path, fixes: list[Path], made: str) -> list[Path]:
    """Two for each region that has fixes; those that are there, if they are of the same. Damaged if
    what is in a file cannot be read. `made` names what they are drawn of; empty: nobody knows."""
    made = made and f"{made} {digest_of(__file__)}"
    note = output / "plots" / "made.json"
    if made and (there := drawn_before(note, made)):
        return there
    note.unlink(missing_ok=True)  # an interrupted run leaves plots of two results
    try:
        drawn = drawn_anew(output, fixes)
    except duckdb.Error as error:
        raise Damaged(f"{output}: no plots: {str(error).splitlines()[0]}") from None
    if made and drawn:
        with replaced(note) as partial:
            names = [plot.name for plot in drawn]
            partial.write_text(json.dumps({"made": made, "plots": names}) + "\n")
    return drawn


def drawn_anew(output: Path, fixes: list[Path]) -> list[Path]:
    drawn = []
    identities = quoted(output / "identities.parquet")
    with duckdb.connect() as connection:
        connection.execute(VIEW.format(fixes=", ".join(map(quoted, fixes)), identities=identities))
        regions = connection.execute("SELECT DISTINCT region FROM fixes ORDER BY 1").fetchall()
        for (region,) in regions:
            points = connection.execute(POINTS, [region, MOST_POINTS]).fetchnumpy()
            rows = connection.execute(HOURS, [region]).fetchall()
            for name, figure in (
                ("tracks", tracks(points, region)),
                ("hours", counts(rows, region)),
            ):
                drawn.append(output / "plots" / f"{region}-{name}.png")
                save(figure, drawn[-1])
    return drawn
