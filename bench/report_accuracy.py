# SPDX-License-Identifier: Apache-2.0
"""The section on accuracy of docs/performance.md, from out/bench/accuracy.json, which ./run bench accuracy writes.

accuracy_section(data) returns it as markdown. As a program this file prints it: bench/report_accuracy.py [FILE.json]
"""

import json
import sys
import textwrap


def _count(n):
    return f"{n:,}"


def _share(share):
    """Half thicknesses as per cent, with two digits."""
    percent = 100 * share
    if percent >= 9.95:
        return f"{percent:.0f} %"
    if percent >= 0.095:
        return f"{percent:.1f} %" if percent >= 0.95 else f"{percent:.2f} %"
    return f"{percent:.1g} %"


def _over(result):
    n = result["n_over_tolerance"]
    return f"{100 * n / result['n_points']:.2f} %" if n else "none"


def _time(microseconds):
    return f"{microseconds:.0f}" if microseconds >= 9.95 else f"{microseconds:.1f}"


def _row(cells):
    return "| " + " | ".join(cells) + " |"


def _paragraph(text, **indents):
    # No line may begin with a per cent sign.
    return textwrap.fill(" ".join(text.split()).replace(" %", "~%"), width=100, **indents).replace("~%", " %")


def _leaflet_title(leaflet):
    return f"{leaflet['valve'].capitalize()} valve, {leaflet['leaflet']}"


def _table(leaflet):
    head = ["method", "tolerance", "made of"]
    for where in ("on it", "off it"):
        head += [f"{where}: median", "95 %", "largest", "over", "µs a point"]
    lines = [_row(head), "|" + "---|" * len(head)]
    made_of = {"triangulation": "triangles", "sampling": "samples", "minimisation": "patches"}
    for run in leaflet["runs"]:
        cells = [run["method"], run["setting"], f"{_count(run['size'])} {made_of[run['method']]}"]
        for where in ("on_surface", "off_surface"):
            result = run[where]
            cells += [_share(result["median"]), _share(result["p95"]), _share(result["max"]), _over(result),
                      _time(result["microseconds"]["mean"])]
        lines.append(_row(cells))
    return "\n".join(lines)


def _runs(data, method):
    return [run for leaflet in data["leaflets"] for run in leaflet["runs"] if run["method"] == method]


def _results(runs):
    return [run[where] for run in runs for where in ("on_surface", "off_surface")]


def _findings(data):
    """The findings. Each sentence is made from the numbers."""
    used = [run[where]["max"] / run["tolerance"] for run in _runs(data, "triangulation")
            for where in ("on_surface", "off_surface")]
    sampled = [run["on_surface"]["max"] / run["tolerance"] for run in _runs(data, "sampling")]
    sampled_off = [run["off_surface"]["max"] / run["tolerance"] for run in _runs(data, "sampling")]
    minimized = _results(_runs(data, "minimisation"))
    n_over = {method: sum(result["n_over_tolerance"] for result in _results(_runs(data, method)))
              for method in ("triangulation", "sampling")}
    slow = [run[where]["microseconds"] for run in _runs(data, "minimisation") for where in ("on_surface", "off_surface")]
    fast = [run[where]["microseconds"] for run in _runs(data, "triangulation") for where in ("on_surface", "off_surface")]

    def spread(times):
        return max(time["p95"] / time["median"] for time in times)

    return "\n".join(_paragraph(line, initial_indent="- ", subsequent_indent="  ") for line in (
        f"""*Triangulation* uses {100 * min(used):.0f} to {100 * max(used):.0f} % of its tolerance;
        {_count(n_over['triangulation'])} points are over it.""",
        f"""*Sampling* uses {100 * min(sampled):.0f} to {100 * max(sampled):.0f} % of it on the surface, and {100 * min(sampled_off):.0f} to {100 * max(sampled_off):.0f} % off it; {_count(n_over['sampling'])} points are over it.""",
        f"""*Minimisation* is off by {_share(min(result['median'] for result in minimized))} to
        {_share(max(result['median'] for result in minimized))} in the middle (medians), and by up to
        {_share(max(result['max'] for result in minimized))} where it ended in a local minimum, or short of one. Its tolerance ends
        iterations and bounds nothing: up to {100 * max(result['share_over_tolerance'] for result in minimized):.2f} %
        of the points are over it.""",
        f"""*Times* of single queries: the slowest twentieth of a run begins at up to {spread(fast):.1f} times its
        median with triangles, {spread(slow):.1f} times with minimisation."""))


def accuracy_section(data: dict) -> str:
    """Returns markdown, from the heading to the last table, for the content of accuracy.json."""
    machine, first = data["machine"], data["leaflets"][0]["truth"]
    offsets = ", ".join(f"{offset:g}" for offset in first["offsets_half_thicknesses"])
    parts = [
        "## How far off distances are",
        _paragraph(f"""`./run bench accuracy`, after the paper's "Performance evaluation": a leaflet of either valve
            by itself, with the paper's parameters, the mitral one open. Points *on* the smooth surface, evenly by
            area, whose distance is 0, and points *off* it, {offsets} half thicknesses along its normal. The
            smooth surface is evaluated from the Bézier curves themselves, with neither polylines nor a tolerance.
            Errors are in per cent of the half thickness, {data['half_thickness']:g} cm; "over" are points that are
            off by more than the tolerance."""),
        _paragraph(f"""{machine['cpu']}, {machine['cores']} cores, {machine['compiler']}; riis {machine['riis']}. Times
            are the mean of all points by one thread. Sampling is asked through boxes of boxes of samples,
            triangles through Embree; the paper's loops over all of them take time in proportion to their
            number."""),
    ]
    for leaflet in data["leaflets"]:
        truth = leaflet["truth"]
        parts += [
            f"### {_leaflet_title(leaflet)}",
            _paragraph(f"""{_count(truth['n_on_surface'])} points on the surface, {_count(truth['n_off_surface'])} off
                it. Left out off it: {_count(truth['n_left_out_curved'])} whose offset is more than
                {truth['largest_share_of_curvature_radius']:g} of the curvature radius,
                {_count(truth['n_left_out_other_part_nearer'])} to which another part of the leaflet is nearer than
                their foot. Both were checked with {_count(truth['n_fine_triangles'])} triangles, within
                {_share(truth['fine_error'])} of the smooth surface: distances to them differ from the true ones by at
                most {_share(truth['most_from_fine'])}."""),
            _table(leaflet),
        ]
    parts += ["### What it means", _findings(data),
              _paragraph("""`./run figures` paints the errors on both leaflets and draws how they are
                  distributed.""")]
    return "\n\n".join(parts) + "\n"


if __name__ == "__main__":
    with open(sys.argv[1] if len(sys.argv) > 1 else "out/bench/accuracy.json", encoding="utf-8") as file:
        print(accuracy_section(json.load(file)), end="")
