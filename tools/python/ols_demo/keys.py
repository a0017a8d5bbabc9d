"""Throw-away keys for a site on this host, made by `ols-key` as a field team makes them."""

import os
import subprocess
from collections.abc import Iterable
from pathlib import Path

import ols

SERVICES = {
    "fusion": "fusion",
    "console": "operator",
    "operator": "operator",
    "simulator": "simulator",
    "logger": "listener",
    "exporter": "listener",
    "export": "listener",
    "cue": "cue",
    "archive": "listener",
}


def make_keys(
    binaries: Path, folder: Path, stations: Iterable[str], mode: str = "require"
) -> dict[str, str]:
    """Enrols the stations and one of each other program. Returns the environment in which all of
    them sign, and require signatures or observe."""
    folder.mkdir(parents=True)
    run = [str(binaries / "ols-key")]

    def call(*words: str) -> None:
        subprocess.run([*run, *words], cwd=folder, check=True, capture_output=True, timeout=60)

    call("site-new", "throw-away")
    for station in stations:
        call("enrol", station)
    for name, role in SERVICES.items():
        call("enrol", name, "--role", role)
    return {"OLS_TRUST": mode, "OLS_KEYS": str(folder)}


class Members:
    """All members of a site whose keys are in one folder: signs each message as the member that may
    send on its channel. For tests and experiments, which play parts of a site."""

    def __init__(self, keys: str, boot_id: int = 1):
        self._keys, self._boot_id = keys, boot_id
        self._members: dict[str, ols.Trust] = {}
        self._heard: dict[str, bytes] = {}  # the newest status on each channel

    def _member(self, name: str) -> ols.Trust:
        if name not in self._members:
            self._members[name] = ols.Trust(self._keys, name, self._boot_id)
            for channel, status in self._heard.items():
                self._members[name].hear(channel, status)
        return self._members[name]

    def hear(self, channel: str, message: bytes) -> None:
        """Of each status, as received: a command must name its station's boot."""
        self._heard[channel] = message
        for member in self._members.values():
            member.hear(channel, message)

    def sign(self, channel: str, message: bytes) -> bytes:
        """Unchanged on a channel of nobody."""
        sender = ols.sender_of(channel)
        if sender is None:
            return message
        role, name = sender
        return self._member(name or role).sign(channel, message)


def members_of_environment() -> Members | None:
    """Of the site whose keys the environment names, as the programs find them; None: unsigned."""
    if os.environ.get("OLS_TRUST", "off") == "off":
        return None
    return Members(os.environ["OLS_KEYS"])
