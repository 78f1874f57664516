#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The program of ./run validate: it computes the rows, draws the plots, and writes the rows' numbers into docs/validation.md.
rows.py describes a row.

validate.py --marks PROGRAM --flow PROGRAM --out FOLDER [--short] [--page FILE] [--reuse]
The status is 1 if a row misses its bar. With --reuse the program computes nothing and reads FOLDER/rows.json."""

import argparse
import datetime
import json
import multiprocessing
import os
import subprocess
import sys
import time

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path.insert(0, os.path.join(ROOT, "bench", "report"))
PAGE = os.path.join(ROOT, "docs", "validation.md")
PLOTS = {
    "stokes": "Effective radius over the half thickness, and c over the cells in it",
    "jets": "Contraction over h, and the jet behind both rims",
}  # fmt: skip
GROUPS = ("stokes", "closed", "jets", "bodyfit", "offset", "clinical")
FIELDS = ("id", "group", "quantity", "reference", "source", "solver", "grids", "order", "extrapolated", "deviation", "bar",
          "note")  # fmt: skip


def compute(library, variant, n_processes, say):
    """Returns {name: result} for all tasks. The longest tasks start first, so the processes end at about the same time."""
    import rows

    tasks = rows.jet_tasks(variant)[::-1] + rows.stokes_tasks(variant)[::-1]
    results, start = {}, time.monotonic()
    with multiprocessing.Pool(n_processes) as pool:
        jobs = [(name, function, (library, *arguments)) for name, function, arguments in tasks]
        for done, (name, result) in enumerate(pool.imap_unordered(_call, jobs), 1):
            results[name] = result
            if done % 10 == 0 or done == len(tasks):
                say(f"{done} of {len(tasks)} flows, {time.monotonic() - start:.0f} s")
    return results


def _call(job):
    name, function, arguments = job
    return name, function(*arguments)


def check_rows(rows, where):
    """Refuses rows that the page cannot show. The check is needed because another program writes the rows of all.json."""
    for number, row in enumerate(rows):
        for field in FIELDS:
            if field not in row:
                raise SystemExit(f"{where}: row {number} ({row.get('id', '?')}) lacks the field {field}")
        if row["group"] not in GROUPS:
            raise SystemExit(f"{where}: row {row['id']} has the group '{row['group']}', which is none of {', '.join(GROUPS)}")
    ids = [row["id"] for row in rows]
    for key in ids:
        if ids.count(key) > 1:
            raise SystemExit(f"{where}: two rows have the id {key}")


def read_committed(path):
    """Returns the content of all.json, {"commit", "machine", "command", "rows"}, or None if the file is missing."""
    if not os.path.exists(path):
        return None
    with open(path, encoding="utf-8") as file:
        found = json.load(file)
    for field in ("commit", "machine", "command", "rows"):
        if field not in found:
            raise SystemExit(f"{path} lacks {field}")
    return found


def machine():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        names = [line.split(":", 1)[1].strip() for line in file if line.startswith("model name")]
    words = ["git", "-C", ROOT, "describe", "--always", "--dirty"]
    commit = subprocess.run(words, capture_output=True, text=True, check=False).stdout
    return {
        "commit": commit.strip() or "unknown", "machine": f"{names[0] if names else 'unknown'}, {os.cpu_count()} processors",
        "date": datetime.date.today().isoformat(),
    }  # fmt: skip


# -------------------------------------------------------------------------------------------------------------------- page


def _text(value, digits=4):
    return "" if value is None else f"{value:.{digits}g}"


def _range(row):
    values = [grid["value"] for grid in row["grids"][-2:]]
    return f"{min(values):.2f} to {max(values):.2f}"


def letters_of(rows):
    """Returns {solver: letter} for the solvers of the rows, or {} if there are fewer than two."""
    solvers = sorted({row["solver"] for row in rows})
    return {solver: chr(ord("a") + at) for at, solver in enumerate(solvers)} if len(solvers) > 1 else {}


def solvers_of(rows):
    """Returns the names of the solvers. If there are several, each name has the letter that the table uses."""
    letters = letters_of(rows)
    return "; ".join(f"({letters[name]}) {name}" for name in letters) or "".join({row["solver"] for row in rows})


def table_of(rows):
    import report_text

    lines, letters = [], letters_of(rows)
    for row in rows:
        deviation = "" if row["deviation"] is None else f"{100 * row['deviation']:+.2f} %"
        if row["bar"] is not None:
            deviation += f" (bar {100 * row['bar']:g} %)" + ("" if abs(row["deviation"]) <= row["bar"] else " **missed**")
        grids = "<br>".join(f"{grid['n']}: {_text(grid['value'])}" for grid in row["grids"])
        lines.append([row["quantity"], f"{_text(row['reference'])}<br>{row['source']}", grids, _text(row["order"], 2),
                      _text(row["extrapolated"]), deviation, *([letters[row["solver"]]] if letters else []),
                      row["note"]])  # fmt: skip
    heads = ["quantity", "reference", "ours", "order", "extrapolated", "deviation", *(["solver"] if letters else []), "note"]
    return report_text.table(heads, [[cell.replace("|", "\\|") for cell in line] for line in lines])


def offsets_of(rows):
    """Returns the short table of the rows of bands with an offset. The table has the deviations of area and drop for each
    opening, half thickness and offset."""
    import report_text

    offsets = sorted({row["offset"] for row in rows})
    cell = {(row["valve"], row["opening"], row["eps"], row["offset"]):
            f"{100 * row['deviation']:+.1f} % ({100 * row['drop']:+.0f} %)" for row in rows}  # fmt: skip
    order = sorted({key[:3] for key in cell}, key=lambda key: (key[0] != "trileaflet", key[0], -key[1], -key[2]))
    lines = [[valve, f"{opening:g}", f"{1e3 * eps:g} mm", *(cell.get((valve, opening, eps, offset), "") for offset in offsets)]
             for valve, opening, eps in order]  # fmt: skip
    return report_text.table(["valve", "opening", "ε", *(f"o = {offset:g}" for offset in offsets)], lines)


def page_values(rows, about, committed, plots):
    """Returns the values that fill the marked places (`<!--=name-->`) of docs/validation.md."""
    import report_text

    by_id = {row["id"]: row for row in rows}
    values = {"command": "`./run validate --short`" if about["short"] else "`./run validate`", **about}
    values.update({f"{name}_plot": f"![{title}](validation-{name}.png)" for name, title in PLOTS.items() if plots})
    for group in GROUPS:
        chosen = [row for row in rows if row["group"] == group]
        values[group + "_table"] = table_of(chosen) if chosen else None
        values[group + "_solvers"] = report_text.wrapped(f"Solvers: {solvers_of(chosen)}.") if chosen else None
        values[group + "_commits"] = " and ".join(dict.fromkeys(row["commit"] for row in chosen if "commit" in row)) or None
        if group == "offset":
            steady = [row for row in chosen if "offset" in row]
            values["offsets_table"] = offsets_of(steady) if steady else None
    for kind in ("hole", "disc"):
        for rim in ("round", "cut"):
            row = by_id[f"c_{kind}_{rim}"]
            values[f"c_{kind}_{rim}"] = f"{row['extrapolated']:.2f}"
            for at in (0, 1):
                values[f"less_{at}_{kind}_{rim}"] = f"{row['extrapolated'] - row['grids'][at]['value']:.2f}"
            some = [r for r in rows if r["id"].startswith(f"stokes_{kind}_{rim}_")]
            values[f"range_{kind}_{rim}"] = f"{min(r['c'] for r in some):.2f} to {max(r['c'] for r in some):.2f}"
    rims = [[f"Stokes, {kind}", rim, values[f"c_{kind}_{rim}"], "ε = a/4 to a/16: " + values[f"range_{kind}_{rim}"]]
            for kind in ("hole", "disc") for rim in ("round", "cut")]  # fmt: skip
    rims += [["jet from a slit, ε = b/4 to b/8", row["id"].split("_")[2], f"{row['extrapolated']:.2f}",
              "two finest grids: " + _range(row)] for row in rows if row["id"].startswith("c_slit_")]  # fmt: skip
    values["rims_table"] = report_text.table(["flow", "rim", "c", "range"], rims)
    resistances = [[f"{row['R_over_mu']:.0e}", f"{row['extrapolated']:.2f}"] for row in rows if row["id"].startswith("R_")]
    values["resistances_table"] = report_text.table(["R/μ", "c of the hole, round rim"], resistances)
    for at, grid in enumerate(by_id["c_hole_round"]["grids"][:2]):
        values[f"cells_{at}"] = grid["n"].split()[-1]
    jets = [row for row in rows if row["id"].startswith("jet_")]
    values["jet_finest"] = f"{max(100 * (row['grids'][-1]['value'] / row['reference'] - 1) for row in jets):.0f}"
    values["committed"] = committed and {**committed, "command": f"`{committed['command']}`"}
    return values


def draw(rows, fields, folder):
    """Draws validation-stokes.png and validation-jets.png. Returns False if matplotlib is missing."""
    try:
        import matplotlib
    except ImportError:
        print("==> no matplotlib (python3-matplotlib): the page is made without plots")
        return False
    matplotlib.use("Agg")
    import matplotlib.pyplot as pyplot
    import numpy as np

    import report_text

    matplotlib.rcParams.update({"font.size": 10, "axes.titlesize": 11})
    matplotlib.rcParams["axes.prop_cycle"] = matplotlib.cycler(color=report_text.COLOURS)
    plot, axes = pyplot.subplots(1, 2, figsize=(8.5, 4.4), layout="constrained")
    for color, (kind, rim) in enumerate((k, r) for k in ("hole", "disc") for r in ("round", "cut")):
        some = [r for r in rows if r["id"].startswith(f"stokes_{kind}_{rim}_")]
        eps = [1 / int(r["id"].split("_")[-1]) for r in some]
        label = f"{kind}, {rim} rim"
        radii = [1] + [r["extrapolated"] for r in some][::-1]
        axes[0].plot([0] + eps[::-1], radii, "o-", color=f"C{color}", markersize=4, label=label)
        for r, e, style in zip(some, eps, ("s", "^", "v")):
            h = [1 / float(g["n"].split()[-1]) for g in r["grids"]]
            sign = 1 if kind == "hole" else -1
            c = [sign * (1 - g["value"]) / e for g in r["grids"]]
            axes[1].plot(h + [0], c + [r["c"]], style + "-", color=f"C{color}", markersize=4, linewidth=0.8)
            if color == 0:
                axes[1].plot([], [], style, color="0.4", markersize=4, label=f"ε = a/{round(1 / e)}")
    axes[0].set(xlabel="ε / a", ylabel="a_eff / a", title="effective radius in Stokes flow")
    axes[1].set(xlabel="h / ε (0: extrapolated)", ylabel="c = |a − a_eff| / ε", title="c; colours as on the left")
    for axis in axes:
        axis.grid(True, linewidth=0.3)
        axis.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2 if axis is axes[0] else 3, frameon=False)
    plot.savefig(os.path.join(folder, "validation-stokes.png"), dpi=110, metadata={"Software": None})
    pyplot.close(plot)

    plot = pyplot.figure(figsize=(8.5, 6.6), layout="constrained")
    upper, lower = plot.subfigures(2, 1, height_ratios=(1, 0.92))
    ratios, jets = upper.subplots(), lower.subplots(1, 2, sharey=True)
    for color, row in enumerate(r for r in rows if r["id"].startswith(("jet_", "slit_"))):
        h = [1 / float(g["n"].split()[-1]) for g in row["grids"]]
        values = [g["value"] / row["reference"] for g in row["grids"]]
        words = row["id"].split("_")
        is_jet = words[0] == "jet"
        label = f"contraction, slit {words[1]} of channel" if is_jet else f"width, {words[1]} rim, ε = b/{words[2]}"
        ratios.plot(h + [0], values + [row["extrapolated"] / row["reference"]], "o-" if is_jet else "s--",
                    color=f"C{color}", markersize=4, linewidth=1, label=label)  # fmt: skip
    ratios.set(xlabel="h / b (0: extrapolated)", ylabel="over the reference", title="contraction, and effective width of slits")
    ratios.axhspan(0.95, 1.05, color="0.92", zorder=0)
    ratios.grid(True, linewidth=0.3)
    ratios.legend(loc="center left", bbox_to_anchor=(1.02, 0.5), frameon=False)
    for axis, rim in zip(jets, ("round", "cut")):
        field = fields[rim]
        b = 0.008
        x, y = np.array(field["x"]) / b, np.array(field["y"]) / b
        speed, eps = np.array(field["speed"]), field["eps"] / b
        image = axis.pcolormesh(x, y, speed.T, cmap="viridis", shading="nearest", vmin=0, vmax=1.8)
        axis.contour(x, y, np.array(field["stream"]).T, levels=np.linspace(0, 0.9, 10), colors="w", linewidths=0.5)
        if rim == "round":
            angle = np.linspace(0, -np.pi, 60)
            around = eps * np.cos(angle), 1 + eps * np.sin(angle)
            outline = np.concatenate([[eps], around[0], [-eps]]), np.concatenate([[4], around[1], [4]])
        else:
            outline = (np.array([eps, eps, -eps, -eps]), np.array([4, 1, 1, 4]))
        axis.fill(*outline, facecolor="0.6", edgecolor="k", linewidth=0.6)
        axis.set(xlim=(-1.5, 3), ylim=(0, 2.5), xlabel="x / b", title=f"{rim} rim, with streamlines")
        axis.set_aspect("equal")
    jets[0].set_ylabel("y / b")
    lower.colorbar(image, ax=jets, shrink=0.8, label="speed, m/s")
    plot.savefig(os.path.join(folder, "validation-jets.png"), dpi=110, metadata={"Software": None})
    pyplot.close(plot)
    return True


def make_page(path, rows, about, committed, plots):
    """Writes docs/validation.md with the values of these rows to `path`."""
    import report_text

    left = report_text.fill_in_place(PAGE, page_values(rows, about, committed, plots), path)
    if left:
        print(f"==> {path}: these values of earlier runs stay: {', '.join(left)}")


def print_table(rows, say=print):
    say(f"{'row':22} {'reference':>10} {'extrapolated':>12} {'order':>6} {'deviation':>10} {'bar':>6}")
    for row in rows:
        deviation = "" if row["deviation"] is None else f"{100 * row['deviation']:+.2f} %"
        bar = "" if row["bar"] is None else f"{100 * row['bar']:g} %"
        reference, order = _text(row["reference"], 5), _text(row["order"], 2)
        say(f"{row['id']:22} {reference:>10} {row['extrapolated']:12.5g} {order:>6} {deviation:>10} {bar:>6}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--marks", help="the program of marks.c")
    parser.add_argument("--flow", help="the program of closed.f90")
    parser.add_argument("--out", required=True)
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--reuse", action="store_true")
    parser.add_argument("--processes", type=int, default=os.cpu_count())
    parser.add_argument("--page", help="the page, and its plots beside it; without it FOLDER/validation.md")
    arguments = parser.parse_args()
    os.makedirs(arguments.out, exist_ok=True)
    saved = os.path.join(arguments.out, "rows.json")
    if not arguments.reuse:
        import exact
        import marking
        import rows as computed

        print("==> the closed forms by their own equations", flush=True)
        exact.check()
        variant = computed.SHORT if arguments.short else computed.FULL
        library = marking.Library(arguments.marks)
        results = compute(library, variant, arguments.processes, lambda text: print("   ", text, flush=True))
        rows = computed.stokes_rows(variant, results) + computed.closed_rows(library, arguments.flow, arguments.short)
        rows += computed.jet_rows(variant, results)
        n, cells = variant.jet_n, variant.jet_cells[-1]
        fields = {rim: computed.picture(results["jet", rim, 0.3, n, cells, 1.0]) for rim in ("round", "cut")}
        with open(saved, "w", encoding="utf-8") as file:
            json.dump({"about": {**machine(), "short": arguments.short}, "rows": rows, "fields": fields}, file, indent=1)
    with open(saved, encoding="utf-8") as file:
        found = json.load(file)
    committed = read_committed(os.path.join(HERE, "all.json"))
    rows = found["rows"] + (committed["rows"] if committed else [])
    check_rows(rows, "rows of " + saved + " and all.json")
    page = arguments.page or os.path.join(arguments.out, "validation.md")
    plots = draw(rows, found["fields"], os.path.dirname(page) or ".")
    make_page(page, rows, found["about"], committed, plots)
    print_table(rows)
    bad = [row for row in rows if row["bar"] is not None and not abs(row["deviation"]) <= row["bar"]]
    for row in bad:
        print(f"validate.py: {row['id']} is {100 * row['deviation']:+.2f} % off, and its bar is {100 * row['bar']:g} %")
    print(f"==> left: {page}, {saved}")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
