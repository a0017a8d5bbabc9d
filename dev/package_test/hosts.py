"""Debian 12 hosts in containers (systemd-nspawn), on a bridge that leads nowhere else."""

import os
import shutil
import subprocess
import time
from pathlib import Path

BRIDGE = "ols-bridge"
HANG_S = 300.0  # for what takes seconds; how long it may take is judged elsewhere


def run(*command, check=True, **options):
    words = [str(word) for word in command]
    return subprocess.run(words, check=check, capture_output=True, text=True, **options)


def make_network():
    run("ip", "link", "set", "lo", "up")
    run("ip", "link", "add", BRIDGE, "type", "bridge", "mcast_snooping", "0")
    run("ip", "link", "set", BRIDGE, "up")


class Host:
    def __init__(self, name, number, rootfs, work):
        self.name = name
        self.address = f"10.7.0.{number}"
        self.root = work / f"host-{name}"
        self.console = (work / f"console-{name}.txt").open("w")
        changes = work / f"changes-{name}"
        shutil.rmtree(changes, ignore_errors=True)
        for folder in (self.root, changes / "upper", changes / "work"):
            folder.mkdir(parents=True, exist_ok=True)
        layers = f"lowerdir={rootfs},upperdir={changes}/upper,workdir={changes}/work"
        run("mount", "-t", "overlay", "overlay", "-o", layers, self.root)
        (self.root / "etc/machine-id").write_text("")
        self.start()

    def start(self):
        environment = {**os.environ, "SYSTEMD_NSPAWN_UNIFIED_HIERARCHY": "1"}
        self.container = subprocess.Popen(
            [
                *("systemd-nspawn", "--quiet", "--register=no", "--keep-unit", "--link-journal=no"),
                *(f"--machine={self.name}", f"--directory={self.root}"),
                f"--network-bridge={BRIDGE}",
                *("--system-call-filter=bpf", "--capability=CAP_BPF", "--boot"),
            ],
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=self.console,
            stderr=subprocess.STDOUT,
        )
        self.leader = self.wait("its first process", self.find_leader)
        self.wait("its start", self.has_started)
        self.run("ip", "link", "set", "host0", "up")
        self.run("ip", "address", "add", f"{self.address}/24", "dev", "host0")

    def has_started(self):
        return self.says("systemctl", "is-system-running").strip() in ("running", "degraded")

    def find_leader(self):
        """Of nspawn's children the one that is the first process of its own namespace."""
        children = Path(f"/proc/{self.container.pid}/task/{self.container.pid}/children")
        for child in children.read_text().split():
            status = Path(f"/proc/{child}/status").read_text()
            if status.split("NSpid:")[1].splitlines()[0].split()[-1] == "1":
                return int(child)
        return None

    def run(self, *command, check=True, **options):
        done = run(
            *("nsenter", f"--target={self.leader}", "--mount", "--uts", "--ipc", "--net", "--pid"),
            *("--root", "--wd", "--", "env", "-i", "PATH=/usr/sbin:/usr/bin:/sbin:/bin"),
            *("LC_ALL=C.UTF-8", "DEBIAN_FRONTEND=noninteractive", *command),
            check=False,
            **options,
        )
        if check and done.returncode != 0:
            words = " ".join(map(str, command))
            raise RuntimeError(f"{self.name}: {words}:\n{done.stdout}{done.stderr}")
        return done

    def says(self, *command):
        done = self.run(*command, check=False)
        return done.stdout + done.stderr

    def write(self, path, text):
        file = self.root / path.lstrip("/")
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)

    def wait(self, what, condition):
        """The condition's value; asked ten times a second."""
        end_s = time.monotonic() + HANG_S
        while True:
            value = condition()
            if value:
                return value
            if time.monotonic() > end_s:
                raise RuntimeError(f"{self.name}: waited {HANG_S:g} s for {what}")
            if self.container.poll() is not None:
                raise RuntimeError(f"{self.name}: ended; see {self.console.name}")
            time.sleep(0.1)

    def start_again(self):
        """As a computer that is switched off and on: what was started by hand is gone."""
        self.stop()
        self.start()

    def stop(self):
        if self.container.poll() is not None:
            return
        self.container.terminate()
        try:
            self.container.wait(30)
        except subprocess.TimeoutExpired:
            self.container.kill()
            self.container.wait()

    def end(self):
        self.stop()
        self.console.close()
        run("umount", "--lazy", self.root)
