#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the numbers of the JSON in out/bench into docs/performance.md, and makes out/bench/details.md.

This script computes every number of the pages from the JSON. Both times of a ratio always come from one run."""

import argparse
import json
import os
import sys
import tempfile

import gbench
from report_accuracy import accuracy_values
from report_text import Template, figure, fill_in_place, grouped, number, plural, table, without_marks

HERE = os.path.dirname(os.path.abspath(__file__))
PAGE = os.path.join(HERE, "..", "..", "docs", "performance.md")
VALVES = ("aortic", "mitral")
SIZES = (110, 260, 500, 1000, 1480)  # thousands of nodes, in the order of the paper's rows
METHODS = ("triangles", "sampling", "minimisation")


class Data:
    """The results in the folder. A missing result is None."""

    def __init__(self, folder):
        self.folder = folder
        self.machine = self.json("machine")
        self.searches, self.stages = self.benchmarks("searches"), self.benchmarks("stages")
        self.marking, self.peers, self.python_peers = self.json("marking"), self.json("peers"), self.json("peers_python")
        self.accuracy, self.roofline = self.json("accuracy"), self.json("roofline")
        with open(os.path.join(HERE, "paper_tables.json"), encoding="utf-8") as file:
            self.paper = json.load(file)
        with open(os.path.join(HERE, "design_steps.json"), encoding="utf-8") as file:
            self.design = json.load(file)

    def json(self, name):
        path = os.path.join(self.folder, name + ".json")
        if not os.path.exists(path):
            return None
        with open(path, encoding="utf-8") as file:
            return json.load(file)

    def benchmarks(self, name):
        path = os.path.join(self.folder, name + ".json")
        if not os.path.exists(path):
            return None
        times, failed = gbench.load(path)
        if failed:
            raise SystemExit(f"report.py: {path}: ended early: {failed}")
        return times

    def run(self, name):
        """Returns the time, the command and the load of a part's measurement, or None if they are unknown."""
        return ((self.machine or {}).get("runs") or {}).get(name)

    def run_values(self, name):
        run = self.run(name)
        return run and {"date": run["date"], "command": f"`{run['command']}`", "load": f"{run['load_before']:.1f}"}


def machine_table(data):
    m = data.machine["machine"]
    rows = [[key, str(m[key])] for key in ("CPU", "processors", "caches", "memory", "architecture", "system")]
    rows += [[name, version] for name, version in m["versions"].items()]
    return table(["machine", ""], rows)


# ---------------------------------------------------------------------------------------------------------------- searches


def search(data, name, valve, size, threads):
    return (data.searches or {}).get(f"search_{name}/{VALVES.index(valve)}/{size}/{threads}")


def paper_rows(data, valve):
    """Returns every row of the paper's table, with this run's searches of the row's size and number of threads."""
    for block, size in zip(data.paper[valve], SIZES):
        for threads, exhaustive, neighbor in block["rows"]:
            runs = {
                name: search(data, name, valve, size, threads)
                for name in (
                    "paper_exhaustive", "paper_neighbor", "exhaustive", "neighbor_warm", "neighbor_cold", "clusters",
                    "all_distances", "paper",
                )
            }
            if all(runs.values()):
                yield block["nodes"], threads, exhaustive, neighbor, runs


def threads_text(data, threads):
    cores = data.machine["machine"]["processors"] if data.machine else threads
    return f"{threads} (oversubscribed)" if threads > cores else str(threads)


def ms_of(name, run):
    return run["all_nodes_ms"] if name == "paper_exhaustive" else run["ms"]


def table_of_paper(data, valve):
    """Returns the table for at most as many threads as there are processors. details.md has the speed-ups with more threads."""
    rows = []
    for nodes, threads, exhaustive, neighbor, runs in paper_rows(data, valve):
        if threads_text(data, threads) != str(threads):
            continue
        ms = {name: ms_of(name, run) for name, run in runs.items()}
        rows.append(
            [
                grouped(nodes), grouped(runs["exhaustive"]["nodes"]), threads_text(data, threads),
                number(exhaustive), number(neighbor), number(exhaustive / neighbor),
                number(ms["paper_exhaustive"] / 1e3), number(ms["paper_neighbor"] / 1e3),
                number(ms["paper_exhaustive"] / ms["paper_neighbor"]),
                number(ms["exhaustive"]), number(ms["neighbor_warm"]), number(ms["clusters"]),
                grouped(ms["paper_exhaustive"] / ms["exhaustive"]), grouped(ms["paper_exhaustive"] / ms["clusters"]),
                number(ms["paper_neighbor"] / ms["clusters"]), number(ms["exhaustive"] / ms["clusters"]),
            ]
        )  # fmt: skip
    return table(
        [
            "nodes, paper", "nodes, here", "threads", "paper: exhaustive, s", "paper: neighbour, s", "ratio",
            "plain: exhaustive, s", "plain: neighbour, s", "ratio", "exhaustive, ms", "neighbour, ms", "clusters, ms",
            "plain exhaustive / exhaustive", "plain exhaustive / clusters", "plain neighbour / clusters", "exhaustive / clusters",
        ],
        rows,
    )  # fmt: skip


def table_of_threads(data, valve):
    """Returns the table of speed-ups compared with one thread."""
    names = ("paper_exhaustive", "paper_neighbor", "exhaustive", "neighbor_warm", "clusters")
    first, rows = {}, []
    for nodes, threads, exhaustive, neighbor, runs in paper_rows(data, valve):
        times = [exhaustive, neighbor] + [ms_of(name, runs[name]) for name in names]
        if threads == 1:
            first[nodes] = times
        elif nodes in first:
            rows.append(
                [grouped(runs["exhaustive"]["nodes"]), threads_text(data, threads)]
                + [number(one / t) for one, t in zip(first[nodes], times)]
            )
    heads = [
        "nodes", "threads", "paper: exhaustive", "paper: neighbour", "plain: exhaustive", "plain: neighbour", "exhaustive",
        "neighbour", "clusters",
    ]
    return table(heads, rows) if rows else ""


def table_of_other_searches(data):
    rows = []
    for valve in VALVES:
        for _, threads, _, _, runs in paper_rows(data, valve):
            loop = search(data, "every_triangle", valve, round(runs["exhaustive"]["nodes"] / 1e4) * 10, threads)
            every, cold = runs["all_distances"]["ms"], runs["neighbor_cold"]["ms"]
            rows.append(
                [
                    valve, grouped(runs["exhaustive"]["nodes"]), threads_text(data, threads),
                    grouped(1e3 * loop["all_nodes_s"]) if loop else "", number(every), number(cold),
                    number(runs["neighbor_warm"]["ms"]), number(runs["paper"]["ms"]),
                    number(every / cold), number(runs["exhaustive"]["ms"] / runs["neighbor_warm"]["ms"]),
                ]
            )  # fmt: skip
    heads = [
        "valve", "nodes", "threads", "every triangle", "every distance", "neighbour, cold", "warm", "the paper's rule",
        "every distance / cold", "exhaustive / warm",
    ]
    return table(heads, rows)


def queried_values(data, valve):
    """Returns, by size, the fraction of nodes that the plain neighbour search queries."""
    rows, sample = [], None
    for nodes, threads, exhaustive, neighbor, runs in paper_rows(data, valve):
        if threads != 1:
            continue
        here, queried = runs["exhaustive"], runs["paper_neighbor"]
        sample = runs["paper_exhaustive"]
        marked = f"{100 * here['marked'] / here['nodes']:.1f} %"
        rows.append(
            [grouped(here["nodes"]), marked, f"{queried['nodes'] / queried['asked']:.1f}", f"{exhaustive / neighbor:.1f}"]
        )
    if not rows:
        return None
    heads = ["nodes", "marked", "nodes for each query", "paper's ratio"]
    return {"valve": valve, "triangles": grouped(sample["triangles"]), "queried_table": table(heads, rows)}


def sampled_values(data):
    every = sorted(int(runs["paper_exhaustive"]["every"]) for valve in VALVES for *_, runs in paper_rows(data, valve))
    return {"fewest": every[0], "most": every[-1]} if every else None


def searches_values(data, plots):
    if not data.searches:
        return None
    valves = {
        valve: {
            "Valve": valve.capitalize(), "paper_table": table_of_paper(data, valve), "queried": queried_values(data, valve),
            "threads_table": table_of_threads(data, valve),
        }
        for valve in VALVES
    }  # fmt: skip
    return {
        "run": data.run_values("searches"), "sampled": sampled_values(data), **valves, "valves": list(valves.values()),
        "searches_plot": plots.get("searches"), "threads_plot": plots.get("threads"),
        "other_table": table_of_other_searches(data),
    }  # fmt: skip


def once_values(data):
    if not data.searches:
        return None
    what = (
        ("groups", "balls of the nodes, in a mesh's first neighbour search"),
        ("adjacency_of_tetrahedra", "adjacency from tetrahedra, if the library makes it"),
        ("adjacency_of_faces", "adjacency from faces (owner, neighbour)"),
        ("adjacency_of_grid", "adjacency from a structured grid"),
    )
    rows = []
    for name, label in what:
        for threads in (1, 2):
            runs = [search(data, name, "aortic", size, threads) for size in (110, 500, 1000)]
            if all(runs):
                rows.append([label, str(threads)] + [number(run["ms"]) for run in runs])
    return {"once_table": table(["milliseconds", "threads", "110,000 nodes", "500,000", "1,000,000"], rows)}


# ------------------------------------------------------------------------------------------------------------------ stages


def stages_values(data):
    if not data.stages:
        return None
    stages = (
        ("patches", "control points of all curves, from parameters"),
        ("curves", "subdivision of the curves into polylines that may use the whole error"),
        ("quads", "surface generation: curves as fine as needed, Coons patches, quads"),
        ("triangles", "the same with the triangulation"),
        ("scene", "Embree scene, built"),
        ("scene_again", "Embree scene, refitted to triangles that moved"),
        ("surface", "`riis_surface_create`: all of these"),
        ("surface_again", "`riis_surface_update`: the same for a valve that moved"),
    )
    rows = []
    for name, label in stages:
        runs = [data.stages.get(f"pipeline_{name}/{valve}") for valve in VALVES]
        if all(runs):
            rows.append([label] + [number(1e3 * run["ms"]) for run in runs])
    triangles = {valve: data.stages[f"pipeline_triangles/{valve}"]["triangles"] for valve in VALVES}
    return {
        "run": data.run_values("stages"),
        **{f"{valve}_triangles": grouped(n) for valve, n in triangles.items()},
        "stages_table": table(["microseconds", "aortic", "mitral"], rows),
        "queries_table": table_of_queries(data),
    }


def table_of_queries(data):
    rows = []
    for valve in VALVES:
        for method, label in enumerate(METHODS):
            for tolerance in (50, 20, 10, 1):
                on, off = (
                    data.stages.get(f"distance_query/{valve}/method:{method}/tolerance:{tolerance}/on_surface:{k}")
                    for k in (1, 0)
                )
                if on and off:
                    rows.append(
                        [
                            valve, label, f"{tolerance / 10:g} %",
                            grouped(on["triangles"] or on["samples"]) if on["triangles"] or on["samples"] else "",
                            number(1e3 * on["ms"]), number(1e3 * off["ms"]), f"{off['largest_error']:.2g}",
                        ]
                    )  # fmt: skip
    return table(
        ["valve", "method", "tolerance", "triangles or samples", "on the surface, µs", "in the box, µs", "largest error"], rows
    )


# ----------------------------------------------------------------------------------------------------------------- marking


def pair_ns(data):
    """Returns the time of the reference for one node and one triangle, in the plain loop."""
    counts = data.marking["counts"]
    least = data.marking["times"]["the paper's search, every triangle, 1 thread"]["least_ms"]
    return 1e6 * least / counts["asked_by_paper"] / counts["triangles"]


def query_ns(data):
    """Returns the reference's time for a point query."""
    least = data.marking["times"]["the paper's search, point queries, 1 thread"]["least_ms"]
    return 1e6 * least / data.marking["counts"]["asked_by_paper"]


def bars_table(bars):
    rows = [
        [
            bar["name"],
            f"{bar['value']:.2f}",
            f"{'<=' if bar['kind'] == 'at most' else '>='} {bar['bar']:g}",
            "met" if bar["met"] else "NOT met",
        ]
        for bar in bars
    ]
    return table(["bar", "value", "wanted", ""], rows)


def stage_shares(case):
    """Returns each stage's fraction of the sum of all stages of a step."""
    spent = {stage: case["nanoseconds"][stage] for stage, _, _ in STEP_STAGES}
    return {stage: ns / sum(spent.values()) for stage, ns in spent.items()}


def floor_values(data):
    """Returns the times at which a step would meet the bars that it misses. Also returns the times of the step's parts, by the
    fractions of the roofline."""
    least = {name: t["least_ms"] for name, t in data.marking["times"].items()}
    step, fine = least.get("step, 1 thread"), least.get("step, 2 threads, fine triangles")
    queries, cgal = least.get("the paper's search, point queries, 1 thread"), least.get("CGAL, every node, 1 thread")
    if not data.roofline or not all((step, fine, queries, cgal)):
        return None
    share = {name: stage_shares(data.roofline[name]) for name in ("coarse", "fine")}
    fine_ratio = fine / least["step, 2 threads"]
    values = {
        "filter_ms": share["coarse"]["filter"] * step, "step_ms": step,
        "decided_ms": (share["coarse"]["filter"] + share["coarse"]["decide"]) * step,
        "by_queries_ms": queries / 8, "by_cgal_ms": cgal / 17, "fine_ratio": fine_ratio,
        "ratio_without_surfaces": fine_ratio * (1 - share["fine"]["update"]) / (1 - share["coarse"]["update"]),
    }  # fmt: skip
    return {"instructions": data.roofline["instructions"], **{name: f"{value:.1f}" for name, value in values.items()}}


def design_values(data):
    """Returns the gains of design changes. The gains were measured once, and are stored in design_steps.json."""
    if not data.marking:
        return None
    design = data.design
    rows = [
        [step["what"]] + [f"{step[name]['step']:.2f}" if name in step else "" for name in ("coarse", "fine")]
        for step in design["steps"]
    ]
    return {
        "nodes": design["nodes"],
        **{f"{name}_triangles": design["triangles"][name] for name in ("coarse", "fine")},
        "date": design["date"],
        "design_table": table(["with", "coarse", "fine"], rows),
    }


def few_processors(data):
    """Returns a sentence if the machine has too few processors for 4 to 16 threads."""
    n = data.machine["machine"]["processors"] if data.machine else 0
    if not 0 < n < 4:
        return ""
    return (
        f"This machine has {plural(n, 'processor')}. 4 to 16 threads with a processor each,\n"
        "and 4 to 16 ranks, were therefore not measured."
    )


def marking_values(data):
    if not data.marking:
        return None
    counts = data.marking["counts"]
    rows = [
        [name, f"{t['least_ms']:.3f}", f"{t['median_ms']:.3f}", str(t["turns"])]
        for name, t in sorted(data.marking["times"].items())
    ]
    missed = [bar for bar in data.marking["bars"] if not bar["met"]]
    return {
        "run": data.run_values("marking"),
        **{name: grouped(counts[name]) for name in ("triangles", "fine_triangles", "nodes")},
        "queried_by_paper": grouped(counts["asked_by_paper"]),
        "marked_share": f"{100 * counts['marked'] / counts['nodes']:.1f}",
        "thick_share": f"{100 * counts['marked_with_0.3'] / counts['nodes']:.1f}",
        "pair_ns": f"{pair_ns(data):.2f}",
        "marked_ns": grouped(round(1e6 * data.marking["times"]["step, 1 thread"]["least_ms"] / counts["marked"])),
        "few_processors": few_processors(data),
        "smaller": "" if counts["nodes"] > 9e5 else " (this mesh is smaller, so a missed bar says little)",
        "times_table": table(["what", "least, ms", "median, ms", "turns"], rows),
        "bars_table": bars_table(data.marking["bars"]),
        "missed_text": "\n\n".join(
            data.marking.get("left_out", [])
            + ["`./run bench marking` prints the reasons for missed bars." if missed else "All bars are met."]
        ),
        "has_missed": bool(missed),
        "query_ns": f"{query_ns(data):.0f}",
        "floor": floor_values(data),
        "missed": [
            {"name": bar["name"], "factor": f"{max(bar['value'] / bar['bar'], bar['bar'] / bar['value']):.2f}"} for bar in missed
        ],
    }


# ---------------------------------------------------------------------------------------------------------------- roofline

STEP_STAGES = (
    ("update", "update of the surface", None),
    ("regions", "regions, clusters and leaves: candidates", "floats"),
    ("filter", "filter", "floats"),
    ("decide", "decision", "doubles"),
    ("rest", "the rest of the search: lists, the best of each node", None),
    ("order", "putting in order and writing", None),
)


def peak_ns(peak, stage, unit, case):
    """Returns the least time that the machine needs for a stage. The operations need one time and the transfer of the bytes
    another, and the longer time counts."""
    by_memory = case["bytes"][stage] / peak["bytes"]
    return max(by_memory, case["operations"][stage] / peak[unit]) if unit else by_memory


def table_of_stages(data, case):
    """Returns a row for each stage, and a row for their sum. The numbers are per marked node."""
    peak, marked, rows, sums = data.roofline["peak"], case["marked"], [], [0.0] * 4
    for stage, label, unit in STEP_STAGES:
        values = [
            case["nanoseconds"][stage],
            case["operations"].get(stage, 0),
            case["bytes"][stage],
            peak_ns(peak, stage, unit, case),
        ]
        sums = [total + value for total, value in zip(sums, values)]
        rows.append((label, values))
    rows.append(("together", sums))
    return table(
        ["stage", "ns", "operations", "bytes", "ns at the peak", "of the peak"],
        [
            [
                label, number(ns / marked), number(operations / marked) if operations else "",
                number(size / marked), number(at_peak / marked), f"{100 * at_peak / ns:.0f} %",
            ]
            for label, (ns, operations, size, at_peak) in rows
        ],
    )  # fmt: skip


def roofline_values(data):
    if not data.roofline:
        return None
    roofline, cases = data.roofline, []
    for name in ("coarse", "fine"):
        case = roofline[name]
        cases.append(
            {
                "triangles": grouped(case["triangles"]), "groups": grouped(case["groups"]), "leaves": grouped(case["leaves"]),
                "groups_a_leaf": number(case["near_groups"] / case["leaves"]),
                "filtered": number(case["filtered_pairs"] / case["marked"]),
                "decided": number(case["decided_pairs"] / case["marked"]),
                "whole_ns": number(case["nanoseconds"]["whole"] / case["marked"]), "roofline_table": table_of_stages(data, case),
            }
        )  # fmt: skip
    return {
        "run": data.run_values("roofline"),
        "cpu": data.machine["machine"]["CPU"] if data.machine else "an unknown machine",
        "instructions": roofline["instructions"],
        "nodes": grouped(roofline["nodes"]),
        "marked": grouped(roofline["coarse"]["marked"]),
        **{f"peak_{name}": number(value) for name, value in roofline["peak"].items()},
        "cases": cases,
    }


# ------------------------------------------------------------------------------------------------------------------- peers

PYTHON_PEERS = (
    "`./run bench peers` also measures packages from PyPI. The run of this page left this command out.",
    "The packages of PyPI have a version in their name. `bench/peers/peers.py` measured these packages right\n"
    "after the libraries, in a process of their own on one processor. Their arrays were made before the\n"
    "measurement. libigl and point-cloud-utils make their tree in every call.",
)
BOUNDED = ("CGAL", "VTK, vtkStatic", "OpenVDB", "fcpw")


def peers_table(data, valve):
    own = data.peers[valve]
    by_clusters, every = own["times"]["riis, clusters"]["least_ms"], own["times"]["riis, every distance"]["least_ms"]
    rows = []
    for peers in (own, (data.python_peers or {}).get(valve)):
        if not peers:
            continue
        for name, t in sorted(peers["times"].items(), key=lambda item: item[1]["least_ms"]):
            marks = peers["marks"].get(name)
            if not marks:  # timed only for a bar
                continue
            reasons = ", ".join(f"{n} {reason}" for reason, n in sorted(marks["reasons"].items()))
            is_bounded = name.startswith(BOUNDED) or name in ("riis, clusters", "riis, exhaustive search")
            is_bounded = is_bounded and "every distance" not in name
            made = peers.get("made", {}).get(name)
            rows.append(
                [
                    name, "yes" if is_bounded else "no", grouped(marks["marked"]),
                    str(marks["different"]) + (f" ({reasons})" if reasons else ""), f"{marks['largest_difference']:.1g}",
                    "" if is_bounded or "largest_anywhere" not in marks else f"{marks['largest_anywhere']:.1g}",
                    "" if made is None else number(made),
                    number(t["least_ms"]), number(t["least_ms"] / by_clusters),
                    "" if is_bounded else number(t["least_ms"] / every),
                ]
            )  # fmt: skip
    heads = [
        "what", "bounded", "marked", "marked differently", "distances differ by, cm", "anywhere, cm", "made in, ms",
        "least, ms", "/ clusters",
        "/ every distance",
    ]
    return table(heads, rows)


def peers_values(data, plots):
    if not data.peers:
        return None
    left_out = {}
    for peers in (data.peers, data.python_peers):
        for valve in VALVES:
            left_out.update(((peers or {}).get(valve) or {}).get("left_out") or {})
    return {
        "run": data.run_values("peers"),
        "nodes": grouped(data.peers["aortic"]["nodes"]),
        **{
            valve: {
                "triangles": grouped(data.peers[valve]["triangles"]),
                "peers_table": peers_table(data, valve),
                "peers_bars_table": bars_table(data.peers[valve]["bars"]),
            }
            for valve in VALVES
        },
        "peers_plot": plots.get("peers"),
        "python_text": PYTHON_PEERS[bool(data.python_peers)],
        "left_out_text": "\n\n".join(f"Left out: {name} ({why})." for name, why in sorted(left_out.items())),
    }


# -------------------------------------------------------------------------------------------------------------------- page


SEARCH_LINES = (
    ("paper_exhaustive", "plain exhaustive"), ("paper_neighbor", "plain neighbour"), ("exhaustive", "exhaustive"),
    ("neighbor_warm", "neighbour"), ("clusters", "clusters"),
)  # fmt: skip


def plot_searches(data, path):
    """Plots seconds by nodes, on one thread. Returns False if the data is missing."""
    panels = []
    for valve in VALVES:
        rows = [row for row in paper_rows(data, valve) if row[1] == 1]
        lines = [
            ("paper, exhaustive", [(nodes, exhaustive) for nodes, _, exhaustive, _, _ in rows], "--"),
            ("paper, neighbour", [(nodes, neighbor) for nodes, _, _, neighbor, _ in rows], "--"),
        ]
        lines += [
            (label, [(runs["exhaustive"]["nodes"], ms_of(name, runs[name]) / 1e3) for *_, runs in rows], "-")
            for name, label in SEARCH_LINES
        ]
        panels.append((f"{valve} valve, 1 thread", lines))
    return bool(data.searches) and figure.lines(panels, "nodes", "seconds", path)


def plot_threads(data, path):
    """Plots the speed-up over one thread for a million nodes. Runs with more threads than processors are omitted, because their
    threads take turns. Returns False if the data is missing."""
    if not data.searches or not data.machine:
        return False
    panels, ticks = [], [row[0] for row in data.paper[VALVES[0]][0]["rows"]]
    processors = data.machine["machine"]["processors"]
    for valve in VALVES:
        block = data.paper[valve][SIZES.index(1000)]
        runs = {
            threads: runs
            for nodes, threads, _, _, runs in paper_rows(data, valve)
            if nodes == block["nodes"] and threads <= processors
        }
        if 1 not in runs:
            continue
        lines = [
            (label, [(row[0], block["rows"][0][column] / row[column]) for row in block["rows"]], "--")
            for column, label in ((1, "paper, exhaustive"), (2, "paper, neighbour"))
        ]
        lines += [
            (
                label,
                [(threads, ms_of(name, runs[1][name]) / ms_of(name, run[name])) for threads, run in sorted(runs.items())],
                "-",
            )
            for name, label in SEARCH_LINES
        ]
        lines.append(("as many times as threads", [(n, n) for n in ticks], ":"))
        panels.append((f"{valve} valve, {plural(processors, 'processor')} here", lines))
    return bool(panels) and figure.lines(panels, "threads", "times faster than one thread", path, ticks)


def plot_peers(data, path):
    """Plots milliseconds of each peer. Returns False if the data is missing."""
    panels = []
    for valve in VALVES:
        bars = {
            name: t["least_ms"]
            for part in (data.peers, data.python_peers)
            if part
            for name, t in part[valve]["times"].items()
            if name in part[valve]["marks"]
        }
        panels.append((f"{valve} valve", sorted(bars.items(), key=lambda item: -item[1])))
    return bool(data.peers) and figure.bars(panels, "milliseconds", path)


PLOTS = (
    ("searches", plot_searches, "Seconds of a marking by number of nodes on one thread: the paper's times and these"),
    (
        "threads",
        plot_threads,
        "Speedup over one thread with a million nodes: the paper's searches and these",
    ),
    ("peers", plot_peers, "Milliseconds of each peer for the same nodes"),
)


def images_for_page(data, folder):
    """Draws the plots whose data exists. Returns the markdown of each plot by its name."""
    return {
        name: f"![{title}](performance-{name}.png)\n"
        for name, plot, title in PLOTS
        if plot(data, os.path.join(folder, f"performance-{name}.png"))
    }


def measured_text(data, name):
    """Returns when and where a part was measured, in HTML. The text includes the machine, because the page of figures does not
    describe it."""
    run = data.run(name)
    if not run:
        return ""
    machine = data.machine["machine"]
    processors = plural(machine["processors"], "processor")
    return (
        f"Measured {run['date']} by <code>{run['command']}</code> on {machine['CPU']}, {processors}, "
        f"load before {run['load_before']:.1f}."
    )


def plot_left_out(data, name, title):
    """Returns a text that names the missing plot, the reason, and the command that makes it."""
    measured = data.peers if name == "peers" else data.searches
    if not measured:
        file, command = ("peers", "./run bench peers") if name == "peers" else ("searches", "./run bench search")
        why = f"{data.folder}/{file}.json is missing: ./run figures --measure measures it in the short variant, {command} in full"
    elif not figure.can_draw():
        why = "the Python package matplotlib is missing (Debian: python3-matplotlib)"
    else:
        why = "out/bench has no times of a million nodes on one thread: ./run bench search measures them"
    return f"{title}: {why}."


def write_figures(data, folder):
    """Writes the plots for the page of figures. Also writes plots.json, which has the texts and names the missing plots with
    reasons."""
    os.makedirs(folder, exist_ok=True)
    drawn = {name: title for name, plot, title in PLOTS if plot(data, os.path.join(folder, name + ".png"))}
    figures = []
    if "searches" in drawn:
        threads = [{"png": "threads.png", "caption": drawn["threads"] + "."}] if "threads" in drawn else []
        figures.append(
            {
                "title": "Cost and scaling of a marking",
                "columns": 1,
                "panels": [{"png": "searches.png", "caption": drawn["searches"] + "."}, *threads],
                "caption": "Dashed lines are the paper's own seconds, from its tables, on its machine. <i>Plain</i> lines are "
                "its two algorithms, written plainly and run here; they compute the distance to every triangle. The others are "
                "this library's searches: exhaustive, neighbour and clusters. All mark the same nodes. The tolerance is 5 %, the "
                "half thickness 0.1 cm. A shaded part has more threads than processors here (oversubscribed), so no search can "
                "gain there. " + measured_text(data, "searches"),
                "paper": "tables <i>Scaling of mesh traversal functions</i> of the aortic and of the mitral valve "
                "(section 4.2.3).",
            }
        )
    if "peers" in drawn:
        figures.append(
            {
                "title": "Other libraries",
                "columns": 1,
                "panels": [{"png": "peers.png", "caption": drawn["peers"] + "."}],
                "caption": f"{grouped(data.peers['aortic']['nodes'])} nodes, one thread, the same triangles. "
                "docs/performance.md says which libraries answer only within the half thickness, and which nodes are marked "
                "differently. "
                + measured_text(data, "peers"),
                "paper": "nothing: the paper compares only with itself.",
            }
        )
    left_out = [plot_left_out(data, name, title) for name, _, title in PLOTS if name not in drawn]
    path = os.path.join(folder, "plots.json")
    with open(path, "w", encoding="utf-8") as file:
        json.dump({"figures": figures, "left_out": left_out}, file, indent=2)
        file.write("\n")
    print(f"==> wrote {path}, {len(figures)} figures")
    for text in left_out:
        print(f"==> not drawn: {text}")


def values_of_page(data, plots):
    """Returns every value by its name in the templates. A missing measurement gives an empty value."""
    return {
        "machine": data.machine and {"machine_table": machine_table(data)},
        "searches": searches_values(data, plots),
        "once": once_values(data),
        "stages": stages_values(data),
        "marking": marking_values(data),
        "roofline": roofline_values(data),
        "design": design_values(data),
        "accuracy": data.accuracy and accuracy_values(data.accuracy),
        "peers": peers_values(data, plots),
    }


# Lists two things for each PART of ./run bench: the heading of the page's section, and the part of details.template.md to print.
PRINTED = {
    "search": ("## The paper's tables", "searches"), "marking": ("## A time step", "marking"), "roofline": (None, "roofline"),
    "peers": ("## Others", None),
}  # fmt: skip


def section_of(path, heading):
    """Returns the section of a page with this heading, as readers see it."""
    with open(path, encoding="utf-8") as file:
        after = without_marks(file.read()).partition(heading + "\n")[2]
    return heading + "\n" + after.partition("\n## ")[0]


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--data", default=os.path.join("out", "bench"), help="the folder of the JSON (%(default)s)")
    parser.add_argument("--page", default=PAGE, help="the page to write, with the text of docs/performance.md (%(default)s)")
    parser.add_argument("--details", help="the page of all other measurements to write (details.md beside the JSON)")
    parser.add_argument("--print", choices=sorted(PRINTED), help="print that section in place of writing the page")
    parser.add_argument(
        "--figures", metavar="FOLDER", help="only draw the plots of the figures' page there, with plots.json for it"
    )
    options = parser.parse_args(arguments)
    data = Data(options.data)
    if options.figures:
        write_figures(data, options.figures)
        return 0
    with open(os.path.join(HERE, "details.template.md"), encoding="utf-8") as file:
        details = Template(file.read())
    if options.print:
        heading, part = PRINTED[options.print]
        with tempfile.NamedTemporaryFile() as page:
            fill_in_place(PAGE, values_of_page(data, {}), page.name)
            print((section_of(page.name, heading) if heading else "") + details.fill(values_of_page(data, {}), only=part))
        return 0
    values = values_of_page(data, images_for_page(data, os.path.dirname(options.page) or "."))
    left = fill_in_place(PAGE, values, options.page)
    if left:
        print(f"==> {options.page}: these values of earlier runs stay: {', '.join(left)}")
    print(f"==> wrote {options.page}")
    path = options.details or os.path.join(options.data, "details.md")
    with open(path, "w", encoding="utf-8") as file:
        file.write(details.fill(values))
    print(f"==> wrote {path}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
