# SPDX-License-Identifier: Apache-2.0
"""Reads OpenFOAM's fields, lists and tables, as text or binary. If a file is not readable, the program ends with the file's name
and the reason."""
import pathlib
import re

import numpy

TYPES = {"scalar": ("<f8", 1), "vector": ("<f8", 3), "label": ("<i4", 1)}


def _bytes(path):
    try:
        return pathlib.Path(path).read_bytes()
    except OSError as error:
        raise SystemExit(f"{path}: {error.strerror}") from None


def text(path, coding="utf-8"):
    return _bytes(path).decode(coding)


def _number(word, place):
    try:
        value = float(word)
    except ValueError:
        value = numpy.nan
    if not numpy.isfinite(value):
        raise SystemExit(f"{place} has '{word}' in the place of a finite number")
    return value


def _is_binary(data):
    return re.search(rb"format\s+binary;", data) is not None


def _values(path, data, start, kind, count, binary):
    """Returns the list of values that begins at the first opening bracket after start."""
    dtype, width = TYPES[kind]
    begin = data.find(b"(", start) + 1
    if binary:
        size = numpy.dtype(dtype).itemsize
        values = numpy.frombuffer(data, dtype, min(count * width, (len(data) - begin) // size), begin)
    else:
        end = data.find(b"\n)", begin) if count else begin
        words = data[begin:end if end >= 0 else len(data)].replace(b"(", b" ").replace(b")", b" ").split()
        try:
            values = numpy.array(words, dtype)
        except ValueError as error:
            raise SystemExit(f"{path} has a list with another word than numbers: {error}") from None
    if len(values) != count * width:
        raise SystemExit(f"{path} has {len(values)} numbers in a list of {count} times {width}")
    return values.reshape(count, width) if width > 1 else values


def field(path, n_cells):
    """Returns the values in the cells, (n_cells) or (n_cells, 3)."""
    data = _bytes(path)
    found = re.search(rb"internalField\s+nonuniform\s+List<(\w+)>\s*(\d+)", data)
    if found:
        count = int(found.group(2))
        if count != n_cells:
            raise SystemExit(f"{path} has {count} cells, and the mesh has {n_cells}")
        return _values(path, data, found.end(), found.group(1).decode(), count, _is_binary(data))
    found = re.search(rb"internalField\s+uniform\s+\(?([^;)]*)\)?;", data)
    if not found:
        raise SystemExit(f"{path} has no internalField")
    value = numpy.array(found.group(1).split(), float)
    return numpy.tile(value, (n_cells, 1)) if len(value) > 1 else numpy.full(n_cells, value[0])


def _list(path, kind):
    data = _bytes(path)
    found = re.search(rb"\}.*?\n(\d+)\s*(?=\()", data, re.DOTALL)
    if not found:
        raise SystemExit(f"{path} has no list of {kind}s")
    return _values(path, data, found.end(), kind, int(found.group(1)), _is_binary(data))


def labels(path):
    """Reads a list of labels, such as constant/polyMesh/owner."""
    return _list(path, "label")


def vectors(path):
    """Reads a list of vectors, such as constant/polyMesh/points."""
    return _list(path, "vector")


def points_of_faces(path, start, n):
    """Returns the labels of the points of n faces, each once, from a binary file constant/polyMesh/faces."""
    data = _bytes(path)
    lists, end = [], data.find(b"\n}") + 1
    for _ in range(2):  # where each face begins, and the labels of all faces
        found = re.compile(rb"\n(\d+)\s*(?=\()").search(data, end)
        if not found or not _is_binary(data):
            raise SystemExit(f"{path} has no binary lists of faces")
        lists.append(_values(path, data, found.end(), "label", int(found.group(1)), True))
        end = found.end() + 1 + lists[-1].nbytes
    first, points = lists
    return numpy.unique(points[first[start]:first[start + n]])


def n_cells(mesh):
    """Returns the number of cells, from the note in constant/polyMesh/owner."""
    path = pathlib.Path(mesh) / "owner"
    note = re.search(rb"nCells:\s*(\d+)", _bytes(path))
    if not note:
        raise SystemExit(f"{path} has no note with nCells")
    return int(note.group(1))


def parts(case):
    """Returns the folders that contain the time folders of a case, each with the global ids of its cells."""
    case = pathlib.Path(case)
    folders = sorted(case.glob("processor[0-9]*"))
    if not folders:
        return [(case, numpy.arange(n_cells(case / "constant/polyMesh")))]
    return [(folder, labels(folder / "constant/polyMesh/cellProcAddressing")) for folder in folders]


def global_field(case, time, name):
    """Returns a field of a serial or a decomposed case, in the order of the global ids of the cells."""
    pieces = []
    for folder, ids in parts(case):
        path = folder / time / name
        values = field(path, len(ids))
        odd = numpy.flatnonzero(~numpy.isfinite(values.reshape(len(ids), -1)).all(axis=1))
        if len(odd):
            raise SystemExit(f"{path} has values that are not finite, first in cell {odd[0]}")
        pieces.append((ids, values))
    all_ids = numpy.concatenate([ids for ids, _ in pieces])
    if (numpy.sort(all_ids) != numpy.arange(len(all_ids))).any():
        raise SystemExit(f"{case}: its ranks do not have each of {len(all_ids)} cells once")
    values = numpy.empty((len(all_ids),) + pieces[0][1].shape[1:])
    for ids, piece in pieces:
        values[ids] = piece
    return values


def times(case):
    """Returns the names of the written times, ascending, without the start time."""
    folder = parts(case)[0][0]
    names = [path.name for path in folder.iterdir() if re.fullmatch(r"[0-9.e-]+", path.name) and float(path.name) > 0]
    if not names:
        raise SystemExit(f"{folder} has no written time")
    return sorted(names, key=float)


def columns(case, pattern, n):
    """Returns the first n columns of all tables of a function object, in the order of the starts.

    The first column is the time. If a run was cut off, the next table begins before the end of its table. In the overlap, the
    later table counts.
    """
    rows = []
    for path in sorted(pathlib.Path(case).glob(pattern), key=lambda path: float(path.parent.name)):
        rows = [row for row in rows if row[0] <= float(path.parent.name) * (1 + 1e-9)]
        for i, line in enumerate(text(path).splitlines()):
            words = line.split()
            if line.startswith("#"):
                continue
            if len(words) < n:
                raise SystemExit(f"{path}: line {i + 1} has {len(words)} columns, and needs {n}")
            rows.append([_number(word, f"{path}: line {i + 1}") for word in words[:n]])
    if not rows:
        raise SystemExit(f"{case} has no rows in a file {pattern}")
    return numpy.array(rows)


def table(case, name):
    """Returns the table of a function object: times and values."""
    return columns(case, f"postProcessing/{name}/*/surfaceFieldValue.dat", 2)


def steps(case):
    """Reads the log of the solver. Returns for each step: time, opening, cells, seconds of the library and of the whole step.

    The integral of K stands between cells and seconds. In the first step, the seconds of the whole step are NaN.
    """
    path = pathlib.Path(case) / "log.pimpleFoam"
    rows, before = [], numpy.nan
    for block in re.split(r"\nTime = ", text(path))[1:]:
        time = block.split()[0]
        riis = re.search(r"riis \w+: opening (\S+), (\d+) cells marked, integral of K (\S+) kg/s, (\S+) s in the library", block)
        clock = re.search(r"ExecutionTime = (\S+) s", block)
        for found, what in ((riis, "cells marked"), (clock, "ExecutionTime")):
            if not found:
                raise SystemExit(f"{path}: the step of time {time} has no line with {what}")
        numbers = [_number(word, f"{path}: the step of time {time}") for word in (time, *riis.groups(), clock.group(1))]
        rows.append(numbers[:-1] + [numbers[-1] - before])
        before = numbers[-1]
    if not rows:
        raise SystemExit(f"{path} has no time step")
    return numpy.array(rows)


def triangles(path):
    """Reads a .vtk file of triangles. Returns points (n, 3), triangles (m, 3) and vectors at the points (n, 3). The vectors are
    None if the file has none."""
    words = text(path).split()
    for word in ("POINTS", "POLYGONS"):
        if word not in words:
            raise SystemExit(f"{path} has no {word}")
    at, count = words.index("POINTS") + 3, int(words[words.index("POINTS") + 1])
    points = numpy.array(words[at:at + 3 * count], float).reshape(-1, 3)
    at, n = words.index("POLYGONS") + 3, int(words[words.index("POLYGONS") + 1])
    corners = numpy.array(words[at:at + 4 * n], int).reshape(-1, 4)[:, 1:]
    at = words.index("POINT_DATA") if "POINT_DATA" in words else len(words)
    vectors = numpy.array(words[-3 * count:], float).reshape(-1, 3) if at + 3 * count < len(words) else None
    return points, corners, vectors


def cut(points, corners):
    """Returns the segments in which triangles cut the plane x = 0. Each segment has y and z of both ends."""
    segments = []
    for triangle in points[corners]:
        ends = []
        for k in range(3):
            a, b = triangle[k], triangle[(k + 1) % 3]
            if (a[0] > 0) != (b[0] > 0):
                t = a[0] / (a[0] - b[0])
                ends.append((a + t * (b - a))[1:])
        if len(ends) == 2:
            segments.append(ends)
    return segments


def area(points, corners):
    a, b, c = (points[corners[:, k]] for k in range(3))
    return numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2
