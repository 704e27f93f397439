# SPDX-License-Identifier: GPL-3.0-or-later
"""The command `clatter study`."""
import argparse
import sys

from clatter.artefact import BadArtefact
from .. import study as study_package
from . import effects, findings, markdown, place, plan, proof, proposal, quantities, results, run


def add_arguments(command):
    """Declares the arguments of `clatter study`."""
    command.formatter_class = argparse.RawDescriptionHelpFormatter
    command.description = study_package.__doc__
    command.epilog = f"{quantities.__doc__}\n{effects.__doc__}\n{proposal.__doc__}\n{place.__doc__}\n{proof.__doc__}"
    command.add_argument("study", metavar="study.toml", help="names pipeline, settings and quantities, as above")
    command.add_argument("-j", "--jobs", type=int, default=1, help="number of stages that run in parallel")
    command.add_argument("--effects", action="store_true", help="switch each effect of the scenes off or on instead: what it changes, what it costs")
    command.add_argument("--within", metavar="'QUANTITY ERROR'", help="propose the cheapest settings for an error, as \"sound power 0.5\" or \"height 2 %%\", and prove them by a run")
    command.add_argument("--at", action="append", default=[], metavar="FILE:KEY=VALUE", help="of --within: prove them where this key has another value, as slap.run.toml:engine.speed_rpm=1500")
    command.add_argument("--markdown", action="store_true", help="print the tables as Markdown, for a document")
    command.add_argument("--seconds", type=float, default=float("inf"), metavar="S", help="of --within: at most so many seconds")


def write_study(options):
    """`clatter study`: makes what is missing, prints tables and sentences, writes study.h5, CSV and page; of effects sentences, CSV and page."""
    jobs = options.jobs
    if jobs < 1:
        raise BadArtefact(f"-j: found {jobs}, expected a number from 1")
    if options.effects and options.within is not None:
        raise BadArtefact("--within and --effects exclude each other: settings are proposed for the scene as it is")
    if options.seconds != float("inf") and not (options.within is not None and options.seconds > 0.0):
        raise BadArtefact(f"--seconds: found {options.seconds:g}, expected a positive number, and --within")
    if options.at and options.within is None:
        raise BadArtefact(f"--at {options.at[0]} needs --within")
    if options.within is not None or options.at:
        wanted = plan.read(options.study)
        request = proof.requested(wanted, options.within)
        there = place.elsewhere(wanted, options.at)
    if options.effects:
        found = effects.make(options.study, jobs)
        print("\n".join(markdown.effects(found) if options.markdown else effects.report(found)))
        from . import effects_page  # as page below
        paths = [effects.write(found), effects_page.write(found)]
    else:
        study = run.make(options.study, jobs)
        if options.within is not None:
            proof.answer(study, request, options.within, options.seconds, jobs, there, options.at)
            return
        print("\n".join([*markdown.study(study), "", *markdown.proofs(study.plan)] if options.markdown else findings.report(study)))
        paths = results.write(study)
        from . import page  # which loads matplotlib
        paths.append(page.write(study))
    print(f"\n{', '.join(map(str, paths))}", file=sys.stderr if options.markdown else sys.stdout)
    if not options.effects:
        report_missing(study)


def report_missing(study):
    """Failed, which names them, where variants could not be made."""
    missing = [one.name for k, one in enumerate(study.variants) if any(known[k] is None for known in study.values)]
    if missing:
        raise run.Failed(f"{study.plan.path}: {len(missing)} of {len(study.variants)} variants lack a result: {', '.join(missing)}; see what their stages say above")
