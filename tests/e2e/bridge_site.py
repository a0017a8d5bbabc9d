"""What the tests of ols-bridge have in common: servers of NATS with the permissions of the shipped
examples, buses, and the process between them."""

import base64
import contextlib
import itertools
import json
import os
import re
import signal
import socket
import subprocess
import threading
import time
from pathlib import Path

import lcm
import ols_msg
import pytest
from conftest import BIN, ROOT, finished, made, wait

DEADLINE_S = 60.0
SERVER = Path(os.environ.get("OLS_NATS_SERVER", ROOT / "build/nats/nats-server"))
EXAMPLES = ROOT / "systemd/examples"
NAMES = {"moravia": "r", "bohemia": "q", "airfield": "s", "alfa": "alfa", "bravo": "bravo"}

needs_server = pytest.mark.skipif(
    not SERVER.exists(), reason="nats-server is not built: tools/build-nats-server"
)


def bus_url(port):
    return f"udpm://239.255.76.67:{port}?ttl=0"


def key(path):
    """A user's seed in this file; the public key is returned."""
    done = finished(BIN / "ols-bridge", "--make-key", path, check=True)
    return done.stdout.strip()


class Server:
    """nats-server with one of the shipped examples, as `change` adapts it to this host."""

    def __init__(self, folder: Path, example: str, change):
        self.folder, self.process = folder, None
        text = (EXAMPLES / example).read_text()
        for name, short in NAMES.items():
            text = re.sub(rf"(?<![A-Za-z0-9-]){name}(?![A-Za-z0-9-])", short, text)
        self.config = folder / example
        self.config.write_text(change(text.replace('"/var/lib/nats"', f'"{folder}/{example}.d"')))
        self.log = folder / f"{example}.log"
        self.start()

    def start(self):
        with self.log.open("ab") as out:
            before = out.tell()
            self.process = subprocess.Popen(
                [str(SERVER), "-c", str(self.config)], stdout=out, stderr=out
            )
        wait(
            lambda: b"Server is ready" in self.log.read_bytes()[before:] or self.process.poll(),
            "nats-server is ready",
        )
        assert self.process.poll() is None, self.log.read_text()

    def signal(self, how):
        """A stop is waited for: until then one of its threads may go on."""
        self.process.send_signal(how)
        if how == signal.SIGSTOP:
            os.waitid(os.P_PID, self.process.pid, os.WSTOPPED)

    def stop(self):
        if self.process is not None:
            self.process.send_signal(signal.SIGCONT)
            self.process.terminate()
            self.process.wait(DEADLINE_S)
        self.process = None


def active(text, after, last="nothing"):
    """An example's text without the # of the lines after one that begins so, to one that is so."""
    lines, is_in = [], False
    for line in text.split("\n"):
        words = line.strip().removeprefix("# ")
        lines.append(line.replace("# ", "", 1) if is_in and line.strip().startswith("#") else line)
        is_in = (is_in and words != last) or words.startswith(after)
    return "\n".join(lines)


class Proxy:
    """The link between leaf and hub, which can be cut: connections end, and no new one is taken."""

    def __init__(self, port, to):
        self.port, self.to, self._pairs, self._server = port, to, [], None
        self.mend()

    def mend(self):
        self._server = socket.create_server(("127.0.0.1", self.port))
        threading.Thread(target=self._accept, args=(self._server,), daemon=True).start()

    def _accept(self, server):
        while True:
            try:
                near = server.accept()[0]
                far = socket.create_connection(("127.0.0.1", self.to))
            except OSError:
                return
            self._pairs += [near, far]
            for one, other in ((near, far), (far, near)):
                threading.Thread(target=self._pass, args=(one, other), daemon=True).start()

    @staticmethod
    def _pass(one, other):
        try:
            while data := one.recv(65536):
                other.sendall(data)
        except OSError:
            pass

    def cut(self):
        self._server.shutdown(socket.SHUT_RDWR)
        self._server.close()
        for one in self._pairs:
            with contextlib.suppress(OSError):
                one.shutdown(socket.SHUT_RDWR)
            one.close()
        self._pairs = []


class Watcher:
    """A client of NATS of our own, small and plain: what passes, and requests with an answer."""

    def __init__(self, port, *subjects):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=DEADLINE_S)
        self._stream = self.socket.makefile("rb")
        self._stream.readline()  # INFO
        self._lock, self._numbers = threading.Lock(), itertools.count(1)
        self.heard, self._answers = [], {}
        options = {"verbose": False, "headers": True, "user": "watch", "pass": "watch"}
        self.send(f"CONNECT {json.dumps(options)}\r\n".encode())
        self.send(b"SUB _INBOX.watch.* 0\r\n")
        for subject in subjects:
            self.send(f"SUB {subject} 1\r\n".encode())
        threading.Thread(target=self._read, daemon=True).start()
        self.request("$JS.API.INFO", {})

    def send(self, data):
        with self._lock:
            self.socket.sendall(data)

    def request(self, subject, body, deadline_s=DEADLINE_S):
        """The answer as JSON; None: none came."""
        number = next(self._numbers)
        data = json.dumps(body).encode()
        self.send(f"PUB {subject} _INBOX.watch.{number} {len(data)}\r\n".encode() + data + b"\r\n")
        end = time.monotonic() + deadline_s
        while number not in self._answers and time.monotonic() < end:
            time.sleep(0.005)
        return self._answers.pop(number, None)

    def _read(self):
        try:
            while line := self._stream.readline():
                words = line.decode().split()
                if words[:1] == ["PING"]:
                    self.send(b"PONG\r\n")
                if words[:1] in (["MSG"], ["HMSG"]):
                    self._take(words)
        except (OSError, ValueError):
            pass

    def _take(self, words):
        head = int(words[-2]) if words[0] == "HMSG" else 0
        data = self._stream.read(int(words[-1]) + 2)[:-2]
        lines = data[:head].decode().split("\r\n")[1:]
        headers = dict(line.split(": ", 1) for line in lines if ": " in line)
        if words[1].startswith("_INBOX.watch."):
            body = data[head:]
            self._answers[int(words[1].split(".")[-1])] = json.loads(body) if body else {}
        else:
            self.heard.append((time.monotonic(), words[1], headers, data[head:]))

    def stored(self, domain, stream):
        """All messages of a stream, by their Nats-Msg-Id."""
        state = self.request(f"$JS.{domain}.API.STREAM.INFO.{stream}", {})["state"]
        found = []
        if not state["messages"]:  # the first of none is 0, which none has
            return found
        for number in range(state["first_seq"], state["last_seq"] + 1):
            got = self.request(f"$JS.{domain}.API.STREAM.MSG.GET.{stream}", {"seq": number})
            headers = base64.b64decode(got["message"].get("hdrs", "")).decode()
            name = re.search(r"Nats-Msg-Id: ?(\S+)", headers)
            found.append(
                (
                    got["message"]["subject"],
                    name[1] if name else None,
                    base64.b64decode(got["message"]["data"]),
                )
            )
        return found

    def close(self):
        self.socket.close()


class Bridge:
    def __init__(self, folder: Path, name: str, bus: str, seed: Path, public: str, **options):
        self.status_file = folder / f"{name}.json"
        self.log = folder / f"{name}.log"
        more = dict(options)
        text = f'lcm_url = "{bus}"\nstatus_file = "{self.status_file}"\n{more.pop("head")}\n'
        text += f'[nats]\nservers = ["nats://127.0.0.1:{more.pop("port")}"]\n'
        text += f'nkey = "{public}"\nseed = "{seed}"\n{more.pop("tail", "")}\n'
        self.config = folder / f"{name}.toml"
        self.config.write_text(text)
        self.process = None
        self.start()

    def spawn(self):
        """Returns how long its log was before."""
        command = [str(BIN / "ols-bridge"), "--config", str(self.config)]
        with self.log.open("ab") as out:
            before = out.tell()
            self.process = subprocess.Popen(command, stderr=out, stdout=out)
        return before

    def start(self):
        before = self.spawn()
        wait(
            lambda: b"ready" in self.log.read_bytes()[before:] or self.process.poll() is not None,
            "ols-bridge is ready",
        )
        assert self.process.poll() is None, self.log.read_text()

    def status(self):
        wait(self.status_file.exists, "a status")
        return json.loads(self.status_file.read_text())

    def until(self, condition, what, deadline_s=DEADLINE_S):
        return wait(lambda: condition(self.status()), what, deadline_s)

    def stop(self):
        if self.process.poll() is None:
            self.process.terminate()
        return self.process.wait(DEADLINE_S)


class Other:
    """A bridge of another configuration, which need not connect."""

    def __init__(self, folder, name, nats):
        self.status_file = folder / f"{name}.json"
        config = folder / f"{name}.toml"
        config.write_text(
            f'lcm_url = "{bus_url(7670)}"\nstatus_file = "{self.status_file}"\n[nats]\n{nats}\n'
        )
        self.log = folder / f"{name}.log"
        command = [str(BIN / "ols-bridge"), "--config", str(config)]
        with self.log.open("wb") as out:
            self._process = subprocess.Popen(command, stderr=out)

    def status(self):
        return json.loads(self.status_file.read_text()) if self.status_file.exists() else None

    def says(self, words):
        return self.status() and any(words in alarm["text"] for alarm in self.status()["alarms"])

    def stop(self):
        self._process.terminate()
        assert self._process.wait(DEADLINE_S) == 0


class Network:
    """A hub, a leaf, and a bridge at each: one site, one region."""

    def __init__(self, folder: Path, region_tail="", site_tail="", site_head=""):
        self.folder, self.with_targets = folder, "targets" in site_head
        users = ("site", "leaf", "region", "archive", "neighbour")
        self.seeds = {name: folder / f"{name}.seed" for name in users}
        self.keys = {name: key(self.seeds[name]) for name in users}
        seed = self.seeds["leaf"].read_text().strip()
        (folder / "leaf-key.conf").write_text(f"nkey: {seed}\n")
        self.link = Proxy(7522, 7422)
        self.hub = Server(folder, "nats-hub.conf", self._hub)
        self.leaf = Server(folder, "nats-leaf.conf", self._leaf)
        self.site_url, self.region_url = bus_url(7667), bus_url(7668)
        self.site = Bridge(
            *(folder, "site", self.site_url, self.seeds["site"], self.keys["site"]),
            port=4223,
            head=f'role = "site"\nregion = "r"\nsite = "s"\n{site_head}',
            tail=site_tail,
        )
        self.region = Bridge(
            *(folder, "region", self.region_url, self.seeds["region"], self.keys["region"]),
            port=4222,
            head='role = "region"\nregion = "r"\ntargets = true\n',
            tail=region_tail,
        )
        self.region.until(lambda s: s["link"]["open"], "the region's server")
        self.site.until(lambda s: s["link"]["open"], "the site's server")

    def _hub(self, text):
        text = re.sub(r"^  tls \{.*?\n  \}\n", "", text, flags=re.S | re.M)
        text = text.replace("users: [", "users: [\n{user: watch, password: watch}\n")
        text = text.replace("# " * self.with_targets + '"ols.v1.r.target"', '"ols.v1.r.target"')
        text = active(text, "The hub of a second region")
        text = text.replace("UAHUBOFANOTHERREGION", self.keys["neighbour"])
        text = text.replace("UBRIDGEOFTHEREGION", self.keys["region"])
        text = text.replace("UARCHIVEOFTHEREGION", self.keys["archive"])
        return text.replace("UALEAFOFTHESITE", self.keys["leaf"])

    def _leaf(self, text):
        text = re.sub(r"    tls \{.*?\}\n", "", text)
        text = text.replace("users: [", "users: [\n{user: watch, password: watch}\n")
        text = text.replace("# " * self.with_targets + '"ols.v1.r.target"', '"ols.v1.r.target"')
        text = text.replace("tls://hub.example:7422", "nats-leaf://127.0.0.1:7522")
        text = text.replace("127.0.0.1:4222", "127.0.0.1:4223")
        return text.replace("UABRIDGEOFTHESITE", self.keys["site"])

    def close(self):
        self.link.cut()
        codes = [bridge.stop() for bridge in (self.site, self.region)]
        for server in (self.leaf, self.hub):
            server.stop()
        assert codes == [0, 0], (codes, self.site.log.read_text(), self.region.log.read_text())


class Listener:
    """What comes on a bus, as bytes."""

    def __init__(self, url):
        self.bus = lcm.LCM(url)
        self.heard = []
        heard = self.bus.subscribe(".*", lambda channel, data: self.heard.append((channel, data)))
        heard.set_queue_capacity(10_000)

    def handle(self, timeout_ms=20):
        while self.bus.handle_timeout(timeout_ms) > 0:
            timeout_ms = 0

    def on(self, channel):
        self.handle()
        return [data for name, data in self.heard if name == channel]


def bearing(station="alfa", sequence=1, boot_id=7, age_s=0.0):
    sender = {"station": station, "boot_id": boot_id, "sequence": sequence}
    return made(ols_msg.bearing_t, age_s, **sender).encode()


def status(station="alfa", sequence=1, boot_id=7):
    sender = {"station": station, "boot_id": boot_id, "sequence": sequence}
    return made(ols_msg.station_status_t, **sender).encode()


def slew(station="alfa", sequence=1, age_s=0.0, target_id=0):
    sender = {"station": station, "boot_id": 9, "sequence": sequence}
    return made(ols_msg.slew_t, age_s, **sender, lease_s=1.0, target_id=target_id).encode()


def target(sequence):
    return made(ols_msg.target_t, boot_id=3, sequence=sequence, target_id=1).encode()
