"""One run of `ao bake` as a child process: started, asked how far it is, cancelled. Knows nothing of Blender's interface."""

import array
import math
import os
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading

# Debian's Blender comes without numpy.


class BakeError(Exception):
    """Its text is one line for the user."""


def find_program(configured):
    """The path of the program: as configured, else from the environment (AO_PROGRAM), else from PATH."""
    wanted = configured or os.environ.get("AO_PROGRAM") or "ao"
    found = shutil.which(os.path.expanduser(wanted))
    if found is None:
        raise BakeError(f"the program {wanted} was not found; set its path in the add-on's preferences")
    return found


def little_endian(values):
    if sys.byteorder == "big":
        values = values[:]
        values.byteswap()
    return values.tobytes()


def write_ply(path, positions, triangles):
    """positions: array of floats, 3 per vertex; triangles: array of 32-bit indices, 3 each. Vertices keep their order."""
    vertices, faces = len(positions) // 3, len(triangles) // 3
    corners = little_endian(triangles)
    with open(path, "wb") as file:
        file.write(
            f"ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\n"
            "property float x\nproperty float y\nproperty float z\n"
            f"element face {faces}\nproperty list uchar int vertex_indices\nend_header\n".encode()
        )
        file.write(little_endian(positions))
        file.write(b"".join(b"\x03" + corners[12 * i : 12 * i + 12] for i in range(faces)))


def read_npy(path):
    """One-dimensional, 32-bit floats, little-endian: what `ao bake` writes."""
    with open(path, "rb") as file:
        content = file.read()
    if content[:6] != b"\x93NUMPY":
        raise ValueError("no npy file")
    wide = content[6] > 1
    start = 12 if wide else 10
    (size,) = struct.unpack_from("<I" if wide else "<H", content, 8)
    if b"'<f4'" not in content[start : start + size]:
        raise ValueError("not of 32-bit floats")
    values = array.array("f")
    values.frombytes(content[start + size :])
    if sys.byteorder == "big":
        values.byteswap()
    return values


class Bake:
    """options: further arguments of `ao bake`, as a list of strings."""

    def __init__(self, program, positions, triangles, options):
        self._folder = tempfile.TemporaryDirectory(prefix="ao_bake_")
        model = os.path.join(self._folder.name, "mesh.ply")
        self._values = os.path.join(self._folder.name, "values.npy")
        self._count = len(positions) // 3
        self._lines = []
        self._share = 0.0
        write_ply(model, positions, triangles)
        try:
            self._process = subprocess.Popen(
                [program, "bake", model, "--out", self._values, "--progress", *options],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                text=True,
            )
        except OSError as wrong:
            self._folder.cleanup()
            raise BakeError(f"{program} does not start: {wrong.strerror}") from wrong
        # A pipe that nobody reads would stop the program.
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self):
        for line in self._process.stderr:
            said = re.search(r"(\d+(?:\.\d+)?) ?%", line)
            if said:
                self._share = min(float(said.group(1)) / 100, 1.0)
            elif line.strip():
                self._lines.append(line.strip())

    @property
    def share(self):
        """Of the work that is done, 0 to 1."""
        return self._share

    def running(self):
        return self._process.poll() is None

    def cancel(self):
        if self.running():
            self._process.send_signal(signal.SIGINT if os.name == "posix" else signal.SIGTERM)
            try:
                self._process.wait(timeout=5)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
        self._reader.join()
        self._folder.cleanup()

    def values(self):
        """Waits for the end: one float per vertex, in the order of `positions`."""
        self._process.wait()
        self._reader.join()
        try:
            if self._process.returncode != 0:
                said = self._lines[-1] if self._lines else f"ao ended with status {self._process.returncode}"
                raise BakeError(said)
            values = read_npy(self._values)
            if len(values) != self._count or not all(map(math.isfinite, values)):
                raise BakeError(f"ao gave {len(values)} values for {self._count} vertices")
            return values
        except (OSError, ValueError) as wrong:
            raise BakeError(f"the values of ao cannot be read: {wrong}") from wrong
        finally:
            self._folder.cleanup()
