#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reports which benchmarks have become slower than a baseline. The exit status is 1 if a benchmark became slower.

Times are divided by those of the calibration benchmarks of the same run. The division makes runs on two machines, or on one
machine on two days, comparable. There are two calibrations, for memory and for arithmetic. A benchmark may depend on memory or on
arithmetic, so it counts as slower only if it is slower relative to both calibrations. If the calibrations of two machines differ
by a factor, a loss below this factor is not noticed. The output states this factor, and --factor should not be smaller.

Exit status: 0, no benchmark is slower; 1, one is slower, is missing or ended early; 2, a file has the wrong content."""

import argparse
import json
import sys

import gbench

CALIBRATION = "calibration_"


class Unusable(Exception):
    pass


def read(path):
    """Returns times in milliseconds by name, and the failures. The file is a baseline, or JSON of Google Benchmark."""
    try:
        with open(path, encoding="utf-8") as file:
            data = json.load(file)
        if "milliseconds" in data:
            times, failed = {name: float(ms) for name, ms in data["milliseconds"].items()}, {}
        else:
            best, failed = gbench.least_times(data["benchmarks"])
            times = {name: run["ms"] for name, run in best.items()}
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise Unusable(f"{path}: {type(error).__name__}: {error}") from error
    if not any(name.startswith(CALIBRATION) for name in times):
        raise Unusable(f"{path}: no benchmark {CALIBRATION}*, so nothing can be compared")
    for name, ms in times.items():
        if not ms > 0:
            raise Unusable(f"{path}: {name} took {ms} ms")
    return times, failed


def compare(base, now):
    """Returns by how many times each benchmark is slower now. The more lenient calibration counts. Also returns the factors of
    the calibrations themselves."""
    calibrations = sorted(name for name in base if name.startswith(CALIBRATION) and name in now)
    if not calibrations:
        raise Unusable("the two files have no calibration in common")
    machine = {name: now[name] / base[name] for name in calibrations}
    factors = {}
    for name in sorted(base):
        if name in now and not name.startswith(CALIBRATION):
            factors[name] = now[name] / base[name] / max(machine.values())
    return factors, machine


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("base", help="a baseline, or Google Benchmark's JSON")
    parser.add_argument("now", help="the same for the run to be judged")
    parser.add_argument("--factor", type=float, default=1.3, help="fail if something is slower by more than this (%(default)s)")
    options = parser.parse_args(arguments)
    if not options.factor > 0:
        parser.error(f"argument --factor: {options.factor} is not above 0")
    try:
        (base, _), (now, failed) = read(options.base), read(options.now)
        factors, machine = compare(base, now)
    except Unusable as error:
        print(f"compare.py: {error}", file=sys.stderr)
        return 2

    for name, factor in machine.items():
        print(f"{name}: {factor:.2f} times the baseline's time")
    spread = max(machine.values()) / min(machine.values())
    print(f"A loss of less than {spread:.2f} times may stay unseen, because the calibrations differ by as much.\n")
    bad = False
    for name, factor in sorted(factors.items(), key=lambda item: -item[1]):
        slower = factor > options.factor
        bad = bad or slower
        print(f"{factor:7.2f}  {name}{'  SLOWER' if slower else ''}")
    for name in sorted(set(base) - set(now)):
        bad = True
        print(f"   FAILED  {name}: {failed[name]}" if name in failed else f"     GONE  {name}")
    for name in sorted(set(failed) - set(base)):
        bad = True
        print(f"   FAILED  {name}: {failed[name]}")
    for name in sorted(set(now) - set(base)):
        print(f"      new  {name}")
    n_slower = sum(factor > options.factor for factor in factors.values())
    print(f"\n{n_slower} of {len(factors)} are slower by more than {options.factor:g}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
