"""A fresh Debian 12, with what the packages depend on downloaded and not installed.

rootfs.py FOLDER PACKAGES
"""

import shutil
import sys
from pathlib import Path

from hosts import run

LOGGER = "liblcm-bin"  # what is on the bus, as evidence of the tests


def dependencies(packages):
    fields = [run("dpkg-deb", "--field", path, "Depends", "Recommends") for path in packages]
    return "".join(field.stdout for field in fields)


def main(tree, packages):
    stamp = tree.with_suffix(".dependencies")
    wanted = dependencies(packages)
    if stamp.exists() and stamp.read_text() == wanted:
        return
    print("== root file system: Debian 12, and the packages' dependencies downloaded", flush=True)
    shutil.rmtree(tree, ignore_errors=True)
    tree.parent.mkdir(parents=True, exist_ok=True)
    paths = " ".join(map(str, packages))
    run(
        *("mmdebstrap", "--quiet", "--variant=minbase", "--skip=cleanup/apt"),
        "--include=systemd,systemd-sysv,dbus,udev,iproute2,procps",
        "--customize-hook=APT_CONFIG=$MMDEBSTRAP_APT_CONFIG "
        f"apt-get install -y -qq --install-recommends --download-only {LOGGER} {paths}",
        *("bookworm", tree),
    )
    stamp.write_text(wanted)


if __name__ == "__main__":
    found = sorted(Path(sys.argv[2]).resolve().glob("*.deb"))
    main(Path(sys.argv[1]).resolve(), [path for path in found if "-dbgsym_" not in path.name])
