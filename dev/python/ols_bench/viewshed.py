"""What `ols-precision coverage` says a camera sees of the ground, beside GRASS's r.viewshed.

Needs GRASS and GDAL's programs (Debian: apt install grass-core gdal-bin). Both get the same model
of the elevation, in UTM; the land is resampled to latitude and longitude once more.
"""

import argparse
import csv
import subprocess
import tempfile
from pathlib import Path

import numpy as np

CAMERA_M, REACH_M, SPACING_M = 10, 8000, 90


def run(*command: object, text: str | None = None) -> str:
    return subprocess.run(
        [str(part) for part in command], input=text, capture_output=True, text=True, check=True
    ).stdout


def grass(work: Path, *command: object) -> None:
    run("grass", work / "grass/PERMANENT", "--exec", *command)


def values(raster: Path, places: np.ndarray) -> np.ndarray:
    """Of the cells at these (N, 2) eastings and northings; NaN outside."""
    text = "\n".join(f"{east} {north}" for east, north in places)
    lines = run("gdallocationinfo", "-geoloc", "-valonly", raster, text=text).splitlines()
    return np.array([float(line) if line.strip() else np.nan for line in lines])


def utm(rows: list[dict[str, str]], zone: int) -> np.ndarray:
    """(N, 2) eastings and northings of rows with latitude_deg and longitude_deg."""
    text = "\n".join(f"{row['longitude_deg']} {row['latitude_deg']}" for row in rows)
    said = run("gdaltransform", "-s_srs", "EPSG:4326", "-t_srs", f"EPSG:{zone}", text=text)
    return np.array([line.split()[:2] for line in said.splitlines()], float)


def prepare(work: Path, elevation: str, site: str, zone: int) -> None:
    model = work / "utm.tif"
    run("gdalwarp", "-q", "-t_srs", f"EPSG:{zone}", "-r", "bilinear", elevation, model)
    run("grass", "-e", "-c", model, work / "grass")
    grass(work, "r.in.gdal", f"input={model}", "output=dem", "--quiet")
    grass(work, "g.region", "raster=dem")
    land = ("--elevation", model, "--heights", "ellipsoid", "--sd", "0.01")
    where = ("--site", site, "--radius-km", 20, "--output", work / "land")
    run("build/release/bin/ols-land", "import", *where, *land)


def compare(work: Path, place: dict[str, str], zone: int) -> str:
    east, north = utm([place], zone)[0]
    ground_m = values(work / "utm.tif", np.array([[east, north]]))[0]
    options = ["observer_elevation=" + str(CAMERA_M), "target_elevation=0", "-c", "-r", "-b"]
    options += [f"max_distance={REACH_M + 500}", "refraction_coeff=0.13", "--overwrite"]
    at = f"coordinates={east},{north}"
    grass(work, "r.viewshed", "input=dem", "output=view", at, *options)
    view = work / "view.tif"
    grass(work, "r.out.gdal", "input=view", f"output={view}", "--overwrite", "type=Byte")
    (work / "stations.csv").write_text(
        "station,latitude_deg,longitude_deg,height_m\n"
        f"camera,{place['latitude_deg']},{place['longitude_deg']},{ground_m + CAMERA_M}\n"
    )
    site = ("--stations", work / "stations.csv", "--land", work / "land", "--reach", REACH_M)
    output = ("--spacing", SPACING_M, "--output", work / "coverage.csv")
    run("build/release/bin/ols-precision", "coverage", *site, *output)
    rows = list(csv.DictReader((work / "coverage.csv").open()))
    places = utm(rows, zone)
    side = round(len(rows) ** 0.5)
    theirs = values(view, places).reshape(side, side) > 0
    ours = np.array([float(row["one_m"] or "nan") < 0.5 for row in rows]).reshape(side, side)
    known = np.array([float(row["ground_m"] or "nan") > 1.0 for row in rows])  # not the sea
    distance = np.hypot(*(places - (east, north)).T)
    judged = (known & (distance < REACH_M) & (distance > 100)).reshape(side, side)
    around = np.array([np.roll(theirs, (i, j), (0, 1)) for i in (-1, 0, 1) for j in (-1, 0, 1)])
    beyond = (ours & ~around.any(axis=0)) | (~ours & around.all(axis=0))
    return (
        f"{place['latitude_deg']},{place['longitude_deg']}: {judged.sum()} cells, "
        f"seen {ours[judged].mean():.1%} (GRASS {theirs[judged].mean():.1%}), "
        f"same {(ours == theirs)[judged].mean():.2%}, within a cell {1 - beyond[judged].mean():.2%}"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, prog="tools/bench viewshed")
    parser.add_argument("elevation", help="any model that GDAL reads")
    parser.add_argument("cameras", nargs="+", help="latitude,longitude in degrees")
    arguments = parser.parse_args()
    places = [
        dict(zip(("latitude_deg", "longitude_deg"), one.split(","), strict=True))
        for one in arguments.cameras
    ]
    zone = 32600 + int((float(places[0]["longitude_deg"]) + 180) // 6) + 1
    zone += 100 if float(places[0]["latitude_deg"]) < 0 else 0
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        prepare(work, arguments.elevation, arguments.cameras[0], zone)
        for place in places:
            print(compare(work, place, zone), flush=True)


if __name__ == "__main__":
    main()
