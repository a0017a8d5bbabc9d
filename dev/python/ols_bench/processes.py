"""What a process costs, by the kernel's data on it. `process`: its id, or its folder in /proc."""

import os
from pathlib import Path

PAGE = os.sysconf("SC_PAGE_SIZE")


def folder(process: int | Path) -> Path:
    return process if isinstance(process, Path) else Path(f"/proc/{process}")


def cpu_s(process: int | Path) -> float:
    fields = (folder(process) / "stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def first_thread_cpu_s(pid: int) -> float:
    """Of the process's first thread: a station's control loop."""
    return cpu_s(Path(f"/proc/{pid}/task/{pid}"))


def resident_bytes(process: int | Path) -> int:
    return int((folder(process) / "statm").read_text().split()[1]) * PAGE


def open_files(pid: int) -> int:
    return len(os.listdir(f"/proc/{pid}/fd"))


def threads(pid: int) -> int:
    return len(os.listdir(f"/proc/{pid}/task"))


def datagrams_dropped(process: int | Path) -> int:
    """Datagrams that the kernel dropped because the process did not fetch them in time."""
    sockets = set()
    for descriptor in (folder(process) / "fd").iterdir():
        try:
            target = str(descriptor.readlink())
        except OSError:  # closed meanwhile
            continue
        if target.startswith("socket:["):
            sockets.add(target[len("socket:[") : -1])
    rows = [line.split() for line in (folder(process) / "net/udp").read_text().splitlines()[1:]]
    return sum(int(row[12]) for row in rows if row[9] in sockets)
