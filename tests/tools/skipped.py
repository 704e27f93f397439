#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What CTest's last run skipped and why, a line for each reason: CTest itself lists skipped programs without reasons, and does not see
the methods that a Python test skips.

    tests/tools/skipped.py build/release
"""
import collections
import pathlib
import re
import sys

REASONS = (
    r"(?:^|\.\.\. )skipped '(.*)'$",  # unittest, of a method, a class or a subtest; needs -v
    r'(?:^|\.\.\. )skipped "(.*)"$',
    r"^skipped: (.*)$",  # a program that ends with 77
    r"^\S+:\d+: Skipped\n(.*)$",  # GoogleTest
)


def skipped(log):
    """{reason: [name of CTest's test, as often as it skipped for it]} of LastTest.log."""
    found = collections.defaultdict(list)
    for block in re.split(r"^(?=\d+/\d+ Testing: )", log, flags=re.M)[1:]:
        name = block.partition("Testing: ")[2].partition("\n")[0]
        output = block.partition("\nOutput:\n")[2]
        for pattern in REASONS:
            for reason in re.findall(pattern, output, re.M):
                found[reason].append(name)
    return found


def summary(log):
    found = skipped(log)
    if not found:
        return ["skipped: no test"]
    count = sum(map(len, found.values()))
    rows = sorted(found.items(), key=lambda one: (-len(one[1]), one[0]))
    return [f"skipped: {count} test{'s' * (count > 1)}",
            *(f"skipped: {len(names)}, {reason} ({', '.join(sorted(set(names)))})" for reason, names in rows)]


def main():
    log = pathlib.Path(sys.argv[1]) / "Testing/Temporary/LastTest.log"
    if not log.exists():
        sys.exit(f"skipped.py: {log} does not exist: CTest has not run")
    print("\n".join(summary(log.read_text(errors="replace"))))


if __name__ == "__main__":
    main()
