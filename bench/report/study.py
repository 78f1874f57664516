#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""./run bench: runs the benchmark programs and leaves their JSON in out/bench. report.py makes the page from this JSON.

out/bench/machine.json has the machine, the dates and the commands."""

import argparse
import datetime
import json
import os
import platform
import subprocess
import sys

import compare
import report

PAPER_THREADS = (1, 2, 4, 8, 12)
SEARCHES = "exhaustive|clusters|neighbor_warm|neighbor_cold|paper|all_distances|paper_exhaustive|paper_neighbor"
ONCE = "^search_(every_triangle|groups|adjacency)"
STAGES = "^(calibration|pipeline|distance_query|surface_update|closest_point|mark_exhaustive|brute_force)"
# Baselines keep these benchmarks. Each benchmark takes at most about a second, on the smallest mesh.
GUARDED = (
    r"^(calibration|pipeline|surface_update|closest_point/|mark_exhaustive|distance_query/.*/(method:0/|method:1/tolerance:50/))"
    r"|^search_(exhaustive|clusters|neighbor_warm|neighbor_cold|all_distances)/[01]/110/[12]/"
)
# The results that a new study removes first. Other programs wrote the other files, or the study always writes them again.
OWN_JSON = ("searches", "stages", "marking", "roofline", "accuracy", "peers", "peers_python")


def processors():
    return len(os.sched_getaffinity(0))


def first_line(path, key):
    try:
        with open(path, encoding="utf-8") as file:
            for line in file:
                name, _, value = line.partition(":")
                if name.strip() == key:
                    return value.strip()
    except OSError:
        pass
    return "unknown"


def operating_system():
    try:
        return platform.freedesktop_os_release()["PRETTY_NAME"]
    except (OSError, KeyError):
        return platform.platform()


def caches():
    """Returns the cache sizes of the first processor, by level."""
    folder, found = "/sys/devices/system/cpu/cpu0/cache", []
    try:
        for index in sorted(os.listdir(folder)):
            if index.startswith("index"):
                level, kind, size = (
                    open(f"{folder}/{index}/{name}", encoding="ascii").read().strip() for name in ("level", "type", "size")
                )
                if kind != "Instruction":
                    found.append(f"L{level} {size}")
    except OSError:
        return "unknown"
    return ", ".join(found)


def machine(build):
    with open(os.path.join(build, "bench", "versions.json"), encoding="utf-8") as file:
        versions = json.load(file)
    return {
        "CPU": first_line("/proc/cpuinfo", "model name"),
        "architecture": platform.machine(),
        "processors": processors(),
        "caches": caches(),
        "memory": first_line("/proc/meminfo", "MemTotal"),
        "system": f"{operating_system()}, Linux {platform.release()}",
        "versions": versions,
    }


class Study:
    def __init__(self, build, out, command):
        self.build, self.out, self.command = build, out, command
        os.makedirs(out, exist_ok=True)
        self.record = {"machine": machine(build), "runs": {}}
        try:
            with open(self.path("machine"), encoding="utf-8") as file:
                before = json.load(file)
        except (OSError, ValueError):
            before = {}
        if before.get("machine") == self.record["machine"]:
            self.record["runs"] = before["runs"]
        elif before:
            print("==> out/bench has figures of another machine or another build: they are removed", flush=True)
            for name in OWN_JSON:
                if os.path.exists(self.path(name)):
                    os.remove(self.path(name))

    def path(self, name):
        return os.path.join(self.out, name + ".json")

    def program(self, name):
        return os.path.join(self.build, "bench", name)

    def run(self, name, command):
        """Runs a command that writes out/bench/NAME.json, and records the time. The file is replaced only if the command
        succeeds."""
        print(f"==> {name}: {' '.join(command)}", flush=True)
        load = os.getloadavg()[0]
        date = datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC")
        part = self.path(name) + ".part"
        words = [part if word == "OUT" else word.replace("=OUT", "=" + part) for word in command]
        status = subprocess.run(words, check=False).returncode
        if status:
            sys.exit(f"study.py: {command[0]} failed ({status})")
        os.replace(part, self.path(name))
        self.record["runs"][name] = {"date": date, "command": self.command, "load_before": load}
        with open(self.path("machine"), "w", encoding="utf-8") as file:
            json.dump(self.record, file, indent=2, sort_keys=True)
            file.write("\n")

    def google_benchmark(self, name, regex, seconds, repetitions):
        # The order is random, so that other work on the machine slows all benchmarks alike.
        self.run(
            name,
            [
                self.program("riis_bench"), f"--benchmark_filter={regex}", f"--benchmark_min_time={seconds}",
                f"--benchmark_repetitions={repetitions}", "--benchmark_enable_random_interleaving=true",
                "--benchmark_display_aggregates_only=true", "--benchmark_out_format=json", "--benchmark_out=OUT",
            ],
        )  # fmt: skip

    def searches(self, full):
        threads = [n for n in PAPER_THREADS if full or n <= processors()]
        regex = f"^search_({SEARCHES})/[01]/[0-9]+/({'|'.join(map(str, threads))})/|{ONCE}"
        self.google_benchmark("searches", regex, 0.2 if full else 0.05, 3 if full else 1)

    def stages(self, full):
        self.google_benchmark("stages", STAGES, 0.2 if full else 0.05, 3 if full else 1)

    def marking(self, full):
        self.run("marking", [self.program("riis_bench_marking"), "OUT", "1000" if full else "200"])

    def roofline(self, full):
        self.run("roofline", [self.program("riis_bench_roofline"), "OUT", "1000" if full else "200"])

    def accuracy(self, full):
        self.run("accuracy", [self.program("riis_accuracy"), "OUT", "20000" if full else "2000"])

    def peers(self):
        # Old results of the Python packages are removed, because they belong to an earlier run of the other packages.
        if os.path.exists(self.path("peers_python")):
            os.remove(self.path("peers_python"))
        os.makedirs(os.path.join(self.out, "peers"), exist_ok=True)
        self.run("peers", [self.program("riis_bench_peers"), "OUT", "100", os.path.join(self.out, "peers")])

    def python_peers(self):
        environment = os.path.join(self.build, "peers-venv")
        python = os.path.join(environment, "bin", "python")
        if not os.path.exists(os.path.join(environment, "complete")):
            print("==> numpy, libigl, open3d, fcpw, point-cloud-utils from PyPI", flush=True)
            subprocess.run([sys.executable, "-m", "venv", "--clear", environment], check=True)
            for package in ("numpy", "libigl", "fcpw", "point-cloud-utils", "open3d"):
                pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", package]
                if subprocess.run(pip, check=False).returncode:
                    print(f"==> {package} cannot be installed and is left out", flush=True)
            open(os.path.join(environment, "complete"), "w", encoding="ascii").close()
        here = os.path.dirname(os.path.abspath(__file__))
        self.run("peers_python", [python, os.path.join(here, "..", "peers", "peers.py"), os.path.join(self.out, "peers"), "OUT"])

    def missing_for_figures(self):
        """Measures the costs that the page of figures plots, if out/bench lacks them. Existing results are kept, because they may
        come from a longer run."""
        for name, measure in (("searches", lambda: self.searches(False)), ("peers", self.peers)):
            if os.path.exists(self.path(name)):
                print(f"==> {self.path(name)} is there and is not measured again", flush=True)
            else:
                measure()

    def guard(self):
        self.google_benchmark("guard", GUARDED, 0.1, 5)

    def keep_baseline(self, path):
        times, failed = compare.read(self.path("guard"))
        if failed:
            sys.exit(f"study.py: {failed}: not kept")
        run = self.record["runs"]["guard"]
        with open(path, "w", encoding="utf-8") as file:
            json.dump({"machine": self.record["machine"], **run, "milliseconds": times}, file, indent=2, sort_keys=True)
            file.write("\n")
        print(f"==> wrote {path}")


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "what", choices=("short", "full", "search", "marking", "roofline", "accuracy", "peers", "compare", "baseline", "figures")
    )
    parser.add_argument("file", nargs="?", help="the file of compare or baseline")
    parser.add_argument("--factor", default="1.3", help="compare fails if something is slower by more than this (%(default)s)")
    parser.add_argument("--build", default="build")
    parser.add_argument("--out", default=os.path.join("out", "bench"))
    options = parser.parse_args(arguments)
    words = {"short": "", "compare": "--compare"}.get(options.what, options.what)
    command = (
        "./run figures --measure" if options.what == "figures" else " ".join(filter(None, ["./run bench", words, options.file]))
    )
    study = Study(options.build, options.out, command)
    if options.what == "figures":
        study.missing_for_figures()
        return 0
    full = options.what != "short"
    if options.what in ("compare", "baseline"):
        if not options.file:
            parser.error(f"{options.what} takes a file")
        if options.what == "compare":
            try:
                compare.read(options.file)  # read first, before minutes have been spent
            except compare.Unusable as error:
                sys.exit(f"study.py: {error}")
        study.guard()
        if options.what == "baseline":
            return study.keep_baseline(options.file)
        return compare.main([options.file, study.path("guard"), "--factor", options.factor])
    if options.what in ("short", "full", "search"):
        study.searches(full)
    if options.what in ("short", "full"):
        study.stages(full)
    if options.what in ("short", "full", "marking"):
        study.marking(full)
    if options.what in ("short", "full", "roofline"):
        study.roofline(full)
    if options.what in ("short", "full", "accuracy"):
        study.accuracy(full)
    if options.what in ("short", "full", "peers"):
        study.peers()
    if options.what == "peers":
        study.python_peers()
    if options.what in ("short", "full"):
        return report.main(["--data", options.out])
    if options.what == "accuracy":
        return 0  # the program has printed its tables
    return report.main(["--data", options.out, "--print", options.what])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
