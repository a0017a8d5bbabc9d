"""pandas frames in and out: bearings of logs and archives, positions from them.

    import ols.frames as frames
    bearings = frames.read_log("flight.lcmlog")                       # one row a message
    fixes = frames.locate(bearings[bearings.station != "charlie"])    # one row a position
    fixes.plot(x="longitude_deg", y="latitude_deg")
    flights = frames.read_fixes("result", "brno")                     # of a batch run

Needs pandas and pyarrow (requirements-archive.txt). Columns have the names and units of the
messages (lcmtypes/, docs/archive.md): SI and radians; heights are above the WGS84 ellipsoid.
"""

import warnings
from collections import Counter
from pathlib import Path

import numpy as np

import ols

try:
    import pandas as pd
    import pyarrow  # noqa: F401 (of ols_archive, which is only imported where it is needed)
except ModuleNotFoundError as missing:
    raise ModuleNotFoundError(f"{missing}: install ols[archive]", name=missing.name) from missing

SCALARS = (
    *("utime", "boot_id", "track_id", "calibration_id", "azimuth_rad", "elevation_rad", "belief"),
    "clock_error_s",
)
TRIPLES = (
    *("camera_ecef_m", "camera_position_sd_m", "covariance_white_rad2"),
    "covariance_systematic_rad2",
)

# Bearings recorded before it was stated lack it, and zero is unknown.
AIM = "aim_sd_rad"

EARTH_RADIUS_M = 6.37e6


def read_log(path: str | Path, kind: str = "bearing", *, skip_damage: bool = False) -> pd.DataFrame:
    """The messages of one kind (docs/archive.md) in a log, in the order of the file, with a column
    `time` (UTC) beside their fields. ValueError names a file that cannot be read, a kind that is
    not known or not in the log, and the places where the log is damaged; with skip_damage they are
    left out, and a UserWarning names them."""
    from ols_archive import kinds

    wanted = _kind(kind)
    rows = []
    reader = ols.LogReader(str(path))
    for recorded_us, channel, payload, signature in reader:
        if not wanted.is_on(channel):
            continue
        try:
            message = kinds.decode(wanted, channel, payload)
        except kinds.Unusable:
            reader.reject(channel)
            continue
        rows.append((channel, recorded_us, signature or None, 0, *kinds.values_of(message)))
    if reader.damage and not skip_damage:
        raise ValueError(f"{path}: {reader.damage}; skip_damage=True leaves it out")
    if not rows:
        damage = f"; {reader.damage}" if reader.damage else ""
        raise ValueError(f"{path}: has no message of kind {kind}{damage}")
    if reader.damage:
        warnings.warn(f"{path}: left out: {reader.damage}", stacklevel=2)
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
    of time. ValueError if there are none, or a file is damaged: it says what is there, and names
    the file."""
    from ols_archive.partitions import file_of, hours_of

    wanted = _kind(kind)
    begin_us, end_us = _utime(begin), _utime(end)
    known = hours_of(Path(archive), wanted.name)
    hours = [
        hour
        for hour in known
        if hour.region == region and hour.end_us > begin_us and hour.start_us < end_us
    ]
    parts = [_read(file_of(Path(archive), wanted.name, hour), (begin_us, end_us)) for hour in hours]
    if not sum(map(len, parts)):
        raise ValueError(
            f"{archive}: no message of kind {kind} in region {region} from {begin} to {end}; "
            f"{_extent(known, region)}"
        )
    return _with_time(pd.concat(parts, ignore_index=True))


def read_fixes(
    result: str | Path,
    region: str | None = None,
    begin: str | pd.Timestamp = "1970-01-01",
    end: str | pd.Timestamp = "2200-01-01",
) -> pd.DataFrame:
    """The fixes of a batch run from `begin` up to `end` (UTC, unless they say otherwise), with
    their `region`, and `target`, the name that identities.parquet has for their object. ValueError
    if there are none, or a file is damaged.

    Whoever joins the two by region, day, hour and object otherwise must bring the folders' text and
    identities' dates to one type: pandas finds no row equal.
    """
    from ols_archive.partitions import Hour, file_of, hours_of

    begin_us, end_us = _utime(begin), _utime(end)
    known = hours_of(Path(result), "fixes")
    parts = []
    for hour in known:
        if region in (None, hour.region) and hour.end_us > begin_us and hour.start_us < end_us:
            part = _read(file_of(Path(result), "fixes", hour), (begin_us, end_us))
            parts.append(part.assign(region=hour.region, start_us=hour.start_us))
    if not sum(map(len, parts)):
        regions = [region] if region else sorted({hour.region for hour in known})
        has = ", ".join(_extent(known, one) for one in regions) or "it has none at all"
        raise ValueError(f"{result}: no fix from {begin} to {end}; {has}")
    names = _read(Path(result) / "identities.parquet")
    # Of each row the hour that its folder is named after.
    names["start_us"] = [
        Hour.of_folder(Path(f"region={region}/day={day}/hour={hour}")).start_us
        for region, day, hour in zip(names["region"], names["day"], names["hour"], strict=True)
    ]
    key = ["region", "start_us", "object"]
    fixes = pd.concat(parts, ignore_index=True).merge(names[[*key, "target"]], on=key, how="left")
    return _with_time(fixes.drop(columns="start_us"))


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
    if AIM in frame:
        columns[AIM] = frame[AIM].fillna(0.0).to_numpy(float)
    return ols.Bearings(frame["station"].to_list(), **columns)


def locate(
    frame: pd.DataFrame, config: "ols.OfflineConfig | None" = None, separate: bool = True
) -> pd.DataFrame:
    """Positions from the bearings of a frame, by the estimators of ols-fuse (`config`: which one).

    separate: objects are told apart as the live fusion does; otherwise all bearings are of one.
    Returns a row for each position: utime [us], time, object (number), latitude_deg, longitude_deg,
    height_m, position_ecef_m (three numbers), east_sd_m, north_sd_m, up_sd_m (1-sigma),
    crossing_angle_rad, residual, stations_used, stations_set_aside.

    Its `attrs` have `unused`: {reason: bearings}, and `unlocated`: {reason: instants without a
    position}. ValueError, with these reasons and what seems to be the cause, if there is no
    position at all, or the columns are not in their units; a UserWarning if some rows are not.
    """
    bearings = bearings_of(frame)
    codes = ols.check_bearings(bearings)
    fit, doubts = codes == 0, _doubts(frame)
    if not fit.any() or _unit_of_stamps(frame["utime"]):
        why = "; ".join(doubts) or _words(_counts(codes))
        raise ValueError(f"none of {len(frame)} bearings can be used: {why}")
    objects = ols.separate_objects(bearings) if separate else np.where(fit, 1, codes)
    unused, unlocated, parts = _counts(objects), Counter(), []
    for number in np.unique(objects[objects > 0]).tolist():
        part, why = _fixes(bearings, np.flatnonzero(objects == number), number, config)
        parts.append(part)
        unlocated.update(why)
    if not sum(map(len, parts)):
        raise ValueError(f"no position: {_words(unused + unlocated)}")
    if not fit.all():
        why = "; ".join(doubts) or _words(_counts(codes[~fit]))
        warnings.warn(f"not used: {why}", stacklevel=2)
    fixes = pd.concat(parts, ignore_index=True)
    fixes = _with_time(fixes.sort_values(["utime", "object"], ignore_index=True))
    fixes.attrs |= {"unused": dict(unused), "unlocated": dict(unlocated)}
    return fixes


def _words(counts: Counter[str]) -> str:
    return ", ".join(f"{count} {why}" for why, count in counts.items()) or "there are no bearings"


def _counts(objects: np.ndarray) -> Counter[str]:
    """Of bearings that are refused or of no object, by the reason."""
    numbers, counts = np.unique(objects[objects <= 0], return_counts=True)
    return Counter(
        {
            ols.REFUSALS.get(number, "of_no_object"): count
            for number, count in zip(numbers.tolist(), counts.tolist(), strict=True)
        }
    )


def _unit_of_stamps(utime: pd.Series) -> str:
    """What stamps that cannot be microseconds since 1970 seem to be; empty: they can."""
    middle, span = utime.median(), utime.max() - utime.min()
    if middle > 1e16:
        return "nanoseconds"
    # Microseconds from a recording's own beginning would be spread over more than this.
    if middle > 1e9 and span < 0.01 * middle:
        return "seconds" if middle < 1e11 else "milliseconds" if middle < 1e14 else ""
    return ""


def _doubts(frame: pd.DataFrame) -> list[str]:
    """What no bearing can have, with the unit that a column seems to be in instead."""
    columns = {name: frame[name].to_numpy(float).reshape(-1, 1) for name in SCALARS}
    columns |= {name: np.array(frame[name].to_list(), float).reshape(-1, 3) for name in TRIPLES}
    azimuth, elevation = columns["azimuth_rad"][:, 0], columns["elevation_rad"][:, 0]
    height_m = np.linalg.norm(columns["camera_ecef_m"], axis=1) - EARTH_RADIUS_M
    impossible = {
        "azimuth_rad is not within 0..2 pi: degrees?": (azimuth < 0) | (azimuth > 2 * np.pi),
        "elevation_rad is not within -pi/2..pi/2: degrees?": abs(elevation) > np.pi / 2,
        "camera_ecef_m is not near the Earth's surface: latitude, longitude and height? "
        "ols.ecef_from_geodetic converts": abs(height_m) > 1e5,
    }
    impossible |= {
        f"{name} has a negative variance": (columns[name][:, [0, 2]] < 0.0).any(1)
        for name in ("covariance_white_rad2", "covariance_systematic_rad2")
    }
    impossible |= {
        f"{name} is not finite": ~np.isfinite(values).all(1) for name, values in columns.items()
    }
    found = [f"in {rows.sum()} rows {what}" for what, rows in impossible.items() if rows.any()]
    if unit := _unit_of_stamps(frame["utime"]):
        found.append(f"utime is in microseconds since 1970, these seem to be {unit}")
    return found


def _fixes(
    bearings: "ols.Bearings", chosen: np.ndarray, number: int, config: "ols.OfflineConfig | None"
) -> tuple[pd.DataFrame, dict[str, int]]:
    columns, unlocated, _ = ols.fuse_columns(bearings, chosen, config or ols.OfflineConfig())
    place, quality = columns["place"], columns["quality"]
    sd_m = np.sqrt(columns["position_covariance_enu_m2"][:, [0, 3, 5]])
    fixes = pd.DataFrame(
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
    return fixes, unlocated


def _read(path: Path, utime_us: tuple[int, int] | None = None) -> pd.DataFrame:
    from ols_archive.partitions import Damaged, read

    try:
        return read(path, None, utime_us).to_pandas()
    except Damaged as damage:
        raise ValueError(str(damage)) from None


def _extent(hours: list, region: str) -> str:
    """What an archive has, for whoever has looked for something else."""
    here = [hour for hour in hours if hour.region == region]
    if here:
        return f"it has the hours from {here[0]} to {here[-1]}"
    regions = ", ".join(sorted({hour.region for hour in hours}))
    return f"it has the regions {regions}" if regions else "it has none at all"


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
