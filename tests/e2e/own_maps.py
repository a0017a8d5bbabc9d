"""Maps of one colour everywhere, in each form that the console takes."""

import io
import sqlite3
import struct

from PIL import Image

EDGE_E7 = 850_511_287  # of Web Mercator's latitudes [1e-7 deg]


def tile(colour):
    buffer = io.BytesIO()
    Image.new("RGB", (256, 256), colour).save(buffer, "PNG")
    return buffer.getvalue()


def write_mbtiles(path, name, colour, attribution):
    """At the zoom levels 0 to 2; a browser enlarges them."""
    with sqlite3.connect(path) as database:
        database.execute("CREATE TABLE metadata (name text, value text)")
        database.execute(
            "CREATE TABLE tiles (zoom_level int, tile_column int, tile_row int, tile_data blob)"
        )
        rows = [("name", name), ("minzoom", "0"), ("maxzoom", "2"), ("attribution", attribution)]
        database.executemany("INSERT INTO metadata VALUES (?, ?)", rows)
        for zoom in range(3):
            for column in range(2**zoom):
                for row in range(2**zoom):
                    database.execute(
                        "INSERT INTO tiles VALUES (?, ?, ?, ?)", (zoom, column, row, tile(colour))
                    )


def write_folder(path, colour):
    """One tile, of the whole world."""
    (path / "0/0").mkdir(parents=True)
    (path / "0/0/0.png").write_bytes(tile(colour))


def write_pmtiles(path, colour):
    """One tile, of the whole world, without compression: https://github.com/protomaps/PMTiles."""
    png = tile(colour)
    none, png_type = 1, 2
    length = bytes([len(png) & 0x7F | 0x80, len(png) >> 7])  # of fewer than 2^14 bytes
    directory = bytes([1, 0, 1]) + length + bytes([1])  # entries, id, run, length, offset + 1
    metadata = b"{}"
    lengths = [len(directory), len(metadata), 0, len(png)]
    header = b"PMTiles" + bytes([3])
    offset = 127
    for size in lengths:
        header += struct.pack("<QQ", offset, size)
        offset += size
    header += struct.pack("<QQQ", 1, 1, 1) + bytes([1, none, none, png_type, 0, 0])
    header += struct.pack("<iiii", -1_800_000_000, -EDGE_E7, 1_800_000_000, EDGE_E7)
    header += struct.pack("<Bii", 0, 0, 0)
    path.write_bytes(header + directory + metadata + png)
