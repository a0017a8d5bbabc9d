"""ols-batch: from an archive to fixes, targets and plots, hour by hour on all processors.

What is done already, from the same bearings with the same options, is skipped. Exit code: 0; 1 if
an hour failed, a file was damaged (it is named, the rest is done) or there is no fix at all; 2 if
it could not work at all.
"""

import argparse
import json
import sys
from datetime import UTC, datetime
from pathlib import Path

FAILED, UNUSABLE = 1, 2


def instant_us(text: str) -> int:
    """UTC, unless the text says otherwise."""
    time = datetime.fromisoformat(text)
    return round((time if time.tzinfo else time.replace(tzinfo=UTC)).timestamp() * 1e6)


def parse_arguments(words: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="ols-batch", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("archive", type=Path, help="folder of ols-archive")
    parser.add_argument("output", type=Path, help="folder for fixes, targets and plots")
    parser.add_argument("--region", help="only this one")
    parser.add_argument("--from", dest="begin", type=instant_us, default=0, metavar="TIME")
    parser.add_argument("--to", dest="end", type=instant_us, default=1 << 62, metavar="TIME")
    parser.add_argument("--workers", type=int, help="on this machine; default: its processors")
    parser.add_argument("--scheduler", metavar="URL", help="of a Dask cluster instead")
    parser.add_argument(
        "--estimator", choices=("filter", "least-squares", "paper"), default="filter"
    )
    parser.add_argument(
        "--smooth", action="store_true", help="with the filter: use later bearings too"
    )
    parser.add_argument(
        "--warm-up-s", type=float, default=1800.0, help="[s] read before each hour; default 1800"
    )
    parser.add_argument(
        "--run-out-s", type=float, default=30.0, help="[s] read after each hour; default 30"
    )
    parser.add_argument("--no-plots", action="store_true")
    parser.add_argument("--report", type=Path, help="JSON; default: report.json in the output")
    arguments = parser.parse_args(words)
    check(parser, arguments)
    return arguments


def check(parser: argparse.ArgumentParser, arguments: argparse.Namespace) -> None:
    if not (arguments.archive / "bearing").is_dir():
        parser.error(f"{arguments.archive}: no archive with bearings")
    if arguments.output.exists() and not arguments.output.is_dir():
        parser.error(f"{arguments.output} is no folder")
    if arguments.output.resolve() == arguments.archive.resolve():
        parser.error("archive and output are the same folder")
    if arguments.workers is not None and arguments.workers < 1:
        parser.error("--workers must be at least 1")
    for name in ("warm_up_s", "run_out_s"):
        if not 0.0 <= getattr(arguments, name) <= 86_400.0:
            parser.error(f"--{name.replace('_', '-')} must be 0 to 86400")
    if arguments.smooth and arguments.estimator != "filter":
        parser.error("--smooth: only the filter can be smoothed")


def tell(report, path: Path) -> None:
    partial = path.with_name(path.name + ".partial")
    partial.parent.mkdir(parents=True, exist_ok=True)
    partial.write_text(json.dumps(report.as_json(), indent=2) + "\n")
    partial.rename(path)
    print(
        f"hours     {report.done} done, {report.skipped} skipped, {len(report.failed)} failed\n"
        f"bearings  {report.bearings}, {report.used} of an object\n"
        f"fixes     {report.fixes}; targets in all {report.targets}\n"
        f"time      {report.seconds:.1f} s\n"
        f"report    {path}"
    )
    for reason, count in sorted(report.unused.items()):
        print(f"unused    {count} {reason}")
    for plot in report.plots:
        print(f"plot      {plot}")
    for hour, why in sorted(report.failed.items()):
        print(f"ols-batch: {hour} failed: {why}", file=sys.stderr)
    for path in sorted(report.damaged):
        print(f"ols-batch: damaged: {path}", file=sys.stderr)
    if not report.fixes:
        print("ols-batch: no position at all", file=sys.stderr)


def exit_code(report) -> int:
    return FAILED if report.failed or report.damaged or not report.fixes else 0


def main(words: list[str] | None = None) -> int:
    try:
        return work(words)
    except ModuleNotFoundError as missing:
        print(f"ols-batch: {missing}: install ols[archive]", file=sys.stderr)
        return UNUSABLE


def work(words: list[str] | None) -> int:
    arguments = parse_arguments(words)
    from ols_batch.plan import Settings
    from ols_batch.run import run

    settings = Settings(
        arguments.archive.resolve(),
        arguments.output.resolve(),
        arguments.warm_up_s,
        arguments.run_out_s,
        arguments.estimator,
        arguments.smooth,
    )
    try:
        report = run(
            settings,
            arguments.workers,
            arguments.scheduler,
            arguments.region,
            (arguments.begin, arguments.end),
            not arguments.no_plots,
        )
    except OSError as error:
        print(f"ols-batch: {error}", file=sys.stderr)
        return UNUSABLE
    if not report.done + report.skipped + len(report.failed):
        print(f"ols-batch: {arguments.archive}: no hour with bearings is chosen", file=sys.stderr)
        return UNUSABLE
    tell(report, arguments.report or settings.output / "report.json")
    return exit_code(report)


if __name__ == "__main__":
    sys.exit(main())
