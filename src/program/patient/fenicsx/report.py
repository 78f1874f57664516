#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""report.py: prints a table of the last beat in valve.csv, and what it should be, and writes report.txt. It needs no dolfinx, and
also works while run.py runs.

It ends with 1 if a value is not as it should be, and with 2 if the beat is not complete.
"""
import csv
import json
import pathlib
import sys

from beat_table import beat_table, save_and_print

HERE = pathlib.Path(__file__).resolve().parent


def table():
    """Prints the table, and returns its status."""
    case = json.loads((HERE / "case.json").read_text("utf-8"))
    with open(HERE / "valve.csv", newline="", encoding="utf-8") as file:
        rows = [{name: float(word) for name, word in row.items()} for row in csv.DictReader(file)]
    ideal = case["half_thickness"] / case["resistance"]
    steps = [{"time": row["time_s"], "opening": row["opening"], "flow": row["flow_m3_s"], "balance": row["balance_m3_s"],
              "difference": row["before_Pa"] - row["behind_Pa"], "fastest": row["fastest_m_s"],
              "band": row["fastest_in_band_m_s"], "leak": ideal * row["area_m2"] * (row["behind_Pa"] - row["before_Pa"]),
              "arterial": row["behind_Pa"] if case["windkessels"] else None}
             for row in rows]
    text, status = beat_table(steps, case["period"], where="node")
    save_and_print(text, HERE)
    return status


def main():
    if not (HERE / "valve.csv").exists():
        sys.exit(f"report.py: {HERE} has no valve.csv yet: run.py writes it after ten steps")
    return table()


if __name__ == "__main__":
    sys.exit(main())
