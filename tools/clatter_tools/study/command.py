# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `clatter study`."""
import argparse

from .. import study as study_package
from . import effects, findings, quantities, results, run


def add_arguments(command):
    """Declares the arguments of `clatter study`."""
    command.formatter_class = argparse.RawDescriptionHelpFormatter
    command.description = study_package.__doc__
    command.epilog = f"{quantities.__doc__}\n{effects.__doc__}"
    command.add_argument("study", metavar="study.toml", help="names pipeline, settings and quantities, as above")
    command.add_argument("-j", "--jobs", type=int, default=1, help="number of stages that run in parallel")
    command.add_argument("--effects", action="store_true", help="switch each effect of the scenes off or on instead: what it changes, what it costs")


def write_study(options):
    """`clatter study`: makes what is missing, prints tables and sentences, writes study.h5, CSV and page; of effects sentences and CSV."""
    jobs = max(1, options.jobs)
    if options.effects:
        found = effects.make(options.study, jobs)
        print("\n".join(effects.report(found)))
        print(f"\n{effects.write(found)}")
        return
    study = run.make(options.study, jobs)
    print("\n".join(findings.report(study)))
    paths = results.write(study)
    from . import page  # which loads matplotlib
    paths.append(page.write(study))
    print(f"\n{', '.join(map(str, paths))}")
