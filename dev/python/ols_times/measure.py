#!/usr/bin/python3 -ISE
"""Runs a command and measures it. As a program it is the launcher of the preset `times`:
measure.py LOG COMMAND... appends what the command took to LOG, one line of JSON."""

import json
import os
import subprocess
import sys
import time
from pathlib import Path


def measured(command: list[str], **options) -> tuple[int, dict[str, float]]:
    """The exit status, and the seconds of the command with all processes that it waited for."""
    start = time.monotonic()
    process = subprocess.Popen(command, **options)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    spent = {"processor_s": usage.ru_utime + usage.ru_stime, "wall_s": time.monotonic() - start}
    return process.returncode, spent


def append(log: Path, record: dict) -> None:
    """In one write, because several processes append at once."""
    with open(log, "ab", buffering=0) as file:
        file.write(json.dumps(record).encode() + b"\n")


def main() -> int:
    log, *command = sys.argv[1:]
    status, spent = measured(command)
    if "-o" in command:
        append(Path(log), {"name": command[command.index("-o") + 1], **spent})
    return status if status >= 0 else 128 - status


if __name__ == "__main__":
    sys.exit(main())
