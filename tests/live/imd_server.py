"""Sends frames by IMD (version 2 or 3), as a simulation does that is followed while it runs.

serve() is all that a generator of frames in Python needs. As a program it sends a chain that it generates.
"""

import argparse
import contextlib
import itertools
import select
import socket
import struct
import subprocess

import numpy as np

DISCONNECT, FCOORDS, GO, HANDSHAKE, TRATE, SESSION, TIME, BOX, VELOCITIES = 0, 2, 3, 4, 8, 10, 12, 13, 14


def packet(kind, number, body=b""):
    return struct.pack(">ii", kind, number) + body


def packed(step, frame, version, order, dt):
    """Returns the bytes of a frame: an array of positions (atoms, 3) in angstrom, or a tuple (positions, velocities, box) of
    which version 2 sends the positions. Velocities are in angstrom/ps; `box` (3, 3) has three vectors. Both may be None."""
    positions, velocities, box = frame if isinstance(frame, tuple) else (frame, None, None)

    def floats(kind, number, values):
        return packet(kind, number, np.asarray(values, order + "f4").tobytes())

    if version == 2:
        return floats(FCOORDS, len(positions), positions)
    parts = [packet(TIME, 1, struct.pack(order + "ddq", dt, step * dt, step))]
    parts += [] if box is None else [floats(BOX, 1, box)]
    parts += [floats(FCOORDS, len(positions), positions)]
    parts += [] if velocities is None else [floats(VELOCITIES, len(velocities), velocities)]
    return b"".join(parts)


def serve(frames, listener, version=2, order="<", dt=0.002):
    """Waits for one client at `listener`, a socket of listen(), and sends it the frames until it leaves. packed() says what a
    frame is; bytes are sent as they are. `order` is the byte order, "<" or ">"; `dt` is in picoseconds. Returns the number of
    frames sent and the client's messages, (type, number)."""
    client, rate, messages, sent = listener.accept()[0], 1, [], 0
    client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
    frames = iter(frames)
    first = next(frames)
    try:
        client.sendall(struct.pack(">i", HANDSHAKE) + struct.pack(order + "i", version))
        if version == 3:
            has = [isinstance(first, tuple) and first[k] is not None for k in (1, 2)]
            client.sendall(packet(SESSION, 7, bytes([1, 0, has[1], 1, 0, has[0], 0])))
        for step, frame in enumerate(itertools.chain([first], frames)):
            while not messages or select.select([client], [], [], 0)[0]:  # the first message is GO
                head = client.recv(8, socket.MSG_WAITALL)
                if len(head) < 8:
                    return sent, messages
                messages.append(struct.unpack(">ii", head))
                kind, number = messages[-1]
                if kind == DISCONNECT:
                    return sent, messages
                rate = max(number, 1) if kind == TRATE else rate
            if isinstance(frame, bytes):
                client.sendall(frame)
            elif step % rate == 0:
                client.sendall(packed(step, frame, version, order, dt))
                sent += 1
        client.shutdown(socket.SHUT_WR)
        while head := client.recv(8, socket.MSG_WAITALL):  # unread messages would turn the end into a reset
            messages += [struct.unpack(">ii", head)] if len(head) == 8 else []
    except ConnectionError:
        pass  # the client left
    finally:
        client.close()
    return sent, messages


def listen(port=0):
    """Returns a socket that waits for a client at a port of the loopback address; 0 takes a free one."""
    return socket.create_server(("127.0.0.1", port))


def free_port():
    with listen() as listener:
        return listener.getsockname()[1]


@contextlib.contextmanager
def running(*command, **options):
    """Runs a program during a block, which gets its process. Kills the program at the end of the block if it still runs."""
    with subprocess.Popen([str(word) for word in command], **options) as process:
        try:
            yield process
        finally:
            process.kill()


def chain(atoms, seed=1):
    """Generates frames of a chain without end: a random walk in steps of 3.8 angstrom, and each bead swings about its place."""
    random = np.random.default_rng(seed)
    steps = random.normal(size=(atoms, 3))
    places = np.cumsum(3.8 * steps / np.linalg.norm(steps, axis=1)[:, None], axis=0)
    swings, phases = random.normal(size=(2, atoms, 3))
    for step in itertools.count():
        angles = 0.05 * step + 6 * phases
        yield places + swings * np.sin(angles), 25 * swings * np.cos(angles), None


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--atoms", type=int, default=100, help="atoms of the chain (default: 100)")
    parser.add_argument("--frames", type=int, default=100, help="number of frames (default: 100)")
    parser.add_argument("--port", type=int, default=0, help="port (default: a free one, which is printed)")
    parser.add_argument("--version", type=int, choices=(2, 3), default=2)
    parser.add_argument("--big-endian", action="store_true")
    given = parser.parse_args()
    listener = listen(given.port)
    print(listener.getsockname()[1], flush=True)
    serve(itertools.islice(chain(given.atoms), given.frames), listener, given.version, ">" if given.big_endian else "<")


if __name__ == "__main__":
    main()
