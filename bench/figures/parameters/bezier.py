# SPDX-License-Identifier: Apache-2.0
"""Evaluates Bézier curves from riis-figures --curves. A span is the list of its control points, and a curve the list of its
spans."""

import math


def point(piece, t):
    points = [tuple(p) for p in piece]
    while len(points) > 1:
        points = [tuple((1 - t) * a + t * b for a, b in zip(p, q)) for p, q in zip(points, points[1:])]
    return points[0]


def samples(pieces, n=64):
    made = []
    for piece in pieces:
        made += [point(piece, i / n) for i in range(1 if made else 0, n + 1)]
    return made


def length_until(piece, end):
    """Returns the arc length up to a parameter, extrapolated from the lengths of chords."""

    def chords(n):
        points = [point(piece, end * i / n) for i in range(n + 1)]
        return sum(map(math.dist, points, points[1:]))

    coarse, fine = chords(64), chords(128)
    return fine + (fine - coarse) / 3


def length(pieces, until=None):
    """Returns the arc length of the curve. If `until` is given, returns the length up to this point."""
    total = 0.0
    for piece in pieces:
        if until is not None:
            t = parameter(piece, until)
            if math.dist(point(piece, t), until) < 1e-7:
                return total + length_until(piece, t)
        total += length_until(piece, 1.0)
    return total


def at_share(pieces, share):
    """Returns the point at a fraction of the curve's length, by bisection."""
    lengths = [length([piece]) for piece in pieces]
    rest = share * sum(lengths)
    for piece, whole in zip(pieces, lengths):
        if rest <= whole * (1 + 1e-12):
            break
        rest -= whole
    low, high = 0.0, 1.0
    for _ in range(50):
        middle = (low + high) / 2
        if length_until(piece, middle) < rest:
            low = middle
        else:
            high = middle
    return point(piece, (low + high) / 2)


def parameter(piece, where):
    """Returns the parameter of the span's point that is nearest to `where`. The search starts from the best of many samples, and
    narrows the interval around this sample."""
    n = 64
    best = min(range(n + 1), key=lambda i: math.dist(point(piece, i / n), where))
    low, high = max(0, best - 1) / n, min(n, best + 1) / n
    for _ in range(100):
        a, b = low + (high - low) / 3, high - (high - low) / 3
        if math.dist(point(piece, a), where) < math.dist(point(piece, b), where):
            high = b
        else:
            low = a
    return (low + high) / 2
