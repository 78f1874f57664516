# SPDX-License-Identifier: Apache-2.0
"""Reads Google Benchmark's JSON."""

import json

MILLISECONDS = {"ns": 1e-6, "us": 1e-3, "ms": 1.0, "s": 1e3}


def without_suffix(name):
    """Shortens search_clusters/0/110/1/min_time:0.250/real_time to search_clusters/0/110/1."""
    parts = name.split("/")
    return "/".join(p for p in parts if p not in ("real_time", "process_time") and not p.startswith(("min_time:", "repeats:")))


def least_times(runs):
    """Returns the "benchmarks" of a file by name, and the messages of the runs that ended early. If a benchmark was repeated, the
    run with the least time counts. "ms" is the counter least_ms, the shortest single call. Without this counter, "ms" is the time
    per iteration."""
    best, failed = {}, {}
    for run in runs:
        if run.get("run_type", "iteration") != "iteration":
            continue
        name = without_suffix(run.get("run_name", run["name"]))
        if run.get("error_occurred") or run.get("skipped"):
            failed[name] = run.get("error_message") or run.get("skip_message") or "ended early"
            continue
        time = run.get("least_ms", run["real_time"] * MILLISECONDS[run["time_unit"]])
        if name not in best or time < best[name]["ms"]:
            best[name] = {**run, "ms": time}
    return best, failed


def load(path):
    with open(path, encoding="utf-8") as file:
        return least_times(json.load(file)["benchmarks"])
