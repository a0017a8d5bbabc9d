"""Messages from the stream that ols-bridge has its server of NATS keep (docs/bridge.md).

What has been read is remembered beside the archive, so that a run goes on where the last one ended;
what is read twice is archived once, as from logs.
"""

import asyncio
import contextlib
import json
import re
import ssl
from collections.abc import AsyncIterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import ols

from ols_archive.archiver import Archiver
from ols_archive.partitions import replaced

SUBJECT = re.compile(
    r"ols\.v1\.[\w-]+\.(?:[\w-]+\.(?P<station>[\w-]+)\.(?P<kind>bearing|status)|target)"
)
CHANNELS = {"bearing": "OLS_BEARING_", "status": "OLS_STATUS_"}
BATCH = 500  # messages that are asked for at once
WRITE_EVERY = 50_000  # messages
PATIENCE_S = 10.0
# Answers come here: a user needs no right to hear others'.
INBOX = "_INBOX.archive"


async def unsaid(_: Exception) -> None:
    """What is raised is said; each try before it is not."""


def over_tls_alone(client: type) -> type:
    """Of nats.NATS: the library alone leaves it to the server whether the log-in is encrypted."""
    from nats.errors import Error

    class OverTlsAlone(client):
        def _connect_command(self) -> bytes:
            # Where the server demanded it, the library has shaken hands by now.
            if not self._server_info.get("tls_required"):
                raise Error("a server without TLS")
            return super()._connect_command()

    return OverTlsAlone


@dataclass(frozen=True)
class Server:
    """A server of NATS, and who we are there."""

    url: str
    domain: str | None = None
    seed: Path | None = None
    credentials: Path | None = None
    authority: Path | None = None

    def options(self) -> dict[str, Any]:
        """For nats.connect(); OSError if a file cannot be read."""
        options: dict[str, Any] = {"servers": self.url, "name": "ols-archive", "error_cb": unsaid}
        options |= {"inbox_prefix": INBOX, "connect_timeout": PATIENCE_S}
        # A few tries to connect; a connection that is lost is not made again: the next run goes on.
        options |= {"max_reconnect_attempts": 2, "reconnect_time_wait": 0.2}
        options |= {"allow_reconnect": False}
        if self.seed:
            options["nkeys_seed_str"] = self.seed.read_text().strip()
        if self.credentials:
            self.credentials.open().close()
            options["user_credentials"] = str(self.credentials)
        if self.authority:
            options["tls"] = ssl.create_default_context(cafile=self.authority)
        return options

    def client(self) -> Any:
        import nats

        return (over_tls_alone(nats.NATS) if self.url.startswith("tls://") else nats.NATS)()


class Position:
    """How far a stream has been archived. A stream that was made anew begins from its start."""

    def __init__(self, root: Path, region: str, server: Server, stream: str):
        name = ".".join([region, server.domain or "server", stream])
        self._path = root / ".streams" / f"{name}.json"

    def read(self, created: str) -> int:
        """The number of the last message; 0: none."""
        try:
            known = json.loads(self._path.read_text())
            return int(known["sequence"]) if known["created"] == created else 0
        except (OSError, ValueError, KeyError, TypeError):
            return 0  # the worst that comes of it is reading all of it again

    def write(self, created: str, sequence: int) -> None:
        self._path.parent.mkdir(parents=True, exist_ok=True)
        with replaced(self._path) as partial:
            partial.write_text(json.dumps({"created": created, "sequence": sequence}) + "\n")


def channel_of(subject: str) -> str | None:
    """Of the bus, on which the message was."""
    found = SUBJECT.fullmatch(subject)
    if found is None:
        return None
    return CHANNELS[found["kind"]] + found["station"] if found["kind"] else "OLS_TARGET"


def take(message: Any, stream: str, archiver: Archiver) -> None:
    number = message.metadata.sequence.stream
    channel = channel_of(message.subject)
    if channel is None:
        archiver.tally.count("not_archived")
        return
    stored_us = round(message.metadata.timestamp.timestamp() * 1e6)
    payload, signature = ols.split_signature(message.data)
    archiver.take(stored_us, channel, payload, signature, f"{stream}: message {number}")


async def messages(context: Any, stream: str, first: int, last: int) -> AsyncIterator[Any]:
    """Those from `first` to `last` that are still kept, in order."""
    from nats.js import api

    config = api.ConsumerConfig(
        ack_policy=api.AckPolicy.NONE,
        deliver_policy=api.DeliverPolicy.BY_START_SEQUENCE,
        opt_start_seq=first,
        inactive_threshold=60.0,
        mem_storage=True,
    )
    wanted = await context.pull_subscribe("", stream=stream, config=config)
    left = (await wanted.consumer_info()).num_pending
    while left:
        for message in await wanted.fetch(min(BATCH, left), timeout=PATIENCE_S):
            if message.metadata.sequence.stream > last:
                return
            left = message.metadata.num_pending
            yield message


class StreamReader:
    """One run over one stream."""

    def __init__(self, stream: str, archiver: Archiver, position: Position):
        self._stream, self._archiver, self._position = stream, archiver, position
        self._created, self._done, self._written = "", 0, 0

    def _write(self) -> None:
        """The position follows the files, never the reverse."""
        self._archiver.flush()
        if self._done > self._written:
            self._position.write(self._created, self._done)
            self._written = self._done

    def _begin(self, info: Any, again: bool) -> int:
        """The number of the first message to read."""
        self._created = str(info.created)
        self._done = self._written = 0 if again else self._position.read(self._created)
        expired = info.state.first_seq - 1 - self._done
        if self._done and expired > 0:
            what = f"{self._stream}: {expired} messages since the last run are not kept any more"
            self._archiver.tally.count("expired", what, expired)
        return max(self._done + 1, info.state.first_seq)

    async def run(self, context: Any, again: bool) -> None:
        """All that is there now. `again`: also what has been read before."""
        info = await context.stream_info(self._stream)
        first, last = self._begin(info, again), info.state.last_seq
        try:
            async for message in messages(context, self._stream, first, last):
                take(message, self._stream, self._archiver)
                self._done = message.metadata.sequence.stream
                if self._done - self._written >= WRITE_EVERY:
                    self._write()
            self._done = max(self._done, last)
        finally:
            self._write()


def archive_stream(
    server: Server, stream: str, archiver: Archiver, position: Position, again: bool = False
) -> None:
    """OSError, in words for a person, if the server or the stream cannot be read; what came until
    then is in the files."""
    try:
        from nats.errors import Error
        from nkeys import NkeysError
    except ModuleNotFoundError as missing:
        raise OSError(f"{missing}: requirements-archive.txt") from None
    options, connection = server.options(), server.client()

    async def run() -> None:
        try:
            await connection.connect(**options)
        except (OSError, Error, NkeysError) as error:
            raise OSError(f"{server.url}: {error or type(error).__name__}") from None
        try:
            context = connection.jetstream(domain=server.domain, timeout=PATIENCE_S)
            await StreamReader(stream, archiver, position).run(context, again)
        except (Error, TimeoutError) as error:
            raise OSError(f"{server.url}, {stream}: {error or type(error).__name__}") from None
        finally:
            with contextlib.suppress(Error):
                await connection.close()

    asyncio.run(run())
