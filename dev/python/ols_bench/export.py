"""Measures ols-export with every format to a receiver: from a target's publication to its
datagram at the receiver, and the processor that it takes. On a machine that does nothing else;
the load before is printed.
"""

import argparse
import re
import socket
import tempfile
import threading
import time
from pathlib import Path

import export_site
import numpy as np
from ols_demo.site import bring_up_loopback
from sapient_site import Receiver as SapientReceiver

from ols_bench.processes import cpu_s

LATITUDE = re.compile(rb'lat="([0-9.]+)"')


class Receiver:
    """Of events by datagram: the time from publication of those that it knows by their latitude."""

    def __init__(self, published: dict[str, float]):
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 8 << 20)
        self._socket.bind(("127.0.0.1", 0))
        self.port = self._socket.getsockname()[1]
        self._published = published
        self.delays_s: list[float] = []
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        while True:
            data = self._socket.recv(65536)
            now_s = time.monotonic()
            found = LATITUDE.search(data)
            sent_s = self._published.pop(found[1].decode(), None) if found else None
            if sent_s is not None:
                self.delays_s.append(now_s - sent_s)


def drain(server: socket.socket) -> None:
    while True:
        connection = server.accept()[0]
        threading.Thread(
            target=lambda c=connection: all(iter(lambda: c.recv(65536), b"")), daemon=True
        ).start()


def outputs(folder: Path, port: int, rate_hz: float) -> str:
    server = socket.create_server(("127.0.0.1", 0))
    threading.Thread(target=drain, args=(server,), daemon=True).start()
    plain = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    plain.bind(("127.0.0.1", 0))
    hub = SapientReceiver()
    outputs.kept = (server, plain, hub)  # type: ignore[attr-defined]
    every = {"rate_hz": rate_hz, "lines": True}
    text = export_site.output("xml", "cot", f"udp://127.0.0.1:{port}", **every)
    mesh = f"udp://127.0.0.1:{plain.getsockname()[1]}"
    text += export_site.output("mesh", "cot-protobuf", mesh, **every)
    text += export_site.output("display", "asterix", mesh, **every)
    stream = f"tcp://127.0.0.1:{server.getsockname()[1]}"
    text += export_site.output("stream", "cot-protobuf", stream, **every)
    text += export_site.output("hub", "sapient", f"tcp://127.0.0.1:{hub.port}", rate_hz=rate_hz)
    broker = f"mqtt://127.0.0.1:{export_site.MQTT_PORT}"
    text += export_site.output("home", "mqtt", broker, **every)
    for kind in ("geojson", "kml", "gpx", "courageous"):
        to = f"file://{folder}/site.{kind}"
        text += export_site.output(kind, kind, to, rate_hz=0.2, lines=True)
    return text


def publish(publisher, count: int, rate_hz: float, seconds: float, published: dict) -> int:
    """Evenly in time, as a fusion does; each with a latitude of its own."""
    begin_s, sent = time.monotonic(), 0
    message = export_site.target()
    while (late_s := time.monotonic() - begin_s) < seconds:
        while sent < late_s * count * rate_hz:
            message.utime = time.time_ns() // 1000
            message.target_id = 1 + sent % count
            message.latitude_deg = 47.0 + sent * 1e-7
            published[f"{message.latitude_deg:.8f}"] = time.monotonic()
            publisher.bus.publish("OLS_TARGET", message.encode())
            sent += 1
        time.sleep(0.002)
    return sent


def main() -> None:
    parser = argparse.ArgumentParser(prog="tools/bench export", description=__doc__)
    parser.add_argument("--targets", type=int, default=200)
    parser.add_argument("--rate", type=float, default=15.0, help="[Hz] of each target on the bus")
    parser.add_argument("--output-rate", type=float, default=2.0, help="[Hz] of each output")
    parser.add_argument("--seconds", type=float, default=20.0)
    arguments = parser.parse_args()
    print("load before:", Path("/proc/loadavg").read_text().split()[0])
    bring_up_loopback([])
    folder = Path(tempfile.mkdtemp())
    broker = export_site.Broker(folder)
    published: dict[str, float] = {}
    receiver = Receiver(published)
    publisher = export_site.Publisher()
    text = outputs(folder, receiver.port, arguments.output_rate)
    try:
        with export_site.Exporter(folder, text) as exporter:
            publish(publisher, arguments.targets, arguments.rate, 2.0, published)
            receiver.delays_s.clear()
            published.clear()
            before_s = cpu_s(exporter.process.pid)
            sent = publish(
                publisher, arguments.targets, arguments.rate, arguments.seconds, published
            )
            cores = (cpu_s(exporter.process.pid) - before_s) / arguments.seconds
            time.sleep(1.5)
            status = exporter.status()
    finally:
        broker.kill()
    delays_ms = 1e3 * np.array(receiver.delays_s)
    print(f"published {sent / arguments.seconds:.0f} targets/s, received {len(delays_ms)}")
    print(f"publication to datagram: p50 {np.percentile(delays_ms, 50):.2f} ms, ", end="")
    print(f"p95 {np.percentile(delays_ms, 95):.2f} ms, p99 {np.percentile(delays_ms, 99):.2f} ms")
    print(f"processor: {cores:.3f} cores")
    for name, report in status["outputs"].items():
        print(f"  {name}: {report}")


if __name__ == "__main__":
    main()
