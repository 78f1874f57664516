# SPDX-License-Identifier: Apache-2.0
"""Finds the curves of valves in the images of patches, which riis-figures writes."""

import math

ANTERIOR = 0


def mix(p, q, share):
    return [a + share * (b - a) for a, b in zip(p, q)]


def split(piece, t):
    """Returns the two parts of a span, by de Casteljau's algorithm."""
    left, right = [piece[0]], [piece[-1]]
    while len(piece) > 1:
        piece = [mix(p, q, t) for p, q in zip(piece, piece[1:])]
        left.append(piece[0])
        right.insert(0, piece[-1])
    return left, right


def join(a, b):
    """Returns the span whose parts are a and b, by de Casteljau's algorithm in reverse. Returns None if there is no such span."""
    before, after = math.dist(a[-2], a[-1]), math.dist(b[0], b[1])
    if len(a) != len(b) or not (before > 0 and after > 0):
        return None
    t = before / (before + after)
    second, last_but_one = mix(a[0], a[1], 1 / t), mix(b[-1], b[-2], 1 / (1 - t))
    whole = [a[0], second, b[-1]] if len(a) == 3 else [a[0], second, last_but_one, b[-1]]
    parts = split(whole, t)
    return whole if all(math.dist(p, q) < 1e-9 for made, part in zip(parts, (a, b)) for p, q in zip(made, part)) else None


def joined(pieces):
    """Joins the parts of curves that were cut. Spans that were always separate stay separate."""
    made = []
    for piece in pieces:
        whole = join(made[-1], piece) if made else None
        made[-1:] = [whole] if whole else [*made[-1:], piece]
    return made


def reversed_curve(pieces):
    return [piece[::-1] for piece in pieces[::-1]]


def cusp_curves(images, cusp, frame="placed"):
    """Returns the curves that define half a cusp in the paper, and their mirror images. The curves are joined again where the
    bending curve cuts them."""
    below, above = (
        [image[frame] for image in images if image["leaflet"] == cusp and (image["lengths"]["v0"] == 0) == is_below]
        for is_below in (True, False)
    )
    return {
        "leaflet": [upper["v1"] for upper in above],
        "bending": [lower["v1"] for lower in below],
        "sinus": [joined(lower["u1"] + upper["u1"]) for lower, upper in zip(below, above)],
        "symmetry": joined(below[0]["u0"] + above[0]["u0"]),
    }


def mitral_curves(images):
    """Returns the annulus, once around from the posterior point. Also returns the free edges from one commissure to the other. In
    each half of the valve, patches are listed from the anterior point of the annulus to the posterior point."""
    annulus, anterior, posterior = ([], []), ([], []), ([], [])  # each entry has a curve and its mirror image
    for i, image in enumerate(images):
        annulus[i % 2].extend(image["placed"]["v0"])
        if image["lengths"]["v1"] > 0:
            (anterior if image["leaflet"] == ANTERIOR else posterior)[i % 2].extend(image["placed"]["v1"])
    return {
        "annulus": joined(reversed_curve(annulus[0]) + annulus[1]),
        "anterior": joined(reversed_curve(anterior[0]) + anterior[1]),
        "posterior": joined(posterior[0] + reversed_curve(posterior[1])),
    }


def mitral_arcs(images):
    """Returns arcs from the annulus to the free edges on the half x >= 0. The arcs begin at fractions u of the annulus' length
    from its posterior point. "lines" has the ends of many arcs. "arcs" has the arcs between two patches."""
    half, lines, arcs, u = images[::2], [], [], 0.5  # patches go from the anterior to the posterior point
    whole = 2 * sum(image["lengths"]["v0"] for image in half)
    for image in half:
        share, ends = image["lengths"]["v0"] / whole, image["ends_of_lines"]
        for i, (on_annulus, on_edge) in enumerate(ends):
            at = u - i / (len(ends) - 1) * share
            lines.append({"u": at, "annulus": on_annulus, "edge": on_edge, "leaflet": image["leaflet"]})
        arcs.append({"u": u, "curve": image["placed"]["u0"]})
        u -= share
    arcs.append({"u": u, "curve": half[-1]["placed"]["u1"]})
    return {"lines": lines, "arcs": arcs}


def all_cusps(images, frame="placed"):
    return [cusp_curves(images, cusp, frame) for cusp in range(3)]


def state_of(kind, state):
    """Returns the opening and the curves of a valve's state."""
    images = state["images"]
    if kind == "mitral":
        return {"opening": state["opening"], **mitral_curves(images), **mitral_arcs(images)}
    if kind == "bileaflet":
        return {"opening": state["opening"], "halves": [{"leaflet": each["leaflet"], **each["placed"]} for each in images]}
    return {"opening": state["opening"], "own_frames": all_cusps(images, "own_frame"), "cusps": all_cusps(images)}
