"""tools/bench tracking: our tracker and OpenCV's, on clips with ground truth."""

import argparse
import os
import platform
import re
import sys
from pathlib import Path

import cv2

from ols_bench import tables
from ols_bench.clips import BadInput, Clip, read_folder
from ols_bench.pictures import frames_per_second
from ols_bench.places import places_of
from ols_bench.results import Result, results_of, with_repeats
from ols_bench.trackers import NAMES, OURS, RANDOM, run_opencv, run_ours
from ols_bench.variants import KINDS, variant

ROOT = Path(__file__).resolve().parents[3]


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="tools/bench tracking", description=__doc__)
    parser.add_argument(
        "clips",
        type=Path,
        nargs="+",
        metavar="CLIPS",
        help="folder with NAME.mp4, NAME.avi or a folder NAME/ of pictures, and NAME.csv "
        "(frame,x,y,w,h: the truth)",
    )
    parser.add_argument(
        "--variants",
        default="",
        metavar="KINDS",
        help="run also on clips made of the given ones, into OUTPUT/clips: " + ", ".join(KINDS),
    )
    parser.add_argument("--output", type=Path, default=ROOT / "out/tracking")
    parser.add_argument(
        "--trackers",
        default=",".join(NAMES),
        help="run only these; others that are complete in the output folder are shown as they are "
        "there (default: %(default)s)",
    )
    parser.add_argument(
        "--seeds",
        default="1",
        help="of the random numbers, such as 1,2,3: tables are of the first one, mean "
        "and range of all are given beside (default: %(default)s)",
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


def variants_of(
    folders: dict[str, list[Clip]], kinds: list[str], output: Path
) -> dict[str, list[Clip]]:
    made = {}
    for folder, clips in folders.items():
        for kind in kinds:
            name = f"{folder}-{kind}"
            made[name] = variant(kind, clips, output / "clips" / name)
            print(f"{name}: made of {len(made[name])} of {len(clips)} clips", flush=True)
    return {name: clips for name, clips in made.items() if clips}


def names_in(text: str, known: tuple[str, ...], option: str) -> list[str]:
    names = [name.strip() for name in text.split(",") if name.strip()]
    for name in names:
        if name not in known:
            raise BadInput(f"{option}: {name}: none of {', '.join(known)}")
    return names


def seeds_in(text: str) -> list[int]:
    try:
        seeds = [int(part) for part in text.split(",")]
    except ValueError:
        raise BadInput(f"--seeds: not whole numbers: {text}") from None
    if min(seeds) < 0 or len(set(seeds)) < len(seeds):
        raise BadInput(f"--seeds: negative, or one of them twice: {text}")
    return seeds


def seed_places(tracker: str, seeds: list[int]) -> dict[int, int | None]:
    """Of each seed to run with, what its place is called by."""
    wanted = seeds if tracker in RANDOM else seeds[:1]
    return {seed: seed if place else None for place, seed in enumerate(wanted)}


def run(
    tracker: str, folders: dict[str, list[Clip]], given: argparse.Namespace, seeds: list[int]
) -> None:
    for folder, clips in folders.items():
        for clip in clips:
            for seed, place in seed_places(tracker, seeds).items():
                places = places_of(given.output, tracker, folder, clip, place)
                if tracker in OURS:
                    run_ours(tracker, clip, places, seed, given.program, given.config)
                else:
                    run_opencv(tracker, clip, places, seed)
            print(f"{tracker:14} {folder}/{clip.name}", flush=True)


def complete(tracker: str, folders: dict[str, list[Clip]], output: Path) -> bool:
    return all(
        places_of(output, tracker, folder, clip).complete()
        for folder, clips in folders.items()
        for clip in clips
    )


def about(ran: list[str], shown: list[str], seeds: list[int]) -> str:
    core = ",".join(map(str, sorted(os.sched_getaffinity(0))))
    found = re.search(r"^model name\s*: (.*)", Path("/proc/cpuinfo").read_text(), re.M)
    model = found[1] if found else "unknown processor"
    text = (
        f"One thread on core {core} of {platform.machine()}, {model}; OpenCV {cv2.__version__}'s "
        f"trackers; seed {seeds[0]}. Times are processor time inside the trackers' update alone, "
        "decoding apart."
    )
    earlier = [tracker for tracker in shown if tracker not in ran]
    if earlier:
        text += f" From an earlier run: {', '.join(earlier)}."
    return text


def results_with_seeds(
    tracker: str,
    folders: dict[str, list[Clip]],
    together: list[str],
    output: Path,
    seeds: list[int],
) -> dict[str, Result]:
    rates = {clip.path: frames_per_second(clip) for clips in folders.values() for clip in clips}
    first, *others = (
        results_of(output, tracker, folders, rates, together, place)
        for place in seed_places(tracker, seeds).values()
    )
    return with_repeats(first, others)


def bench(given: argparse.Namespace) -> None:
    wanted = names_in(given.trackers, NAMES, "--trackers")
    kinds = names_in(given.variants, KINDS, "--variants")
    seeds = seeds_in(given.seeds)
    folders = folders_of(given.clips)
    together = list(folders)
    folders |= variants_of(folders, kinds, given.output)
    for name in wanted:
        run(name, folders, given, seeds)
    shown = [name for name in NAMES if name in wanted or complete(name, folders, given.output)]
    results = {}
    for name in shown:
        of = seeds if name in wanted else seeds[:1]
        results[name] = results_with_seeds(name, folders, together, given.output, of)
    tables.write(given.output, results, about(wanted, shown, seeds))


def main() -> None:
    given = arguments()
    try:
        bench(given)
    except (BadInput, OSError) as error:
        sys.exit(f"tools/bench tracking: {error}")
    print((given.output / "tracking.md").read_text())
    print(f"Written to {given.output}")


if __name__ == "__main__":
    main()
