# SPDX-License-Identifier: Apache-2.0
"""Reads OpenFOAM's fields, lists and tables, as text or binary."""
import pathlib
import re

import numpy

TYPES = {"scalar": ("<f8", 1), "vector": ("<f8", 3), "label": ("<i4", 1)}


def _values(data, start, kind, count, binary):
    dtype, width = TYPES[kind]
    begin = data.index(b"(", start) + 1
    if binary:
        values = numpy.frombuffer(data, dtype, count * width, begin)
    else:
        end = data.index(b"\n)", begin) if count else begin
        text = data[begin:end].replace(b"(", b" ").replace(b")", b" ")
        values = numpy.array(text.split(), dtype)
    return values.reshape(count, width) if width > 1 else values.reshape(count)


def field(path, n_cells):
    """The values in the cells: (n_cells) or (n_cells, 3)."""
    data = pathlib.Path(path).read_bytes()
    binary = re.search(rb"format\s+binary;", data) is not None
    found = re.search(rb"internalField\s+nonuniform\s+List<(\w+)>\s*(\d+)", data)
    if found:
        count = int(found.group(2))
        if count != n_cells:
            raise SystemExit(f"{path} has {count} cells, and the mesh has {n_cells}")
        return _values(data, found.end(), found.group(1).decode(), count, binary)
    found = re.search(rb"internalField\s+uniform\s+\(?([^;)]*)\)?;", data)
    if not found:
        raise SystemExit(f"{path} has no internalField")
    value = numpy.array(found.group(1).split(), float)
    return numpy.tile(value, (n_cells, 1)) if len(value) > 1 else numpy.full(n_cells, value[0])


def labels(path):
    """A list of labels, such as constant/polyMesh/owner."""
    data = pathlib.Path(path).read_bytes()
    binary = re.search(rb"format\s+binary;", data) is not None
    found = re.search(rb"\n(\d+)\s*\(", data[data.index(b"}"):])
    return _values(data, data.index(b"}") + found.start(1), "label", int(found.group(1)), binary)


def n_cells(mesh):
    """The number of cells, from the note in constant/polyMesh/owner."""
    note = re.search(rb"nCells:\s*(\d+)", (pathlib.Path(mesh) / "owner").read_bytes())
    return int(note.group(1))


def parts(case):
    """The folders with the time folders of a case, and the global ids of their cells."""
    case = pathlib.Path(case)
    folders = sorted(case.glob("processor[0-9]*"))
    if not folders:
        return [(case, numpy.arange(n_cells(case / "constant/polyMesh")))]
    return [(folder, labels(folder / "constant/polyMesh/cellProcAddressing")) for folder in folders]


def global_field(case, time, name):
    """A field of a serial or a decomposed case, by the global ids of the cells."""
    pieces = [(ids, field(folder / time / name, len(ids))) for folder, ids in parts(case)]
    total = sum(len(ids) for ids, _ in pieces)
    values = numpy.full((total,) + pieces[0][1].shape[1:], numpy.nan)
    for ids, piece in pieces:
        values[ids] = piece
    return values


def times(case):
    """The names of the written times, ascending, without that of the start."""
    names = [path.name for path in parts(case)[0][0].iterdir() if re.fullmatch(r"[0-9.e-]+", path.name)]
    return sorted((name for name in names if float(name) > 0), key=float)


def table(case, name):
    """A table of a function object: times and values."""
    rows = []
    for path in sorted(pathlib.Path(case).glob(f"postProcessing/{name}/*/surfaceFieldValue.dat")):
        rows += [line.split()[:2] for line in path.read_text().splitlines() if not line.startswith("#")]
    return numpy.array(rows, float)


def steps(case):
    """What the solver's log says of each step: time, opening, cells, seconds of the library and of the whole step."""
    text = (pathlib.Path(case) / "log.pimpleFoam").read_text()
    rows, before = [], None
    for block in re.split(r"\nTime = ", text)[1:]:
        time = float(block.split()[0])
        riis = re.search(r"riis \w+: opening (\S+), (\d+) cells marked, integral of K (\S+) kg/s, (\S+) s in the library", block)
        clock = float(re.search(r"ExecutionTime = (\S+) s", block).group(1))
        row = [time] + ([float(word) for word in riis.groups()] if riis else [numpy.nan] * 4)
        rows.append(row + [clock - before if before is not None else numpy.nan])
        before = clock
    return numpy.array(rows)


def triangles(path):
    """The points (n, 3), triangles (m, 3) and vectors at the points (n, 3) of a .vtk of triangles; no vectors are None."""
    words = pathlib.Path(path).read_text().split()
    at, count = words.index("POINTS") + 3, int(words[words.index("POINTS") + 1])
    points = numpy.array(words[at:at + 3 * count], float).reshape(-1, 3)
    at, n = words.index("POLYGONS") + 3, int(words[words.index("POLYGONS") + 1])
    corners = numpy.array(words[at:at + 4 * n], int).reshape(-1, 4)[:, 1:]
    at = words.index("POINT_DATA") if "POINT_DATA" in words else len(words)
    vectors = numpy.array(words[-3 * count:], float).reshape(-1, 3) if at + 3 * count < len(words) else None
    return points, corners, vectors


def area(points, corners):
    a, b, c = (points[corners[:, k]] for k in range(3))
    return numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2
