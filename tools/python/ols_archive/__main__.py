"""ols-archive: messages from logs, from the bus and from a bridge's stream into hourly Parquet
files, each once.

Running it again adds nothing. Exit code: 0; 1 if something was damaged (it is named, the rest is
archived); 2 if it could not work at all.
"""

import argparse
import json
import signal
import sys
import time
from pathlib import Path

DAMAGED, UNUSABLE = 1, 2


def parse_arguments(words: list[str] | None) -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        prog="ols-archive",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("archive", type=Path, nargs="?", help="folder of the archive")
    parser.add_argument("logs", type=Path, nargs="*", help="logs of ols-logger or lcm-logger")
    parser.add_argument(
        "--region", help="letters, digits and -: the first part of each file's path"
    )
    parser.add_argument("--live", metavar="URL", help="LCM URL of a bus: until a signal ends it")
    parser.add_argument(
        "--stream", help="of the bridge, OLS_REGION: what is new in it since the last run"
    )
    add_server(parser)
    parser.add_argument("--flush-s", type=float, default=60.0, help="[s] between writes when live")
    parser.add_argument("--keys", help="folder of keys: when live, only what is signed is archived")
    parser.add_argument("--name", default="archive", help="of the member in that folder")
    parser.add_argument(
        "--without-signatures", action="store_true", help="96 bytes a message less, not verifiable"
    )
    parser.add_argument("--report", type=Path, help="write the counts as JSON")
    parser.add_argument("--schema", action="store_true", help="print the columns as Markdown")
    arguments = parser.parse_intermixed_args(words)
    if not arguments.schema:
        check(parser, arguments)
    return arguments


def add_server(parser: argparse.ArgumentParser) -> None:
    server = parser.add_argument_group("the server of a stream (docs/bridge.md)")
    server.add_argument("--server", default="nats://127.0.0.1:4222", help="nats:// or tls://")
    server.add_argument("--domain", help="JetStream's, of the server that keeps the stream")
    server.add_argument("--seed", type=Path, help="file of the seed of our key there")
    server.add_argument("--credentials", type=Path, help="file of our credentials, in its place")
    server.add_argument("--authority", type=Path, help="PEM file that the server's is signed by")
    server.add_argument("--again", action="store_true", help="all of it, not only what is new")


def check(parser: argparse.ArgumentParser, arguments: argparse.Namespace) -> None:
    from ols_archive.partitions import REGION

    if arguments.archive is None or arguments.region is None:
        parser.error("a folder and --region are needed")
    if not REGION.fullmatch(arguments.region):
        parser.error(f"--region {arguments.region}: small letters, digits and - only")
    if [bool(arguments.logs), bool(arguments.live), bool(arguments.stream)].count(True) != 1:
        parser.error("logs, --live or --stream, one of them")
    if arguments.seed and arguments.credentials:
        parser.error("--seed or --credentials")
    if not arguments.server.startswith(("nats://", "tls://")):
        parser.error(f"--server {arguments.server} is neither nats://HOST:PORT nor tls://HOST:PORT")
    if arguments.authority and not arguments.server.startswith("tls://"):
        parser.error("--authority only with a --server of tls://")
    if arguments.flush_s <= 0.0:
        parser.error("--flush-s must be more than 0")
    if arguments.archive.exists() and not arguments.archive.is_dir():
        parser.error(f"{arguments.archive} is no folder")


def print_schema() -> None:
    from ols_archive.kinds import KINDS, columns_of

    for kind in KINDS:
        print(f"### `{kind.name}`\n\nChannel `{kind.channel}{'<station>' * kind.of_station}`.\n")
        print("| column | type | meaning |\n|---|---|---|")
        for field in columns_of(kind):
            type_name = str(field.type).replace("element: ", "")
            print(f"| `{field.name}` | {type_name} | {field.description.replace('|', '/')} |")
        print()


def run_live(arguments: argparse.Namespace, archiver) -> None:
    import ols

    from ols_archive.sources import LiveSource

    ended: list[int] = []
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda received, _: ended.append(received))
    trust = None
    if arguments.keys:
        trust = ols.Trust(arguments.keys, arguments.name, time.time_ns() >> 1)
    source = LiveSource(arguments.live, archiver, trust)
    print("ols-archive: ready", file=sys.stderr, flush=True)
    source.run(arguments.flush_s, lambda: bool(ended))


def run_logs(arguments: argparse.Namespace, archiver) -> None:
    from ols_archive.sources import archive_log

    for number, path in enumerate(arguments.logs, 1):
        archive_log(path, archiver)
        done = f"{number} of {len(arguments.logs)} logs"
        print(f"ols-archive: {done}, {path}", file=sys.stderr, flush=True)
    archiver.flush()


def run_stream(arguments: argparse.Namespace, archiver) -> None:
    from ols_archive.streams import Position, Server, archive_stream

    given = ("domain", "seed", "credentials", "authority")
    server = Server(arguments.server, **{name: getattr(arguments, name) for name in given})
    position = Position(arguments.archive, arguments.region, server, arguments.stream)
    archive_stream(server, arguments.stream, archiver, position, arguments.again)


def tell(arguments: argparse.Namespace, archiver) -> None:
    tally = archiver.tally.report()
    counts = ", ".join(f"{count} {reason}" for reason, count in tally["counts"].items())
    print(f"ols-archive: {counts or 'nothing'}", file=sys.stderr)
    for reason, cases in tally["named"].items():
        for case in cases:
            print(f"ols-archive: {reason}: {case}", file=sys.stderr)
    if arguments.report:
        partial = arguments.report.with_name(arguments.report.name + ".partial")
        partial.write_text(json.dumps(tally, indent=2) + "\n")
        partial.rename(arguments.report)


def main(words: list[str] | None = None) -> int:
    try:
        return work(words)
    except ModuleNotFoundError as missing:
        print(f"ols-archive: {missing}: install ols[archive]", file=sys.stderr)
        return UNUSABLE


def work(words: list[str] | None) -> int:
    arguments = parse_arguments(words)
    if arguments.schema:
        print_schema()
        return 0
    from ols_archive.archiver import Archiver

    archiver = Archiver(arguments.archive, arguments.region, not arguments.without_signatures)
    try:
        run = run_live if arguments.live else run_stream if arguments.stream else run_logs
        run(arguments, archiver)
    except (OSError, ValueError) as error:
        print(f"ols-archive: {error}", file=sys.stderr)
        return UNUSABLE
    finally:
        tell(arguments, archiver)
    return DAMAGED if archiver.found_damage else 0


if __name__ == "__main__":
    sys.exit(main())
