"""See tools/bench-bridge."""

import argparse
import os
import re
import socket
import struct
import tempfile
import threading
import time
from pathlib import Path

import bridge_site
import numpy as np
from ols_demo.site import bring_up_loopback

GROUP = "239.255.76.67"
SETTLE_S = 2.0
UTIME_AT = 8  # behind LCM's fingerprint
BUFFER_BYTES = 64 << 20


def any_station(example: str) -> str:
    """The servers' files name two stations; here every name may be sent."""
    text = example.replace(".alfa.", ".*.")
    return re.sub(r"\n[^\n]*\.bravo\.[^\n]*", "", text)


class Network(bridge_site.Network):
    def _hub(self, text: str) -> str:
        return any_station(super()._hub(text))

    def _leaf(self, text: str) -> str:
        return any_station(super()._leaf(text))


class Sender:
    """Bearings of all stations in turn, each stamped as it is sent: the datagrams of LCM, whose
    Python takes too long for this."""

    def __init__(self, stations: int, size: int):
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 4 << 20)
        names = [f"s{number:04d}" for number in range(stations)]
        self._parts = [self._part(name, size) for name in names]
        self.sent = 0

    @staticmethod
    def _part(name: str, size: int) -> tuple[bytearray, int, int]:
        body = bridge_site.bearing(name, 0)
        head = b"LC02" + struct.pack(">I", 0) + f"OLS_BEARING_{name}".encode() + b"\0"
        data = bytearray(head + body + bytes(max(0, size - len(body))))
        # utime, version, name, boot id, sequence.
        sequence_at = len(head) + UTIME_AT + 8 + 4 + 4 + len(name) + 1 + 8
        return data, len(head) + UTIME_AT, sequence_at

    def run(self, rate_hz: float, seconds: float) -> None:
        begin, turn = time.monotonic(), 0
        total = int(rate_hz * seconds) * len(self._parts)
        while self.sent < total:
            due = min(total, int((time.monotonic() - begin) * rate_hz * len(self._parts)))
            while self.sent < due:
                data, utime_at, sequence_at = self._parts[self.sent % len(self._parts)]
                turn = self.sent // len(self._parts) + 1
                struct.pack_into(">q", data, sequence_at, turn)
                struct.pack_into(">q", data, utime_at, time.time_ns() // 1000)
                self._socket.sendto(data, (GROUP, 7667))
                self.sent += 1
            time.sleep(0.0005)


class Receiver:
    def __init__(self, port: int):
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        for option in (socket.SO_RCVBUF, 33):  # SO_RCVBUFFORCE, where it is allowed
            try:
                self._socket.setsockopt(socket.SOL_SOCKET, option, BUFFER_BYTES)
            except OSError:
                continue
        self._socket.bind((GROUP, port))
        member = socket.inet_aton(GROUP) + socket.inet_aton("127.0.0.1")
        self._socket.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)
        self.delays_us: list[int] = []
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        while True:
            data = self._socket.recv(65536)
            now_us = time.time_ns() // 1000
            end = data.find(b"\0", 8)
            if data[8:20] == b"OLS_BEARING_":
                (utime,) = struct.unpack_from(">q", data, end + 1 + UTIME_AT)
                self.delays_us.append(now_us - utime)


def processor_s(pid: int) -> float:
    fields = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def measure(net: Network, options: argparse.Namespace) -> None:
    parts = {
        "bridge of the site": net.site.process.pid,
        "leaf": net.leaf.process.pid,
        "hub": net.hub.process.pid,
        "bridge of the region": net.region.process.pid,
    }
    sender, receiver = Sender(options.stations, options.bytes), Receiver(7668)
    before = {name: processor_s(pid) for name, pid in parts.items()}
    begin = time.monotonic()
    child = os.fork()  # a process of its own: one interpreter is too slow for both
    if child == 0:
        sender.run(options.rate, options.seconds)
        os._exit(0)
    os.waitpid(child, 0)
    took_s = time.monotonic() - begin
    used = {name: processor_s(pid) - before[name] for name, pid in parts.items()}
    time.sleep(SETTLE_S)
    sent = int(options.rate * options.seconds) * options.stations
    delays_ms = np.array(receiver.delays_us) * 1e-3
    print(f"{options.stations} stations, {options.rate:g} Hz, {options.bytes} bytes each")
    print(f"sent {sent} in {took_s:.1f} s, {sent / took_s:.0f} a second; came {len(delays_ms)}")
    if len(delays_ms) > 0:
        p50, p95, p99 = np.percentile(delays_ms, [50, 95, 99])
        print(
            f"site's bus to region's bus: p50 {p50:.2f}, p95 {p95:.2f}, p99 {p99:.2f} ms, "
            f"longest {delays_ms.max():.1f} ms"
        )
    for name, seconds in used.items():
        print(f"{name}: {seconds / took_s:.2f} of a core")
    state = net.region.status()
    print(f"missing by the stations' own numbers: {state['missing']}, twice: {state['repeated']}")
    for name, one in (("site", net.site.status()), ("region", state)):
        print(
            f"{name}: bus {one['counters']}, refused "
            f"{sum(one['out']['refused'].values()) + sum(one['in']['refused'].values())}, "
            f"unsent {one['link']['unsent']}, displaced {one['link']['displaced']}"
        )


def main() -> None:
    parser = argparse.ArgumentParser(prog="bench-bridge")
    parser.add_argument("--stations", type=int, default=1000)
    parser.add_argument("--rate", type=float, default=15.0, help="[Hz] bearings of each")
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--bytes", type=int, default=400, help="of each, with its signature")
    options = parser.parse_args()
    print(f"load before: {os.getloadavg()[0]:.2f}")
    bring_up_loopback([])
    with tempfile.TemporaryDirectory() as folder:
        net = Network(Path(folder))
        try:
            measure(net, options)
        finally:
            net.close()


if __name__ == "__main__":
    main()
