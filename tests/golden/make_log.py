"""The bearing logs that goldens begin with, the same at every run: what a fusion hears, and the
clean bearings of the drones for ols-fuse. stations.csv and offline_stations.csv place the stations
on the earth.

Seven stations around a field follow two drones that cross 8 m apart, and the log has what a real
site has: bearings out of order, doubled, stale, ahead of time, of low belief and not finite; a
station whose clock is 0.8 s off; one that reboots; one that follows a bird; a drone that leaves.
"""

import math
from pathlib import Path

import numpy as np

SEED = 20
START_US = 1_700_000_000_000_000
RATE_HZ, SECONDS = 5.0, 18.0
PIXEL_RAD, HEADING_RAD = 7.5e-5, 3e-4
STATIONS = {  # metres east, north, up; and what they follow
    "alfa": ((-300.0, -250.0, 2.0), "a"),
    "bravo": ((320.0, -240.0, 4.0), "a"),
    "charlie": ((310.0, 260.0, 0.0), "a"),
    "delta": ((-290.0, 270.0, 3.0), "b"),
    "echo": ((10.0, -330.0, 1.0), "b"),
    "foxtrot": ((0.0, 350.0, 6.0), "bird"),
    "golf": ((-340.0, 10.0, 2.0), "b"),
}
CLOCK_OFF_S = {"golf": 0.8}
REBOOTS_S = {"echo": 9.0}


def place(target: str, time_s: float) -> np.ndarray:
    """Metres east, north, up."""
    if target == "a":
        return np.array([-120.0 + 14.0 * time_s, 20.0 * math.sin(0.4 * time_s), 70.0])
    if target == "b":
        return np.array([120.0 - 13.0 * time_s, 4.0 - 3.0 * math.sin(0.3 * time_s), 77.0])
    return np.array([60.0 * math.cos(0.5 * time_s), 420.0 + 9.0 * time_s, 40.0])


def seen(target: str, time_s: float) -> bool:
    return not (target == "b" and 13.0 < time_s < 16.0)


def bearing_row(station, time_s, noise_rad, heading_rad):
    position, target = STATIONS[station]
    line = place(target, time_s) - np.array(position)
    azimuth = math.atan2(line[0], line[1]) + heading_rad
    elevation = math.atan2(line[2], math.hypot(line[0], line[1]))
    boot = 200 if time_s > REBOOTS_S.get(station, math.inf) else 100
    stamp_s = time_s + CLOCK_OFF_S.get(station, 0.0)
    belief = 0.3 if 6.0 < time_s < 6.6 and station == "alfa" else 0.9
    return {
        "utime": START_US + round(1e6 * stamp_s),
        "station": station,
        "boot_id": boot,
        "track_id": 1 if boot == 200 or time_s < 11.0 else 2,
        "belief": belief,
        "azimuth_rad": round((azimuth + noise_rad[0] / math.cos(elevation)) % math.tau, 9),
        "elevation_rad": round(elevation + noise_rad[1], 9),
    }


def spoil(rows, random):
    """What the way brings: doubled, late, early and broken messages. In order of arrival."""
    arrivals = []
    for number, (time_s, row) in enumerate(rows):
        late_s = 0.02 + (0.25 if random.random() < 0.03 else 0.0)
        arrivals.append((time_s + late_s, row))
        if random.random() < 0.02:
            arrivals.append((time_s + late_s + 0.01, row))
        if number % 97 == 40:
            arrivals.append((time_s + 0.03, {**row, "utime": row["utime"] - 3_000_000}))
        if number % 97 == 50:
            arrivals.append((time_s + 0.03, {**row, "utime": row["utime"] + 2_000_000}))
        if number % 97 == 60:
            arrivals.append((time_s + 0.03, {**row, "elevation_rad": math.nan}))
        if number % 97 == 70:
            arrivals.append((time_s + 0.03, {**row, "azimuth_rad": 7.5}))
    return [row for _, row in sorted(arrivals, key=lambda arrival: arrival[0])]


def write_heard(path: Path, rows) -> None:
    lines = [",".join(rows[0]).replace("utime", "utime_us")]
    lines += [",".join(map(str, row.values())) for row in rows]
    path.write_text("\n".join(lines) + "\n")


def write_clean(path: Path, rows) -> None:
    lines = ["utime_us,station,azimuth_deg,elevation_deg,sigma_deg,belief,target"]
    for row in rows:
        target = STATIONS[row["station"]][1]
        azimuth_deg, elevation_deg = (
            math.degrees(row[name]) for name in ("azimuth_rad", "elevation_rad")
        )
        if target != "bird" and row["station"] not in CLOCK_OFF_S:
            lines.append(
                f"{row['utime']},{row['station']},{azimuth_deg:.6f},{elevation_deg:.6f},0.005,"
                f"{row['belief']},{target}"
            )
    path.write_text("\n".join(lines) + "\n")


def write(folder: Path) -> None:
    """heard.csv and clean.csv."""
    random = np.random.default_rng(SEED)
    headings = {station: HEADING_RAD * random.standard_normal() for station in STATIONS}
    rows = []
    for frame in range(int(RATE_HZ * SECONDS)):
        for number, station in enumerate(STATIONS):
            time_s = (frame + number / len(STATIONS)) / RATE_HZ
            noise_rad = PIXEL_RAD * random.standard_normal(2)
            if seen(STATIONS[station][1], time_s) and random.random() > 0.02:
                rows.append((time_s, bearing_row(station, time_s, noise_rad, headings[station])))
    write_clean(folder / "clean.csv", [row for _, row in rows])
    write_heard(folder / "heard.csv", spoil(rows, random))
