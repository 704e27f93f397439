# SPDX-License-Identifier: GPL-3.0-or-later
"""Of a study: total error over seconds with the Pareto front, error along each setting, budget of the base's error."""
import numpy as np

from ..study import convergence, findings
from ..study.run import BASE
from . import style

WIDTH = 12.0  # inches
COLUMNS = 4   # of the legend
LINEAR = 5.0  # range of an abscissa up to which it is linear


def picture(study, quantity):
    """One quantity: three axes."""
    own = study.plan.quantities[quantity]
    figure, axes = style.figure(1, 3, height=3.4)
    figure.set_size_inches(WIDTH, 4.2)
    factor, unit = (100.0, "%") if own.relative else (1.0, own.unit)
    draw_pareto(axes[0, 0], study, quantity, factor)
    draw_lines(axes[0, 1], study, quantity, factor)
    draw_budget(axes[0, 2], study, quantity, factor)
    for axis in axes[0, :2]:
        axis.set_ylabel(f"error [{unit}]")
    axes[0, 2].set_xlabel(f"error of the base [{unit}]")
    handles, labels = axes[0, 1].get_legend_handles_labels()
    rows = -(-len(labels) // COLUMNS)
    style.headline(figure, "\n".join([own.name] + [" "] * rows))
    figure.legend(handles, labels, loc="upper left", bbox_to_anchor=(0.0, 1.0 - 0.24 / figure.get_figheight()), ncol=COLUMNS, fontsize=9, borderaxespad=0.0)
    return figure


def draw_pareto(axis, study, quantity, factor):
    """Total error over seconds of all variants whose seconds are compared, the base as a ring."""
    seconds = [study.compared_cost(k, quantity) for k in range(len(study.variants))]
    errors = [factor * study.error(quantity, k) for k in range(len(study.variants))]
    least = findings.NOTHING * factor * study.size(quantity)
    errors = [one if one > least else float("nan") for one in errors]
    for number, setting in enumerate(study.plan.settings):
        chosen = [k for k, one in enumerate(study.variants) if one.setting == number]
        axis.plot([seconds[k] for k in chosen], [errors[k] for k in chosen], "o", markersize=4, color=colour(number))
    refined = [k for k, one in enumerate(study.variants) if one.setting is None and k != BASE]
    axis.plot([seconds[k] for k in refined], [errors[k] for k in refined], "s", markersize=5, color="#333333")
    axis.plot([seconds[BASE]], [errors[BASE]], "o", markersize=9, markerfacecolor="none", color="#333333")
    front = convergence.pareto(seconds, errors)
    axis.plot([seconds[k] for k in front], [errors[k] for k in front], "-", color="#888888", linewidth=1.0, zorder=0)
    logarithmic(axis, [one for one in errors if one > 0.0], [one for one in seconds if one > 0.0])
    axis.set_xlabel("seconds")


def draw_lines(axis, study, quantity, factor):
    """Error from the setting's reference over the refinement: how much smaller the step is than the coarsest; all settings have an entry
    of the legend."""
    found, steps = [], []
    least = findings.NOTHING * factor * study.size(quantity)
    for number, line in study.lines[quantity].items():
        setting = study.plan.settings[number]
        errors = [factor * study.scaled(quantity, one.size()) for one in line.errors]
        if setting.sizes and len(line.variants) == len(setting.values):
            x = [setting.sizes[0] / one for one in setting.sizes]
        else:
            x = [float(k + 1) for k in range(len(errors))]
        shown = [k for k, one in enumerate(errors) if one > least]
        order = f", order {line.order:.1f}" if np.isfinite(line.order) else ""
        axis.plot([x[k] for k in shown], [errors[k] for k in shown], "o-", markersize=4, color=colour(number), label=f"{study.plan.settings[number].name}{order}")
        found += [errors[k] for k in shown]
        steps += x
    logarithmic(axis, found, [1.0, *steps])
    axis.set_xlabel("refinement")


def draw_budget(axis, study, quantity, factor):
    """Bars: the parts by setting, their sum, the run with everything refined."""
    budget = study.budgets[quantity]
    bars = [(study.plan.settings[number].name, study.scaled(quantity, part.number()), colour(number)) for number, part in budget.parts]
    bars.append(("sum", study.scaled(quantity, budget.sum.number()), "#555555"))
    if budget.refined is not None:
        bars.append(("all refined", study.scaled(quantity, budget.refined.number()), "#000000"))
    axis.barh(range(len(bars)), [factor * value for _, value, _ in bars], color=[one for *_, one in bars], height=0.6)
    axis.set_yticks(range(len(bars)), [name for name, *_ in bars])
    axis.invert_yaxis()
    axis.axvline(0.0, color="#555555", linewidth=0.8)


def colour(number):
    return style.COLOURS[number % len(style.COLOURS)]


def logarithmic(axis, errors, x):
    """Logarithmic axes with plain numbers, where there is something to show on them."""
    if errors:
        axis.set_yscale("log")
    if x and max(x) > LINEAR * min(x):
        axis.set_xscale("log")
        few = max(x) / min(x) < 30.0
        axis.xaxis.set_major_locator(style.matplotlib.ticker.LogLocator(subs=(1.0, 2.0, 5.0) if few else (1.0,)))
        axis.xaxis.set_major_formatter(style.matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}"))
        axis.xaxis.set_minor_formatter(style.matplotlib.ticker.NullFormatter())
