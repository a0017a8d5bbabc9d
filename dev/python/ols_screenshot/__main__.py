"""tools/console-screenshot: the console's page in a browser, with the demo's site behind it."""

import argparse
import subprocess
import sys
import time
from pathlib import Path

from console_site import browser
from ols_demo.site import Site, SiteError, bring_up_loopback
from ols_demo.wiring import Wiring
from playwright.sync_api import Page, expect

ROOT = Path(__file__).resolve().parents[3]
TRAIL_S = 25.0  # until the trail is long enough to see
PATIENCE_S = 120.0


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="tools/console-screenshot", description=__doc__)
    parser.add_argument("file", nargs="?", type=Path, default=ROOT / "docs/console.png")
    parser.add_argument("--theme", choices=("night", "day"), default="night")
    parser.add_argument("--size", default="1500x900", help="WIDTHxHEIGHT [px]")
    parser.add_argument("--bin", type=Path, default=ROOT / "build/release/bin")
    return parser.parse_args()


def start_demo(options: argparse.Namespace, folder: Path) -> subprocess.Popen:
    command = [sys.executable, "-m", "ols_demo", "--operator", "--headless"]
    command += ["--seconds", "600"]
    command += ["--output", str(folder), "--bin", str(options.bin.resolve())]
    command += ["--patience", str(PATIENCE_S)]
    return subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True)


def wait_until_tracking(demo: subprocess.Popen) -> None:
    for line in demo.stdout:
        if line.startswith("tracking for"):
            return
    raise SiteError("the demo has ended before its stations tracked")


def take(page: Page, address: str, file: Path) -> None:
    page.goto(address)
    target = page.get_by_role("region", name="Targets").get_by_role("row").nth(1)
    expect(target).to_contain_text("4", timeout=PATIENCE_S * 1000)
    time.sleep(TRAIL_S)
    target.click()
    page.get_by_role("region", name="Stations").get_by_role("button", name="bravo").click()
    page.get_by_role("button", name="Whole site").click()
    page.mouse.move(0, 0)
    page.evaluate("document.activeElement.blur()")
    time.sleep(2.0)
    page.screenshot(path=str(file))
    print(file)


def main() -> int:
    options = arguments()
    width, height = map(int, options.size.split("x"))
    folder = ROOT / "out/screenshot"
    wiring = Wiring(options.bin, ROOT / "sim/scenarios/fig7.toml", 1, folder)
    bring_up_loopback([f"127.0.0.{n}" for n in range(11, 15)])
    demo = start_demo(options, folder)
    try:
        wait_until_tracking(demo)
        with Site(folder / "console-logs") as site, browser() as chromium:
            address = wiring.start_console(site)
            scheme = "dark" if options.theme == "night" else "light"
            size = {"width": width, "height": height}
            take(chromium.new_page(viewport=size, color_scheme=scheme), address, options.file)
    except SiteError as error:
        print(f"tools/console-screenshot: {error}", file=sys.stderr)
        return 1
    finally:
        demo.terminate()
        demo.wait()
    return 0


if __name__ == "__main__":
    sys.exit(main())
