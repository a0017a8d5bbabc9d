"""Sends an attack at the greatest rate that the bus carries: as the victim's socket takes it.

In a process of its own, so that what measures is not slowed by what attacks."""

import math
import time
from typing import Any

import lcm
from ols_bench.processes import datagrams_dropped
from ols_demo.bus import LIVE_URL

Messages = list[tuple[str, bytes]]

START_HZ = 5000.0
LOOK_S = 0.05
SLOWER, FASTER = 0.7, 1.1
LEAST_HZ = 500.0
AT_ONCE = 200


def send(
    messages: Messages, seconds: float, most_hz: float, stated_hz: float, victim: int, report: Any
) -> None:
    """victim: its process; report: a queue, for a word at the beginning and then the number that
    was sent. At a stated rate if it is finite, else as the victim's socket takes it: slower when it
    loses some, faster when it does not."""
    bus = lcm.LCM(LIVE_URL)
    fixed = math.isfinite(stated_hz)
    rate, sent, due = most_hz if fixed else min(START_HZ, most_hz), 0, 0.0
    report.put("begins")
    lost, begin = datagrams_dropped(victim), time.monotonic()
    now, look = begin, begin + LOOK_S
    while now < begin + seconds:
        before, now = now, time.monotonic()
        due = min(due + (now - before) * rate, rate * LOOK_S)
        for _ in range(min(int(due), AT_ONCE)):
            channel, data = messages[sent % len(messages)]
            bus.publish(channel, data)
            sent += 1
            due -= 1.0
        if now >= look:
            look = now + LOOK_S
            lost_now = datagrams_dropped(victim)
            if not fixed:
                faster = min(most_hz, rate * FASTER)
                rate = max(LEAST_HZ, rate * SLOWER) if lost_now > lost else faster
            lost = lost_now
        if due < 1.0:
            time.sleep(0.0005)
    report.put(sent)
