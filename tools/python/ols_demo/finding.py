"""What a site finds that nobody operates, and when: said as it happens."""

import time
from collections.abc import Callable
from typing import Any

import numpy as np
import ols_msg

from ols_demo.observer import Observer

CLASSES = {
    ols_msg.target_t.CLASS_DRONE: "drone",
    ols_msg.target_t.CLASS_BIRD: "bird",
    ols_msg.target_t.CLASS_AIRCRAFT: "aircraft",
    ols_msg.target_t.CLASS_OTHER: "something else",
}
STATIONS = 2  # that track it: it is held


class Finding:
    """Takes every message of the bus; prints what is new, with the seconds since the start."""

    def __init__(self, say: Callable[[str], None] = print):
        self._say = say
        self._start = time.monotonic()
        self._seeing: set[str] = set()
        self._located: set[int] = set()
        self._named: dict[int, int] = {}  # class by target
        self._alarmed: set[int] = set()  # numbers of incidents

    def receive(self, channel: str, message: Any) -> None:
        if channel.startswith("OLS_BEARING_"):
            self._see(message)
        elif channel == "OLS_TARGET":
            self._locate(message)
            self._name(message)
        elif channel == "OLS_INCIDENT":
            self._alarm(message)

    @property
    def drones(self) -> set[int]:
        """The targets that are, or were last, called drones."""
        return {i for i, what in self._named.items() if what == ols_msg.target_t.CLASS_DRONE}

    def holds(self, observer: Observer) -> bool:
        """A drone has been named, and enough stations track."""
        tracking = [name for name in observer.status if observer.state(name) == "tracking"]
        return bool(self.drones) and len(tracking) >= STATIONS

    def _at(self, text: str) -> None:
        self._say(f"{time.monotonic() - self._start:6.1f} s  {text}")

    def _see(self, bearing: Any) -> None:
        if not bearing.detected or bearing.station in self._seeing:
            return
        self._seeing.add(bearing.station)
        self._at(f"{bearing.station} sees something for the first time")

    def _locate(self, target: Any) -> None:
        if target.solution != target.SOLUTION_OK or target.target_id in self._located:
            return
        self._located.add(target.target_id)
        by = ", ".join(np.array(target.station)[np.array(target.used, dtype=bool)])
        self._at(f"target {target.target_id} is located by {by}")

    def _name(self, target: Any) -> None:
        what = target.object_class
        if what == target.CLASS_UNKNOWN or self._named.get(target.target_id) == what:
            return
        self._named[target.target_id] = what
        self._at(
            f"target {target.target_id} is named: {CLASSES.get(what, 'of a class not known here')} "
            f"({target.class_probability:.2f}), {target.size_m:.1f} m"
        )

    def _alarm(self, incident: Any) -> None:
        if incident.number in self._alarmed:
            return
        self._alarmed.add(incident.number)
        self._at(
            f"ALARM: {incident.object_class} {incident.target_id} is inside area {incident.area}"
        )
