#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""report.py RESULTS: prints when the valve opens and closes, the volumes, the leak and the balance of a run of solver.xml.

RESULTS is a folder such as 1-procs. A continued run writes some steps again, and the later ones count.
"""
import base64
import pathlib
import re
import struct
import sys
import xml.etree.ElementTree as xml
import zlib

HERE = pathlib.Path(__file__).resolve().parent
DYN_OF_MMHG = 1333.22
REST = 0.05  # the leak is steady so long after the valve has closed [s]


def table_of(path):
    """Returns the values of each face by step: {step: {"inlet": 1.5, ...}}."""
    names, rows = [], {}
    for line in path.read_text("ascii").splitlines():
        words = line.split()
        if words[:2] == ["step", "time"]:
            names = words[2:]
        elif words and words[0].isdigit() and names:
            rows[int(words[0])] = dict(zip(names, map(float, words[2:])))
    return rows


def attribute(path, array, name):
    """Returns an attribute of an array from the head of a .vtu file, or None."""
    head = path.read_bytes()[:4000].decode("latin-1")
    found = re.search(rf'<DataArray[^>]*Name="{array}"[^>]*?{name}="([^"]*)"', head)
    return found[1] if found else None


def coordinates(path):
    """Returns the points of the leaflets in a file of the solver, as a tuple of numbers."""
    data, offset = path.read_bytes(), int(attribute(path, "coordinates", "offset"))
    is_text = b'encoding="base64"' in data
    data = data[data.index(b"_", data.index(b"<AppendedData")) + 1 + offset:]

    def unpacked(start, size):
        if not is_text:
            return data[start:start + size], start + size
        end = start + -(-size // 3) * 4
        return base64.b64decode(data[start:end])[:size], end

    n_blocks = struct.unpack("<I", unpacked(0, 4)[0])[0]
    head, start = unpacked(0, 12 + 4 * n_blocks)
    sizes = struct.unpack(f"<{n_blocks}I", head[12:])
    blocks = unpacked(start, sum(sizes))[0]
    parts = [zlib.decompress(blocks[sum(sizes[:i]):sum(sizes[:i + 1])]) for i in range(n_blocks)]
    whole = b"".join(parts)
    return struct.unpack(f"<{len(whole) // 8}d", whole)


def frames_of(path):
    """Returns the frames of a face's motion, each a list of numbers."""
    words = path.read_text("ascii").split()
    n_frames, n_numbers = int(words[0]), 3 * int(words[1])
    numbers = list(map(float, words[2:]))
    return [numbers[i * n_numbers:(i + 1) * n_numbers] for i in range(n_frames)]


def motions_of(results, valve, is_closed):
    """Returns [(the word, the last step at rest, the step of the last frame), ...] in time.

    Each step of a motion shows the next frame, so a file with a frame in the middle tells when the motion began.
    """
    face = valve.find("Add_URIS_face")
    opening, closing = (frames_of(HERE / face.find(name).text.strip())
                        for name in ("Open_motion_file_path", "Close_motion_file_path"))
    found = []
    for path in sorted(results.glob(f"result_uris_{valve.get('name')}_*.vtu"), key=lambda path: int(path.stem.split("_")[-1])):
        step, points = int(path.stem.split("_")[-1]), coordinates(path)
        frames = opening if is_closed else closing
        away = [sum((a - b)**2 for a, b in zip(frame, points)) for frame in frames]
        shown = away.index(min(away))
        if shown == 0 or found and step <= found[-1][2]:
            continue
        exact = step - shown if shown < len(frames) - 1 else None
        found.append(("opens" if is_closed else "closes", exact, step + len(frames) - 1 - shown))
        is_closed = not is_closed
    return found


def main():
    if len(sys.argv) != 2 or not (pathlib.Path(sys.argv[1]) / "B_NS_Velocity_flux.txt").exists():
        sys.exit(f"report.py takes the folder of results, such as 1-procs, but got '{' '.join(sys.argv[1:])}'")
    results, case = pathlib.Path(sys.argv[1]), (HERE / "solver.xml").read_text("utf-8")
    tree = xml.fromstring(case)
    dt, valve = float(tree.find(".//Time_step_size").text), tree.find("Add_URIS_mesh")
    flows, pressures = (table_of(results / f"B_NS_{name}.txt") for name in ("Velocity_flux", "Pressure_average"))
    if not flows or "inlet" not in flows[max(flows)]:
        sys.exit(f"report.py: {results}/B_NS_Velocity_flux.txt has no face inlet")
    # Blood enters at the inlet, so the inlet's flow is negative while the valve is open.
    flow = {step: -row["inlet"] for step, row in flows.items()}
    forward, back = (dt * sum(max(sign * value, 0) for value in flow.values()) for sign in (1, -1))
    largest = max(flow, key=flow.get)
    motions = motions_of(results, valve, valve.find("Valve_starts_as_closed").text.strip() == "true")
    for word, before, after in motions:
        print(f"the valve {word} {f'from {dt * before:.3f}' if before is not None else 'until at most'} to {dt * after:.3f} s")
    if not motions:
        print("the valve does not move")
    print(f"flow through the inlet: {forward:.1f} ml forward, {back:.1f} ml back"
          + (f" ({100 * back / forward:.1f} %)" if forward > 0 else "")
          + f", at most {flow[largest]:.0f} ml/s at {dt * largest:.3f} s")
    most = max(abs(value) for value in flow.values())
    if most > 0:
        print(f"inflow less outflow, over the largest flow: {max(abs(sum(row.values())) for row in flows.values()) / most:.1e}")
    # The leak needs a valve that has long been closed, and the largest pressures that close it.
    closed_at = 0 if not motions else motions[-1][2] if motions[-1][0] == "closes" else max(flow)
    ends = {step: (row["inlet"] - sum(p for name, p in row.items() if name.startswith("outlet"))
                   / sum(name.startswith("outlet") for name in row)) / DYN_OF_MMHG for step, row in pressures.items()}
    still = [step for step in flow if step * dt > closed_at * dt + REST and ends.get(step, 0) < 0]
    still = [step for step in still if ends[step] < 0.8 * min(ends[s] for s in still)]
    if still:
        found = -sum(flow[step] for step in still) / len(still)
        text = f"leak at {-min(ends[step] for step in still):.0f} mmHg between the ends: {found:.2f} ml/s"
        area = re.search(r"area of the leaflets in the mesh, ([\d.]+)", case)
        if area:
            eps, resistance = (float(valve.find(name).text) for name in ("Closed_thickness", "Resistance"))
            ideal = DYN_OF_MMHG * -sum(ends[step] for step in still) / len(still) * eps * float(area[1]) / resistance
            text += f", {found / ideal:.3f} of the ideal leak"
        print(text)
    speeds = {int(path.stem.split("_")[-1]): float(attribute(path, "Velocity", "RangeMax") or "nan") / 100
              for path in results.glob("result_[0-9]*.vtu")}
    for words, is_wanted in (("while the valve moves", True), ("while it is at rest", False)):
        chosen = [speed for step, speed in speeds.items() if is_wanted == any(
            before is not None and before < step <= after for _, before, after in motions)]
        if chosen:
            print(f"fastest node {words}: {max(chosen):.2f} m/s, in the {len(chosen)} files of it")
    print(f"{results} has the pressures and flows of each step. ParaView opens {results}/result_*.vtu")


if __name__ == "__main__":
    main()
