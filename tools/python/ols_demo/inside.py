"""A way into the demo's site for other programs, while it runs."""

import os
import shlex
from pathlib import Path

SCRIPT = """#!/bin/sh
# Runs a command in the network of the demo's site, with the operator's key: ols-ctl all status
process=/proc/{process}
if [ ! -e $process/ns/net ]; then
  echo "$0: the demo has ended" >&2
  exit 1
fi
# As an ordinary user has started it, it has users of its own, too.
[ "$(readlink /proc/self/ns/user)" = "$(readlink $process/ns/user)" ] ||
  user="--user --preserve-credentials"
exec env PATH={bin}:"$PATH" {keys} nsenter $user --net=$process/ns/net --target {process} "$@"
"""


def write_in_site(output: Path, programs: Path, keys: dict[str, str]) -> Path:
    """Writes the script `in-site`, and returns where it is."""
    # /proc is that of the host: this number is valid out there, os.getpid() is not.
    process = os.readlink("/proc/self")
    script = output / "in-site"
    script.write_text(
        SCRIPT.format(
            process=process,
            bin=shlex.quote(str(programs.resolve())),
            keys=" ".join(f"{name}={shlex.quote(value)}" for name, value in keys.items()),
        )
    )
    script.chmod(0o755)
    return script
