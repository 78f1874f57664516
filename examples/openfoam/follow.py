# SPDX-License-Identifier: Apache-2.0
"""Checks of ./run openfoam for valves that follow a moving mesh, and for the angle law. check.py calls them."""
import pathlib
import re

import numpy

import check
import foam_files as foam
from check import K_NAME, KU_NAME, require

# The cases with a swinging mesh, and their ranks.
SWING = {"follow-patch-1": 1, "follow-patch-2": 2, "follow-zone": 2, "follow-points": 2, "follow-warp-1": 1, "follow-warp-2": 2}


def rigid(case, time):
    """Returns the rotation and the shift of the mesh since it was at rest, and the largest distance of a point from this motion.
    All points of the mesh are used."""
    rest, now = (numpy.concatenate([foam.vectors(folder / at / "polyMesh/points") for folder, _ in foam.parts(case)])
                 for at in ("constant", time))
    require(rest.shape == now.shape, f"{case} at {time} has the points of its mesh at rest")
    turn, shift = best_motion(rest, now)
    return turn, shift, numpy.abs(rest @ turn.T + shift - now).max()


def best_motion(rest, now):
    """Returns the rotation and the shift that move the first points as near as possible to the second points, by a singular value
    decomposition."""
    from_, to = rest.mean(axis=0), now.mean(axis=0)
    u, _, vt = numpy.linalg.svd((rest - from_).T @ (now - to))
    turn = vt.T @ numpy.diag([1, 1, numpy.sign(numpy.linalg.det(vt.T @ u.T))]) @ u.T
    return turn, to - turn @ from_


def leaflets(case, time):
    """Returns the leaflets' points, triangles and velocities at a time."""
    return foam.triangles(pathlib.Path(case) / f"postProcessing/aorticValve/{time}/leaflets.vtk")


def fields(case, time):
    return foam.global_field(case, time, K_NAME), foam.global_field(case, time, KU_NAME)


def follow(cases):
    """Checks a valve in a mesh that moves as a rigid body. The marks and K of this valve equal those of the valve at rest, and
    its velocity is that of the rigid body."""
    cases = pathlib.Path(cases)
    rest = cases / "follow-rest"
    times, dt = foam.times(rest), 1e-3
    require(len(times) == 8, f"{rest} has 8 written times, not {len(times)}")
    still = {time: fields(rest, time) for time in times}
    half = check.constant(rest, "halfThickness")
    print("A valve that opens in a mesh that moves as a rigid body, against the same valve in the mesh at rest. The largest"
          " differences in 8 steps, over the largest value:")
    print(f"  {'':<18} {'ranks':>5} {'turned by':>9} {'moved by':>8} {'same marks':>10} {'K':>8} {'leaflets':>9} {'velocity':>9}")
    for name, ranks in {**SWING, "follow-steady": 1}.items():
        case = cases / name
        require(foam.times(case) == times, f"{case} has the times of {rest}")
        require(len(foam.parts(case)) == ranks, f"{case} has {ranks} ranks, not {len(foam.parts(case))}")
        worst = numpy.zeros(3)
        turn_before, shift_before = numpy.eye(3), numpy.zeros(3)
        turned = moved = 0.0
        for time in times:
            k, k_rest = fields(case, time)[0], still[time][0]
            require(((k > 0) == (k_rest > 0)).all(), f"{name} at {time} has the marks of the valve at rest:"
                    f" {int(((k > 0) != (k_rest > 0)).sum())} cells differ")
            turn, shift, error = rigid(case, time)
            require(error < 1e-12, f"the mesh of {name} moves as a rigid body: {error:.1e} m")
            (x, corners, v), (x_rest, corners_rest, v_rest) = leaflets(case, time), leaflets(rest, time)
            require((corners == corners_rest).all(), f"{name} at {time} has the triangles of the valve at rest")
            wanted = x_rest @ turn.T + shift
            before = (x_rest - dt * v_rest) @ turn_before.T + shift_before
            velocity = (wanted - before) / dt
            worst = numpy.maximum(worst, [numpy.abs(k - k_rest).max() / k_rest.max(), numpy.abs(x - wanted).max() / half,
                                          numpy.abs(v - velocity).max() / numpy.abs(velocity).max()])
            turned = max(turned, numpy.degrees(numpy.arccos(min(1, (numpy.trace(turn) - 1) / 2))))
            moved = max(moved, numpy.linalg.norm(wanted - x_rest, axis=1).max())
            turn_before, shift_before = turn, shift
        print(f"  {name:<18} {ranks:>5} {turned:>8.1f}\N{DEGREE SIGN} {1e3 * moved:>5.2f} mm {'yes':>10}"
              f" {worst[0]:>8.1e} {worst[1]:>9.1e} {worst[2]:>9.1e}")
        require(moved > half, f"{name} moves by more than the half thickness: {moved:.1e} m")
        limit = 1e-9 if "warp" in name else 1e-12
        require(worst[0] < limit, f"{name} has the K of the valve at rest to {limit:g} of the largest: {worst[0]:.1e}")
        require(worst[1] < 1e-6, f"the leaflets of {name} move with the mesh to 1e-6 half thicknesses: {worst[1]:.1e}")
        require(worst[2] < 1e-6, f"the leaflets of {name} have the velocity of the mesh to 1e-6: {worst[2]:.1e}")

    for what in ("patch", "warp"):
        one, two = (cases / f"follow-{what}-{n}" for n in (1, 2))
        worst = 0.0
        for time in times:
            for a, b in zip(fields(one, time), fields(two, time)):
                worst = max(worst, numpy.abs(a - b).max() / numpy.abs(a).max())
        print(f"  follow-{what} on 1 and 2 ranks: K and K U_valve differ by {worst:.1e} of the largest")
        require(worst < 1e-10, f"follow-{what} has the same K and K U_valve on 1 and 2 ranks to 1e-10: {worst:.1e}")
        same_bits(cases / f"follow-{what}-2", cases / f"follow-{what}-restart", times[4:])

    deform(cases / "follow-deform")

    # Checks a mesh that moves steadily, together with the blood. Nothing else may change.
    steady, v = cases / "follow-steady", numpy.array([0.1, 0.2, 0.3])
    worst = 0.0
    for time in times:
        (k, ku), (k_rest, ku_rest) = fields(steady, time), still[time]
        worst = max(worst, numpy.abs(ku - ku_rest - k_rest[:, None] * v).max() / numpy.abs(ku).max())
    print(f"  follow-steady: K U_valve is that at rest plus K times the velocity of the mesh to {worst:.1e}")
    require(worst < 1e-9, f"the valve of follow-steady has the velocity of the mesh to 1e-9: {worst:.1e}")
    a, b = check.forces(rest)[:, 1:], check.forces(steady)[:, 1:]
    worst = numpy.abs(a - b).max() / numpy.abs(a).max()
    print(f"  follow-steady: the force of the flow is that at rest to {worst:.1e} of the largest, {numpy.abs(a).max():.3f} N")
    require(worst < 0.02, f"the force on the valve of follow-steady is that at rest to 2 %: {worst:.1e}")
    a, b = (check.valve_table(case, "valve")["pressure_difference"] for case in (rest, steady))
    worst = numpy.abs(a - b).max() / numpy.abs(a).max()
    print(f"  follow-steady: the pressure difference of the table is that at rest to {worst:.1e} of the largest,"
          f" {numpy.abs(a).max():.1f} Pa")
    require(worst < 0.05, f"the places of the pressures of follow-steady move with the mesh: {worst:.1e}")


def deform(case):
    """Checks that the valve's nadirs move with the nearest points of the wall while the mesh deforms. The nadirs are landmarks,
    and do not move when the valve opens."""
    case = pathlib.Path(case)
    sources = numpy.array(re.findall(r"\(([-.\de]+) ([-.\de]+) ([-.\de]+)\)", foam.text(case / "system/warp")), float)
    require(len(sources) == 6, f"{case}/system/warp has six landmarks, not {len(sources)}")
    folders = [folder for folder, _ in foam.parts(case)]
    rest, order = numpy.unique(numpy.concatenate([wall_points(folder, "constant") for folder in folders]), axis=0,
                               return_index=True)  # sorted, as in the plug-in: of two points as near, the first counts
    nearest = [((rest - source) ** 2).sum(axis=1).argmin() for source in sources]
    half, dt = check.constant(case, "halfThickness"), 1e-3
    before, worst, stretch, speed = sources[:3], numpy.zeros(2), 0.0, 0.0
    for time in foam.times(case):
        now = numpy.concatenate([wall_points(folder, time) for folder in folders])[order]
        moved = now[nearest] - rest[nearest]
        turn, shift = best_motion(rest[nearest], now[nearest])
        rigid_part = rest[nearest] @ turn.T + shift
        # A landmark takes part in the rigid motion, and in the rest of the motion of its point.
        wanted = sources @ turn.T + shift + now[nearest] - rigid_part
        x, _, v = leaflets(case, time)
        nadirs = wanted[:3]
        at = [numpy.linalg.norm(x - place, axis=1).argmin() for place in nadirs]
        velocity = (nadirs - before) / dt
        worst = numpy.maximum(worst, [numpy.abs(x[at] - nadirs).max() / half, numpy.abs(v[at] - velocity).max()])
        speed = max(speed, numpy.abs(velocity).max())
        stretch = max(stretch, numpy.abs(now[nearest] - rigid_part)[:3].max())
        before = nadirs
    print(f"  {case.name}: nadirs move by up to {1e3 * numpy.abs(moved[:3]).max():.2f} mm,"
          f" {1e3 * stretch:.2f} mm of it not rigid. They differ by {worst[0]:.1e} half thicknesses,"
          f" and their velocity by {worst[1] / speed:.1e}")
    require(stretch > 0.05 * half, f"the wall of {case} deforms: {stretch:.1e} m")
    require(worst[0] < 1e-6, f"the nadirs of {case} move with the wall to 1e-6 half thicknesses: {worst[0]:.1e}")
    require(worst[1] < 1e-3 * speed, f"the nadirs of {case} have the velocity of the wall to 1e-3: {worst[1]:.1e} m/s")


def wall_points(case, time):
    """Returns the points of the patch wall at a time, in the order of their labels."""
    text = foam.text(case / "constant/polyMesh/boundary")
    found = re.search(r"\bwall\s*\{[^}]*nFaces\s+(\d+);\s*startFace\s+(\d+);", text)
    require(found, f"{case} has a patch wall")
    n, start = map(int, found.groups())
    return foam.vectors(case / time / "polyMesh/points")[foam.points_of_faces(case / "constant/polyMesh/faces", start, n)]


def same_bits(whole, again, times):
    """Checks that K and K U_valve have the same bits after a restart as in an uninterrupted run."""
    for time in times:
        for a, b in zip(fields(whole, time), fields(again, time)):
            require((a != 0).any() and (a == b).all(),
                    f"the restart {again} at {time} has the bits of {whole}: {int((a != b).sum())} numbers differ")
    print(f"  {again.name}: K and K U_valve have the same bits after the restart")


def angle(case, again):
    """Checks the angle law and its restart, against an integration of its equation with the logged pressures and flows."""
    case, again = pathlib.Path(case), pathlib.Path(again)
    rows = foam.steps(case)
    text = foam.text(case / "log.pimpleFoam")
    drives = numpy.array(re.findall(r"pressure difference (\S+) Pa, flow (\S+) m3/s", text), float)
    require(len(drives) == len(rows) > 20, f"{case} has a pressure difference for each of its steps: {len(drives)}")
    gain, flow_gain, friction, vortex = (check.constant(case, key)
                                         for key in ("pressureGain", "flowGain", "friction", "vortexGain"))
    least, most = numpy.radians([check.constant(case, key) for key in ("angleMin", "angleMax")])

    def slope(state, drive):
        at, rate = state
        return numpy.array([rate, -friction * rate + (gain * drive[0] + flow_gain * drive[1]) * numpy.cos(at)
                            - vortex * max(drive[1], 0) * numpy.sin(2 * at)])

    state, worst, before = numpy.array([least, 0.0]), 0.0, drives[0]
    n, dt = 400, rows[1, 0] - rows[0, 0]
    for row, now in zip(rows, drives):
        h = dt / n
        for i in range(n):
            a, b, c = (before + (now - before) * (i + share) / n for share in (0, 0.5, 1))
            k1 = slope(state, a)
            k2 = slope(state + h / 2 * k1, b)
            k3 = slope(state + h / 2 * k2, b)
            k4 = slope(state + h * k3, c)
            state = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            if not least < state[0] < most:
                state = numpy.array([min(max(state[0], least), most), 0.0])
        before = now
        worst = max(worst, abs(row[1] - (state[0] - least) / (most - least)))
    opening = rows[:, 1]
    print(f"The angle law: the opening is {opening[0]:.3f} at first and {opening.max():.3f} at most. It differs by at most"
          f" {worst:.1e} from an integration of the equation by the logged pressures.")
    require(opening.max() > 0.9 and opening[0] < 0.1, f"the valve of {case} opens: {opening[0]} to {opening.max()}")
    require(worst < 1e-4, f"the opening of {case} is that of the equation to 1e-4: {worst:.1e}")
    # OpenFOAM's own restart may change the last digits of the pressure, which the law uses in the second step.
    times = [time for time in foam.times(again) if float(time) > 0.0151]
    start = numpy.interp(0.015, rows[:, 0], opening)
    require(len(times) == 5 and 0.02 < start < 0.98,
            f"the restart {again} begins while the valve moves, at {start:.3f}, and has five times: {times}")
    same_bits(case, again, times[:1])
    worst = max(numpy.abs(a - b).max() / numpy.abs(a).max()
                for time in times for a, b in zip(fields(case, time), fields(again, time)))
    print(f"  after four more steps K and K U_valve differ by {worst:.1e} of the largest")
    require(worst < 1e-6, f"the restart {again} has the K of {case} to 1e-6 of the largest: {worst:.1e}")
