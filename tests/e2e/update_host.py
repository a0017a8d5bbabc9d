"""A host for the scripts of an update, as they are installed: its systemctl, dpkg and ols-doctor
are scripts of these tests, and its time passes when they sleep."""

import os

from conftest import ROOT, finished

RESTART = ROOT / "systemd/ols-station-restart"
KEEP = ROOT / "systemd/ols-keep-packages"
STATION = "ols-station@alfa.service"
OTHER = "ols-station@bravo.service"
BUSY = "ols-station@charlie.service"
START_S = 5000  # after this host's start
BRIEFLY = ("--watch", "60", "--worse", "150")  # where it is not told how long it watches

# A watch asks them hundreds of times: they use what the shell has itself, where it has it.
SYSTEMCTL = r"""#!/bin/sh
read -r up _ <"$OLS_UPTIME" && now_s=${up%.*}
case "$*" in
  list-units*--state=failed*) grep ' failed ' "$HOST/units" ;;
  list-units*) cat "$HOST/units" ;;
  *ActiveState*bravo*) echo failed ;;
  *ActiveState*) read -r active <"$HOST/active"; echo "$active" ;;
  *ActiveEnterTimestampMonotonic*)
    # A program that ends too soon again and again has been running for a moment whenever one looks.
    if [ -e "$HOST/crashes" ] && [ -e "$HOST/restarted" ]; then echo "$((now_s - 3))000000"
    else read -r started_us <"$HOST/started_us"; echo "$started_us"; fi ;;
  *StatusText*charlie*) echo tracking ;;
  *StatusText*)
    # One line a question; the last one stays.
    head -1 "$HOST/state"
    if [ "$(wc -l <"$HOST/state")" -gt 1 ]; then sed -i 1d "$HOST/state"; fi ;;
  *) echo "systemctl $*" >>"$HOST/done"
     if [ "$1" = restart ]; then
       : >"$HOST/restarted"
       echo "${now_s}000000" >"$HOST/started_us"
       if [ -e "$HOST/active_after" ]; then cp "$HOST/active_after" "$HOST/active"; fi
     fi ;;
esac
"""
# A failure a line, by its first words. It takes its time, as the real one does.
DOCTOR = r"""#!/bin/sh
sleep 6
before="$HOST/failures"
if [ -e "$HOST/restarted" ]; then before="$HOST/failures_after"; fi
read -r up _ <"$OLS_UPTIME" && read -r not_before_s <"$HOST/not_before_s"
if [ "${up%.*}" -lt "$not_before_s" ]; then exit 0; fi
read -r failure <"$before"
[ "$failure" != crash ] || exit 139
echo "ok    configuration: /etc/ols/alfa.toml"
[ -s "$before" ] || exit 0
sed 's/.*/FAIL  &: something is wrong; do something/' "$before"
exit 2
"""
DPKG = r"""#!/bin/sh
echo "$(cut -d. -f1 "$OLS_UPTIME") dpkg $*" >>"$HOST/dpkg"
if [ -e "$HOST/dpkg_busy" ]; then rm "$HOST/dpkg_busy"; exit 2; fi
if [ -e "$HOST/dpkg_broken" ]; then exit 1; fi
echo "dpkg $*" >>"$HOST/done"
"""
# What it is given to run hangs.
TIMEOUT = r"""#!/bin/sh
shift
[ ! -e "$HOST/hangs" ] || { sleep 60; exit 124; }
exec "$@"
"""
# Debian's own, for packages that are nothing but a name here.
DPKG_DEB = '#!/bin/sh\nbasename "$2" | cut -d_ -f2\n'
DPKG_QUERY = r"""#!/bin/sh
case "$*" in
  *Status*) sed 's/^/installed /' "$HOST/installed" ;;
  *) while read -r name version; do
       if [ "$name" = ols-station ]; then echo "$version"; fi
     done <"$HOST/installed"
     # The next update comes.
     if [ -e "$HOST/next" ] && [ -e "$HOST/restarted" ]; then
       mv "$HOST/next" "$HOST/installed"
     fi ;;
esac
"""
REPACK = r"""#!/bin/sh
[ ! -e "$HOST/no_repack" ] || exit 1
touch "$1_$(sed -n "s/^$1 //p" "$HOST/installed")_amd64.deb"
"""
SLEEP = r"""#!/bin/sh
read -r up _ <"$OLS_UPTIME"
echo "$((${up%.*} + $1)).25 17.5" >"$OLS_UPTIME"
"""


class Host:
    def __init__(self, folder):
        self.folder = folder
        self.packages = folder / "packages"
        self.refused = folder / "preferences"
        commands = folder / "bin"
        commands.mkdir()
        scripts = {
            "systemctl": SYSTEMCTL,
            "ols-doctor": DOCTOR,
            "dpkg": DPKG,
            "dpkg-deb": DPKG_DEB,
            "dpkg-query": DPKG_QUERY,
            "dpkg-repack": REPACK,
            "sleep": SLEEP,
            "timeout": TIMEOUT,
        }
        for name, text in scripts.items():
            (commands / name).write_text(text)
            (commands / name).chmod(0o755)
        self.environment = {
            **os.environ,
            "PATH": f"{commands}:{os.environ['PATH']}",
            "HOST": str(folder),
            "OLS_PACKAGES": str(self.packages),
            "OLS_PREFERENCES": str(self.refused),
            "OLS_UPTIME": str(folder / "uptime"),
            "OLS_BOOT_ID": str(folder / "boot_id"),
        }
        self.set(units=f"{STATION} loaded active running", active="active", state="idle")
        self.set(uptime=f"{START_S}.25 17.5", started_us="1000000000", installed="bash 5.2")
        self.set(not_before_s="0", boot_id="first")
        (folder / "failures").touch()
        (folder / "failures_after").touch()

    def set(self, **files):
        for name, text in files.items():
            (self.folder / name).write_text(text + "\n")

    def run(self, *command, **options):
        return finished(*command, env=self.environment, **options)

    def install(self, version):
        """As apt announces what it is about to install, and then does."""
        folder = self.folder / f"archive-{version}"
        folder.mkdir(exist_ok=True)
        names = [f"ols-station_{version}_amd64.deb", f"ols-common_{version}_amd64.deb"]
        for name in (*names, "chrony_4.3_amd64.deb"):
            (folder / name).write_text(version)
        text = "".join(f"{path}\n" for path in sorted(folder.iterdir()))
        done = self.run(KEEP, input=text)
        assert done.returncode == 0, done.stderr
        self.set(installed=f"ols-common {version}\nols-station {version}")
        return done

    def restart(self, *words):
        return self.run(RESTART, *words)

    def start_again(self, watch, *words):
        """The computer, while the update was waited for or watched."""
        self.set(boot_id="second")
        (self.packages / "watch").write_text(watch)
        return self.restart(*words)

    def done(self):
        path = self.folder / "done"
        return path.read_text().splitlines() if path.exists() else []


def took_s(host):
    return float((host.folder / "uptime").read_text().split()[0]) - START_S


def went_back(host):
    return [line for line in host.done() if line.startswith("dpkg") and "/1.0/" in line]
