# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `clatter study`."""
import argparse

from .. import study as study_package
from . import findings, quantities, results, run


def add_arguments(command):
    """Declares the arguments of `clatter study`."""
    command.formatter_class = argparse.RawDescriptionHelpFormatter
    command.description = study_package.__doc__
    command.epilog = quantities.__doc__
    command.add_argument("study", metavar="study.toml", help="names pipeline, settings and quantities, as above")
    command.add_argument("-j", "--jobs", type=int, default=1, help="number of stages that run in parallel")


def write_study(options):
    """`clatter study`: makes what is missing, prints tables and sentences, writes study.h5, CSV and page."""
    study = run.make(options.study, max(1, options.jobs))
    print("\n".join(findings.report(study)))
    paths = results.write(study)
    from . import page  # which loads matplotlib
    paths.append(page.write(study))
    print(f"\n{', '.join(map(str, paths))}")
