"""The fault run's changes to the station configurations that the simulator writes."""

import re
from pathlib import Path

from ols_demo.wiring import Wiring

ACCELERATION_DEG_S2 = 57.3  # of every PTU, up and down
SURVEYED = ("latitude_deg", "longitude_deg", "height_m", "tilt_x_deg", "tilt_y_deg")


def without_survey(text: str) -> str:
    """Position and tilt are left to the sensors; an inclinometer that stands still for 5 s is
    stuck (the sensor's noise changes its last digit all the time)."""
    for key in SURVEYED:
        text = re.sub(rf"^{key} = .*\n", "", text, flags=re.MULTILINE)
    return re.sub(r"^stuck_s = .*$", "stuck_s = 5", text, flags=re.MULTILINE)


def with_recorder(text: str, folder: Path) -> str:
    """Recordings that fit a small disk."""
    return (
        f'{text}\n[recorder]\nfolder = "{folder}"\nmemory_s = 2\n'
        "quota_gb = 0.015\ndisk_reserve_gb = 0.001\n"
    )


def alter(wiring: Wiring, disk: Path) -> None:
    """The last station's pose is the sensors'; the first one records; the third one's clock, which
    will be stepped, is trusted again sooner. Every PTU accelerates as it is judged by."""
    names = wiring.stations
    for config in wiring.configs.values():
        line = f"[mount]\nacceleration_deg_s2 = {ACCELERATION_DEG_S2:g}\n"
        config.write_text(config.read_text().replace("[mount]\n", line))
    first, last = wiring.configs[names[0]], wiring.configs[names[-1]]
    last.write_text(without_survey(last.read_text()))
    stepped = wiring.configs[names[2]]
    stepped.write_text(stepped.read_text().replace("[clock]\n", "[clock]\ndistrust_s = 10\n"))
    first.write_text(with_recorder(first.read_text(), disk))
