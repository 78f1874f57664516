# SPDX-License-Identifier: Apache-2.0
"""Computes the numbers on accuracy in out/bench/details.md from out/bench/accuracy.json, which ./run bench accuracy writes.

accuracy_values(data) returns the numbers by their names in details.template.md.
"""


def _count(n):
    return f"{n:,}"


def _share(share):
    """Formats a fraction of the half thickness as per cent, with two digits."""
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
    """Returns sentences about the numbers."""
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

    return {
        "least_used": f"{100 * min(used):.0f}", "most_used": f"{100 * max(used):.0f}",
        "n_over_triangulation": _count(n_over["triangulation"]),
        "least_sampled": f"{100 * min(sampled):.0f}", "most_sampled": f"{100 * max(sampled):.0f}",
        "least_sampled_off": f"{100 * min(sampled_off):.0f}", "most_sampled_off": f"{100 * max(sampled_off):.0f}",
        "n_over_sampling": _count(n_over["sampling"]),
        "least_minimized": _share(min(result["median"] for result in minimized)),
        "most_minimized": _share(max(result["median"] for result in minimized)),
        "worst_minimized": _share(max(result["max"] for result in minimized)),
        "share_over": f"{100 * max(result['share_over_tolerance'] for result in minimized):.2f}",
        "spread_triangulation": f"{spread(fast):.1f}", "spread_minimisation": f"{spread(slow):.1f}",
    }  # fmt: skip


def _leaflet_values(leaflet):
    truth = leaflet["truth"]
    return {
        "title": _leaflet_title(leaflet),
        "n_on": _count(truth["n_on_surface"]),
        "n_off": _count(truth["n_off_surface"]),
        "n_curved": _count(truth["n_left_out_curved"]),
        "largest_share": f"{truth['largest_share_of_curvature_radius']:g}",
        "n_nearer": _count(truth["n_left_out_other_part_nearer"]),
        "n_fine": _count(truth["n_fine_triangles"]),
        "fine_error": _share(truth["fine_error"]),
        "most_from_fine": _share(truth["most_from_fine"]),
        "accuracy_table": _table(leaflet),
    }


def accuracy_values(data: dict) -> dict:
    """Returns the values for the content of accuracy.json."""
    machine, first = data["machine"], data["leaflets"][0]["truth"]
    return {
        "offsets": ", ".join(f"{offset:g}" for offset in first["offsets_half_thicknesses"]),
        "half_thickness": f"{data['half_thickness']:g}",
        **{name: machine[name] for name in ("cpu", "cores", "compiler", "riis")},
        "leaflets": [_leaflet_values(leaflet) for leaflet in data["leaflets"]],
        **_findings(data),
    }
