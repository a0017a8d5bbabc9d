"""Opens the console's socket on this host, then becomes the command that is given.

The demo runs in a network of its own. A socket belongs to the network in which it was opened, and
is inherited: the console in there serves browsers out here, and nothing else gets through.

    python -m ols_demo.doorway COMMAND [ARGUMENT...]
"""

import os
import socket
import sys

VARIABLE = "OLS_CONSOLE_SOCKET"  # the number of the open socket, for the command
PORT = 8080


def open_doorway() -> socket.socket:
    """At the usual port, or at a free one."""
    for port in (PORT, 0):
        door = socket.socket()
        door.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            door.bind(("127.0.0.1", port))
        except OSError:
            door.close()
            continue
        door.listen()
        return door
    raise OSError("no port of 127.0.0.1 is free")


def main() -> None:
    door = open_doorway()
    door.set_inheritable(True)
    os.environ[VARIABLE] = str(door.fileno())
    os.execvp(sys.argv[1], sys.argv[1:])


if __name__ == "__main__":
    main()
