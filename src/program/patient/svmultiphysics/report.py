#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""report.py RESULTS: prints a table of the last beat of a run of solver.xml, and what it should be, and writes report.txt.

RESULTS is a folder such as 1-procs. A continued run writes some steps again, and the later ones count. It ends with 1 if a value
is not as it should be, and with 2 if the beat is not complete.
"""
import base64
import pathlib
import re
import struct
import sys
import xml.etree.ElementTree as xml
import zlib

from beat_table import beat_table, save_and_print

HERE = pathlib.Path(__file__).resolve().parent
PASCALS, CUBIC_METRES = 0.1, 1e-6  # in a dyn/cm2, and in a cm3


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

    Each step of a motion shows the next frame, so a file with a frame in the middle tells when the motion began. A motion that no
    file shows counts as if it ended at the next file.
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
        found.append(("opens" if is_closed else "closes", step - shown, step + len(frames) - 1 - shown))
        is_closed = not is_closed
    return found


def openings_of(motions, steps, is_closed):
    """Returns the share of frames from closed to open that each step shows, as {step: share}."""
    shares, rest = {}, 0.0 if is_closed else 1.0
    for step in steps:
        before = [motion for motion in motions if motion[1] < step]
        if not before:
            shares[step] = rest
            continue
        word, start, end = before[-1]
        share = min((step - start) / (end - start), 1.0)
        shares[step] = share if word == "opens" else 1.0 - share
    return shares


def steps_of(results, case):
    tree = xml.fromstring(case)
    dt, valve = float(tree.find(".//Time_step_size").text), tree.find("Add_URIS_mesh")
    flows, pressures = (table_of(results / f"B_NS_{name}.txt") for name in ("Velocity_flux", "Pressure_average"))
    if not flows or "inlet" not in flows[max(flows)]:
        sys.exit(f"report.py: {results}/B_NS_Velocity_flux.txt has no face inlet")
    is_closed = valve.find("Valve_starts_as_closed").text.strip() == "true"
    openings = openings_of(motions_of(results, valve, is_closed), sorted(flows), is_closed)
    speeds = {int(path.stem.split("_")[-1]): float(attribute(path, "Velocity", "RangeMax") or "nan") / 100
              for path in results.glob("result_[0-9]*.vtu")}
    area = re.search(r"area of the leaflets in the mesh, ([\d.]+)", case)
    eps, resistance = (float(valve.find(name).text) for name in ("Closed_thickness", "Resistance"))
    steps = []
    for step in sorted(set(flows) & set(pressures)):
        outlets = [p for name, p in pressures[step].items() if name.startswith("outlet")]
        difference = PASCALS * (pressures[step]["inlet"] - sum(outlets) / len(outlets))
        # Blood enters at the inlet. The flow out of the inlet is therefore negative while the valve is open.
        arterial = PASCALS * sum(outlets) / len(outlets) if valve.get("name").startswith("aortic") else None
        steps.append({"time": dt * step, "opening": openings[step], "flow": -CUBIC_METRES * flows[step]["inlet"],
                      "difference": difference, "arterial": arterial, "balance": CUBIC_METRES * sum(flows[step].values()),
                      "fastest": speeds.get(step),
                      "leak": area and -difference / PASCALS * eps * float(area[1]) / resistance * CUBIC_METRES})
    return steps


def main():
    if len(sys.argv) != 2 or not (pathlib.Path(sys.argv[1]) / "B_NS_Velocity_flux.txt").exists():
        sys.exit(f"report.py takes the folder of results, such as 1-procs, but got '{' '.join(sys.argv[1:])}'")
    results = pathlib.Path(sys.argv[1])
    steps = steps_of(results, (HERE / "solver.xml").read_text("utf-8"))
    period = float((HERE / "ventricle.dat").read_text("ascii").split()[-2])  # the time of its last pressure
    text, status = beat_table(steps, period, where="node")
    save_and_print(text + "\npressures are means over the ends, and speeds are those of the written files", HERE)
    print(f"{results} has the pressures and flows of each step. ParaView opens {results}/result_*.vtu")
    return status


if __name__ == "__main__":
    sys.exit(main())
