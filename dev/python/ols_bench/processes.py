"""What a process costs, by /proc."""

import os
import re
from pathlib import Path


def cpu_s(pid: int) -> float:
    return _cpu_s(Path(f"/proc/{pid}/stat"))


def first_thread_cpu_s(pid: int) -> float:
    """Of the process's first thread: a station's control loop."""
    return _cpu_s(Path(f"/proc/{pid}/task/{pid}/stat"))


def _cpu_s(stat: Path) -> float:
    fields = stat.read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def resident_kb(pid: int) -> int:
    return int(re.findall(r"VmRSS:\s+(\d+)", Path(f"/proc/{pid}/status").read_text())[0])
