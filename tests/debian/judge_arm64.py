#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""judge_arm64.py RESULTS SKIPPED: counts the results of CTest in the file RESULTS (JUnit). Refuses failures, and skips that the
file SKIPPED does not expect. A test that passes may have skipped some of its cases."""

import re
import sys
import xml.etree.ElementTree


def expected_skips(lines):
    """Returns the expected skips, TEST or TEST/CASE. Each name has the text that the skipped test must print, or None."""
    expected = {}
    for number, line in enumerate(lines, 1):
        if not line.strip() or line.startswith("#"):
            continue
        parts = re.fullmatch(r'([\w/]+) *(?:"([^"]+)")? *: \S.*', line.rstrip("\n"))
        if not parts or ("/" in parts[1]) == bool(parts[2]):
            raise ValueError(f'line {number} is neither TEST "PRINTED TEXT": REASON nor TEST/CASE: REASON: {line.strip()}')
        expected[parts[1]] = parts[2]
    return expected


def judge(results, expected):
    """Returns the number of tests that passed, the number of skipped tests, the skipped cases of tests that passed, and the
    faults."""
    passed, skipped, cases, faults = 0, 0, [], []
    for test in results.iter("testcase"):
        name, output = test.get("name"), test.findtext("system-out") or ""
        if test.find("skipped") is not None or test.get("status") in ("notrun", "disabled"):
            skipped += 1
            if name not in expected:
                faults.append(f"{name} was skipped, which is not expected: {output.strip()[-300:]}")
            elif not expected[name] or expected[name] not in output:
                faults.append(f"{name} was skipped for another reason than expected: {output.strip()[-300:]}")
        elif test.find("failure") is not None or test.get("status") != "run":
            faults.append(f"{name} failed")
        else:
            passed += 1
            for case in dict.fromkeys(re.findall(r"^\[  SKIPPED \] (\w+)$", output, re.MULTILINE)):
                cases.append(f"{name}/{case}")
                if f"{name}/{case}" not in expected:
                    faults.append(f"{name} skipped its case {case}, which is not expected")
    if passed + skipped + len(faults) == 0:
        faults.append("no test ran")
    return passed, skipped, cases, faults


def main(results_file, skipped_file):
    with open(skipped_file, encoding="utf-8") as file:
        expected = expected_skips(file)
    passed, skipped, cases, faults = judge(xml.etree.ElementTree.parse(results_file), expected)
    print(f"{passed} tests passed, {skipped} were skipped; of those that passed, {len(cases)} cases were skipped")
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    try:
        sys.exit(main(*sys.argv[1:]))
    except ValueError as error:
        sys.exit(f"judge_arm64.py: {sys.argv[2]}: {error}")
