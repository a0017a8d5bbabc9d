"""Datagrams that must not crash a receiver: fragments of LCM (LC03) with impossible sizes, and
truncated headers. Pure.

The first pair is the one that ends every process that hears with liblcm 1.3.1: it adds a fragment's
offset and length in 32 bits, and copies. No message of this site is a fragment.
"""

import struct
from collections.abc import Iterator

WHOLE, FRAGMENT = 0x4C433032, 0x4C433033  # LC02, LC03
OUTSIDE = 0xFFFFFF00  # with 272 bytes it ends at 16: inside of a message of 100


def fragment(
    sequence: int, size: int, offset: int, number: int, count: int, payload: bytes
) -> bytes:
    """One fragment. The payload of the first one (number 0) begins with the channel's name."""
    return struct.pack(">IIIIHH", FRAGMENT, sequence, size, offset, number, count) + payload


def pair(channel: str, sequence: int) -> list[bytes]:
    """The two datagrams that crashed a site."""
    return [
        fragment(sequence, 100, 0, 0, 3, channel.encode() + b"\0AAAA"),
        fragment(sequence, 100, OUTSIDE, 1, 3, bytes(272)),
    ]


def relatives(channel: str, sequence: int) -> Iterator[list[bytes]]:
    """Near relatives of the pair, a message's datagrams at a time."""
    name = channel.encode() + b"\0"
    for offset in (OUTSIDE, 0xFFFFFFFF, 0x80000000, 0x7FFFFFF0, 65536, 101, 100, 99, 4):
        for length in (0, 1, 272, 1400):
            sequence += 1
            yield [
                fragment(sequence, 100, 0, 0, 3, name + b"AAAA"),
                fragment(sequence, 100, offset, 1, 3, bytes(length)),
            ]
    for size in (0, 1, 0x7FFFFFFF, 0xFFFFFFFF):
        for count in (0, 1, 3, 65535):
            sequence += 1
            yield [
                fragment(sequence, size, 0, 0, count, name + b"AAAA"),
                fragment(sequence, size, OUTSIDE, 1, count, bytes(272)),
                fragment(sequence, size, 4, 65535, count, bytes(8)),  # beyond the count
            ]
    sequence += 1
    yield list(reversed(pair(channel, sequence)))
    for payload in (b"", b"\0", channel.encode(), b"A" * 300 + b"\0", b"\xff\x1b[2J\0"):
        sequence += 1
        yield [
            fragment(sequence, 100, 0, 0, 2, payload),
            fragment(sequence, 100, 50, 1, 2, bytes(50)),
        ]


def malformed(channel: str, sequence: int) -> Iterator[bytes]:
    """Datagrams that are not messages."""
    for magic in (WHOLE, FRAGMENT):
        header = struct.pack(">II", magic, sequence)
        yield from (header[:length] for length in range(8))
        yield header
        yield header + channel.encode()  # without an end
    yield from (struct.pack(">IIIIHH", FRAGMENT, 1, 100, 0, 0, 3)[:n] for n in range(8, 20))
    for name in (b"", b"A" * 300, b"\x1b]0;x\x07", b"\xff\xfe", b"OLS_PTU_\n"):
        yield struct.pack(">II", WHOLE, sequence) + name + b"\0" + bytes(16)
    yield struct.pack(">II", WHOLE, sequence) + channel.encode() + b"\0"  # and nothing in it
    yield b"LC99" + bytes(60)
