// SPDX-License-Identifier: GPL-3.0-or-later
// Histories of the runs over the crank angle of the last cycle.

const UNITS = { m: [1e6, "µm"], Pa: [1e-5, "bar"], rad: [1e3, "mrad"], m2: [1e6, "mm²"], "m3/s": [1e6, "cm³/s"] };

/** Lines of some histories of all runs that have them. */
async function historyLines(names, factor, lessMean) {
  const found = [];
  for (const run of page.mechanism.runs)
    for (const [k, name] of names.entries()) {
      const history = run.histories[name];
      if (!history) continue;
      const [x, values] = await allNumbers(run.x, history.values);
      const mean = lessMean ? values.reduce((a, b) => a + b, 0) / values.length : 0;
      const several = names.length > 1,
        alone = page.mechanism.runs.length === 1;
      found.push({
        ...(alone ? { number: k } : { run: run.run }),
        name: several ? (alone ? words(name) : `${runName(run.run)}: ${words(name)}`) : runName(run.run),
        dash: !alone && k ? [2 + 3 * k, 3] : undefined,
        wide: 1.2,
        x,
        y: values.map(one => factor * (one - mean)),
      });
    }
  return found;
}

function words(name) {
  return name.replaceAll("_", " ");
}

async function mechanismSection() {
  if (!page.mechanism) return;
  const host = section(
    "mechanism",
    "Motion",
    "Motion and forces",
    "Histories of the mechanism over the crank angle of the last cycle.",
  );
  const { runs, names, shown } = page.mechanism,
    axis = { label: runs[0].axis, angles: runs[0].axis.includes("angle") };
  const plots = [];
  for (const { title, label, names: own, factor, unit, less_mean: lessMean } of shown)
    plots.push(
      new Plot({
        title,
        x: axis,
        y: { label: `${label} [${unit}]` },
        marks: axis.angles ? [0] : [],
        lines: await historyLines(own, factor, lessMean),
      }).element,
    );
  host.append(grid(plots), await historyBrowser(names, page.mechanism.left_out, axis));
}

/** Any history, with the other components of the same quantity. */
async function historyBrowser(names, leftOut, axis) {
  const plot = new Plot({ title: "Any history", x: axis, y: {}, marks: axis.angles ? [0] : [], lines: [] });
  const choose = async name => {
    const unit = page.mechanism.runs.map(run => run.histories[name]?.unit).find(one => one !== undefined),
      [factor, shown] = UNITS[unit] ?? [1, unit];
    plot.show(null);
    plot.update({
      title: `History: ${words(name)}`,
      y: { label: `${words(name)} [${shown || "1"}]` },
      lines: await historyLines([name], factor, false),
    });
  };
  const first = names.find(name => name.endsWith("force_z")) ?? names[0];
  const list = selection(
    "any history",
    names.map(name => [name, words(name)]),
    choose,
  );
  list.list.value = first;
  await choose(first);
  return element(
    "div",
    { class: "card" },
    element(
      "div",
      { class: "controls" },
      list.element,
      element(
        "span",
        { class: "note" },
        `${names.length} histories${leftOut ? `, ${leftOut} further ones are left out for the size of the page` : ""}`,
      ),
    ),
    plot.element,
  );
}
