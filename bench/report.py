#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes docs/performance.md from the JSON in out/bench. Every number of the page comes from there, the prose is here.

The page names missing files and the way to get them. A ratio is always of two times of the same run."""

import argparse
import json
import os
import sys

import gbench
from report_accuracy import accuracy_section
from report_text import figure, grouped, number, paragraph, plural, table

HERE = os.path.dirname(os.path.abspath(__file__))
VALVES = ("aortic", "mitral")
SIZES = (110, 260, 500, 1000, 1480)  # thousands of nodes, in the order of the paper's rows
METHODS = ("triangles", "sampling", "minimisation")


class Data:
    """The content of the folder. A missing file is None."""

    def __init__(self, folder):
        self.folder = folder
        self.machine = self.json("machine")
        self.searches, self.stages = self.benchmarks("searches"), self.benchmarks("stages")
        self.marking, self.peers, self.python_peers = self.json("marking"), self.json("peers"), self.json("peers_python")
        self.accuracy = self.json("accuracy")
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
        """The time, command and load of a measurement, or None if these are not known."""
        return ((self.machine or {}).get("runs") or {}).get(name)

    def when(self, name):
        run = self.run(name)
        if not run:
            return ""
        return paragraph(f"Measured {run['date']} by `{run['command']}`; the load of the machine before was {run['load_before']:.1f}.")


def missing(name, command):
    return f"Not measured here: no `{name}.json`; `{command}` makes it.\n"


def machine_section(data):
    if not data.machine:
        return missing("machine", "./run bench")
    m = data.machine["machine"]
    rows = [[key, str(m[key])] for key in ("CPU", "processors", "caches", "memory", "architecture", "system")]
    rows += [[name, version] for name, version in m["versions"].items()]
    return table(["machine", ""], rows)


# ---------------------------------------------------------------------------------------------------------------- searches


def search(data, name, valve, size, threads):
    return (data.searches or {}).get(f"search_{name}/{VALVES.index(valve)}/{size}/{threads}")


def paper_rows(data, valve):
    """Every row of the paper's table, with this run's searches of the same size and number of threads."""
    for block, size in zip(data.paper[valve], SIZES):
        for threads, exhaustive, neighbor in block["rows"]:
            runs = {
                name: search(data, name, valve, size, threads)
                for name in ("paper_exhaustive", "paper_neighbor", "exhaustive", "neighbor_warm", "neighbor_cold", "clusters", "all_distances", "paper")
            }
            if all(runs.values()):
                yield block["nodes"], threads, exhaustive, neighbor, runs


def threads_text(data, threads):
    cores = data.machine["machine"]["processors"] if data.machine else threads
    return f"{threads} (oversubscribed)" if threads > cores else str(threads)


def ms_of(name, run):
    return run["all_nodes_ms"] if name == "paper_exhaustive" else run["ms"]


def table_of_paper(data, valve):
    rows = []
    for nodes, threads, exhaustive, neighbor, runs in paper_rows(data, valve):
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
    """The speed-up over one thread."""
    names = ("paper_exhaustive", "paper_neighbor", "exhaustive", "neighbor_warm", "clusters")
    first, rows = {}, []
    for nodes, threads, exhaustive, neighbor, runs in paper_rows(data, valve):
        times = [exhaustive, neighbor] + [ms_of(name, runs[name]) for name in names]
        if threads == 1:
            first[nodes] = times
        elif nodes in first:
            rows.append([grouped(runs["exhaustive"]["nodes"]), threads_text(data, threads)] + [number(one / t) for one, t in zip(first[nodes], times)])
    heads = ["nodes", "threads", "paper: exhaustive", "paper: neighbour", "plain: exhaustive", "plain: neighbour", "exhaustive", "neighbour", "clusters"]
    return table(heads, rows) if rows else ""


def table_of_other_searches(data):
    rows = []
    for valve in VALVES:
        for _, threads, _, _, runs in paper_rows(data, valve):
            loop = search(data, "every_triangle", valve, round(runs["exhaustive"]["nodes"] / 1e4) * 10, threads)
            every, cold = runs["all_distances"]["ms"], runs["neighbor_cold"]["ms"]
            rows.append(
                [
                    valve, grouped(runs["exhaustive"]["nodes"]), threads_text(data, threads), grouped(1e3 * loop["all_nodes_s"]) if loop else "",
                    number(every), number(cold), number(runs["neighbor_warm"]["ms"]), number(runs["paper"]["ms"]),
                    number(every / cold), number(runs["exhaustive"]["ms"] / runs["neighbor_warm"]["ms"]),
                ]
            )  # fmt: skip
    heads = ["valve", "nodes", "threads", "every triangle", "every distance", "neighbour, cold", "warm", "the paper's rule", "every distance / cold", "exhaustive / warm"]
    return table(heads, rows)


def marked_text(data, valve):
    parts, sample = [], None
    for nodes, threads, exhaustive, neighbor, runs in paper_rows(data, valve):
        if threads != 1:
            continue
        here, asked = runs["exhaustive"], runs["paper_neighbor"]
        sample = runs["paper_exhaustive"]
        parts.append(
            f"{grouped(here['nodes'])} nodes: {100 * here['marked'] / here['nodes']:.1f} % marked, one in "
            f"{asked['nodes'] / asked['asked']:.1f} asked (paper {exhaustive / neighbor:.1f})"
        )
    if not parts:
        return ""
    return paragraph(
        f"The {valve} valve has {grouped(sample['triangles'])} triangles here. The plain neighbour search asks marked nodes and "
        "their neighbours only, the exhaustive one all: where each answer costs the same, the ratio of their times is that of "
        "all nodes to those asked, and the paper's ratio says what share its mesh had. " + "; ".join(parts) + "."
    )


def sampled_text(data):
    samples = [runs["paper_exhaustive"] for valve in VALVES for *_, runs in paper_rows(data, valve)]
    every = sorted(int(run["every"]) for run in samples)
    if not every:
        return ""
    return f"k from {every[0]} to {every[-1]} by size"


def searches_section(data, images=None):
    if not data.searches:
        return missing("searches", "./run bench search")
    text = [
        data.when("searches"),
        paragraph(
            "The paper's tables of its two traversals, set beside the same work here. Cylinders of tetrahedra that the valves fit, "
            "the aortic one of radius 1.8 cm and length 2.5 cm, the mitral one of 2.4 cm and 3.45 cm: grids of boxes bent to a "
            "cylinder, each box cut into six (`bench/cylinder.hpp`). Tolerance 5 %, half thickness 0.1 cm. Every time of the "
            "library's is the shortest of many markings of a valve that moves by about a hundredth of its motion from marking to "
            "marking: what else a machine does only adds. Differences below a tenth mean nothing."
        ),
        paragraph(
            "Not known of the paper's: the number of triangles, the processor, how its cylinders are numbered and meshed. So "
            "only ratios compare, and those within one run: the columns *ratio* with each other, the last four of themselves."
        ),
        "- *paper*: its tables' seconds.\n"
        "- *plain*: the paper's own two algorithms, written plainly (`bench/references.cpp`), run here with the same\n"
        "  triangles, the distance to every triangle for every node that is asked. The exhaustive one is measured on\n"
        f"  every k-th node, {sampled_text(data)}, and multiplied, since each node costs the same;\n"
        "  the neighbour search starts once for each leaflet, so that it finds all of them.\n"
        "- *exhaustive*, *neighbour*, *clusters*: `RIIS_SEARCH_EXHAUSTIVE`, `RIIS_SEARCH_NEIGHBOR` with the same result\n"
        "  every time, `RIIS_SEARCH_CLUSTERS` with the mesh prepared. All of them mark the same nodes.\n",
    ]
    for valve in VALVES:
        text += [f"### {valve.capitalize()} valve\n", table_of_paper(data, valve), marked_text(data, valve)]
        threads = table_of_threads(data, valve)
        text += ["How many times faster than on one thread:\n", threads] if threads else []
    text += [
        (images or {}).get("searches", ""),
        (images or {}).get("threads", ""),
        "### Other searches\n",
        "Milliseconds a marking:\n",
        table_of_other_searches(data),
        "- *every triangle*: the distance of every node to every triangle, with the kernel of this library; every 50th\n"
        "  node, multiplied.\n"
        "- *every distance*: the full distance of every node, too, but by the Embree scene\n"
        "  (`riis_closest_points` without a limit).\n"
        "- *neighbour*: cold with a new result every time, so without a last marking to start from and without\n"
        "  memory to reuse, warm with the same one.\n"
        "- *the paper's rule*: `RIIS_SEARCH_PAPER`. Of the aortic valve it finds one cusp of three, so its time is\n"
        "  that of a third of the marks. It is not complete.\n",
        paragraph(
            "The paper's ratio is that of computing every distance to computing few. With the distance by Embree in place of the "
            "loop its counterpart is *every distance / cold*. But the exhaustive search of this library has that gain, and more, "
            "already. It asks with the half thickness as radius, so that Embree turns down a far node at its first boxes, and it "
            "does not ask nodes outside the surface's bounds at all. That leaves little for a walk to save: the neighbour search "
            "makes less than half of the queries, but those that are left are the dear ones, near the surface, and it makes them "
            "in the order of the walk, where the exhaustive search makes them in the order of the nodes. Clusters gain by looking "
            "at nodes and triangles sixteen at a time, in the order of where they are."
        ),
        paragraph(
            "These nodes are numbered line by line. Where they are numbered at random, or where the valve's bounds hold far more "
            "than its band, it may turn out differently: measure with your own mesh."
        ),
    ]
    return "\n".join(filter(None, text))


def once_section(data):
    if not data.searches:
        return missing("searches", "./run bench search")
    what = (
        ("groups", "groups of the nodes, in a mesh's first neighbour search"),
        ("adjacency_of_tetrahedra", "adjacency from tetrahedra, if the library makes it"),
        ("adjacency_of_faces", "from faces (owner, neighbour)"),
        ("adjacency_of_grid", "from a structured grid"),
    )
    rows = []
    for name, label in what:
        for threads in (1, 2):
            runs = [search(data, name, "aortic", size, threads) for size in (110, 500, 1000)]
            if all(runs):
                rows.append([label, str(threads)] + [number(run["ms"]) for run in runs])
    text = table(["milliseconds", "threads", "110,000 nodes", "500,000", "1,000,000"], rows)
    return text + "\n`riis-mark` marks a mesh once, so its default is the exhaustive search.\n"


# ------------------------------------------------------------------------------------------------------------------ stages


def stages_section(data):
    if not data.stages:
        return missing("stages", "./run bench")
    stages = (
        ("patches", "control points of all curves, from parameters"),
        ("curves", "subdivision of the curves into polylines, all of the error theirs"),
        ("quads", "surface generation: curves as fine as it takes, Coons patches, quads"),
        ("triangles", "the same, and the triangulation"),
        ("scene", "Embree scene, built"),
        ("scene_again", "Embree scene, made again for triangles that moved (refit)"),
        ("surface", "`riis_surface_create`, which is all of this"),
        ("surface_again", "`riis_surface_update`, the same for a valve that moved"),
    )
    rows = []
    for name, label in stages:
        runs = [data.stages.get(f"pipeline_{name}/{valve}") for valve in VALVES]
        if all(runs):
            rows.append([label] + [number(1e3 * run["ms"]) for run in runs])
    triangles = [data.stages[f"pipeline_triangles/{valve}"]["triangles"] for valve in VALVES]
    text = [
        data.when("stages"),
        paragraph(
            f"Tolerance 5 % of the half thickness of 0.1 cm: {grouped(triangles[0])} triangles of the aortic valve, "
            f"{grouped(triangles[1])} of the mitral one, half open. One thread; Embree's scene is made on what TBB grants."
        ),
        table(["microseconds", "aortic", "mitral"], rows),
        "### A query\n",
        paragraph(
            "The paper's three ways to measure a distance (figure distance_bench, right), a query each: of points on the surface, "
            "as in the paper, and of points in a box around it. The paper's plots have no numbers to set beside. Tolerances are "
            "shares of the half thickness; errors are above the distance to triangles within a thousandth of it, in half "
            "thicknesses, of points in the box."
        ),
    ]
    rows = []
    for valve in VALVES:
        for method, label in enumerate(METHODS):
            for tolerance in (50, 20, 10, 1):
                on, off = (data.stages.get(f"distance_query/{valve}/method:{method}/tolerance:{tolerance}/on_surface:{k}") for k in (1, 0))
                if on and off:
                    rows.append(
                        [
                            valve, label, f"{tolerance / 10:g} %", grouped(on["triangles"] or on["samples"]) if on["triangles"] or on["samples"] else "",
                            number(1e3 * on["ms"]), number(1e3 * off["ms"]), f"{off['largest_error']:.2g}",
                        ]
                    )  # fmt: skip
    text.append(table(["valve", "method", "tolerance", "triangles or samples", "on the surface, µs", "in the box, µs", "largest error"], rows))
    return "\n".join(filter(None, text))


# ----------------------------------------------------------------------------------------------------------------- marking


def pair_ns(data):
    """The time of the reference's plain loop for a node and a triangle."""
    counts = data.marking["counts"]
    least = data.marking["times"]["the paper's search, every triangle, 1 thread"]["least_ms"]
    return 1e6 * least / counts["asked_by_paper"] / counts["triangles"]


def query_ns(data):
    """The time of a point query of the reference."""
    least = data.marking["times"]["the paper's search, point queries, 1 thread"]["least_ms"]
    return 1e6 * least / data.marking["counts"]["asked_by_paper"]


def floor_text(data):
    """The time of a step that missed bars would leave, and the times of its parts, by the shares of design_steps.json."""
    least = {name: t["least_ms"] for name, t in data.marking["times"].items()}
    step, fine = least.get("step, 1 thread"), least.get("step, 2 threads, fine triangles")
    queries, cgal = least.get("the paper's search, point queries, 1 thread"), least.get("CGAL, every node, 1 thread")
    if not all((step, fine, queries, cgal)):
        return ""
    share = {name: [part[name] / 100 for part in data.design["profile"]] for name in ("coarse", "fine")}
    filtered, needed = share["coarse"][0] * step, sum(share["coarse"][:2]) * step
    fine_ratio = fine / least["step, 2 threads"]
    without = fine_ratio * (1 - share["fine"][-1]) / (1 - share["coarse"][-1])
    return paragraph(
        f"*Where the floor is.* By these shares the filter takes {filtered:.1f} of the step's {step:.1f} ms on one thread, and with the "
        f"decision {needed:.1f}: that is what it takes to know the distance and the triangle of every node near the band. A ratio of 10 to "
        f"point queries would leave a whole step {queries / 10:.1f} ms, one of 45 to CGAL {cgal / 45:.1f} ms. Fine triangles take "
        f"{fine_ratio:.1f} times as long; were surfaces for nothing, it would be {without:.1f} times."
    )


def design_section(data):
    """The gains of design changes, and the parts of a step's time. They were measured once and kept in design_steps.json."""
    if not data.marking:
        return ""
    design = data.design
    rows = [
        [step["what"]] + [f"{step[name]['step']:.2f}" if name in step else "" for name in ("coarse", "fine")]
        for step in design["steps"]
    ]
    shares = [[part["what"]] + [f"{part[name]:.0f} %" for name in ("coarse", "fine")] for part in design["profile"]]
    return "\n".join([
        paragraph(
            f"One thread, milliseconds a step ({design['nodes']}; {design['triangles']['coarse']} triangles, fine "
            f"{design['triangles']['fine']}), measured {design['date']} with the library before and after each change under one "
            "program of public calls, the least of many steps in turns; each row has the ones above. Surfaces of one thread, too."
        ),
        table(["with", "coarse", "fine"], rows),
        "Where the time of such a step is now, by sampling:\n",
        table(["what", "coarse", "fine"], shares),
        paragraph(
            f"*Point queries.* One of Embree's takes {query_ns(data):.0f} ns here, and the paper's search makes one for each node in and "
            "next to the band. A step compares such a node with the sixteen triangles of one or two groups, which is nearly half of its "
            "time; the rest is spread over stages none of which is a fifth. *CGAL* is asked in a way of this project's own, faster than "
            "any call that its manual has (`bench/cgal_reference.hpp`). *Fine triangles* are fifteen times as many, each of which is "
            "made, grouped and enclosed in every step; and their groups are smaller than leaves, so that more of them are near each."
        ),
        floor_text(data),
    ])


def marking_section(data):
    if not data.marking:
        return missing("marking", "./run bench marking")
    counts = data.marking["counts"]
    rows = [[name, f"{t['least_ms']:.3f}", f"{t['median_ms']:.3f}", str(t["turns"])] for name, t in sorted(data.marking["times"].items())]
    bars = [
        [bar["name"], f"{bar['value']:.2f}", f"{'<=' if bar['kind'] == 'at most' else '>='} {bar['bar']:g}", "met" if bar["met"] else "NOT met"]
        for bar in data.marking["bars"]
    ]
    not_met = [bar for bar in data.marking["bars"] if not bar["met"]]
    text = [
        data.when("marking"),
        paragraph(
            "The surface of a valve that moved, its scene, the marking by clusters, and the list of marked nodes with distances and "
            "triangles. Contenders take turns in one run; a bar is on the ratio of the least times, the median of five parts of the "
            f"run. Aortic valve, {grouped(counts['triangles'])} triangles ({grouped(counts['fine_triangles'])} where they are fine); a "
            f"cylinder of {grouped(counts['nodes'])} nodes of which {100 * counts['marked'] / counts['nodes']:.1f} % are marked, "
            f"{100 * counts['marked_with_0.3'] / counts['nodes']:.1f} % with a half thickness of 0.3 cm. The paper's search asks "
            f"{grouped(counts['asked_by_paper'])} nodes, at {pair_ns(data):.2f} ns a pair of a node and a triangle. "
            "The bars are meant for a million nodes"
            + ("." if counts["nodes"] > 9e5 else ", which these are not: those not met say little.")
        ),
        "What a step is compared with:\n",
        "- *the paper's search*, written plainly (`bench/references.cpp`), with the distance to every triangle or by\n"
        "  Embree's point queries. The loop over triangles counts for 6 ns a pair at most, however long it takes;\n"
        "  one that kept edges and products of each triangle would take less than it does;\n"
        "- *CGAL*: a distance query of every node in its tree of boxes, bounded by the half thickness, in the fastest\n"
        "  way that was found (`bench/cgal_reference.hpp` has the others). The tree is there before: making it does\n"
        "  not count, whereas a step makes its surface. The same nodes must be marked, or the command fails;\n"
        "- *coordinates*: a pass over them that computes every node's distance from the origin;\n"
        "- itself: with other numbers of threads, instructions, triangles, half thicknesses, and with a tenth and ten\n"
        "  times of the nodes, of which only coordinates are made.\n",
        table(["what", "least, ms", "median, ms", "turns"], rows),
        table(["bar", "value", "wanted", ""], bars),
        "\n".join(data.marking.get("left_out", [])),
    ]
    if not_met:
        text.append(
            "What is not met, and by which factor:\n\n"
            + "".join(
                f"- {bar['name']}: {max(bar['value'] / bar['bar'], bar['bar'] / bar['value']):.2f}\n" for bar in not_met
            )
        )
    else:
        text.append("All bars are met.\n")
    return "\n".join(filter(None, text))


# ------------------------------------------------------------------------------------------------------------------- peers

BOUNDED = ("CGAL", "VTK, vtkStaticCellLocator", "fcpw")


def peers_table(data, valve):
    own = data.peers[valve]
    by_clusters, every = own["times"]["riis, clusters"]["least_ms"], own["times"]["riis, every distance"]["least_ms"]
    rows = []
    for peers in (own, (data.python_peers or {}).get(valve)):
        if not peers:
            continue
        for name, t in sorted(peers["times"].items(), key=lambda item: item[1]["least_ms"]):
            marks = peers["marks"][name]
            reasons = ", ".join(f"{n} {reason}" for reason, n in sorted(marks["reasons"].items()))
            is_bounded = name.startswith(BOUNDED) or name in ("riis, clusters", "riis, exhaustive search")
            rows.append(
                [
                    name, "yes" if is_bounded else "no", grouped(marks["marked"]),
                    str(marks["different"]) + (f" ({reasons})" if reasons else ""), f"{marks['largest_difference']:.1g}",
                    number(t["least_ms"]), number(t["least_ms"] / by_clusters), "" if is_bounded else number(t["least_ms"] / every),
                ]
            )  # fmt: skip
    heads = ["what", "bounded", "marked", "marked differently", "distances differ by, cm", "least, ms", "/ clusters", "/ every distance"]
    return table(heads, rows)


def peers_section(data, images=None):
    if not data.peers:
        return missing("peers", "./run bench peers")
    text = [
        data.when("peers"),
        paragraph(
            "The same nodes and the same triangles given to others, on one processor. The slow ones take seconds a million nodes, so "
            f"the mesh has about a hundred thousand ({grouped(data.peers['aortic']['nodes'])}). First the marks are compared with those "
            "of a loop over all triangles in double precision; a node that is marked differently is counted by the reason: *rounding*, "
            "its distance is the half thickness to 1e-12 cm; *float*, to 2e-6 cm, what single precision gives; *degenerate*, its "
            "nearest triangle is a sliver; *radius*, the bounded query found nothing though there is something; *unexplained*. Who is "
            "*bounded* is asked within the half thickness, the others for any distance, which is more work; their counterpart here "
            "is *every distance*. Trees are there before: making them does not count."
        ),
    ]
    for valve in VALVES:
        text += [f"{valve.capitalize()} valve, {grouped(data.peers[valve]['triangles'])} triangles:\n", peers_table(data, valve)]
    text.append((images or {}).get("peers", ""))
    if data.python_peers:
        text.append(
            paragraph(
                "The packages of PyPI, those with a version in their name, were measured by `bench/peers.py` right after, in a "
                "process of their own that was kept to one processor, with their arrays made before. libigl and point-cloud-utils "
                "make their tree in every call."
            )
        )
    else:
        text.append(paragraph("Peers from PyPI are measured by `./run bench peers`, which was not run here."))
    left_out = {}
    for peers in (data.peers, data.python_peers):
        for valve in VALVES:
            left_out.update(((peers or {}).get(valve) or {}).get("left_out") or {})
    text += [f"Left out: {name} ({why}).\n" for name, why in sorted(left_out.items())]
    return "\n".join(filter(None, text))


# -------------------------------------------------------------------------------------------------------------------- page


SEARCH_LINES = (
    ("paper_exhaustive", "plain exhaustive"), ("paper_neighbor", "plain neighbour"), ("exhaustive", "exhaustive"),
    ("neighbor_warm", "neighbour"), ("clusters", "clusters"),
)  # fmt: skip


def plot_searches(data, path):
    """Plots seconds by nodes, on one thread. Returns False if it cannot be drawn."""
    panels = []
    for valve in VALVES:
        rows = [row for row in paper_rows(data, valve) if row[1] == 1]
        lines = [
            ("paper, exhaustive", [(nodes, exhaustive) for nodes, _, exhaustive, _, _ in rows], "--"),
            ("paper, neighbour", [(nodes, neighbor) for nodes, _, _, neighbor, _ in rows], "--"),
        ]
        lines += [(label, [(runs["exhaustive"]["nodes"], ms_of(name, runs[name]) / 1e3) for *_, runs in rows], "-") for name, label in SEARCH_LINES]
        panels.append((f"{valve} valve, 1 thread", lines))
    return bool(data.searches) and figure.lines(panels, "nodes", "seconds", path)


def plot_threads(data, path):
    """Plots the speed-up over one thread, for a million nodes. Returns False if it cannot be drawn."""
    if not data.searches or not data.machine:
        return False
    panels, ticks = [], [row[0] for row in data.paper[VALVES[0]][0]["rows"]]
    processors = data.machine["machine"]["processors"]
    for valve in VALVES:
        block = data.paper[valve][SIZES.index(1000)]
        runs = {threads: runs for nodes, threads, _, _, runs in paper_rows(data, valve) if nodes == block["nodes"]}
        if 1 not in runs:
            continue
        lines = [
            (label, [(row[0], block["rows"][0][column] / row[column]) for row in block["rows"]], "--")
            for column, label in ((1, "paper, exhaustive"), (2, "paper, neighbour"))
        ]
        lines += [
            (label, [(threads, ms_of(name, runs[1][name]) / ms_of(name, run[name])) for threads, run in sorted(runs.items())], "-")
            for name, label in SEARCH_LINES
        ]
        lines.append(("as many times as threads", [(n, n) for n in ticks], "-"))
        panels.append((f"{valve} valve, a million nodes, {plural(processors, 'processor')} here", lines))
    limit = (processors, f"shaded: oversubscribed here, more\nthreads than {plural(processors, 'processor')}")
    return bool(panels) and figure.lines(panels, "threads", "times faster than one thread", path, ticks, limit)


def plot_peers(data, path):
    """Plots the milliseconds of each. Returns False if it cannot be drawn."""
    panels = []
    for valve in VALVES:
        bars = {name: t["least_ms"] for part in (data.peers, data.python_peers) if part for name, t in part[valve]["times"].items()}
        panels.append((f"{valve} valve", sorted(bars.items(), key=lambda item: -item[1])))
    return bool(data.peers) and figure.bars(panels, "milliseconds", path)


PLOTS = (
    ("searches", plot_searches, "Seconds of a marking by nodes, the paper's and those here, on one thread"),
    ("threads", plot_threads, "How many times faster than one thread, the paper's searches and those here; shaded: more threads than processors"),
    ("peers", plot_peers, "Milliseconds of each peer for the same nodes"),
)


def images_for_page(data, folder):
    """Draws all plots that it can. Returns the markdown of each by its name."""
    return {
        name: f"![{title}](performance-{name}.png)\n" for name, plot, title in PLOTS if plot(data, os.path.join(folder, f"performance-{name}.png"))
    }


def measured_text(data, name):
    """Like Data.when, but in HTML and with the machine, which has no table there."""
    run = data.run(name)
    if not run:
        return ""
    machine = data.machine["machine"]
    return f"Measured {run['date']} by <code>{run['command']}</code> on {machine['CPU']}, {plural(machine['processors'], 'processor')}, load before {run['load_before']:.1f}."


def plot_left_out(data, name, title):
    """A text on a plot that is not drawn: its name, the reason, and the command that gets it."""
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
    """Writes the plots for riis-figures' page, and plots.json with their texts and the left-out plots with reasons."""
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
                "caption": "Dashed, the paper's own seconds, from its tables, on its machine. <i>Plain</i>: its two algorithms, the "
                "distance to every triangle, written plainly and run here. The others are this library's searches, which mark the "
                "same nodes: exhaustive, neighbour and clusters. Tolerance 5 %, half thickness 0.1 cm. Where shaded, "
                "there are more threads than processors here (oversubscribed): no search can gain by them. The paper's lines are of its "
                "own machine. " + measured_text(data, "searches"),
                "paper": "tables <i>Scaling of mesh traversal functions</i> of the aortic and of the mitral valve (section 4.2.3).",
            }
        )
    if "peers" in drawn:
        figures.append(
            {
                "title": "Other libraries",
                "columns": 1,
                "panels": [{"png": "peers.png", "caption": drawn["peers"] + "."}],
                "caption": f"{grouped(data.peers['aortic']['nodes'])} nodes, one thread, the same triangles. "
                "docs/performance.md has who is asked within the half thickness only, and which nodes are marked differently. "
                + measured_text(data, "peers"),
                "paper": "nothing: it compares with itself only.",
            }
        )
    left_out = [plot_left_out(data, name, title) for name, _, title in PLOTS if name not in drawn]
    path = os.path.join(folder, "plots.json")
    with open(path, "w", encoding="utf-8") as file:
        json.dump({"figures": figures, "left_out": left_out}, file, indent=2)
        file.write("\n")
    print(f"==> left: {path}, {len(figures)} figures")
    for text in left_out:
        print(f"==> not drawn: {text}")


def page(data, folder):
    images = images_for_page(data, folder)
    sections = [
        "# Performance\n",
        "<!-- Made by bench/report.py (./run bench) from out/bench/*.json: edit the prose there. -->\n",
        paragraph(
            "What a marking costs, beside the paper's figures, beside others, and stage by stage. `./run bench full` measures all of "
            "it and makes this page, `./run bench` a short variant of it; below each headline is which of them it was. Figures are "
            "only worth something where nothing else runs: the load before is that of the last minute."
        ),
        machine_section(data),
        "## The paper's tables\n", searches_section(data, images),
        "## What the neighbour search costs once\n", once_section(data),
        "## Stage by stage\n", stages_section(data),
        "## A time step\n", marking_section(data),
        "### What the design bought\n", design_section(data),
    ]  # fmt: skip
    if data.accuracy is not None:
        sections += [accuracy_section(data.accuracy)]
    sections += ["## Others\n", peers_section(data, images)]
    return "\n".join(section.rstrip("\n") + "\n" for section in sections)


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--data", default=os.path.join("out", "bench"), help="the folder of the JSON (%(default)s)")
    parser.add_argument("--page", default=os.path.join("docs", "performance.md"), help="the page to write (%(default)s)")
    parser.add_argument("--print", choices=("search", "marking", "peers"), help="print that section in place of writing the page")
    parser.add_argument("--figures", metavar="FOLDER", help="only draw the plots of the figures' page there, with plots.json for it")
    options = parser.parse_args(arguments)
    data = Data(options.data)
    if options.figures:
        write_figures(data, options.figures)
        return 0
    if options.print:
        print({"search": searches_section, "marking": marking_section, "peers": peers_section}[options.print](data))
        return 0
    text = page(data, os.path.dirname(options.page) or ".")
    with open(options.page, "w", encoding="utf-8") as file:
        file.write(text)
    print(f"==> left: {options.page}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
