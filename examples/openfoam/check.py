# SPDX-License-Identifier: Apache-2.0
"""Does the checks and draws the pictures of ./run openfoam. A check prints its numbers, and ends with an error if a number is
wrong."""
import ctypes
import pathlib
import re
import struct
import sys

import numpy

import foam_files as foam

RHO = 1060.0  # of case/system/fvOptions
K_NAME, KU_NAME = "K.aorticValve", "KU.aorticValve"


def require(holds, text):
    if not holds:
        raise SystemExit(f"check.py: this does not hold: {text}")


def constant(case, key):
    """Reads a number of the valve from a case's fvOptions."""
    path = pathlib.Path(case) / "system/fvOptions"
    found = re.search(rf"{key}\s+(\S+?);", foam.text(path))
    if not found:
        raise SystemExit(f"{path} has no entry {key}")
    return float(found.group(1))


def flat_drop(case, flow):
    """Returns (R / eps) u in Pa, and the area of the leaflets."""
    leaflets = sorted(pathlib.Path(case).glob("postProcessing/aorticValve/*/leaflets.vtk"))
    if not leaflets:
        raise SystemExit(f"{case} has no file postProcessing/aorticValve/*/leaflets.vtk")
    size = foam.area(*foam.triangles(leaflets[-1])[:2])
    return constant(case, "resistance") / constant(case, "halfThickness") * flow / size, size


def marks(serial, *others):
    """Compares the marked cells and K of runs on several ranks, by the global ids of the cells."""
    centres = foam.global_field(serial, "0", "C")
    times = foam.times(serial)
    require(len(times) > 3, f"{serial} has written more than three steps, not {times}")
    print(f"An opening valve in {len(centres):,} cells, every step written. Cells are compared with those of 1 rank by their"
          " global ids.\nTimes are medians of a step: that of the library on the slowest rank, and the processor time of a"
          " whole step of a rank.")
    print(f"  {'ranks':>5} {'steps':>5} {'marked':>13} {'library':>9} {'step':>7} {'same marks':>10} {'centres with':>13}"
          f" {'K with':>10} {'these with':>13} {'largest difference':>21}")
    print(f"  {'':>5} {'':>5} {'':>13} {'':>9} {'':>7} {'':>10} {'other bits':>13} {'other bits':>10} {'equal centres':>13}"
          f" {'of K':>10} {'K U_valve':>10}")
    for case in (serial,) + others:
        n_ranks = len(foam.parts(case))
        require(foam.times(case) == times, f"{case} has the times {times}, not {foam.times(case)}")
        others_centres = foam.global_field(case, "0", "C")
        require(len(others_centres) == len(centres), f"{case} has {len(centres)} cells as {serial}, not {len(others_centres)}")
        moved = (others_centres != centres).any(axis=1)
        same, different, unexplained, largest, counts = True, 0, 0, {K_NAME: 0.0, KU_NAME: 0.0}, []
        for time in times:
            for name in (K_NAME, KU_NAME):
                here, there = (foam.global_field(folder, time, name).reshape(len(centres), -1) for folder in (serial, case))
                bits = (here != there).any(axis=1)
                unexplained += int((bits & ~moved).sum())
                largest[name] = max(largest[name], float(numpy.abs(here - there).max() / numpy.abs(here).max()))
                if name == K_NAME:
                    counts.append(int((here > 0).sum()))
                    same = same and bool(((here > 0) == (there > 0)).all())
                    different += int(bits.sum())
        require(min(counts) > 100 and max(counts) != min(counts), f"the valve moves through cells: {counts} are marked")
        library, whole = numpy.median(foam.steps(case)[1:, 4:6], axis=0)
        print(f"  {n_ranks:>5} {len(times):>5} {min(counts):>6,}-{max(counts):<6,} {1e3 * library:>6.2f} ms"
              f" {1e3 * whole:>4.0f} ms {'yes' if same else 'no':>10} {moved.sum():>13,} {different:>10,} {unexplained:>13,}"
              f" {largest[K_NAME]:>10.1e} {largest[KU_NAME]:>10.1e}")
        require(same, f"{case} marks the cells that {serial} marks")
        require(unexplained == 0, f"cells whose centres have the same bits have the same K, not {unexplained} others")
        for name, difference in largest.items():
            require(difference < 1e-9, f"{name} differs by at most 1e-9 of its largest value, not {difference:.1e}")


def zones(closed, case, model):
    """Divides the cells into zones of nearly equal K, and writes OpenFOAM's own porosity for these zones into case."""
    levels = 200
    k = foam.global_field(closed, foam.times(closed)[-1], K_NAME)
    n = len(k)
    require((k >= 0).all() and (k > 0).any(), f"K of {closed} is at least 0, and not 0 in every cell")
    level = numpy.minimum((k / k.max() * levels).astype(int), levels - 1)
    head = "FoamFile {{ version 2.0; format ascii; class {}; object {}; }}\n"
    nu = 3.3e-6  # of case/constant/transportProperties
    axes = "coordinateSystem { origin (0 0 0); e1 (1 0 0); e2 (0 1 0); }"
    lines, options = [], []
    used = [i for i in range(levels) if ((level == i) & (k > 0)).any()]
    for i in used:
        cells = numpy.flatnonzero((level == i) & (k > 0))
        mean = k[cells].mean() / RHO
        lines.append(f"zone{i} {{ type cellZone; cellLabels List<label> {len(cells)}({' '.join(map(str, cells))}); }}\n")
        if model == "powerLaw":  # the force is C0 |U|^(C1 - 1) U
            numbers = f"powerLawCoeffs {{ C0 {mean:.17g}; C1 1; {axes} }}"
        else:  # the force is nu d U
            d = f"{mean / nu:.17g}"
            numbers = f"DarcyForchheimerCoeffs {{ d ({d} {d} {d}); f (0 0 0); {axes} }}"
        options.append(f"zone{i} {{ type explicitPorositySource; explicitPorositySourceCoeffs {{ selectionMode cellZone;"
                       f" cellZone zone{i}; type {model}; {numbers} }} }}\n")
    case = pathlib.Path(case)
    (case / "constant/polyMesh/cellZones").write_text(
        head.format("regIOobject", "cellZones") + f"{len(used)}\n(\n{''.join(lines)})\n")
    (case / "system/fvOptions").write_text(head.format("dictionary", "fvOptions") + "".join(options))
    print(f"{n} cells, {int((k > 0).sum())} with K, {len(used)} zones")


def drop(case):
    """Returns the pressure drop over the valve in each step, in Pa, and the flow of the last step."""
    upstream, downstream = foam.table(case, "upstream"), foam.table(case, "downstream")
    require(upstream[:, 0].tolist() == downstream[:, 0].tolist(),
            f"the tables upstream and downstream of {case} have the same times")
    return RHO * (upstream[:, 1] - downstream[:, 1]), foam.table(case, "flow")[-1, 1]


def drops(cases):
    """Compares the drop across the closed valve with OpenFOAM's porosity and with (R / eps) u."""
    cases = pathlib.Path(cases)
    closed, flow = drop(cases / "closed")
    flat, size = flat_drop(cases / "closed", flow)
    print(f"A steady flow of {flow * 1e6:.2f} ml/s from rest, 0.1 m/s at the inlet. The closed leaflets have"
          f" {size * 1e4:.3f} cm2.\nDrop in Pa between sections below and above the valve:")
    print(f"  {'':<34} {'1st step':>10} {'2nd step':>10} {'last step':>10} {'of riis':>9}")
    last = {}
    for name, text in (("closed", "closed valve, riis"), ("aside", "closed valve, band beside it"),
                       ("powerLaw", "OpenFOAM's powerLaw porosity"),
                       ("DarcyForchheimer", "OpenFOAM's DarcyForchheimer"), ("open", "open valve, riis"), ("none", "no valve")):
        values, _ = drop(cases / name)
        require(len(values) == 10, f"{name} has 10 steps, not {len(values)}")
        last[name] = values[-1]
        print(f"  {text:<34} {values[0]:>10.1f} {values[1]:>10.1f} {values[-1]:>10.1f} {100 * values[-1] / closed[-1]:>8.2f}%")
    print(f"  {'(R / eps) u, u = flow / area':<34} {flat:>10.1f} {flat:>10.1f} {flat:>10.1f} {100 * flat / closed[-1]:>8.2f}%")
    for name, text in (("closed", "The log"), ("aside", "For a band beside the leaflets, the log")):
        inside, share, _ = estimate(cases / name)
        measured = last[name] / flat * inside / size  # u is the flow through the leaflets inside the mesh
        print(f"{text} expects {share:.3f} of (R / eps) u, for the {1e4 * inside:.3f} cm2 inside the mesh."
              f" Measured: {measured:.3f}")
        require(abs(share / measured - 1) < 0.03,
                f"{name}: the log expects the measured drop to 3 %: {share:.4f} and {measured:.4f}")
    require(abs(last["powerLaw"] / closed[-1] - 1) < 5e-3,
            f"OpenFOAM's powerLaw porosity and riis give the same drop to 0.5 %: {last['powerLaw']:.1f} and {closed[-1]:.1f} Pa")
    require(abs(closed[1] / closed[-1] - 1) < 0.05,
            f"the second step has the drop of the last one to 5 %: {closed[1]:.1f} and {closed[-1]:.1f} Pa")
    require(0.4 < closed[-1] / flat < 1.1, f"the drop is between 0.4 and 1.1 of (R / eps) u: it is {closed[-1] / flat:.3f} of it")
    require(abs(last["open"] - last["none"]) < 1e-3 * abs(closed[-1]),
            f"the open valve and no valve differ by less than 0.1 % of the closed one:"
            f" {last['open']:.1f} and {last['none']:.1f} Pa")


def sizes(*cases):
    """Compares the drop of the closed valve with (R / eps) u, in meshes of several sizes."""
    print("The closed valve in finer meshes. h is the cube root of the mean volume of a cell.")
    print(f"  {'edges, cm':>9} {'cells':>9} {'marked':>8} {'eps / h':>8} {'drop / ((R / eps) u)':>20}")
    shares = []
    for case in sorted(map(pathlib.Path, cases), key=lambda path: -float(path.name.split("-")[1])):
        values, flow = drop(case)
        n = foam.n_cells(case / "constant/polyMesh")
        log = case.parent.parent / case.name.replace("closed", "mesh") / "checkMesh.log"
        volume = re.search(r"Total volume = ([0-9.e+-]+?)\.? ", foam.text(log))
        if not volume:
            raise SystemExit(f"{log} has no Total volume")
        shares.append(values[-1] / flat_drop(case, flow)[0])
        cells = constant(case, "halfThickness") / (float(volume.group(1)) / n) ** (1 / 3)
        print(f"  {case.name.split('-')[1]:>9} {n:>9,} {int(foam.steps(case)[-1, 2]):>8,} {cells:>8.2f} {shares[-1]:>20.3f}")
    require(all(a < b for a, b in zip(shares, shares[1:])) and shares[-1] < 1.05,
            f"finer meshes come nearer to (R / eps) u: they have {', '.join(f'{share:.3f}' for share in shares)} of it")


def hexahedra(*ratios):
    """Prints the drop across a flat closed leaflet divided by (R / eps) u, for each eps / h. The leaflet is parallel to faces of
    hexahedra, and is tried at many places between two faces. On a face, 1/K is the mean of 1/K in the two cells."""
    places = numpy.linspace(0, 1, 201)
    for ratio in map(float, ratios):
        shares = layers(numpy.arange(-int(ratio) - 2, int(ratio) + 3)[:, None] + places, ratio)
        print(f"  eps / h {ratio:<5g} drop / ((R / eps) u) {shares.min():.3f} to {shares.max():.3f}")


def estimate(case):
    """Returns three numbers of the closed valve from the plug-in's log: area in the mesh, drop divided by (R / eps) u, factor of
    K (or 1)."""
    log = foam.text(pathlib.Path(case) / "log.pimpleFoam")
    found = re.search(r"the closed valve has (\S+) m2 in the mesh, and is expected to drop (\S+) of \(R / eps\) u,"
                      r" u = flow / area(?:\. K is multiplied by (\S+))?", log)
    require(found, f"{case}/log.pimpleFoam has the expected drop")
    return tuple(float(word or 1) for word in found.groups())


def expected(*cases):
    """Compares the expected drops of closed flat leaflets in a duct with the solver's drops, without calibration and with it."""
    print("A closed flat leaflet in a duct. Drops are over (R / eps) u. h is the cube root of the mean volume of a cell.")
    print(f"  {'cells':<10} {'leans':>5} {'eps / h':>8} {'dt, ms':>6} {'expected':>9} {'measured':>9} {'difference':>10}"
          f" {'factor':>7} {'calibrated':>10}")
    require(len(cases) == 12, f"there are 12 cases, not {len(cases)}")
    for case in sorted(map(pathlib.Path, cases)):
        mesh, half, step, degrees = case.name.split("-")[1:5]
        area = 0.008 ** 2 / numpy.cos(numpy.radians(float(degrees)))
        measured = {}
        for calibrate in ("no", "yes"):
            run = case.parent / case.name.replace("-no", f"-{calibrate}")
            pressure, inflow = foam.table(run, "pressure"), foam.table(run, "inflow")
            require(len(pressure) == len(inflow) == 10, f"{run} has 10 steps, not {len(pressure)}")
            flat = constant(run, "resistance") / constant(run, "halfThickness") * -inflow[-1, 1] / area
            measured[calibrate] = RHO * pressure[-1, 1] / flat
            size, share, factor = estimate(run)
            require(abs(size / area - 1) < 0.01, f"{run} has a leaflet of {1e6 * area:.2f} mm2: {1e6 * size:.2f}")
        eps = constant(case, "halfThickness")
        if mesh == "cubes" and degrees == "0":
            form = layers((numpy.arange(-12, 12) + 0.5) * 1e-3 - 0.0003, eps)
            require(abs(share / form - 1) < 0.01, f"{case} expects the sum of harmonic means, {form:.4f}, not {share:.4f}")
        h = (0.008 ** 2 * 0.024 / foam.n_cells(case / "constant/polyMesh")) ** (1 / 3)
        print(f"  {mesh:<10} {degrees:>5} {eps / h:>8.2f} {step:>6} {share:>9.3f} {measured['no']:>9.3f}"
              f" {share / measured['no'] - 1:>10.2%} {factor:>7.3f} {measured['yes']:>10.3f}")
        require(abs(share / measured["no"] - 1) < 0.03, f"{case}: the expected drop is the measured one to 3 %")
        require(abs(measured["yes"] - 1) < 0.02,
                f"{case}: the calibrated drop is (R / eps) u to 2 %: {measured['yes']:.3f} of it")


    first, again = cases_of_factor(cases[0])
    factor = estimate(first)[2]
    text = foam.text(again / "log.pimpleFoam")
    require(f"K is multiplied by {factor:g}, as before" in text and "is expected to drop" not in text,
            f"the restart {again} keeps the factor {factor:g} without a new estimate")
    before, after = (foam.global_field(case, foam.times(case)[-1], K_NAME) for case in (first, again))
    require(before.max() > 0 and (before == after).all(), f"K of the restart {again} has the same bits")
    print(f"A restart keeps the factor {factor:g}, and K has the same bits.")
    for ranks in (2, 4):
        case = first.parent / f"factor-ranks-{ranks}"
        require(len(foam.parts(case)) == ranks, f"{case} has {ranks} ranks")
        other, k = estimate(case)[2], foam.global_field(case, foam.times(first)[-1], K_NAME)
        require(((k > 0) == (before > 0)).all(), f"{case} has the marks of 1 rank")
        worst = numpy.abs(k - before).max() / before.max()
        print(f"  {ranks} ranks: factor {other:g}. K differs by {worst:.1e} of the largest.")
        require(worst < 1e-3, f"{case} has the K of 1 rank to 1e-3 of the largest: {worst:.1e}")


def cases_of_factor(case):
    """Returns the calibrated case that is restarted, and the restarted case."""
    folder = pathlib.Path(case).parent
    return folder / "expected-cubes-2-1-20-yes", folder / "factor-restart"


def layers(heights, eps):
    """Returns the drop of a flat leaflet at height 0, divided by (R / eps) u. Layers of cells have their centres at the
    given heights. On a face, 1/K is the mean of 1/K in the two cells."""
    k = numpy.where(abs(heights) < eps, (1 + numpy.cos(numpy.pi * heights / eps)) / (2 * eps), 0)
    k = numpy.maximum(k, 1e-30 / eps)
    return (2 / (1 / k[1:] + 1 / k[:-1])).sum(axis=0) * (heights[1] - heights[0])[()]


def tables(case, again):
    """Checks a valve's table and its restart in a heartbeat, against the log and OpenFOAM's own tables."""
    rows, flow, log = valve_table(case, "valve"), foam.table(case, "flow"), foam.steps(case)
    require(len(rows["Time"]) == len(flow) == len(log), f"the table of {case} has a row for each step: {len(rows['Time'])}")
    dt = flow[1, 0] - flow[0, 0]

    def same(what, values, others, share=2e-5):
        scale = numpy.abs(others).max()
        worst = numpy.abs(values - others).max() / scale
        require(scale > 0 and worst < share, f"the table of {case} has {what} to {share:g} of the largest: {worst:.1e}")
        print(f"  {what:<58} {worst:.1e}")

    print("The valve's table in a heartbeat. The largest difference, over the largest value:")
    same("the opening of the log", rows["opening"], log[:, 1])
    same("the flow of OpenFOAM's table", rows["flow"], flow[:, 1])
    text = foam.text(pathlib.Path(case) / "log.pimpleFoam")
    next_ones = numpy.array(re.findall(r"pressure difference (\S+) Pa, flow (\S+) m3/s", text), float)
    same("the pressure difference that the law has a step later", rows["pressure_difference"][:-1], next_ones[1:, 0])
    beat_of = numpy.floor((flow[:, 0] - dt / 2) / 0.3)
    for name, sign in (("forward_volume", 1), ("regurgitant_volume", -1)):
        each = numpy.maximum(sign * flow[:, 1], 0) * dt
        total = numpy.concatenate([numpy.cumsum(each[beat_of == i]) for i in numpy.unique(beat_of)])
        same(f"the {name.replace('_', ' ')} since the beat began", rows[name], total)
    leaflets = [rows[f"force_{i}"] for i in range(3)]
    same("the force of the log, as the sum over leaflets", sum(leaflets), forces(case)[:, 1:])
    other = valve_table(case, "shifted")
    shift = numpy.array([0.01, 0.02, 0.03])
    for i in range(3):
        same(f"the moment about another point, leaflet {i}", rows[f"moment_{i}"] - numpy.cross(shift, leaflets[i]),
             other[f"moment_{i}"])
    driven = (rows["flow"] > 0) & (rows["pressure_difference"] > 0)
    area = numpy.where(driven, rows["flow"] / numpy.sqrt(2 * numpy.abs(rows["pressure_difference"]) / RHO), 0)
    same("the effective area flow / sqrt(2 dp / rho)", rows["effective_area"], area, 1e-4)
    closed, opened = (rows["orifice_area"][numpy.isclose(rows["opening"], i)] for i in (0, 1))
    require(len(closed) and len(opened) and closed.max() < 0.01 * opened.min(), f"{case} has an orifice when open, not closed")
    require((rows["band_free_area"] <= rows["orifice_area"]).all(), f"in {case} the band leaves at most the orifice free")
    continued = valve_table(again, "valve")
    start = len(rows["Time"]) - sum(rows["Time"] > continued["Time"][0] - dt / 2)
    end = start + len(continued["Time"])
    require(len(continued["Time"]) > 5, f"the restart {again} has a table")
    for name in ("opening", "forward_volume", "regurgitant_volume"):
        same(f"after the restart: {name.replace('_', ' ')}", continued[name], rows[name][start:end])


def valve_table(case, name):
    """Returns the columns of a table of a valve, with three numbers for each force and moment."""
    paths = sorted(pathlib.Path(case).glob(f"postProcessing/{name}/*/riisValve.dat"))
    require(len(paths) == 1, f"{case} has one file postProcessing/{name}/*/riisValve.dat")
    lines = foam.text(paths[0]).splitlines()
    names = [line for line in lines if line.startswith("# Time")][0][1:].split()
    rows = numpy.array([line.replace("(", "").replace(")", "").split() for line in lines if not line.startswith("#")], float)
    require(numpy.isfinite(rows).all(), f"{paths[0]} has finite numbers")
    columns, at = {}, 0
    for column in names:
        wide = 3 if column.startswith(("force", "moment")) else 1
        columns[column] = rows[:, at:at + wide] if wide > 1 else rows[:, at]
        at += wide
    require(at == rows.shape[1], f"{paths[0]} has a number for each column: {rows.shape[1]}, not {at}")
    return columns


def beat(*cases):
    """Checks the heartbeat with and without the leaflets' velocity."""
    print("A heartbeat by pressure: the valve opens when the pressure difference exceeds 0, and closes when the flow reverses.")
    print(f"  {'':<22} {'opens at':>9} {'closes at':>9} {'least K cells':>13} {'largest flow':>13} {'least flow':>11} {'out':>8}"
          f" {'back':>8} {'library':>9} {'step':>7} {'share':>6}")
    for case in cases:
        name = "with their velocity" if not str(case).endswith("still") else "without it"
        rows, flow = foam.steps(case), foam.table(case, "flow")
        opening, q = rows[:, 1], flow[:, 1] * 1e6
        require(len(rows) == len(flow) > 2,
                f"the log and the table flow of {case} have a row for each step: {len(rows)} and {len(flow)}")
        dt = flow[1, 0] - flow[0, 0]
        rising, falling = numpy.diff(opening) > 0, numpy.diff(opening) < 0
        require(rising.any() and falling.any(), f"the valve of {case} opens and closes: its opening is {opening[0]} at first,"
                f" {opening.max()} at most and {opening[-1]} at the end")
        require(opening.max() > 0.999 and opening[-1] == 0, f"the valve of {case} opens fully and ends closed: its opening is"
                f" {opening.max()} at most and {opening[-1]} at the end")
        library, whole = rows[1:, 4].mean(), rows[1:, 5].mean()
        print(f"  {name:<22} {rows[:-1][rising][0, 0]:>7.3f} s {rows[:-1][falling][0, 0]:>7.3f} s {int(rows[:, 2].min()):>13,}"
              f" {q.max():>8.1f} ml/s {q.min():>6.1f} ml/s {q[q > 0].sum() * dt:>5.2f} ml {-q[q < 0].sum() * dt:>5.2f} ml"
              f" {1e3 * library:>6.2f} ms {1e3 * whole:>4.0f} ms {100 * library / whole:>5.2f}%")
        leak = q[(rows[:, 0] > 0.002) & (rows[:, 0] < 0.02)]
        require(len(leak), f"{case} has steps between 0.002 and 0.02 s, while the valve is closed")
        require(abs(leak).max() < 0.02 * q.max(), f"the closed valve of {case} lets less than 2 % of the largest flow through:"
                f" {abs(leak).max():.2f} of {q.max():.1f} ml/s")


def differences(first, second, time, fields):
    """Compares fields of two runs. K must have the same bits, and other fields may differ by 1e-6. Returns a text with the
    differences."""
    words = []
    for field in fields:
        a, b = foam.global_field(first, time, field), foam.global_field(second, time, field)
        require(len(a) == len(b), f"{first} and {second} have as many cells: {len(a)} and {len(b)}")
        require((a != 0).any(), f"{field} of {first} at {time} is not 0 in every cell")
        difference = numpy.abs(a - b).max() / numpy.abs(a).max()
        words.append(f"{field} {'the same bits' if (a == b).all() else f'differs by {difference:.1e}'}")
        if field in (K_NAME, KU_NAME):
            cells = int((a != b).reshape(len(a), -1).any(axis=1).sum())
            require(cells == 0, f"{field} at {time} has the same bits in {first} and {second}: {cells} cells differ")
        require(difference < 1e-6, f"{field} of {second} at {time} differs by less than 1e-6 of the largest: {difference:.1e}")
    return ", ".join(words)


def restart(whole, again, none, none_again):
    """Compares a restart of the heartbeat with the uninterrupted run. Also compares a restart of a flow without a valve."""
    print("A restart on 2 ranks while the valve closes, against the run that went on:")
    for name, first, second, fields in (("with the valve", whole, again, (K_NAME, KU_NAME, "p", "U")),
                                        ("without a valve", none, none_again, ("p", "U"))):
        times = [time for time in foam.times(second) if float(time) > 0.2001]
        require(len(times) == 2, f"{second} has written two times after its start, not {times}")
        for time in times:
            print(f"  {name:<16} {time:>6} s: {differences(first, second, time, fields)}")


def model(*cases):
    """Compares flows of the plug-in for the Foundation's OpenFOAM with flows of riisValve and riisSource."""
    print("The plug-in for the Foundation's OpenFOAM with a stand-in for its fvModel, against riisValve and riisSource:")
    for case in cases:
        time, again = foam.times(case)[-1], f"{case}-model"
        require(foam.times(again)[-1] == time, f"{again} ends at {time}, not at {foam.times(again)[-1]}")
        print(f"  {pathlib.Path(case).name:<24} {time:>6} s: {differences(case, again, time, (K_NAME, 'p', 'U'))}")


def nan(pressure, owner):
    """Puts NaN into every cell of a pressure that is uniform in its file."""
    count = foam.n_cells(pathlib.Path(owner).parent)
    data = pathlib.Path(pressure).read_bytes()
    values = b"nonuniform List<scalar> %d(" % count + struct.pack("<d", float("nan")) * count + b")"
    old = b"internalField uniform 0;"
    require(data.count(old) == 1, f"{pressure} has the line '{old.decode()}' once")
    binary = data.replace(b"format ascii;", b'format binary; arch "LSB;label=32;scalar=64";')
    pathlib.Path(pressure).write_bytes(binary.replace(old, b"internalField " + values + b";"))


def forces(case):
    """Returns the time and the force of the flow on the valves in each step, (n, 4). The force comes from the last pressure
    corrector. The forces of several valves are added."""
    logs = sorted(pathlib.Path(case).glob("log.p*Foam"))
    if not logs:
        raise SystemExit(f"{case} has no log.p*Foam")
    rows = []
    for block in re.split(r"\nTime = ", foam.text(logs[-1]))[1:]:
        last = dict(re.findall(r"riis (\w+): force of the flow \((.*?)\) N", block))
        require(last, f"{logs[-1]} has the force in the step of time {block.split()[0]}")
        values = [[float(word) for word in text.split()] for text in last.values()]
        rows.append([float(block.split()[0]), *numpy.sum(values, axis=0)])
    rows = numpy.array(rows)
    require(len(rows) > 3 and numpy.isfinite(rows).all(), f"{logs[-1]} has more than three steps, and finite forces")
    return rows


def swept(library, kind, opening):
    """Returns the volume in m3 that a kind of valve sweeps from opening 0 to an opening, by the library that the plug-in uses.
    The sizes of the valve are in centimetres."""
    riis = ctypes.CDLL(library)
    valve, volume = ctypes.c_void_p(), ctypes.c_double()
    require(riis.riis_valve_create(kind.encode(), ctypes.byref(valve)) == 0, f"{library} makes a {kind} valve")
    all_leaflets = -1
    status = riis.riis_valve_get_swept_volume(valve, ctypes.c_double(0), ctypes.c_double(opening), None, all_leaflets,
                                              ctypes.byref(volume))
    riis.riis_valve_destroy(ctypes.byref(valve))
    require(status == 0, f"{library} gives the volume that the {kind} valve sweeps to opening {opening:g}")
    return 1e-6 * volume.value


def moving(cases, library):
    """Checks forces, volumes and jets of moving valves, with riisSource and without it."""
    cases = pathlib.Path(cases)
    opens = [f"{mesh}-{solver}" for mesh in ("hexahedra-28", "hexahedra-32", "tetrahedra", "box-28", "box-32")
             for solver in ("PCG", "riisSource")]
    print("The valve opens in 40 ms between equal pressures, in closed boxes from opening 0.3. The largest forces, in N, and the"
          " same for Fz later than 20 ms. Symmetry demands 0 across:")
    print(f"  {'':<24} {'across':>7} {'Fz up':>7} {'Fz down':>8} {'|Fz| later':>10}")
    across, later = {}, {}
    for name in opens:
        rows = forces(cases / name)
        require(len(rows) == 40, f"{name} has 40 steps, not {len(rows)}")
        across[name] = numpy.hypot(rows[:, 1], rows[:, 2]).max()
        later[name] = abs(rows[rows[:, 0] > 0.0201, 3]).max()
        print(f"  {name:<24} {across[name]:>7.3f} {rows[:, 3].max():>7.3f} {rows[:, 3].min():>8.3f} {later[name]:>10.3f}")
    for name in opens:
        if name.endswith("riisSource"):
            require(across[name] < 0.1, f"{name}: the force across is less than 0.1 N: {across[name]:.3f}")
            require(later[name] < 0.15, f"{name}: |Fz| is less than 0.15 N after 20 ms: {later[name]:.3f}")
        else:
            require(later[name] > 0.15, f"{name}: |Fz| after 20 ms is what riisSource cures: {later[name]:.3f} N")

    print("The same, by other ranks, solvers and valves. The largest difference of a force from that of 1 rank:")
    # Corrections for edges that are not orthogonal to faces do not converge within a step, so the results on tetrahedra differ
    # more.
    for first, share, names in (("hexahedra-28-riisSource", 1e-3, ("ranks-2", "ranks-4", "two-valves", "pisoFoam")),
                                ("tetrahedra-riisSource", 1e-2, ("tetrahedra-ranks-2", "tetrahedra-ranks-4"))):
        whole = forces(cases / first)
        largest_force = abs(whole[:, 1:]).max()
        for name in names:
            rows = forces(cases / name)
            require(rows.shape == whole.shape, f"{name} has {len(whole)} steps, not {len(rows)}")
            largest = abs(rows - whole).max()
            print(f"  {name:<24} {largest:.1e} N")
            require(largest < share * largest_force,
                    f"{name} has the forces of {first} to {share:g} of the largest, {largest_force:.3f} N: {largest:.1e}")
    still = [forces(cases / f"rest-{solver}") for solver in ("PCG", "riisSource")]
    require((still[0] == still[1]).all() and abs(still[0][-1, 3]) > 0.01,
            f"a valve at rest has the same force, not 0, with riisSource and without: {still[0][-1, 3]} and {still[1][-1, 3]} N")
    print(f"  {'a valve at rest':<24} {0:.1e} N")

    stroke = 0.48 * numpy.tan(numpy.radians(1))  # of the plate in the middle of the duct
    print(f"A plate moves by {1e3 * stroke:.3f} mm in a duct of 1 cm2. Volume at inlet and outlet, in ml, and their mean:")
    for name in (f"plate-{n}-{solver}" for n in (10, 20) for solver in ("PCG", "riisSource")):
        inlet, outlet = (foam.table(cases / name, function) for function in ("inflow", "outflow"))
        require(len(inlet) == len(outlet) == 40, f"{name} has 40 steps, not {len(inlet)} and {len(outlet)}")
        volume_in, volume_out = -1e-3 * inlet[:, 1].sum(), 1e-3 * outlet[:, 1].sum()
        share = (volume_in + volume_out) / 2 / (1e-4 * stroke)
        print(f"  {name:<24} {1e6 * volume_in:.5f} {1e6 * volume_out:.5f}: {100 * share:.3f} % of area times stroke")
        require(abs(share - 1) < 0.01, f"{name}: the mean volume is area times stroke to 1 %: {share:.5f} of it")

    print("While the bands of the cusps touch, until the opening is 0.25. Mean volume of inlet and outlet, in ml, and its share"
          " of the volume that the leaflets sweep:")
    for name in opens[:4]:
        inlet, outlet = (foam.table(cases / name, function)[:, 1] for function in ("inflow", "outflow"))
        opening = foam.steps(cases / name)[:, 1]
        require(len(inlet) == len(outlet) == len(opening) == 40, f"{name} has 40 steps, not {len(inlet)} and {len(outlet)}")
        touch = opening <= 0.25
        volume = 1e-3 * (outlet[touch].sum() - inlet[touch].sum()) / 2
        share = volume / swept(library, "trileaflet", opening[touch][-1])
        print(f"  {name:<24} {1e6 * volume:.3f}: {100 * share:.1f} % of the swept volume")
        if name.endswith("riisSource"):
            require(abs(share - 1) < 0.15, f"{name}: the mean volume is the swept volume to 15 %: {share:.3f} of it")

    print("A pressure opens the valve. The largest upward speed of all cells while it opens, in m/s. v is sqrt(2 dp / rho), with"
          " the largest pressure difference since the opening began:")
    for name in (f"jet-{n}-{solver}" for n in (28, 32) for solver in ("PCG", "riisSource")):
        opening = foam.steps(cases / name)[:, 1]
        below, above = foam.table(cases / name, "below"), foam.table(cases / name, "above")
        jet = up(cases / name, "fastest")
        moves = (opening > 0) & (numpy.r_[0, opening[:-1]] < 0.999)
        require(moves.any() and opening[-1] > 0.999, f"the valve of {name} opens: its opening is {opening[-1]} at the end")
        speed = numpy.sqrt(2 * numpy.maximum.accumulate(numpy.where(moves, below[:, 1] - above[:, 1], 0)))
        most = (jet[moves] / speed[moves]).max()
        print(f"  {name:<24} {jet[moves].max():.2f}, {most:.2f} v")
        if name.endswith("riisSource"):
            require(most < 1.05, f"{name}: the jet is at most 1.05 v: {most:.3f}")
        else:
            require(most > 1.05, f"{name}: the jet is what riisSource cures, above 1.05 v: {most:.3f}")


def up(case, function):
    """Returns the upward component of the velocity that a function object has written, in each step."""
    paths = sorted(pathlib.Path(case).glob(f"postProcessing/{function}/*/*FieldValue.dat"))
    found = re.findall(r"^[0-9.e-]+\s+\(\S+ \S+ (\S+)\)", foam.text(paths[0]) if paths else "", re.MULTILINE)
    require(found, f"{case} has velocities in a file postProcessing/{function}/*/*FieldValue.dat")
    return numpy.array(found, float)


def pictures(case, still, out):
    import draw
    draw.beat(case, still, pathlib.Path(out) / "beat.png")
    draw.velocity(case, pathlib.Path(out) / "velocity.png")


def follow(cases):
    import follow as checks
    checks.follow(cases)


def angle(case, again):
    import follow as checks
    checks.angle(case, again)


def physiological(case):
    import heartbeats as checks
    checks.physiological(case)


if __name__ == "__main__":
    commands = {"marks": marks, "zones": zones, "drops": drops, "sizes": sizes, "hexahedra": hexahedra, "expected": expected,
                "moving": moving, "tables": tables, "physiological": physiological, "follow": follow, "angle": angle,
                "beat": beat, "restart": restart, "model": model, "nan": nan, "pictures": pictures}
    if len(sys.argv) < 3 or sys.argv[1] not in commands:
        raise SystemExit(f"usage: check.py {'|'.join(commands)} ARGUMENT...")
    commands[sys.argv[1]](*sys.argv[2:])
