# SPDX-License-Identifier: Apache-2.0
"""Draws the stages that make curves and patches, the aortic valve, the mitral valve, and the effect of the tolerance."""

import math

import numpy as np

from library import HALF_THICKNESS, add_controlled, control_points, model, samples, written
from page import Figure, Panel, count, html_table, number, percent
from picture import BLUE, DARK, GREEN, GREY, LEAFLETS, LIGHT_GREY, ORANGE, PURPLE, TOP_VIEW, VERMILION, Picture, looking, paler

RIGHT, NON_CORONARY, ANTERIOR = 0, 2, 0


def pale(white):
    return tuple(paler(colour, white) for colour in LEAFLETS)


# ------------------------------------------------------------------------------------------------------------------- polylines


def curve_picture(controls, title):
    picture = Picture((760, 560), TOP_VIEW, [*controls, (-0.1, -0.2, 0), (4.3, 2.9, 0)], 70)
    picture.add_title(title)
    return picture


def add_named(picture, controls, name, colour, above_first):
    """Adds a curve with its control polygon, and names its control points."""
    picture.add_dashed(controls, paler(colour, 0.4), 3)
    picture.add_curve(samples([controls]), colour, 6)
    picture.add_points(controls, colour, 17)
    for i, (p, side) in enumerate(zip(controls, (-30, 0, 0, 30))):
        picture.add_label(p, f"{name}{i}", side, above_first if side else 28, colour)


def polyline_panel(controls, length, line):
    points, n = np.array(line["points"]), len(line["points"]) - 1
    picture = curve_picture(controls, f"error at most {number(line['max_error'])}: {n} segments")
    picture.add_curve(samples([controls]), paler(BLUE, 0.6), 10)
    picture.add_curve(points, DARK, 4, 2)
    picture.add_points(points, VERMILION, 11 if n > 20 else 16)
    about = ""
    if n <= 10:
        about = f", with the parameter t of every vertex: its share of the curve's length ({number(length, 4)})"
        for p, (x, y, _), t in zip(points, line["tangents"], line["t"]):
            picture.add_label_away(p, p - (-y, x, 0), number(t, 5), 38, DARK, 20)
    caption = (
        f"The polyline of {n} segments{about}. Largest distance at equal t: bound {number(line['bound'])}, measured "
        f"{number(line['measured'])}."
    )
    return Panel(picture.png(), caption)


def bezier_figure():
    made = written("--polylines")
    controls, left, right = (made[name]["controls"] for name in ("curve", "left", "right"))
    whole = curve_picture(controls, "curve and control polygon")
    add_named(whole, controls, "Q", BLUE, -22)
    halved = curve_picture(controls, "halved once")
    add_named(halved, left, "L", ORANGE, -26)
    add_named(halved, right, "R", GREEN, -26)
    halved.add_points([left[-1]], DARK, 17)
    panels = [
        Panel(
            whole.png(),
            "A cubic Bézier curve, its control points Q0 to Q3 and its control polygon (dashed). Its length is "
            f"{number(made['length'], 4)}, its flatness κ {number(made['curve']['flatness'])}.",
        ),
        Panel(
            halved.png(),
            "One step of the recursion, by de Casteljau's algorithm: left part L0 to L3, right part R0 to R3, L3 = R0 (dark). "
            f"riis halves the length (here at the parameter {number(made['middle'], 4)}), the paper the parameter (0.5). κ of "
            f"the parts: {number(made['left']['flatness'])} and {number(made['right']['flatness'])}.",
        ),
        *(polyline_panel(controls, made["length"], line) for line in made["polylines"]),
    ]
    return Figure(
        "A Bézier curve becomes a polyline", 3, panels,
        "A curve is halved until every part is within the allowed error of its chord (here 0.3, 0.05, 0.01 and 0.002; the curve, "
        "pale, is 4.2 wide). More points stand where it bends more. t is the share of the curve's length, always a binary "
        "fraction, so that the parameters of two curves agree to the last bit or differ clearly.",
        "section 3.2, figures “Example of one step of recursive subdivision using de Casteljau algorithm” and “Polyline after "
        "recursive subdivision”; algorithm “Recursive de Casteljau subdivision for quadratic and cubic Bézier curves”.",
    )  # fmt: skip


# ---------------------------------------------------------------------------------------------------------------- a Coons patch

# The tolerance of the upper patch of half a cusp. This tolerance is so coarse that the grid lines can be distinguished.
COARSE = 0.2
SIDES = (
    (BLUE, "v = 0, bending curve"), (VERMILION, "v = 1, leaflet curve"), (GREEN, "u = 0, symmetry curve"),
    (PURPLE, "u = 1, sinus curve"),
)  # fmt: skip


def labelled(t):
    """Returns the inner vertices that are far enough from other vertices to have a label."""
    found, last = [], 1
    for i in range(len(t) - 2, 0, -1):
        if last - t[i] > 0.12 and t[i] > 0.12:
            last = t[i]
            found.append(i)
    return found


def boundary_picture(picture, sides, middle):
    for (points, t), (colour, _) in zip(sides, SIDES):
        picture.add_curve(points, colour, 5)
        picture.add_points(points, colour, 16)
        for i in labelled(t):
            along = points[i + 1] - points[i - 1]
            along, out = along / np.linalg.norm(along), points[i] - middle
            picture.add_label_away(points[i], points[i] - (out - np.dot(out, along) * along), number(t[i], 6), 36, colour, 22)
    return picture


def square_picture(picture, grid, sides):
    for u in grid.u:
        picture.add_curve([(u, 0, 0), (u, 1, 0)], LIGHT_GREY, 2.5)
    for v in grid.v:
        picture.add_curve([(0, v, 0), (1, v, 0)], LIGHT_GREY, 2.5)
    away = ((0, -26), (0, 26), (-46, 0), (46, 0))
    for k, ((_, t), (colour, _)) in enumerate(zip(sides, SIDES)):
        points = [((s, k, 0) if k < 2 else (k - 2, s, 0)) for s in t]
        picture.add_curve([points[0], points[-1]], colour, 5)
        picture.add_points(points, colour, 16)
        for i in labelled(t):
            picture.add_label(points[i], number(t[i], 6), *away[k], colour, 19)
    picture.add_label((0.5, 0, 0), "u", 0, -62)
    picture.add_label((0, 0.5, 0), "v", -110, 0)
    return picture


def coons_figure():
    whole = model("aortic", COARSE).grids
    patch_id = next(grid.patch_id for grid in whole if grid.leaflet == NON_CORONARY and grid.lengths["v0"] > 0)
    patch = model("aortic", COARSE, patch_id)
    grid, sides = patch.grids[0], patch.grids[0].polylines()
    quads, triangles = patch.quads(colours=pale(0.55)), patch.triangles(colours=pale(0.55))
    halving, diagonals = patch.triangle_edges()
    middle = np.mean(quads.points, axis=0)
    # The patch is seen from outside and above.
    x, y, _ = grid.placed["u0"][0][0]  # in the plane of symmetry
    radius = math.hypot(x, y)
    view = looking(((-x + 0.35 * y) / radius, (-y - 0.35 * x) / radius, -0.75), (0, 0, 1))

    def picture_of(title):
        picture = Picture((900, 680), view, quads.points, 90)
        picture.add_title(title)
        return picture

    square = Picture((900, 680), TOP_VIEW, [(0, 0, 0), (1, 1, 0)], 110)
    square.add_title("the square of u and v")
    points, flat, halved, cut = map(picture_of, ("grid points", "quads", "quads, halved", "triangles"))
    for (line, _), (colour, _) in zip(sides, SIDES):
        points.add_curve(line, paler(colour, 0.3), 4)
    points.add_segments(quads.edges(), GREY, 1.5)
    points.add_points(quads.points, DARK, 11)
    flat.add_faces(quads, "flat")
    flat.add_segments(quads.edges(), DARK, 2.5)
    halved.add_faces(triangles, "flat")
    halved.add_segments(halving, VERMILION, 2.5)
    halved.add_segments(quads.edges(), DARK, 2.5, 1)
    cut.add_faces(triangles, "flat")
    cut.add_segments(diagonals, DARK, 1.5)
    cut.add_segments(halving, DARK, 1.5)
    cut.add_segments(quads.edges(), DARK, 2.5, 1)
    p = grid.points
    flatness = 0.25 * np.linalg.norm(p[:-1, :-1] - p[:-1, 1:] + p[1:, 1:] - p[1:, :-1], axis=2)
    n = [len(t) - 1 for _, t in sides]
    panels = [
        Panel(
            boundary_picture(picture_of("four polylines and their t"), sides, middle).png(),
            "The boundary: four polylines that meet in the corners, and the t of their inner vertices where there is room for "
            f"it. They have {n[0]}, {n[1]}, {n[2]} and {n[3]} segments, in the order of the key.",
        ),
        Panel(
            square_picture(square, grid, sides).png(),
            f"Grid lines stand at the union of the t of opposite sides: {len(grid.u)} values of u, {len(grid.v)} of v.",
        ),
        Panel(points.png(), f"The Coons patch S(u,v) at these {count(len(quads.points))} points."),
        Panel(
            flat.png(),
            f"{count(len(quads.corners))} quads. S is exactly bilinear in each of them, so no detail of the polylines is lost.",
        ),
        Panel(
            halved.png(),
            f"{grid.n_halved} quads are farther from their two triangles than the curves' errors leave room for: they are halved "
            f"both ways (red) until all parts are close enough. The largest κ<sub>quad</sub> is {number(np.max(flatness))} cm.",
        ),
        Panel(cut.png(), f"Every quad, or part of one, is cut into two triangles: {count(len(triangles.corners))}."),
    ]
    return Figure(
        "A Coons patch becomes quads and triangles", 3, panels,
        "The upper patch of half the non-coronary aortic cusp, between bending curve and free edge, with the paper's parameters, "
        f"seen from outside and above. The tolerance is {percent(COARSE)} ({number(COARSE * HALF_THICKNESS)} cm), four times "
        "coarser than the default, so that single lines can be seen. The other half is a mirrored copy of the same patch.",
        "section 3.3, figure “Aortic valve cusp surface representations”; section 4.1, algorithm “Recursive quad subdivision for "
        "triangulation”.",
        SIDES,
    )  # fmt: skip


# -------------------------------------------------------------------------------------------------------------- the aortic valve

LEAFLET_CURVE, BENDING, SINUS, SYMMETRY = VERMILION, BLUE, PURPLE, GREEN
CURVE_KEY = (
    (LEAFLET_CURVE, "leaflet curve (free edge)"), (BENDING, "bending curve"), (SINUS, "sinus curve"),
    (SYMMETRY, "symmetry curve"),
)  # fmt: skip
HALF_CURVES = (("leaflet", LEAFLET_CURVE), ("bending", BENDING), ("sinus", SINUS))
OUTSIDE_AND_ABOVE = looking((-1, 0.35, -0.55), (0, 0, 1))


def curves_of(cusp):
    """Returns the seven curves of a cusp, each with its colour."""
    halves = [(cusp[name][k], colour) for k in (0, 1) for name, colour in HALF_CURVES]
    return [(cusp["symmetry"], SYMMETRY), *halves]


def widest_gap(cusps):
    """Returns the widest gap between the free edges of neighbouring cusps at their ends."""
    ends = [np.array([edge[-1][-1] for edge in cusp["leaflet"]]) for cusp in cusps]
    return max(
        min(math.dist(end, other) for j, others in enumerate(ends) if j != i for other in others)
        for i, own in enumerate(ends)
        for end in own
    )


def aortic_valve_figure():
    fine = 0.01
    valve = model("aortic", fine)
    faces, cusps = valve.triangles(), valve.cusps()
    all_curves = [curve for cusp in cusps for curve in curves_of(cusp)]
    controls = np.concatenate([control_points(pieces) for pieces, _ in all_curves])
    to_fit = np.concatenate([faces.points, controls])
    side = looking((-0.15, 1, -0.28), (0, 0, 1))

    def picture_of(view, title, shading):
        picture = Picture((900, 760), view, to_fit)
        picture.add_title(title)
        picture.add_faces(faces, shading)
        if shading == "ghost":
            for pieces, colour in all_curves:
                add_controlled(picture, pieces, colour, 5, 13, 0.3)
        picture.add_scale_and_axes()
        return picture.png()

    panels = [
        Panel(
            picture_of(TOP_VIEW, "curves, top", "ghost"),
            "Curves and control points from the aorta; control polygons dashed; surfaces see-through.",
        ),
        Panel(picture_of(side, "curves, side", "ghost"), "The same from the side and slightly above; the aorta is up."),
        Panel(picture_of(TOP_VIEW, "surfaces, top", "smooth"), "Surfaces of the three cusps from the aorta."),
        Panel(picture_of(side, "surfaces, side", "smooth"), "The same from the side and slightly above."),
    ]
    names = zip(LEAFLETS, ("right cusp", "left cusp", "non-coronary cusp"))
    return Figure(
        "The aortic valve", 2, panels,
        "Each of the three cusps has two mirrored halves. Four curves make a half, and the halves share the symmetry curve: "
        f"{len(all_curves)} curves with {len(controls)} control points in all. Parameters: the paper's. Surfaces: "
        f"{count(len(faces.corners))} triangles at a tolerance of {percent(fine)}. Neighbouring cusps have different radii where "
        f"they meet the wall, so their free edges end up to {number(widest_gap(cusps), 2)} cm apart there: the surfaces are "
        "three separate pieces.",
        "section 2.1, figure “Overview of the cusps in the aortic valve”; table “Aortic valve parameters”.",
        (*CURVE_KEY, *names),
    )  # fmt: skip


def aortic_cusp_figure():
    tolerance, fine = 0.05, 0.005
    valve = model("aortic", tolerance)
    cusp = curves_of(valve.cusps()[RIGHT])
    quads, triangles = valve.quads(RIGHT, colours=pale(0.5)), valve.triangles(RIGHT, colours=pale(0.5))
    smooth = model("aortic", fine).triangles(RIGHT)
    controls = np.concatenate([control_points(pieces) for pieces, _ in cusp])
    to_fit = np.concatenate([quads.points, controls])

    def picture_of(title):
        picture = Picture((860, 640), OUTSIDE_AND_ABOVE, to_fit)
        picture.add_title(title)
        picture.add_scale_and_axes()
        return picture

    names = ("curves and control points", "polylines", "interpolated points", "quads", "triangles", "surface")
    controlled, lines, dots, flat, cut, surface = map(picture_of, names)
    controlled.add_faces(smooth, "ghost")
    for pieces, colour in cusp:
        add_controlled(controlled, pieces, colour, 6, 16, 0.3)
    for grid in valve.grids:
        if grid.leaflet == RIGHT:
            upper_or_lower = (BENDING, LEAFLET_CURVE) if grid.lengths["v0"] > 0 else (SYMMETRY, BENDING)
            for (points, _), colour in zip(grid.polylines(), (*upper_or_lower, SYMMETRY, SINUS)):
                if len(points) > 1:
                    lines.add_curve(points, colour, 4)
                lines.add_points(points, DARK, 10)
    dots.add_points(quads.points, BLUE, 9)
    flat.add_faces(quads, "flat")
    flat.add_segments(quads.edges(), DARK, 1.5)
    cut.add_faces(triangles, "flat")
    halving, diagonals = valve.triangle_edges(RIGHT)
    cut.add_segments(diagonals, GREY, 1)
    cut.add_segments(halving, DARK, 1.5)
    surface.add_faces(smooth, "smooth")
    captions = (
        f"The {len(cusp)} curves of the cusp with {len(controls)} control points.",
        "Their polylines, cut where the bending curve cuts them, at the tolerance of the quads.",
        "Points of the four Coons patches at the union of the parameters of opposite sides.",
        f"{count(len(quads.corners))} quads.",
        f"{count(len(triangles.corners))} triangles: quads that are not flat enough are halved both ways, then cut.",
        f"The surface ({count(len(smooth.corners))} triangles at {percent(fine)}).",
    )
    pictures = (controlled, lines, dots, flat, cut, surface)
    return Figure(
        "One cusp, from curves to its surface", 3, [Panel(picture.png(), text) for picture, text in zip(pictures, captions)],
        f"The right cusp, seen from outside and above, with the paper's parameters; tolerance {percent(tolerance)} except in the "
        "last picture. A half is made once and placed twice, unchanged and mirrored, so the halves meet to the last bit. At the "
        "root the lower patches end in one point: the quads there are triangles, and triangles without area are dropped.",
        "figures “Curves used for defining the aortic valve cusp” (section 2.1) and “Aortic valve cusp surface representations” "
        "(section 3.3); algorithm “Recursive quad subdivision for triangulation” (section 4.1).",
        CURVE_KEY,
    )  # fmt: skip


# -------------------------------------------------------------------------------------------------------------- the mitral valve

CURVE_COLOURS = {"annulus": DARK, "posterior": VERMILION, "anterior": BLUE}  # in the order of drawing
# In the view from the side, the anterior point of the annulus is on the right and the ventricle below.
FROM_THE_SIDE = looking((-1, 0, 0), (0, 0, 1))


def mitral_at(opening, tolerance):
    return model("mitral", tolerance, opening=opening)


def name_annulus_points(picture, annulus, from_top):
    """Labels the joints between the annulus' spans in the order of the paper's points P0 to P5: anticlockwise from the posterior
    point."""
    joints = np.array([piece[0] for piece in annulus])
    n, is_in_order = len(joints), joints[1][0] > joints[0][0]
    for i, joint in enumerate(joints):
        of_paper = i if is_in_order else (n - i) % n
        if from_top:
            picture.add_label_away(joint, np.mean(joints, axis=0), f"A{of_paper}", 34)
        elif joint[0] >= -1e-9:  # points with x > 0 hide the points with x <
            # 0
            picture.add_label(joint, f"A{of_paper}", *{2: (30, 10), 3: (-14, 30)}.get(of_paper, (0, 30)))


def mitral_curves_figure():
    closed, opened = (mitral_at(opening, 0.01).mitral() for opening in (0, 1))
    to_fit = np.concatenate([control_points(pieces) for state in (closed, opened) for pieces in state.values()])

    def picture_of(state, view, title):
        from_top = view is TOP_VIEW
        picture = Picture((960, 780) if from_top else (960, 620), view, to_fit, 70)
        picture.add_title(title)
        for name, colour in CURVE_COLOURS.items():
            if state is opened or name != "posterior":
                add_controlled(picture, state[name], colour, 5, 15, 0.35)
        name_annulus_points(picture, state["annulus"], from_top)
        picture.add_scale_and_axes()
        return picture.png()

    def counts(pieces):
        return f"{len(pieces)} piece{'s' * (len(pieces) > 1)} and {len(control_points(pieces))} control points"

    panels = [
        Panel(picture_of(closed, TOP_VIEW, "closed, top"), "Closed, from the atrium. Both free edges are one curve."),
        Panel(picture_of(opened, TOP_VIEW, "open, top"), "Open, from the atrium: the posterior edge has three scallops."),
        Panel(
            picture_of(closed, FROM_THE_SIDE, "closed, side"),
            "Closed, from the posteromedial side: the saddle of the annulus; the free edge lies in a plane.",
        ),
        Panel(
            picture_of(opened, FROM_THE_SIDE, "open, side"),
            "Open, from the side: the annulus is flat, the free edges hang into the ventricle.",
        ),
    ]
    return Figure(
        "The mitral valve: annulus and free edges", 2, panels,
        "Curves with the control points of all their Bézier pieces, which are all cubic; A0 to A5 are the paper's "
        f"P<sub>an</sub><sup>0</sup> to P<sub>an</sub><sup>5</sup>. The annulus has {counts(opened['annulus'])}, the anterior "
        f"edge {counts(opened['anterior'])}, the posterior edge when open {counts(opened['posterior'])} (closed: "
        f"{counts(closed['posterior'])}, those of the anterior edge). Parameters: the paper's, with opening 0 and 1, moved by "
        "(0, 0, 1). Between the two, every control point moves on a straight line.",
        "appendix, figures “Top and side view of the mitral valve model in a closed state” and “… in an open state”; its "
        "misprints are corrected as docs/theory/mitral.md says.",
        (
            (DARK, "annulus, A0 posterior to A3 anterior point"), (BLUE, "anterior free edge (closed: both)"),
            (VERMILION, "posterior free edge"),
        ),
    )  # fmt: skip


def mitral_surfaces_figure():
    fine, openings = 0.01, (0, 0.5, 1)
    models = [mitral_at(opening, fine) for opening in openings]
    to_fit = np.concatenate([each.points for each in models])
    rows = (
        (TOP_VIEW, "top", "from the atrium."),
        (FROM_THE_SIDE, "side", "from the posteromedial side."),
        (looking((-0.3, 1, 0.55), (0, 0, 1)), "from the ventricle", "from the ventricle, posterior leaflet in front."),
    )
    panels = []
    for view, seen, caption in rows:
        for valve, opening, name in zip(models, openings, ("closed", "half open", "open")):
            picture = Picture((860, 700), view, to_fit)
            picture.add_title(f"{name}, {seen}")
            picture.add_faces(valve.triangles(), "smooth")
            picture.add_scale_and_axes()
            panels.append(Panel(picture.png(), f"Opening {number(opening)}, {caption}"))
    n = [count(len(valve.corners)) for valve in models]
    return Figure(
        "The mitral valve: surfaces, closed, half open and open", 3, panels,
        "The leaflets, made of arcs from the annulus to the free edges that leave the straight line by 20 degrees. Parameters: "
        f"the paper's; tolerance {percent(fine)}, {n[0]}, {n[1]} and {n[2]} triangles.",
        "figures “Example of mitral valve in open state” (section 2.2) and “Closed mitral valve surfaces” (appendix).",
        tuple(zip(LEAFLETS, ("anterior leaflet", "posterior leaflet"))),
    )  # fmt: skip


def mitral_quads_figure():
    tolerance, panels = 0.05, []
    views = looking((-0.25, 0.8, -1), (0, 0, 1)), looking((-0.45, 1, -0.25), (0, 0, 1))
    for opening, state, view in zip((0, 1), ("closed", "open"), views):
        valve = mitral_at(opening, tolerance)
        quads, triangles = valve.quads(colours=pale(0.5)), valve.triangles(colours=pale(0.5))
        pictures = [Picture((860, 680), view, quads.points) for _ in range(3)]
        for picture, title in zip(pictures, ("curves of the patches", "quads", "triangles")):
            picture.add_title(f"{state}: {title}")
            picture.add_scale_and_axes()
        for grid in valve.grids:
            edge = BLUE if grid.leaflet == ANTERIOR else VERMILION
            for name, colour in (("v0", DARK), ("v1", edge), ("u0", GREY), ("u1", GREY)):
                if grid.lengths[name] > 0:
                    pictures[0].add_curve(samples(grid.placed[name]), colour, 3 if colour is GREY else 5)
        pictures[1].add_faces(quads, "flat")
        pictures[1].add_segments(quads.edges(), DARK, 1.2)
        pictures[2].add_faces(triangles, "flat")
        halving, diagonals = valve.triangle_edges()
        pictures[2].add_segments(diagonals, GREY, 1)
        pictures[2].add_segments(halving, DARK, 1.2)
        captions = (
            f"Opening {number(opening)}: the sides of the {len(valve.grids)} patches: parts of the annulus and of the free "
            "edges, and the arcs between them.",
            f"{count(len(quads.corners))} quads.",
            f"{count(len(triangles.corners))} triangles.",
        )
        panels += [Panel(picture.png(), text) for picture, text in zip(pictures, captions)]
    return Figure(
        "The mitral valve: quads and triangles", 3, panels,
        f"The valve at a tolerance of {percent(tolerance)}, with the paper's parameters. Half a valve consists of five patches, "
        "which are placed twice, unchanged and mirrored in x. Beside each commissure a patch has a part of the annulus on one "
        "side and a single point, the end of the free edge, on the other: the paper's triangle regions.",
        "appendix, “Leaflet surfaces”; section 4.1 for the triangles.",
        (
            (DARK, "annulus"), (BLUE, "anterior free edge"), (VERMILION, "posterior free edge"),
            (GREY, "arcs that patches share"), (pale(0.5)[0], "anterior leaflet"), (pale(0.5)[1], "posterior leaflet"),
        ),
    )  # fmt: skip


# ----------------------------------------------------------------------------------------------------------------- the tolerance


def tolerance_figure():
    tolerances, panels = (0.1, 0.05, 0.02, 0.005), []
    rows = [["tolerance", "bound (cm)"]] + [[percent(each), number(each * HALF_THICKNESS)] for each in tolerances]
    subjects = (
        ("aortic", "right cusp", RIGHT, OUTSIDE_AND_ABOVE),
        ("mitral", "anterior leaflet", ANTERIOR, looking((-0.35, -1, -0.35), (0, 0, 1))),
    )
    for kind, name, leaflet, view in subjects:
        rows[0] += [f"{name}: quads", "triangles", f"{kind} valve: quads", "triangles"]
        for row, tolerance in zip(rows[1:], tolerances):
            valve = model(kind, tolerance)
            quads, triangles = valve.quads(leaflet), valve.triangles(leaflet, colours=pale(0.5))
            picture = Picture((1000, 720), view, quads.points, 45)
            picture.add_title(percent(tolerance))
            picture.add_faces(triangles, "flat")
            # The finest triangles have edges in the leaflet's colour, because dark edges would cover the triangles.
            picture.add_segments(triangles.edges(), LEAFLETS[0] if tolerance == tolerances[-1] else DARK, 1)
            n = [count(len(faces)) for faces in (quads.corners, triangles.corners, valve.quads().corners, valve.corners)]
            panels.append(Panel(picture.png(), f"The {name} at {percent(tolerance)}: {n[0]} quads, {n[1]} triangles."))
            row += n
    return Figure(
        "What the tolerance does", 2, panels,
        "Triangles of an aortic cusp and of a mitral leaflet (open) at tolerances of 10, 5, 2 and 0.5 %, with the paper's "
        "parameters. Whatever the tolerance, distances to the triangles differ from distances to the smooth surface by no more "
        "than the bound, everywhere; curved parts get more triangles, flat ones fewer.",
        "section 4.1: the threshold φ of the triangulation, and its performance evaluation, which varies the tolerance.",
        table=html_table(rows),
    )  # fmt: skip
