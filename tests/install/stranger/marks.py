# SPDX-License-Identifier: Apache-2.0
"""Prints in Python what marks.c prints."""
import numpy
import riis

n = 41
i = numpy.arange(n**3)
xyz = -2.5 + 0.125 * numpy.column_stack([i % n, i // n % n, i // n**2])
surface = riis.Surface(riis.Valve("mitral", opening=0.5))
mesh = riis.Mesh(xyz)
marks = riis.mark(surface, mesh)
for node, bits in zip(marks.ids, marks.distance.view(numpy.uint64)):
    print(f"{node} {bits:016X}")
