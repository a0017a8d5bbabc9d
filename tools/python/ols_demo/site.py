"""The processes of a site on this host: started, watched, ended in order."""

import os
import select
import signal
import subprocess
import time
from dataclasses import dataclass, field
from pathlib import Path

READY_S = 180.0
END_S = 30.0


class SiteError(RuntimeError):
    """A process of the site did not come up, or died."""


def bring_up_loopback(addresses: list[str]) -> None:
    """Makes the network namespace we are in a site: multicast on lo, an address for each camera."""
    commands = [
        "ip link set lo up multicast on",
        "ip route replace 224.0.0.0/4 dev lo",
        *(f"ip address replace {address}/8 dev lo" for address in addresses),
    ]
    path = os.environ["PATH"] + ":/usr/sbin:/sbin"
    for command in commands:
        subprocess.run(command.split(), check=True, env={**os.environ, "PATH": path})


@dataclass
class Site:
    """Processes by name; each appends what it says to a file of that name in `logs`."""

    logs: Path
    processes: dict[str, subprocess.Popen] = field(default_factory=dict)

    def start(
        self,
        name: str,
        command: list[str],
        environment: dict[str, str] | None = None,
        keep: tuple[int, ...] = (),
    ) -> int:
        """Returns how long the log was before. `keep`: descriptors that the process inherits.
        Raises SiteError if a process of this name runs: nobody would end it."""
        if name in self.processes and self.processes[name].poll() is None:
            raise SiteError(f"{name} runs already")
        self.logs.mkdir(parents=True, exist_ok=True)
        with open(self.logs / f"{name}.log", "ab") as out:
            before = out.tell()
            self.processes[name] = subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=subprocess.STDOUT,
                env={**os.environ, **(environment or {})},
                pass_fds=keep,
            )
        return before

    def start_and_wait(
        self,
        name: str,
        command: list[str],
        ready: str,
        environment: dict[str, str] | None = None,
        keep: tuple[int, ...] = (),
    ) -> None:
        """Waits until the process has said a line with `ready`."""
        before = self.start(name, command, environment, keep)
        deadline = time.monotonic() + READY_S
        log = self.logs / f"{name}.log"
        while ready not in log.read_bytes()[before:].decode(errors="replace"):
            self.check()
            if time.monotonic() > deadline:
                raise SiteError(f"{name} was not ready after {READY_S:.0f} s; see {log}")
            select.select([], [], [], 0.05)

    def check(self) -> None:
        """Raises SiteError when a process has ended by itself."""
        for name, process in self.processes.items():
            if process.poll() is not None:
                tail = (self.logs / f"{name}.log").read_text(errors="replace").strip()
                last = tail.splitlines()[-1] if tail else "it said nothing"
                raise SiteError(f"{name} ended with status {process.returncode}: {last}")

    def stop(self, name: str, how: signal.Signals = signal.SIGTERM) -> int:
        """Ends one process and returns its status."""
        process = self.processes.pop(name)
        if process.poll() is None:
            process.send_signal(how)
        try:
            return process.wait(END_S)
        except subprocess.TimeoutExpired:
            process.kill()
            return process.wait()

    def __enter__(self) -> "Site":
        return self

    def __exit__(self, *_exception: object) -> None:
        for name in reversed(list(self.processes)):
            self.stop(name)
