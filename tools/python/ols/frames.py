"""pandas frames in and out: bearings of logs and archives, positions from them.

    import ols.frames as frames
    bearings = frames.read_log("flight.lcmlog")                       # one row a message
    fixes = frames.locate(bearings[bearings.station != "charlie"])    # one row a position
    fixes.plot(x="longitude_deg", y="latitude_deg")

Needs pandas and pyarrow (requirements-archive.txt). Columns have the names and units of the
messages (lcmtypes/, docs/archive.md): SI and radians; heights are above the WGS84 ellipsoid.
"""

from pathlib import Path

import numpy as np
import pandas as pd

import ols

SCALARS = (
    *("utime", "boot_id", "track_id", "calibration_id", "azimuth_rad", "elevation_rad", "belief"),
    "clock_error_s",
)
TRIPLES = (
    *("camera_ecef_m", "camera_position_sd_m", "covariance_white_rad2"),
    "covariance_systematic_rad2",
)


def read_log(path: str | Path, kind: str = "bearing") -> pd.DataFrame:
    """The messages of one kind (docs/archive.md) in a log, in the order of the file, with a column
    `time` (UTC) beside their fields. What is damaged is left out. ValueError names a file that
    cannot be read, or a kind that is not known."""
    from ols_archive import kinds

    wanted = _kind(kind)
    rows = []
    for recorded_us, channel, payload, signature in ols.LogReader(str(path)):
        if not wanted.is_on(channel):
            continue
        try:
            message = kinds.decode(wanted, channel, payload)
        except kinds.Unusable:
            continue
        rows.append((channel, recorded_us, signature or None, 0, *kinds.values_of(message)))
    frame = kinds.table_of(wanted, rows).drop_columns(["digest"]).to_pandas()
    return _with_time(frame)


def read_csv(stations: str | Path, bearings: str | Path) -> pd.DataFrame:
    """The rows of two CSV files as ols-fuse reads them, with the columns that bearing_t gives them
    and a column `target`, empty where the file has none. What the clocks are off by is guessed from
    the noise. ols.CsvError, a ValueError, names file, line and column."""
    read, targets = ols.read_bearings(str(stations), str(bearings))
    columns = read.columns()
    frame = pd.DataFrame({name: _cells(values) for name, values in columns.items()})
    frame["target"] = targets or [""] * len(frame)
    return _with_time(frame)


def read_archive(
    archive: str | Path,
    region: str,
    begin: str | pd.Timestamp,
    end: str | pd.Timestamp,
    kind: str = "bearing",
) -> pd.DataFrame:
    """The messages of one kind from `begin` up to `end` (UTC, unless they say otherwise), in order
    of time."""
    from ols_archive.kinds import schema_of
    from ols_archive.partitions import file_of, hours_of, read

    wanted = _kind(kind)
    begin_us, end_us = _utime(begin), _utime(end)
    hours = [
        hour
        for hour in hours_of(Path(archive), wanted.name)
        if hour.region == region and hour.end_us > begin_us and hour.start_us < end_us
    ]
    parts = [
        read(file_of(Path(archive), wanted.name, hour), None, (begin_us, end_us)).to_pandas()
        for hour in hours
    ]
    empty = schema_of(wanted).empty_table().to_pandas()
    return _with_time(pd.concat(parts, ignore_index=True) if parts else empty)


def bearings_of(frame: pd.DataFrame) -> "ols.Bearings":
    """Of a frame with bearing_t's columns, n rows; those of three numbers hold sequences of three.
    ValueError names a column that is missing or of another shape."""
    missing = [name for name in ("station", *SCALARS, *TRIPLES) if name not in frame]
    if missing:
        raise ValueError(f"the frame has no column {', '.join(missing)}")
    columns = {name: frame[name].to_numpy() for name in SCALARS}
    for name in TRIPLES:
        values = frame[name].to_list()
        if any(len(value) != 3 for value in values):
            raise ValueError(f"column {name}: each row must have three numbers")
        columns[name] = np.array(values, float).reshape(-1, 3)
    return ols.Bearings(frame["station"].to_list(), **columns)


def locate(
    frame: pd.DataFrame, config: "ols.OfflineConfig | None" = None, separate: bool = True
) -> pd.DataFrame:
    """Positions from the bearings of a frame, by the estimators of ols-fuse (`config`: which one).

    separate: objects are told apart as the live fusion does; otherwise all bearings are of one.
    Returns a row for each position: utime [us], time, object (number), latitude_deg, longitude_deg,
    height_m, position_ecef_m (three numbers), east_sd_m, north_sd_m, up_sd_m (1-sigma),
    crossing_angle_rad, residual, stations_used, stations_set_aside.
    """
    bearings = bearings_of(frame)
    objects = ols.separate_objects(bearings) if separate else np.ones(len(frame), np.int64)
    parts = [_fixes(bearings, np.empty(0, np.int64), 0, config)]
    for number in np.unique(objects[objects > 0]).tolist():
        parts.append(_fixes(bearings, np.flatnonzero(objects == number), number, config))
    parts = parts[1:] or parts
    fixes = pd.concat(parts, ignore_index=True)
    return _with_time(fixes.sort_values(["utime", "object"], ignore_index=True))


def _fixes(
    bearings: "ols.Bearings", chosen: np.ndarray, number: int, config: "ols.OfflineConfig | None"
) -> pd.DataFrame:
    columns, _, _ = ols.fuse_columns(bearings, chosen, config or ols.OfflineConfig())
    place, quality = columns["place"], columns["quality"]
    sd_m = np.sqrt(columns["position_covariance_enu_m2"][:, [0, 3, 5]])
    return pd.DataFrame(
        {
            "utime": columns["utime"],
            "object": np.full(len(place), number, np.int64),
            "latitude_deg": place[:, 0],
            "longitude_deg": place[:, 1],
            "height_m": place[:, 2],
            "position_ecef_m": list(columns["position_ecef_m"]),
            "east_sd_m": sd_m[:, 0],
            "north_sd_m": sd_m[:, 1],
            "up_sd_m": sd_m[:, 2],
            "crossing_angle_rad": quality[:, 0],
            "residual": quality[:, 1],
            "stations_used": columns["stations_used"],
            "stations_set_aside": columns["stations_set_aside"],
        }
    )


def _cells(values: "list | np.ndarray") -> "list | np.ndarray":
    return list(values) if np.ndim(values) == 2 else values


def _kind(name: str):
    from ols_archive.kinds import BY_NAME

    if name not in BY_NAME:
        raise ValueError(f"kind {name}: not one of {', '.join(BY_NAME)}")
    return BY_NAME[name]


def _utime(time: str | pd.Timestamp) -> int:
    stamp = pd.Timestamp(time)
    stamp = stamp.tz_localize("UTC") if stamp.tzinfo is None else stamp
    return int(stamp.value // 1000)


def _with_time(frame: pd.DataFrame) -> pd.DataFrame:
    # Out of range of pandas' time, as a clock that is off can be: no time.
    times = pd.to_datetime(frame["utime"], unit="us", utc=True, errors="coerce")
    frame.insert(frame.columns.get_loc("utime") + 1, "time", times)
    return frame
