#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs the tests of every entry of docs/hard-cases.md and prints a line for each: `make hard`.

    run_hard_cases.py BUILD [--cases B3 N] [--jobs 2] [--output build/hard] [--long]

Exit code 1 when a case failed or none of its tests ran, 2 for an invalid command line."""
import argparse
import concurrent.futures
import json
import pathlib
import re
import signal
import sys
import time

import hard_list
import jobs
import results

SOURCE = pathlib.Path(__file__).resolve().parents[2]


def chosen(entries, cases):
    """The entries named by `B3` or by the letters of a section, `N`; ValueError for a name that fits none."""
    if not cases:
        return entries
    fits = {case: [one for one in entries if case in (one.case, re.match("[A-Z]*", one.case)[0])] for case in cases}
    unknown = [case for case, found in fits.items() if not found]
    if unknown:
        raise ValueError(f"no case {', '.join(unknown)} in docs/hard-cases.md: expected a case like B3 or its letters")
    return [one for one in entries if any(one in found for found in fits.values())]


def run_entry(entry, registered, with_long):
    begin = time.monotonic()
    found, missing = jobs.jobs_of(entry.tests, registered, with_long)
    outcomes = [jobs.run(one) for one in found]
    return results.result(entry, outcomes, missing, time.monotonic() - begin), outcomes


def run_all(entries, registered, processes, with_long=True, say=print):
    """Results of the entries, in their order; a line for each as soon as those before it are done."""
    found = []
    with concurrent.futures.ThreadPoolExecutor(processes) as pool:
        for one, outcomes in pool.map(lambda entry: run_entry(entry, registered, with_long), entries):
            say(results.line(one))
            if one.trouble:
                for outcome in (outcome for outcome in outcomes if outcome.failed):
                    say("\n".join("    " + line for line in outcome.output.splitlines()[-40:]))
            found.append(one)
    return found


def write_whole(path, text):
    """The complete file or the older one."""
    part = path.with_name(path.name + ".part")
    part.write_text(text, encoding="utf-8")
    part.replace(path)


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Runs the tests of every entry of docs/hard-cases.md and prints a line for each.")
    parser.add_argument("build", type=pathlib.Path, help="build folder with all tests")
    parser.add_argument("--cases", nargs="*", default=[], help="cases, B3, or letters of sections, N; all by default")
    parser.add_argument("--jobs", type=int, default=1, help="entries at once")
    parser.add_argument("--output", type=pathlib.Path, help="folder of hard.json and index.html")
    parser.add_argument("--long", action="store_true", help="runs tests with the label long as well, which take minutes")
    given = parser.parse_args(arguments)
    try:
        entries = chosen(hard_list.listed((SOURCE / "docs/hard-cases.md").read_text(encoding="utf-8")), given.cases)
    except ValueError as error:
        parser.error(str(error))
    # Tests interrupt programs: a shell that starts this in the background would have them ignore it.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    found = run_all(entries, jobs.registered_tests(given.build), max(1, given.jobs), given.long,
                    say=lambda text: print(text, flush=True))
    print(results.summary(found))
    if given.output:
        given.output.mkdir(parents=True, exist_ok=True)
        write_whole(given.output / "hard.json", json.dumps(results.as_json(found), indent=1) + "\n")
        style = (SOURCE / "tools/clatter_tools/page/page.css").read_text(encoding="utf-8")
        write_whole(given.output / "index.html", results.page(found, style))
    return 1 if any(one.trouble for one in found) else 0


if __name__ == "__main__":
    sys.exit(main())
