"""tools/bench-tracking: our tracker and OpenCV's, on clips with ground truth."""

import argparse
import os
import platform
import sys
from pathlib import Path

import cv2

from ols_bench import figures, tables, worst
from ols_bench.clips import BadInput, Clip, read_folder
from ols_bench.places import places_of
from ols_bench.results import results_of
from ols_bench.trackers import NAMES, OURS, frames_per_second, run_opencv, run_ours

ROOT = Path(__file__).resolve().parents[3]


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="tools/bench-tracking", description=__doc__)
    parser.add_argument(
        "clips",
        type=Path,
        nargs="+",
        metavar="CLIPS",
        help="folder with NAME.mp4 or NAME.avi and NAME.csv (frame,x,y,w,h: the truth)",
    )
    parser.add_argument("--output", type=Path, default=ROOT / "out/tracking")
    parser.add_argument(
        "--trackers",
        default=",".join(NAMES),
        help="run only these; others that are complete in the output folder are shown as they are "
        "there (default: %(default)s)",
    )
    parser.add_argument(
        "--seed", type=int, default=1, help="of the random numbers (default: %(default)s)"
    )
    parser.add_argument("--config", type=Path, help="TOML file with a table [tracker] for ours")
    parser.add_argument(
        "--program", type=Path, default=ROOT / "build/release/bin/ols-track", help="ols-track"
    )
    return parser.parse_args()


def folders_of(paths: list[Path]) -> dict[str, list[Clip]]:
    folders = {}
    for path in paths:
        name = path.resolve().name
        if name in folders:
            raise BadInput(f"{path}: two folders have this name")
        folders[name] = read_folder(path)
    return folders


def run(tracker: str, folders: dict[str, list[Clip]], given: argparse.Namespace) -> None:
    for folder, clips in folders.items():
        for clip in clips:
            places = places_of(given.output, tracker, folder, clip)
            if tracker in OURS:
                run_ours(tracker, clip, places, given.seed, given.program, given.config)
            else:
                run_opencv(tracker, clip, places, given.seed)
            print(f"{tracker:14} {folder}/{clip.name}", flush=True)


def complete(tracker: str, folders: dict[str, list[Clip]], output: Path) -> bool:
    return all(
        places_of(output, tracker, folder, clip).complete()
        for folder, clips in folders.items()
        for clip in clips
    )


def about(ran: list[str], shown: list[str], seed: int) -> str:
    core = ",".join(map(str, sorted(os.sched_getaffinity(0))))
    model = "unknown processor"
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            model = line.split(":", 1)[1].strip()
            break
    text = (
        f"One thread on core {core} of {platform.machine()}, {model}; OpenCV {cv2.__version__}'s "
        f"trackers; seed {seed}. Times are processor time inside the trackers' update alone, "
        "decoding apart."
    )
    earlier = [tracker for tracker in shown if tracker not in ran]
    if earlier:
        text += f" From an earlier run: {', '.join(earlier)}."
    return text


def main() -> None:
    given = arguments()
    wanted = [name.strip() for name in given.trackers.split(",")]
    try:
        for name in wanted:
            if name not in NAMES:
                raise BadInput(f"--trackers: {name}: none of {', '.join(NAMES)}")
        folders = folders_of(given.clips)
        for name in wanted:
            run(name, folders, given)
        shown = [name for name in NAMES if complete(name, folders, given.output)]
        rates = {clip.path: frames_per_second(clip) for clips in folders.values() for clip in clips}
        results = {name: results_of(given.output, name, folders, rates) for name in shown}
        text = about(wanted, shown, given.seed)
        tables.write(given.output, results, text)
        figures.draw(given.output, results)
        if "ours (full)" in results:
            worst.draw(given.output, "ours (full)", folders, results["ours (full)"])
    except (BadInput, OSError) as error:
        sys.exit(f"bench-tracking: {error}")
    print((given.output / "tracking.md").read_text())
    print(f"Written to {given.output}")


if __name__ == "__main__":
    main()
