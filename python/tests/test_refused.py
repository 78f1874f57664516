# SPDX-License-Identifier: Apache-2.0
"""Bad input is refused with an exception. The class of the exception tells the kind of fault, and its text names the argument."""

import inspect
import math
import re
import types

import numpy
import pytest

import riis

Argument = riis.InvalidArgumentError
Parameter = riis.InvalidParameterError
Missing = riis.MissingAttributeError


class Objects:
    """Valid arguments."""

    def __init__(self):
        self.valve = riis.Valve("mitral", opening=0.3)
        self.surface = riis.Surface(self.valve, half_thickness=0.15)
        self.sampled = riis.Surface(self.valve, measure="sampling", measure_tolerance=0.5)
        self.thin = riis.Surface(self.valve, half_thickness=0.005)
        self.xyz = numpy.random.default_rng(1).uniform(-1.0, 1.0, (60, 3))
        self.mesh = riis.Mesh(self.xyz)
        self.marks = riis.mark(self.surface, self.mesh)
        self.n = len(self.xyz)
        self.reals = numpy.zeros(self.n)
        self.vectors = numpy.zeros((self.n, 3))
        self.triangle = numpy.eye(3)
        self.faces = numpy.array([[0, 1, 2]])
        self.tetrahedron = numpy.array([[0, 1, 2, 3]])


@pytest.fixture(scope="module")
def o():
    return Objects()


def corners():
    return numpy.array([[x, y, z] for x in (-1.0, 1.0) for y in (-1.0, 1.0) for z in (-1.0, 1.0)])


def read_only(array):
    array = array.copy()
    array.flags.writeable = False
    return array


def unaligned(n):
    return numpy.frombuffer(bytearray(8 * n + 1), numpy.uint8)[1:].view(numpy.float64)


def with_nan(array):
    array = array.copy()
    array[7, 1] = math.nan
    return array


# For each case: a name, the class, the text, and the call.
REFUSED = {
    # Refused arrays of points
    "list": (TypeError, "xyz: must be a numpy array of float64, not list", lambda o: riis.Mesh([[0.0, 0.0, 0.0]])),
    "None": (TypeError, "xyz: must be a numpy array of float64, not NoneType", lambda o: riis.Mesh(None)),
    "float32": (TypeError, "xyz: its dtype is float32; it must be float64", lambda o: riis.Mesh(o.xyz.astype("f4"))),
    "float16": (TypeError, "xyz: .*float16", lambda o: riis.Mesh(o.xyz.astype("f2"))),
    "integers": (TypeError, "xyz: its dtype is int64; it must be float64", lambda o: riis.Mesh(o.xyz.astype(int))),
    "complex": (TypeError, "xyz: its dtype is complex128", lambda o: riis.Mesh(o.xyz.astype(complex))),
    "big-endian": (TypeError, "xyz: its dtype is >f8", lambda o: riis.Mesh(o.xyz.astype(">f8"))),
    "objects": (TypeError, "xyz: its dtype is object", lambda o: riis.Mesh(o.xyz.astype(object))),
    "dates": (TypeError, r"xyz: .*datetime64", lambda o: riis.Mesh(numpy.zeros((3, 3), "M8[s]"))),
    "records": (TypeError, "xyz: its dtype is", lambda o: riis.Mesh(numpy.zeros(3, [("x", "f8"), ("y", "f8")]))),
    "one dimension": (Argument, r"xyz: its shape is \(9,\); it must be \(n, 3\)", lambda o: riis.Mesh(numpy.zeros(9))),
    "no dimension": (Argument, r"xyz: its shape is \(\)", lambda o: riis.Mesh(numpy.zeros(()))),
    "(3, n)": (Argument, r"xyz: its shape is \(3, 60\); it must be \(n, 3\)", lambda o: riis.Mesh(o.xyz.T.copy())),
    "backwards": (Argument, "xyz: its points are -24 bytes apart", lambda o: riis.Mesh(o.xyz[::-1])),
    "repeated": (Argument, "xyz: its points are 0 bytes apart", lambda o: riis.Mesh(numpy.broadcast_to(o.xyz[0], (9, 3)))),
    "unaligned": (Argument, "xyz: its entries are not aligned", lambda o: riis.Mesh(unaligned(9).reshape(3, 3))),
    "NaN": (riis.InvalidMeshError, "7.*nan", lambda o: riis.Mesh(with_nan(o.xyz))),
    "infinite": (riis.InvalidMeshError, "0.*inf", lambda o: riis.Mesh(numpy.full((2, 3), numpy.inf))),
    "strides differ": (Argument, "z: its stride is 1 doubles, that of x is 3",
                       lambda o: riis.Mesh(o.xyz[:, 0], o.xyz[:, 1], o.reals)),
    "lengths differ": (Argument, r"y: its shape is \(5,\); it must be \(60,\)",
                       lambda o: riis.Mesh(o.reals, o.reals[:5], o.reals)),
    "z missing": (TypeError, "z: must be a numpy array", lambda o: riis.Mesh(o.reals, o.reals)),
    "update NaN": (riis.InvalidMeshError, "7.*nan", lambda o: riis.Mesh(o.xyz).update(with_nan(o.xyz))),
    # Valves
    "kind": (riis.InvalidParameterError, "'pulmonary' is not a kind of valve; there are: .* A mechanical valve is 'bileaflet'",
             lambda o: riis.Valve("pulmonary")),
    "type of kind": (TypeError, "kind: must be a str, not int", lambda o: riis.Valve(3)),
    "null in kind": (Argument, "kind: contains a null", lambda o: riis.Valve("mit\0ral")),
    "name": (riis.InvalidParameterError, "'height'", lambda o: riis.Valve("mitral", height=1.0)),
    "name that is cut within a letter": (riis.InvalidParameterError, "^'aé+\ufffd' is not a parameter",
                                         lambda o: riis.Valve("mitral", **{"a" + 60 * "é": 1.0})),
    "type of name": (TypeError, "name: must be a str, not int", lambda o: o.valve[3]),
    "unknown name": (riis.UnknownParameterError, "'height'", lambda o: o.valve["height"]),
    "value": (riis.InvalidParameterError, "opening.*2", lambda o: riis.Valve("mitral", opening=2.0)),
    "NaN value": (riis.InvalidParameterError, "opening.*nan", lambda o: riis.Valve("mitral", opening=math.nan)),
    "type of value": (TypeError, "opening: must be a number, not str", lambda o: riis.Valve("mitral", opening="0.3")),
    "bool value": (TypeError, "opening: must be a number, not bool", lambda o: riis.Valve("mitral", opening=True)),
    "one of three": (riis.InvalidParameterError, "translation", lambda o: riis.Valve("mitral", translation=1.0)),
    "three of one": (riis.InvalidParameterError, "opening", lambda o: riis.Valve("mitral", opening=(0, 0, 0))),
    "two values": (Argument, "translation: has 2 entries", lambda o: riis.Valve("mitral", translation=(1, 2))),
    "all cusps": (riis.UnknownParameterError, "leaflet_angle", lambda o: riis.Valve("aortic")["leaflet_angle"]),
    "clash": (riis.InvalidParameterError, "bending_height is 0.71",
              lambda o: riis.Surface(riis.Valve("aortic", leaflet_height=0.1))),
    "open state of a list": (TypeError, "open: must be a riis.Valve, not list", lambda o: o.valve.set_open_state([])),
    "open state of None": (TypeError, "open: must be a riis.Valve, not NoneType", lambda o: o.valve.set_open_state(None)),
    "open state": (riis.InvalidParameterError, "the open state is of the kind aortic",
                   lambda o: o.valve.copy().set_open_state(riis.Valve("aortic"))),
    "degree": (Argument, "degree: entry 0 is 4",
               lambda o: riis.Valve.from_patches(numpy.array([4], "i4"), o.vectors, numpy.zeros((1, 4), "i4"))),
    "control": (Argument, r"control: its shape is \(60, 3\); it must be \(2, 3\)",
                lambda o: riis.Valve.from_patches(numpy.array([1], "i4"), o.vectors, numpy.zeros((1, 4), "i4"))),
    "curve_id": (TypeError, "curve_id: its dtype is int64; it must be int32",
                 lambda o: riis.Valve.from_patches(numpy.array([1], "i4"), o.vectors[:2], numpy.zeros((1, 4), "i8"))),
    # Surfaces
    "valve": (TypeError, "valve: must be a riis.Valve, not str", lambda o: riis.Surface("mitral")),
    "no valve": (TypeError, "valve: must be a riis.Valve, not NoneType", lambda o: riis.Surface(None)),
    "no argument": (TypeError, "valve", lambda o: riis.Surface()),
    "option": (TypeError, "'thickness' is not an option; the options are half_thickness",
               lambda o: riis.Surface(o.valve, thickness=1.0)),
    "half_thickness": (Argument, "half_thickness", lambda o: riis.Surface(o.valve, half_thickness=-2.0)),
    "type of half_thickness": (TypeError, "half_thickness: must be a number",
                               lambda o: riis.Surface(o.valve, half_thickness=[1])),
    "word of half_thickness": (Argument, "half_thickness: is 'thin'", lambda o: riis.Surface(o.valve, half_thickness="thin")),
    "tolerance": (Argument, "tolerance", lambda o: riis.Surface(o.valve, tolerance=2.0)),
    "NaN scale": (Argument, "scale", lambda o: riis.Surface(o.valve, scale=math.nan)),
    "rotation_axis": (Argument, "rotation_axis: has 2 entries", lambda o: riis.Surface(o.valve, rotation_axis=(0, 1))),
    "text in translation": (TypeError, "translation: must be a number, not str",
                            lambda o: riis.Surface(o.valve, translation=("0", "0", "0"))),
    "translation": (TypeError, "translation: must be three numbers, not float", lambda o: riis.Surface(o.valve, translation=1.0)),
    "offset": (Argument, "offset is 1", lambda o: riis.Surface(o.valve, offset=1)),
    "flip_normals": (TypeError, "flip_normals: must be True or False, not int", lambda o: riis.Surface(o.valve, flip_normals=1)),
    "measure": (Argument, "measure: is 'exact'; it must be one of 'triangles'", lambda o: riis.Surface(o.valve, measure="exact")),
    "triangulation": (Argument, "triangulation: is ''", lambda o: riis.Surface(o.valve, triangulation="")),
    "n_threads": (Argument, "n_threads", lambda o: riis.Surface(o.valve, n_threads=-1)),
    "float n_threads": (TypeError, "n_threads: must be an integer, not float", lambda o: riis.Surface(o.valve, n_threads=1.0)),
    "too many threads": (Argument, "n_threads: is 4294967296", lambda o: riis.Surface(o.valve, n_threads=2**32)),
    "many bits": (Argument, "n_threads: is .* not a 64-bit integer", lambda o: riis.Surface(o.valve, n_threads=2**70)),
    "placement_before": (TypeError, "placement_before: 'tolerance' is not an option; the options are scale",
                         lambda o: riis.Surface(o.valve).update_moving(o.valve, o.valve, 1.0, placement_before={"tolerance": 1})),
    "type of placement_before": (TypeError, "placement_before: must be a dict, not float",
                                 lambda o: riis.Surface(o.valve).update_moving(o.valve, o.valve, 1.0, placement_before=1.0)),
    "valve_before": (TypeError, "valve_before: must be a riis.Valve",
                     lambda o: riis.Surface(o.valve).update_moving(o.valve, o.mesh, 1.0)),
    "dt": (Argument, "dt", lambda o: riis.Surface(o.valve).update_moving(o.valve, o.valve, 0.0)),
    "dp": (Argument, "dp is 0", lambda o: riis.Surface(o.valve).add_direction(o.valve, o.valve, 0.0)),
    "valve_after": (TypeError, "valve_after: must be a riis.Valve",
                    lambda o: riis.Surface(o.valve).add_direction(o.mesh, o.valve, 1.0)),
    "kind of valve_before": (riis.InvalidParameterError, "valve_before is of the kind coapting", lambda o: riis.Surface(
        o.valve).add_direction(o.valve, riis.Valve("coapting"), 1.0)),
    "placement_after": (TypeError, "placement_after: 'tolerance' is not an option; the options are scale",
                        lambda o: riis.Surface(o.valve).add_direction(o.valve, o.valve, 1.0, placement_after={"tolerance": 1})),
    "direction of arrays": (Argument, "surface was made from arrays", lambda o: riis.Surface.from_arrays(
        o.triangle, o.faces).add_direction(o.valve, o.valve, 1.0)),
    "direction_id": (Argument, "direction_id is 0, but the surface has no direction: call Surface.add_direction",
                     lambda o: riis.Surface(o.valve).direction(0)),
    "type of direction_id": (TypeError, "direction_id: must be an integer, not float",
                             lambda o: riis.Surface(o.valve).direction(0.0)),
    "no direction": (Argument, "with 'distance_gradient', but the surface has no direction: call Surface.add_direction",
                     lambda o: riis.mark(o.surface, o.mesh, fields="distance_gradient")),
    "no height": (Missing, "height: the marking did not make it; mark with a surface that has an offset$",
                  lambda o: o.marks.height),
    "no K_gradient": (Missing, "K_gradient: the marking did not make it; mark with R= and fields='distance_gradient'",
                      lambda o: riis.mark(o.surface, riis.Mesh(o.surface.vertices)).K_gradient),
    "faces": (TypeError, "faces: its dtype is float64; it must be int32 or int64",
              lambda o: riis.Surface.from_arrays(o.triangle, o.triangle)),
    "no faces": (TypeError, "faces: must be a numpy array", lambda o: riis.Surface.from_arrays(o.triangle, None)),
    "empty faces": (riis.InvalidSurfaceError, "faces: there are none",
                    lambda o: riis.Surface.from_arrays(o.triangle, o.faces[:0])),
    "pentagons": (Argument, r"faces: its shape is \(1, 5\); it must be \(n, 3\)",
                  lambda o: riis.Surface.from_arrays(o.triangle, numpy.zeros((1, 5), int))),
    "order of faces": (Argument, "faces: its entries must lie in C order",
                       lambda o: riis.Surface.from_arrays(o.triangle, numpy.zeros((3, 2), int).T)),
    "index": (riis.InvalidSurfaceError, "3", lambda o: riis.Surface.from_arrays(o.triangle, o.faces + 1)),
    "zero area": (riis.InvalidSurfaceError, "face 0 .* has zero area",
                  lambda o: riis.Surface.from_arrays(o.triangle, 0 * o.faces)),
    "leaflet_id": (TypeError, "leaflet_id: its dtype is int64; it must be int32",
                   lambda o: riis.Surface.from_arrays(o.triangle, o.faces, leaflet_id=numpy.zeros(1, int))),
    "velocities": (Argument, r"velocities: its shape is \(2, 3\); it must be \(3, 3\)",
                   lambda o: riis.Surface.from_arrays(o.triangle, o.faces, velocities=o.triangle[:2])),
    "NaN vertex": (riis.InvalidSurfaceError, "nan", lambda o: riis.Surface.from_arrays(o.triangle * math.nan, o.faces)),
    "skirt_length": (Argument, "^skirt_length is -1",
                     lambda o: riis.Surface.from_arrays(o.triangle, o.faces, skirt_length=-1.0)),
    "type of attached": (TypeError, "attached: its dtype is int64; it must be bool or uint8",
                         lambda o: riis.Surface.from_arrays(o.triangle, o.faces, attached=numpy.ones(3, int))),
    "shape of attached": (Argument, r"attached: its shape is \(2,\); it must be \(3,\)",
                          lambda o: riis.Surface.from_arrays(o.triangle, o.faces, attached=numpy.ones(2, bool))),
    "nothing attached": (riis.InvalidSurfaceError, "^attached is 0 for all 3 vertices",
                         lambda o: riis.Surface.from_arrays(o.triangle, o.faces, attached=numpy.zeros(3, bool))),
    "skirt_lengths": (Argument, r"skirt_lengths: its shape is \(2,\); it must be \(3,\)",
                      lambda o: riis.Surface.from_arrays(o.triangle, o.faces, skirt_length=0.1, skirt_lengths=numpy.ones(2))),
    "moved vertices of a valve": (Argument, "the surface has no faces to keep",
                                  lambda o: riis.Surface(o.valve).update_from_arrays(o.triangle)),
    "leaflets without faces": (Argument, "leaflet_id: needs faces",
                               lambda o: riis.Surface(o.valve).update_from_arrays(o.triangle, leaflet_id=numpy.zeros(1, "i4"))),
    "keyframes": (TypeError, "keyframes: must be a riis.Keyframes", lambda o: riis.Surface.from_keyframes(o.valve, 0.0)),
    "frames": (Argument, r"vertices: its shape is \(1, 3, 3\); it must be \(2, n, 3\)",
               lambda o: riis.Keyframes(numpy.array([0.0, 1.0]), o.triangle[None], o.faces)),
    "interpolation": (Argument, "interpolation: is 'quintic'",
                      lambda o: riis.Keyframes(numpy.zeros(1), o.triangle[None], o.faces, interpolation="quintic")),
    # Closest points
    "point": (Argument, "point: has 2 entries", lambda o: o.surface.closest_point((0.0, 0.0))),
    "NaN point": (Argument, "nan", lambda o: o.surface.closest_point((0.0, math.nan, 0.0))),
    "points": (Argument, r"points: its shape", lambda o: o.surface.closest_points(o.reals)),
    "output": (Argument, r"distance: its shape is \(3,\); it must be \(60,\)",
               lambda o: o.surface.closest_points(o.xyz, distance=numpy.zeros(3))),
    "read-only output": (Argument, "distance: is read-only",
                         lambda o: o.surface.closest_points(o.xyz, distance=read_only(o.reals))),
    "type of output": (TypeError, "side: its dtype is float64; it must be int32",
                       lambda o: o.surface.closest_points(o.xyz, side=o.reals)),
    "mask of points": (Argument, r"mask: its shape is \(3,\)",
                       lambda o: o.surface.closest_points(o.xyz, mask=numpy.zeros(3, bool))),
    "ids": (Argument, "^ids: entry 1 is 5", lambda o: o.surface.closest_points(o.xyz, ids=numpy.array([5, 5]))),
    "distance_limit of points": (Argument, "distance_limit", lambda o: o.surface.closest_points(o.xyz, distance_limit=math.nan)),
    # Adjacency
    "adjacency": (TypeError, "adjacency: must be a riis.Adjacency", lambda o: o.mesh.set_adjacency(3)),
    "columns": (Argument, "offsets: and columns must both be given",
                lambda o: o.mesh.set_adjacency(offsets=numpy.zeros(61, int))),
    "both": (Argument, "adjacency: cannot be combined with",
             lambda o: o.mesh.set_adjacency(riis.Adjacency.from_grid(3, 4, 5), offsets=numpy.zeros(61, int))),
    "offsets": (Argument, r"offsets: its shape is \(3,\); it must be \(61,\)",
                lambda o: o.mesh.set_adjacency(offsets=numpy.zeros(3, int), columns=numpy.zeros(1, int))),
    "end of offsets": (Argument, "offsets: end at 2; columns has 1",
                       lambda o: o.mesh.set_adjacency(offsets=numpy.append(numpy.zeros(60, int), 2),
                                                      columns=numpy.zeros(1, int))),
    "column": (riis.InvalidMeshError, "60",
               lambda o: o.mesh.set_adjacency(offsets=numpy.append(numpy.zeros(60, int), 1), columns=numpy.array([60]))),
    "other size": (riis.Error, "^the number of rows is 8; the mesh has 60 nodes",
                   lambda o: o.mesh.set_adjacency(riis.Adjacency.from_grid(2, 2, 2))),
    "cells": (Argument, "cells: has 3 nodes per cell", lambda o: riis.Adjacency.from_cells(o.faces, 3)),
    "cells in one row": (Argument, r"cells: its shape is \(4,\); without offsets it must be .* grid.cells_dict",
                         lambda o: riis.Adjacency.from_cells(o.tetrahedron[0], 4)),
    "node of a cell": (riis.InvalidMeshError, "3", lambda o: riis.Adjacency.from_cells(o.tetrahedron, 3)),
    "type of cells": (TypeError, "cells: its dtype is float64", lambda o: riis.Adjacency.from_cells(o.vectors, 3)),
    "offsets of cells": (Argument, "offsets: span 5 nodes; cells has 4",
                         lambda o: riis.Adjacency.from_cells(o.tetrahedron[0], 4, offsets=numpy.array([0, 5]))),
    "type of offsets": (TypeError, "offsets: its dtype is int32; it must be int64",
                        lambda o: riis.Adjacency.from_cells(o.tetrahedron[0], 4, offsets=numpy.array([0, 4], "i4"))),
    "neighbor": (TypeError, "neighbor: its dtype is int32; it must be int64",
                 lambda o: riis.Adjacency.from_faces(numpy.array([0]), numpy.array([1], "i4"), 2)),
    "cell of a face": (riis.InvalidMeshError, "neighbor of face 0 is 2",
                       lambda o: riis.Adjacency.from_faces(numpy.array([0]), numpy.array([2]), 2)),
    "grid": (riis.Error, "ni", lambda o: riis.Adjacency.from_grid(0, 1, 1)),
    # Marking
    "surface": (TypeError, "surface: must be a riis.Surface, not Valve", lambda o: riis.mark(o.valve, o.mesh)),
    "mesh": (TypeError, "mesh: must be a riis.Mesh, not ndarray", lambda o: riis.mark(o.surface, o.xyz)),
    "into": (TypeError, "into: must be a riis.Marks, not dict", lambda o: riis.mark(o.surface, o.mesh, into={})),
    "search": (Argument, "search: is 'fast'; it must be one of 'auto'", lambda o: riis.mark(o.surface, o.mesh, search="fast")),
    "instructions": (Argument, "instructions: is 'avx'", lambda o: riis.mark(o.surface, o.mesh, instructions="avx")),
    "field": (Argument, "fields: 'speed' is not a field; the fields are 'point'",
              lambda o: riis.mark(o.surface, o.mesh, fields="speed")),
    "type of fields": (TypeError, "fields: must be a str or a sequence", lambda o: riis.mark(o.surface, o.mesh, fields=3)),
    "type of a field": (TypeError, "fields: must be a str, not int", lambda o: riis.mark(o.surface, o.mesh, fields=[3])),
    "velocity": (Argument, "(?i)velocit", lambda o: riis.mark(o.surface, o.mesh, fields="velocity")),
    "distance_limit": (Argument, "distance_limit", lambda o: riis.mark(o.surface, o.mesh, distance_limit=0.01)),
    "mask": (Argument, r"mask: its shape is \(3,\); it must be \(60,\)",
             lambda o: riis.mark(o.surface, o.mesh, mask=numpy.ones(3, bool))),
    "type of mask": (TypeError, "mask: its dtype is int64; it must be bool or uint8",
                     lambda o: riis.mark(o.surface, o.mesh, mask=numpy.ones(o.n, int))),
    "order of mask": (Argument, "mask: its entries must lie in C order",
                      lambda o: riis.mark(o.surface, o.mesh, mask=numpy.ones(2 * o.n, bool)[::2])),
    "no adjacency": (Argument, "(?i)adjacency", lambda o: riis.mark(o.surface, o.mesh, search="neighbor")),
    "n_threads of a marking": (Argument, "n_threads.*2000", lambda o: riis.mark(o.surface, o.mesh, n_threads=2000)),
    "positional": (TypeError, "mark", lambda o: riis.mark(o.surface, o.mesh, o.marks)),
    "no such field": (Missing, "normal: the marking did not request it; mark with fields='normal'", lambda o: riis.mark(
        o.surface, riis.Mesh(o.surface.vertices)).normal),
    "velocity of several fields": (Argument, "^fields is 'normal, side, velocity', with 'velocity', .*Surface.update_moving, or",
                                   lambda o: riis.mark(o.surface, o.mesh, fields="velocity side normal")),
    "uv of arrays": (Argument, "^fields is 'uv', with 'uv', but the surface is from arrays", lambda o: riis.mark(
        riis.Surface.from_arrays(o.triangle, o.faces), o.mesh, fields="uv")),
    "fields of samples": (Argument, "^fields is 'rim', but .* sampling.* only the fields 'point', 'normal' and 'patch_id'",
                          lambda o: riis.mark(o.sampled, o.mesh, fields="rim")),
    "clusters of samples": (Argument, "^search is 'clusters'", lambda o: riis.mark(o.sampled, o.mesh, search="clusters")),
    "samples of arrays": (Argument, "^measure is 'sampling', .* it must be 'triangles'$",
                          lambda o: riis.Surface.from_arrays(o.triangle, o.faces, measure="sampling")),
    "fixed arrays": (Argument, "^triangulation is 'fixed', .* it must be 'adapted'$",
                     lambda o: riis.Surface.from_arrays(o.triangle, o.faces, triangulation="fixed")),
    "walk without adjacency": (Argument, "^search is 'neighbor', .* see Mesh.set_adjacency$",
                               lambda o: riis.mark(o.surface, o.mesh, search="neighbor")),
    "more ids than points": (Argument, "^the number of ids is 4; it must be from 0 to n_points, 3$",
                             lambda o: o.surface.closest_points(o.triangle, ids=numpy.arange(4))),
    "ids and mask": (Argument, "^ids and mask are both given$", lambda o: o.surface.closest_points(
        o.triangle, ids=numpy.arange(1), mask=numpy.ones(3, bool))),
    "side of samples": (Argument, "^side is given, but", lambda o: o.sampled.closest_points(o.xyz, side=True)),
    "no node to come from": (Argument, "^the number of from_ids is 0", lambda o: riis.find_passage(
        o.surface, chain(o), numpy.zeros(0, int), numpy.zeros(1, int))),
    "node to go to": (Argument, r"^to_ids\[0\] is 99; the mesh has 60 nodes", lambda o: riis.find_passage(
        o.thin, chain(o), numpy.zeros(1, int), numpy.full(1, 99))),
    "marks of another size": (Argument, "^marks are of a mesh with 60 nodes, mesh has 2",
                              lambda o: riis.label_open_regions(two_nodes(), o.marks)),
    "marks of another half thickness": (Argument, "^marks are of a surface with the half thickness 0.15",
                                        lambda o: riis.find_leaks(o.thin, chain(o), o.marks)),
    "a patch that cannot open": (riis.InvalidParameterError, "opening is 0.5, but .* with Valve.set_open_state$",
                                 lambda o: riis.Surface(opened(patches(o)))),
    # Resistance
    "cut without rim": (Argument, "^rim='cut' needs 'rim', but the nodes were marked with fields = None$",
                        lambda o: o.marks.add_resistance(o.reals, R=1.0, rim="cut")),
    "side of a band": (Argument, "^Marks.band_sums needs 'rim', but the nodes were marked with fields = 'side'$",
                       lambda o: riis.mark(o.surface, o.mesh, fields="side").band_sums(o.reals, o.reals, 0.0, 0.1)),
    "K": (Argument, r"K: its shape is \(3,\); it must be \(60,\)",
                    lambda o: o.marks.add_resistance(numpy.zeros(3), R=1.0)),
    "type of K": (TypeError, "K: its dtype is float32",
                            lambda o: o.marks.add_resistance(o.reals.astype("f4"), R=1.0)),
    "read-only": (Argument, "K: is read-only", lambda o: o.marks.add_resistance(read_only(o.reals), R=1.0)),
    "order of K_u_surface": (Argument, "K_u_surface: its entries must lie in C order",
                          lambda o: o.marks.add_resistance(None, numpy.asfortranarray(o.vectors), R=1.0)),
    "K_u_surface": (Argument, "(?i)velocity", lambda o: o.marks.add_resistance(None, o.vectors, R=1.0)),
    "missing R": (TypeError, r"^R: is missing; R is a mass / \(length time\), such as R=1e4 for kg/\(m s\)$",
             lambda o: o.marks.add_resistance(o.reals)),
    "missing R of a reaction": (TypeError, "^R: is missing", lambda o: o.marks.add_reaction(o.vectors, o.reals)),
    "missing R of vertices": (TypeError, "^R: is missing", lambda o: o.marks.add_vertex_reaction(o.surface, o.vectors, o.reals)),
    "missing R of a leak": (TypeError, "^R: is missing", lambda o: o.surface.leak(1.0)),
    "R below 0": (Argument, "^R is -1; it must be from 0", lambda o: o.marks.add_resistance(o.reals, R=-1.0)),
    "R below 0 of a marking": (Argument, "^R is -1; it must be from 0", lambda o: riis.mark(o.surface, o.mesh, R=-1.0)),
    "K_u_surface without velocity": (Argument, "^K_u_surface needs 'velocity', but the nodes were marked with fields = None$",
                                     lambda o: o.marks.add_resistance(None, o.vectors, R=1.0)),
    "half_thickness -1": (Argument, "^half_thickness: is -1; it must be above 0$",
                          lambda o: riis.Surface(o.valve, half_thickness=-1)),
    "half_thickness -1 of R": (Argument, "^half_thickness: is -1; it must be above 0$",
                               lambda o: o.marks.add_resistance(o.reals, R=1.0, half_thickness=-1.0)),
    "measure_tolerance -1": (Argument, "^measure_tolerance: is -1", lambda o: riis.Surface(o.valve, measure_tolerance=-1)),
    "distance_limit -1": (Argument, "^distance_limit: is -1", lambda o: riis.mark(o.surface, o.mesh, distance_limit=-1)),
    "reach -1": (Argument, "^reach: is -1", lambda o: o.surface.coaptation(reach=-1)),
    "axis without direction": (Argument, r"^axis: is \(0, 0, 0\), which gives no direction$",
                               lambda o: riis.Surface(o.valve, axis=(0, 0, 0))),
    "axis of nan": (Argument, "^axis: is .*nan, 1", lambda o: riis.Surface(o.valve, axis=(0, math.nan, 1))),
    "entries of axis": (Argument, "^axis: has 2 entries", lambda o: riis.Surface(o.valve, axis=(0, 1))),
    "axis and rotation": (Argument, "^axis: cannot be combined with rotation_angle$",
                          lambda o: riis.Surface(o.valve, axis=(0, 0, 1), rotation_angle=30)),
    "allow_none": (TypeError, "^allow_none: must be True or False, not int",
                   lambda o: riis.mark(o.surface, o.mesh, allow_none=1)),
    "path of a mesh": (TypeError, "^xyz: must be .*, not str; read a file by pyvista.read, and pass its points.astype",
                       lambda o: riis.Mesh("tube.vtu")),
    "NaN as R": (Argument, "R.*nan", lambda o: o.marks.add_resistance(o.reals, R=math.nan)),
    "rim": (Argument, "rim: is 'square'", lambda o: o.marks.add_resistance(o.reals, R=1.0, rim="square")),
    "half_thickness of a resistance": (Argument, "half_thickness",
                                       lambda o: o.marks.add_resistance(o.reals, R=1.0, half_thickness=9.0)),
    "empty result": (Argument, "marks: is empty", lambda o: riis.Marks().add_resistance(o.reals, R=1.0)),
    "velocity of a reaction": (Argument, "velocity: its shape", lambda o: o.marks.add_reaction(o.reals, o.reals, R=1.0)),
    "weight": (Argument, "weight: its shape", lambda o: o.marks.add_reaction(o.vectors, o.vectors, R=1.0)),
    "force": (Argument, r"force: its shape is \(2,\)",
              lambda o: o.marks.add_reaction(o.vectors, o.reals, numpy.zeros(2), R=1.0)),
    "moment": (Argument, "moment: its shape",
               lambda o: o.marks.add_reaction(o.vectors, o.reals, R=1.0, moment=numpy.zeros(4))),
    "moment without points": (Argument, "moment.*point",
                              lambda o: o.marks.add_reaction(o.vectors, o.reals, R=1.0, moment=numpy.zeros(3))),
    "about": (Argument, "about", lambda o: o.marks.add_reaction(o.vectors, o.reals, R=1.0, about=(1.0, 2.0))),
    "NaN in about": (Argument, r"about\[1\] is nan",
                     lambda o: o.marks.add_reaction(o.vectors, o.reals, R=1.0, about=(1.0, math.nan, 2.0))),
    "too few leaflets": (Argument, "n_leaflets is 1, but the surface has the leaflet id 1",
                         lambda o: o.marks.add_reaction(o.vectors, o.reals, R=1.0, leaflet_force=numpy.zeros((1, 3)))),
    "leaflet_moment": (Argument, "leaflet_moment: its shape",
                       lambda o: o.marks.add_reaction(o.vectors, o.reals, R=1.0, leaflet_force=numpy.zeros((3, 3)),
                                                      leaflet_moment=numpy.zeros((2, 3)))),
    "vertex forces without barycentric": (
        Argument, "^Marks.add_vertex_reaction needs 'barycentric', but the nodes were marked with fields = None$",
        lambda o: o.marks.add_vertex_reaction(o.surface, o.vectors, o.reals, R=1.0)),
    "vertex forces of another surface": (
        Argument, "^the closest triangle of node .* which the surface lacks: mark the nodes again$",
        lambda o: riis.mark(o.surface, o.mesh, fields="barycentric").add_vertex_reaction(
            riis.Surface.from_arrays(o.triangle, o.faces), o.vectors, o.reals, R=1.0)),
    "force of vertices": (Argument, "force: its shape is", lambda o: riis.mark(
        o.surface, o.mesh, fields="barycentric").add_vertex_reaction(o.surface, o.vectors, o.reals, o.vectors, R=1.0)),
    "radius of loads": (Argument, "^radius is 0; it must be from 1e-50 to 1e[+]50$",
                        lambda o: riis.load_sums(o.xyz, 0.0, numpy.zeros((1, 2, 3)), 1)),
    "leaflets of loads": (Argument, "n_leaflets: must be from 1 to 2.31$",
                          lambda o: riis.load_sums(o.xyz, 1.0, numpy.zeros((1, 2, 3)), 0)),
    "weight of tissue": (Argument, "^weight of node 0 is -1; it must be from 0 to 1e[+]60$",
                         lambda o: riis.load_sums(o.triangle, 1.0, numpy.zeros((1, 2, 3)), 1, weight=numpy.full(3, -1.0))),
    "edges of loads": (Argument, "edges: its shape", lambda o: riis.load_sums(o.xyz, 1.0, numpy.zeros((1, 3)), 1)),
    "too little tissue": (Argument, "^tissue has 0 nodes within the radius 1 of .* leaflet 0,.* give a larger radius",
                          lambda o: riis.loads(o.triangle + 9.0, 1.0, numpy.zeros((1, 2, 3)), numpy.ones((1, 3)),
                                               numpy.zeros((1, 3)))),
    "tissue on a line": (Argument, "lie nearly on a line: .* give a larger radius, or more rows of nodes$",
                         lambda o: riis.loads(numpy.outer([0.1, 0.2, 0.3], [1.0, 1.0, 1.0]), 1.0, numpy.zeros((1, 2, 3)),
                                              numpy.ones((1, 3)), numpy.zeros((1, 3)))),
    "sums of loads": (Argument, r"sums: its shape is \(2, 11\)", lambda o: riis.loads(
        o.triangle, 1.0, numpy.zeros((1, 2, 3)), numpy.ones((1, 3)), numpy.zeros((1, 3)), sums=numpy.zeros((2, 11)))),
    "edges": (Argument, "edges: its shape",
              lambda o: o.marks.add_reaction(o.vectors, o.reals, R=1.0, edges=numpy.zeros((4, 3)))),
    "edge_force": (Argument, "edge_force: its shape",
                   lambda o: o.marks.add_reaction(o.vectors, o.reals, R=1.0, edge_force=numpy.zeros((4, 3)))),
    "edge_leaflet_id": (Argument, "edge_leaflet_id: its shape",
                        lambda o: o.marks.add_reaction(o.vectors, o.reals, R=1.0, edges=numpy.zeros((4, 2, 3)),
                                                       edge_leaflet_id=numpy.zeros(3, "int32"))),
    "a leaflet without edge": (Argument, "no edge of leaflet 1", lambda o: with_points(o).add_reaction(
        o.vectors, o.reals, R=1.0, edges=numpy.zeros((1, 2, 3)), edge_force=numpy.zeros((1, 3)),
        edge_leaflet_id=numpy.zeros(1, "int32"))),
    "NaN in edges": (Argument, "y of the second point of edge 1 is nan", lambda o: with_points(o).add_reaction(
        o.vectors, o.reals, R=1.0, edges=numpy.array([[[0.0] * 3] * 2, [[0.0] * 3, [0.0, math.nan, 0.0]]]),
        edge_moment=numpy.zeros((2, 3)))),
    "landmarks in one place": (Argument, "^sources: landmarks 0 and 3 are in one place",
                               lambda o: riis.Warp(corners()[[0, 1, 2, 0, 3]])),
    "landmarks on a line": (Argument, "all 3 landmarks lie on a line", lambda o: riis.Warp(numpy.outer([0., 1, 3], [1., 2, 3]))),
    "too few landmarks": (Argument, "2; it must be from 3 to 1000", lambda o: riis.Warp(corners()[:2])),
    "NaN in landmarks": (Argument, "z of landmark 0 is nan", lambda o: riis.Warp(corners() * [[1, 1, math.nan]])),
    "shape of landmarks": (Argument, "sources: its shape", lambda o: riis.Warp(numpy.zeros((4, 2)))),
    "noise": (Argument, "^noise is -1", lambda o: riis.Warp(corners(), noise=-1.0)),
    "placement of a warp": (Argument, "scale is 0", lambda o: riis.Warp(corners(), placement={"scale": 0.0})),
    "number of targets": (Argument, "4, but the warp has 8 landmarks", lambda o: riis.Warp(corners()).set_targets(corners()[:4])),
    "a fold": (Parameter, "the warp folds near landmark", lambda o: riis.Warp(corners()).set_targets(-corners())),
    "keys of targets": (Argument, "targets: its shape", lambda o: riis.Warp(corners()).set_targets_at(
        numpy.zeros(1), corners(), 0.0)),
    "landmarks of keys": (Argument, "7, but the warp has 8 landmarks", lambda o: riis.Warp(corners()).set_targets_at(
        numpy.zeros(1), corners()[None, :7].copy(), 0.0)),
    "mapped points": (Argument, "points: its shape", lambda o: riis.Warp(corners()).map(numpy.zeros(3))),
    "open without closed": (Argument, "closed is NULL|closed is None", lambda o: riis.Valve("mitral").set_warp(
        None, riis.Warp(corners()))),
    "warp of a bileaflet valve": (Parameter, "the bileaflet valve cannot be warped", lambda o: riis.Valve(
        "bileaflet").set_warp(riis.Warp(corners()))),
    "type of a warp": (TypeError, "closed: must be a riis.Warp", lambda o: riis.Valve().set_warp(corners())),
    "attachment of arrays": (Missing, "made from arrays",
                             lambda o: riis.Surface.from_arrays(numpy.eye(3), numpy.array([[0, 1, 2]])).attachment),
    "band": (Argument, "(?i)side|rim", lambda o: o.marks.band_sums(o.reals, o.reals, 0.0, 0.1)),
    "far_distance": (Argument, "far_distance", lambda o: o.marks.dense(far_distance=0.01)),
    "dense": (Argument, r"distance: its shape", lambda o: o.marks.dense(distance=numpy.zeros(2))),
    # Leaks and the like
    "leaks of an empty result": (Argument, "marks: is empty", lambda o: riis.find_leaks(o.surface, o.mesh, riis.Marks())),
    "leaks without adjacency": (Argument, "(?i)adjacency", lambda o: riis.find_leaks(o.surface, o.mesh, o.marks)),
    "regions of a mesh": (TypeError, "mesh: must be a riis.Mesh", lambda o: riis.label_open_regions(o.surface, o.marks)),
    "regions of an empty result": (Argument, "marks: is empty", lambda o: riis.label_open_regions(o.mesh, riis.Marks())),
    "from_ids": (TypeError, "from_ids: its dtype is int32; it must be int64",
                 lambda o: riis.find_passage(o.surface, o.mesh, numpy.zeros(1, "i4"), numpy.zeros(1, "i8"))),
    # What a valve means for the flow
    "skirt of a bileaflet valve": (riis.InvalidParameterError, "skirt_length' is not a parameter of the bileaflet valve",
                                   lambda o: riis.Valve("bileaflet", skirt_length=0.1)),
    "skirt to a wall far away": (Argument, "^wall is not within longest, 1e-09",
                                 lambda o: riis.Valve().skirt_to_wall(o.surface, 1e-9)),
    "wall of a skirt": (TypeError, "wall: must be a riis.Surface", lambda o: riis.Valve().skirt_to_wall(None, 1.0)),
    "longest skirt": (Argument, "^longest is 0", lambda o: riis.Valve().skirt_to_wall(o.surface, 0.0)),
    "gap of arrays": (Argument, "made from arrays",
                      lambda o: riis.Surface.from_arrays(o.triangle, o.faces).gap(o.surface)),
    "leaflet of a coaptation": (Argument, "^leaflet_id is 9", lambda o: o.surface.coaptation(9)),
    "reach of a coaptation": (Argument, "^reach is 0", lambda o: o.surface.coaptation(reach=0.0)),
    "rim of an orifice": (Argument, "rim: is 'square'", lambda o: o.surface.orifice(rim="square")),
    "half_thickness of an orifice": (Argument, "^half_thickness is 0", lambda o: o.surface.orifice(half_thickness=0.0)),
    "R of a leak": (Argument, "R is 0; it must be from 1e-60 to 1e\\+60", lambda o: o.surface.leak(1.0, R=0.0)),
    "drop": (Argument, "^drop is nan", lambda o: o.surface.leak(math.nan, R=1.0)),
    "opening of a sweep": (Argument, "^opening_to is 2", lambda o: riis.Valve().swept_volume(0.0, 2.0)),
    "leaflet of a sweep": (Argument, "^leaflet_id is 9, .*; None stands for all$",
                           lambda o: riis.Valve().swept_volume(0.0, 1.0, leaflet_id=9)),
    "type of a leaflet": (TypeError, "leaflet_id: must be an integer",
                          lambda o: riis.Valve().swept_volume(0.0, 1.0, leaflet_id="right")),
    "scale of a sweep": (Argument, "^scale is 0", lambda o: riis.Valve().swept_volume(0.0, 1.0, scale=0.0)),
    "cells without adjacency": (Argument, "^mesh has no adjacency, .* see Mesh.set_adjacency$",
                                lambda o: riis.mark(o.surface, two_nodes()).cells_across(riis.Mesh(o.triangle[:2]))),
    "cells of empty marks": (Argument, "^marks are empty: first call riis.mark", lambda o: riis.Marks().cells_across(chain(o))),
    "mesh of cells": (TypeError, "mesh: must be a riis.Mesh", lambda o: o.marks.cells_across(o.surface)),
    "area out of reach": (Argument, "^area 1 is 9, which is out of reach: from opening 0 to 1", lambda o: riis.find_by_area(
        riis.Valve("bileaflet"), numpy.array([1.0, 9.0]), n_samples=3)),
    "area": (Argument, "^area 0 is nan; it must be from 0", lambda o: riis.find_by_area(riis.Valve(), numpy.array([math.nan]))),
    "shape of areas": (Argument, "areas: its shape", lambda o: riis.find_by_area(riis.Valve(), numpy.ones((2, 2)))),
    "area_tolerance": (Argument, "^area_tolerance: is 0", lambda o: riis.find_by_area(
        riis.Valve(), numpy.ones(1), area_tolerance=0.0)),
    "n_samples of areas": (Argument, "^n_samples is 1; it must be from 2", lambda o: riis.find_by_area(
        riis.Valve(), numpy.ones(1), n_samples=1)),
    "range of areas": (Argument, "^from_ is 2; it must be from 0 to 1", lambda o: riis.find_by_area(
        riis.Valve(), numpy.ones(1), from_=2.0)),
    "scale of areas": (Argument, "^scale is 0", lambda o: riis.find_by_area(riis.Valve(), numpy.ones(1), scale=0.0)),
    "name of a size": (Parameter, "'radus' is not a parameter of the bileaflet valve; did you mean 'radius'", lambda o:
                       riis.find_by_area(riis.Valve("bileaflet"), numpy.ones(1), name="radus")),
    "first passage without adjacency": (Argument, "^at the opening 0: mesh has no adjacency", lambda o: riis.find_first_passage(
        riis.Valve(), o.mesh, numpy.zeros(1, int), numpy.ones(1, int))),
    "opening_tolerance": (Argument, "^opening_tolerance: is 0", lambda o: riis.find_first_passage(
        riis.Valve(), o.mesh, numpy.zeros(1, int), numpy.ones(1, int), opening_tolerance=0.0)),
    "option of a first passage": (TypeError, "'thickness' is not an option", lambda o: riis.find_first_passage(
        riis.Valve(), o.mesh, numpy.zeros(1, int), numpy.ones(1, int), thickness=1.0)),
    "depth": (Argument, "depth", lambda o: riis.find_crossings(o.surface, depth=2.0)),
    "set_log": (TypeError, "function: must be callable or None, not str", lambda o: riis.set_log("print")),
    "status": (TypeError, "status: must be an integer", lambda o: riis.status_name("RIIS_OK")),
    # Laws
    "keys": (Argument, "(?i)time", lambda o: riis.OpeningTable(numpy.array([1.0, 0.0]), numpy.zeros(2))(0.0)),
    "lengths of keys": (Argument, r"opening: its shape", lambda o: riis.OpeningTable(numpy.array([0.0]), numpy.zeros(2))(0.0)),
    "type of keys": (TypeError, "time: must be a numpy array", lambda o: riis.OpeningTable([0.0], [0.0])(0.0)),
    "times": (Argument, "opening_duration", lambda o: riis.OpeningTimes(0.0, 0.0, 1.0, 1.0)(0.0)),
    "order of times": (Argument, "^closing_start is 0.2; it must be from 1.4", lambda o: riis.OpeningTimes(0.9, 0.5, 0.2, 0.1)),
    "law of keys": (Argument, "^opening of key 1 is 2; ",
                    lambda o: riis.OpeningTable(numpy.arange(2.0), numpy.array([0.0, 2.0]))),
    "law of a switch": (Argument, "^opening_duration is 0; ", lambda o: riis.OpeningSwitch(0.0, 1.0)),
    "law of an angle": (Argument, "^friction is nan; ", lambda o: riis.OpeningAngle(1.0, 1.0, math.nan, 1.0)),
    "time": (TypeError, "time: must be a number, not str", lambda o: riis.OpeningTimes(0.0, 1.0, 2.0, 1.0)("now")),
    "NaN time": (Argument, "time", lambda o: riis.OpeningTimes(0.0, 1.0, 2.0, 1.0)(math.nan)),
    "time goes back": (Argument, "time",
                       lambda o: riis.OpeningSwitch(1.0, 1.0).advance(riis.OpeningSwitchState(), -1.0, 0.0, 0.0)),
    "phase": (Argument, "phase: is 'shut'",
              lambda o: riis.OpeningSwitch(1.0, 1.0).advance(riis.OpeningSwitchState(phase="shut"), 1.0, 0.0, 0.0)),
    "gain": (Argument, "pressure_gain",
             lambda o: riis.OpeningAngle(math.nan, 1.0, 1.0, 1.0).advance(riis.OpeningAngleState(), 1.0, 0.0, 0.0)),
    "long step": (riis.LimitExceededError, "take shorter steps",
                  lambda o: riis.OpeningAngle(5500.0, 2.0, 50.0, 7.0).advance(riis.OpeningAngleState(), 1e9, 1.0, 1.0)),
}


# The control points of four straight lines between the corners of a square.
CONTROL = numpy.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0), (0, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 0)], float)


def patches(o, degree=None, control=CONTROL, curve_id=None, **rest):
    return riis.Valve.from_patches(
        numpy.ones(4, "i4") if degree is None else degree,
        control,
        numpy.array([[0, 1, 2, 3]], "i4") if curve_id is None else curve_id, **rest)


def lines(n):
    """Rows of an adjacency in which the only neighbour of each node is the next node."""
    ends = numpy.cumsum([0, 1, *[2] * (n - 2), 1])
    return ends, numpy.array([j for i in range(n) for j in (i - 1, i + 1) if 0 <= j < n])


def two_nodes():
    mesh = riis.Mesh(numpy.zeros((2, 3)))
    mesh.set_adjacency(riis.Adjacency.from_grid(2, 1, 1))
    return mesh


def opened(valve):
    valve["opening"] = 0.5
    return valve


def chain(o):
    mesh = riis.Mesh(o.xyz)
    mesh.set_adjacency(offsets=lines(o.n)[0], columns=lines(o.n)[1])
    return mesh


def with_points(o):
    return riis.mark(o.surface, o.mesh, fields=["point"])


def with_sides(o):
    return riis.mark(o.surface, o.mesh, fields="side, rim")


# Each array argument that a call reads: its name, a valid value, the call.
READ = [
    ("xyz", lambda o: o.xyz, lambda o, a: riis.Mesh(a)),
    ("xyz", lambda o: o.xyz, lambda o, a: riis.Mesh(o.xyz).update(a)),
    ("x", lambda o: o.reals, lambda o, a: riis.Mesh(a, o.reals, o.reals)),
    ("z", lambda o: o.reals, lambda o, a: riis.Mesh(o.reals, o.reals, a)),
    ("degree", lambda o: numpy.ones(4, "i4"), lambda o, a: patches(o, degree=a)),
    ("control", lambda o: CONTROL, lambda o, a: patches(o, control=a)),
    ("curve_id", lambda o: numpy.array([[0, 1, 2, 3]], "i4"), lambda o, a: patches(o, curve_id=a)),
    ("reversed", lambda o: numpy.zeros((1, 4), "i4"), lambda o, a: patches(o, reversed=a)),
    ("leaflet_id", lambda o: numpy.zeros(1, "i4"), lambda o, a: patches(o, leaflet_id=a)),
    ("vertices", lambda o: o.triangle, lambda o, a: riis.Surface.from_arrays(a, o.faces)),
    ("faces", lambda o: o.faces, lambda o, a: riis.Surface.from_arrays(o.triangle, a)),
    ("leaflet_id", lambda o: numpy.zeros(1, "i4"), lambda o, a: riis.Surface.from_arrays(o.triangle, o.faces, leaflet_id=a)),
    ("velocities", lambda o: o.triangle, lambda o, a: riis.Surface.from_arrays(o.triangle, o.faces, velocities=a)),
    ("vertices", lambda o: o.triangle,
     lambda o, a: riis.Surface.from_arrays(o.triangle, o.faces).update_from_arrays(a)),
    ("time", lambda o: numpy.zeros(1), lambda o, a: riis.Keyframes(a, o.triangle[None], o.faces)),
    ("vertices", lambda o: o.triangle[None], lambda o, a: riis.Keyframes(numpy.zeros(1), a, o.faces)),
    ("points", lambda o: o.xyz, lambda o, a: o.surface.closest_points(a)),
    ("mask", lambda o: numpy.ones(o.n, bool), lambda o, a: o.surface.closest_points(o.xyz, mask=a)),
    ("ids", lambda o: numpy.array([3, 5]), lambda o, a: o.surface.closest_points(o.xyz, ids=a)),
    ("mask", lambda o: numpy.ones(o.n, bool), lambda o, a: riis.mark(o.surface, o.mesh, mask=a)),
    ("offsets", lambda o: lines(o.n)[0], lambda o, a: riis.Mesh(o.xyz).set_adjacency(offsets=a, columns=lines(o.n)[1])),
    ("columns", lambda o: lines(o.n)[1], lambda o, a: riis.Mesh(o.xyz).set_adjacency(offsets=lines(o.n)[0], columns=a)),
    ("cells", lambda o: o.tetrahedron, lambda o, a: riis.Adjacency.from_cells(a, 4)),
    ("offsets", lambda o: numpy.array([0, 4]), lambda o, a: riis.Adjacency.from_cells(o.tetrahedron[0], 4, offsets=a)),
    ("owner", lambda o: numpy.array([0]), lambda o, a: riis.Adjacency.from_faces(a, numpy.array([1]), 2)),
    ("neighbor", lambda o: numpy.array([1]), lambda o, a: riis.Adjacency.from_faces(numpy.array([0]), a, 2)),
    ("velocity", lambda o: o.vectors, lambda o, a: o.marks.add_reaction(a, o.reals, R=1.0)),
    ("weight", lambda o: o.reals, lambda o, a: o.marks.add_reaction(o.vectors, a, R=1.0)),
    ("value", lambda o: o.reals, lambda o, a: with_sides(o).band_sums(a, o.reals, 0.0, 0.1)),
    ("weight", lambda o: o.reals, lambda o, a: with_sides(o).band_sums(o.reals, a, 0.0, 0.1)),
    ("from_ids", lambda o: numpy.array([0]), lambda o, a: riis.find_passage(o.thin, chain(o), a, numpy.array([o.n - 1]))),
    ("to_ids", lambda o: numpy.array([o.n - 1]), lambda o, a: riis.find_passage(o.thin, chain(o), numpy.array([0]), a)),
    ("time", lambda o: numpy.array([0.0, 1.0]), lambda o, a: riis.OpeningTable(a, numpy.zeros(2))(0.5)),
    ("opening", lambda o: numpy.zeros(2), lambda o, a: riis.OpeningTable(numpy.array([0.0, 1.0]), a)(0.5)),
    ("time", lambda o: numpy.zeros(2), lambda o, a: riis.OpeningTimes(0.0, 1.0, 2.0, 1.0)(a)),
    ("points", lambda o: o.surface.vertices, lambda o, a: riis.fit(a, "mitral", free=["opening"], placement=[], n_starts=1)),
    ("weights", lambda o: numpy.ones(o.surface.info.n_vertices),
     lambda o, a: riis.fit(o.surface.vertices, "mitral", free=["opening"], placement=[], n_starts=1, weights=a)),
]
CORNERS_OF_TISSUE = numpy.array([[0.1, 0.2, 0.3], [-0.1, 0.2, 0.1], [0.3, -0.2, 0.0], [0.0, 0.1, -0.3]])
LOADS = {"nodes": CORNERS_OF_TISSUE, "edges": numpy.zeros((1, 2, 3)), "leaflet_force": numpy.ones((1, 3)),
         "leaflet_moment": numpy.zeros((1, 3)), "edge_leaflet_id": numpy.zeros(1, "i4"), "weight": numpy.ones(4)}
READ += [(name, lambda o, name=name: LOADS[name], lambda o, a, name=name: riis.loads(radius=1.0, **LOADS | {name: a}))
         for name in LOADS]
# Each array argument that a call writes.
WRITTEN = [
    ("distance", lambda o: o.reals, lambda o, a: o.surface.closest_points(o.xyz, distance=a)),
    ("mark", lambda o: numpy.zeros(o.n, bool), lambda o, a: o.marks.dense(mark=a)),
    ("K", lambda o: o.reals, lambda o, a: o.marks.add_resistance(a, R=1.0)),
    ("force", lambda o: numpy.zeros(3), lambda o, a: o.marks.add_reaction(o.vectors, o.reals, a, R=1.0)),
    ("leaflet_force", lambda o: numpy.zeros((3, 3)),
     lambda o, a: o.marks.add_reaction(o.vectors, o.reals, R=1.0, leaflet_force=a)),
    ("label", lambda o: numpy.zeros(o.n, int), lambda o, a: riis.label_open_regions(chain(o), o.marks, label=a)),
]


def cases(table):
    return [pytest.param(*case, id=f"{i}-{case[0]}") for i, case in enumerate(table)]


@pytest.mark.parametrize("name, good, call", cases(READ))
def test_a_refused_array_converts_as_the_text_says(o, name, good, call):
    good = good(o)
    call(o, good)
    others = {"f8": numpy.float32, "i4": numpy.float64, "i8": numpy.float64, "b1": numpy.int64}
    for wrong in good.tolist(), good.astype(others[good.dtype.str[1:]]):
        with pytest.raises(TypeError, match=f"^{name}: ") as refusal:
            call(o, wrong)
        hint = re.search(r"; pass (numpy.ascontiguousarray\(.*\))$", str(refusal.value))
        assert hint, str(refusal.value)
        call(o, eval(hint[1], {"numpy": numpy, name: wrong}))


@pytest.mark.parametrize("name, good, call", cases(WRITTEN))
def test_an_array_that_is_written_is_not_converted(o, name, good, call):
    good = good(o)
    call(o, good)
    for wrong in good.tolist(), good.astype(numpy.float32):
        with pytest.raises(TypeError, match=rf"^{name}: .*; the call writes it, so make it by numpy.zeros\(\.\.\., dtype=\w"):
            call(o, wrong)


@pytest.mark.parametrize("name, good, call", cases(READ + WRITTEN))
def test_a_masked_array_is_refused(o, name, good, call):
    good = good(o)
    for mask in numpy.arange(good.size).reshape(good.shape) == 0, False:
        with pytest.raises(TypeError, match=f"^{name}: is a masked array, and its mask would be lost; pass {name}.filled"):
            call(o, numpy.ma.masked_array(good, mask))


class Frame:
    """An object that, like a data frame of pandas, has a method `mask` and can be converted to an array."""

    def __init__(self, array):
        self.array = array

    def __array__(self, dtype=None, copy=None):
        return numpy.array(self.array, dtype)

    def mask(self):
        raise NotImplementedError


def test_what_gives_an_array_converts_as_the_text_says(o):
    text = "xyz: must be a numpy array of float64, not Frame; pass numpy.ascontiguousarray(xyz, dtype=float)"
    with pytest.raises(TypeError, match=f"^{re.escape(text)}$"):
        riis.Mesh(Frame(o.xyz))
    assert len(riis.Mesh(numpy.ascontiguousarray(Frame(o.xyz), dtype=float))) == o.n


def test_three_numbers_and_numbers_with_masks_are_refused(o):
    with pytest.raises(TypeError, match="^translation: is a masked array"):
        riis.Surface(o.valve, translation=numpy.ma.masked_array([0.0, 1.0, 2.0], [True, False, False]))
    for masked in numpy.ma.masked, numpy.ma.masked_array(0.3, True):
        with pytest.raises(TypeError, match="^opening: is a masked array"):
            riis.Valve("mitral", opening=masked)


def test_an_array_without_dimensions_is_a_number(o):
    for number in numpy.array(3.0), numpy.array(3), numpy.float32(3.0), numpy.int64(3):
        valve = riis.Valve("mitral", AP_diameter=number)
        assert valve["AP_diameter"] == 3.0
        valve["ALPM_diameter"] = number
        valve.update(translation=[number, 0, numpy.array(1.0)])
        assert valve["ALPM_diameter"] == 3.0 and valve["translation"].tolist() == [3.0, 0.0, 1.0]
    surface = riis.Surface(o.valve, half_thickness=numpy.array(0.2), n_threads=numpy.array(1))
    assert surface.half_thickness == 0.2
    assert riis.OpeningTimes(numpy.array(0.0), 1.0, 2.0, 1.0)(numpy.array(0.5)) == 0.5
    with pytest.raises(TypeError, match="translation: must be three numbers, not ndarray"):
        riis.Surface(o.valve, translation=numpy.array(1.0))
    with pytest.raises(Argument, match="AP_diameter: has 1 entry; it must have three numbers"):
        riis.Valve("mitral", AP_diameter=numpy.array([3.0]))


# Matches names of C that no message may contain, because Python lacks them.
OF_C = re.compile(r"riis_|RIIS_|\bNULL\b|\b(arrays|cells|csr|faces|frames|law|options|patches|resistance|table|times)\.[a-z]")


@pytest.mark.parametrize("name", REFUSED)
def test_refused(o, name):
    kind, text, call = REFUSED[name]
    with pytest.raises(kind, match=text) as refusal:
        call(o)
    assert str(refusal.value) and not OF_C.search(str(refusal.value)), str(refusal.value)
    if kind is not TypeError and kind is not riis.Error:
        assert type(refusal.value) is kind


def test_a_refusal_changes_nothing(o):
    valve = riis.Valve("mitral")
    with pytest.raises(riis.InvalidParameterError):
        valve["opening"] = 2.0
    assert valve["opening"] == 1.0
    surface = riis.Surface(valve, half_thickness=0.2)
    with pytest.raises(riis.InvalidArgumentError):
        surface.update(valve, half_thickness=-2.0)
    surface.update(valve)
    assert surface.half_thickness == 0.2
    coefficient = numpy.zeros(o.n)
    with pytest.raises(riis.InvalidArgumentError):
        o.marks.add_resistance(coefficient, o.vectors, R=1.0)
    assert not coefficient.any()
    mesh = riis.Mesh(o.xyz)
    with pytest.raises(riis.InvalidMeshError):
        mesh.update(with_nan(o.xyz))
    assert len(riis.mark(o.surface, mesh)) == len(o.marks)


def test_a_coordinate_that_becomes_nan_is_refused(o):
    nodes = o.xyz.copy()
    mesh = riis.Mesh(nodes)
    nodes[7, 1] = math.nan
    with pytest.raises(riis.InvalidMeshError, match="7"):
        riis.mark(o.surface, mesh)


def test_classes_of_errors_are_those_of_statuses():
    statuses = {}
    for error in vars(riis).values():
        if isinstance(error, type) and issubclass(error, riis.Error) and error is not riis.Error:
            assert error.status_name == riis.status_name(error.status)
            assert error.__doc__ and error.__module__ == "riis"
            statuses[error.status] = error
    # Two classes cannot occur: the package always passes the right struct sizes, and only riis_vtk.h has errors of files.
    assert set(statuses) == {1, 3, 4, 5, 6, 7, 9, -1}
    for status, base in {1: ValueError, 3: ValueError, 4: ValueError, 5: ValueError, 7: MemoryError, 9: RuntimeError}.items():
        assert issubclass(statuses[status], base)


def test_missing_instructions_are_unavailable(o):
    with open("/proc/cpuinfo", encoding="utf-8") as info:
        if "avx512vl" in info.read():
            pytest.skip("this processor has all instructions")
    with pytest.raises(riis.UnavailableError, match="instructions"):
        riis.mark(o.surface, o.mesh, instructions="avx512")


@pytest.mark.parametrize("make", [
    lambda points: pytest.importorskip("pyvista").PolyData(points.astype("f4")).cast_to_unstructured_grid(),
    lambda points: pytest.importorskip("pyvista").PolyData(points),
    lambda points: pytest.importorskip("meshio").Mesh(points, []),
    lambda points: types.SimpleNamespace(vertices=points),
    lambda points: types.SimpleNamespace(geometry=types.SimpleNamespace(x=points)),
    lambda points: points.tolist(),
    lambda points: points.astype("f4"),
])
def test_the_advice_for_other_objects_works(make):
    """The message names an expression, and a mesh of this expression has the points."""
    points = numpy.random.default_rng(3).integers(-99, 99, (20, 3)) / 64.0  # exact in single precision
    xyz = make(points)
    with pytest.raises(TypeError, match="^xyz: ") as refused:
        riis.Mesh(xyz)
    advice = re.search(r"; pass (numpy\.ascontiguousarray\(.*\))$", str(refused.value))
    assert advice, refused.value
    mesh = riis.Mesh(eval(advice[1], {"numpy": numpy, "xyz": xyz}))
    assert numpy.array_equal(mesh.xyz, points)


def test_objects_answer_questions_for_their_attributes(o):
    """hasattr and inspect.getmembers expect an AttributeError for an attribute that an object lacks."""
    arrays = riis.Surface.from_arrays(o.triangle, o.faces, half_thickness=0.1)
    adjacency = riis.Adjacency.from_cells(o.tetrahedron, 4)
    warp = riis.Warp(corners())
    marks, mesh, valve = riis.mark(o.surface, o.mesh, fields="normal"), riis.Mesh(o.xyz), riis.Valve("aortic")
    for lacks, names in ((marks, ("K", "K_gradient", "velocity", "uv")), (marks.within_limit, ("K", "uv")),
                         (arrays, ("attachment",))):
        for name in names:
            assert not hasattr(lacks, name) and getattr(lacks, name, 7) == 7
            with pytest.raises(Missing) as missing:
                getattr(lacks, name)
            assert isinstance(missing.value, Argument) and isinstance(missing.value, AttributeError)
    assert hasattr(marks, "normal") and hasattr(o.surface, "attachment")
    with pytest.raises(Argument, match="^K: the marking did not make it; mark with R=$"):
        marks.K
    objects = [arrays, adjacency, warp, marks, mesh, valve, riis.Marks(), marks.within_limit,
               riis.Surface(valve), riis.find_crossings(o.surface)]
    for one in objects:
        n_members = len(inspect.getmembers(one))
        assert n_members > 20
        if hasattr(one, "close"):
            one.close()
            assert one.closed and len(inspect.getmembers(one)) <= n_members
    assert not hasattr(mesh, "xyz") and not hasattr(valve, "parameters") and not hasattr(marks, "ids")


FIELDS_AND_K = ("point", "normal", "barycentric", "side", "rim", "uv", "velocity", "patch_id", "distance_gradient", "K",
                "K_u_surface", "K_gradient")


@pytest.mark.parametrize("name", FIELDS_AND_K)
def test_the_advice_for_a_field_works(o, name):
    """A marking with the arguments that the message names has the field."""
    near, valve = riis.Valve("mitral", opening=0.31), riis.Valve("mitral", opening=0.3)
    surface = riis.Surface(valve, half_thickness=0.15)
    surface.update_moving(valve, near, 0.1)
    surface.add_direction(near, valve, 0.01)
    mesh = riis.Mesh(numpy.array(surface.vertices[:50]))
    with pytest.raises(Missing, match=f"^{name}: the marking did not (request|make) it; mark with ") as refused:
        getattr(riis.mark(surface, mesh), name)
    advised = dict(re.findall(r"(R|fields)=(?:'(\w+)')?", str(refused.value).split("; mark with ")[1]))
    arguments = {key: value or 1e4 for key, value in advised.items()}
    assert arguments and len(getattr(riis.mark(surface, mesh, **arguments), name)) == 50


@pytest.mark.parametrize("wrong", [numpy.zeros(60, "f4"), numpy.zeros(120)[::2], [0.0] * 60])
def test_the_advice_for_written_arrays_works(o, wrong):
    with pytest.raises((TypeError, Argument), match="^K: .*; the call writes it, so make it by numpy.zeros") as refused:
        o.marks.add_resistance(wrong, R=1e4)
    call = re.search(r"make it by (numpy\.zeros.*)$", str(refused.value))[1].replace("...", "o.n")
    K = eval(call if call.endswith(")") else call + "(o.n)", {"numpy": numpy, "o": o})
    o.marks.add_resistance(K, R=1e4)
