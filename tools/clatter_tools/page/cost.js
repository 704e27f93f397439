// SPDX-License-Identifier: GPL-3.0-or-later
// Effects of the runs and their cost; seconds, memory and size of each stage.

function barCell(value, most) {
  return element("td", { class: "bar-cell" }, element("i", { style: `width:${(100 * value) / most}%` }));
}

function costSection() {
  const host = section(
    "cost",
    "Cost",
    "Effects and cost",
    "What each run simulated, why something was left out, and the seconds that each effect took; then all stages.",
  );
  for (const { run, rows, total } of page.cost.effects) {
    const most = Math.max(...rows.map(row => row[3]), 1e-9);
    const lines = rows
      .slice()
      .sort((a, b) => b[3] - a[3])
      .map(([name, state, why, seconds]) => [
        name,
        state,
        barCell(seconds, most),
        seconds > 0 ? figure(seconds) : "–",
        why,
      ]);
    host.append(
      element(
        "details",
        { class: "card", open: page.cost.effects.length === 1 },
        element("summary", {}, `Effects of ${page.runs[run].label}, ${figure(total)} s`),
        table(["effect", "", "", "seconds", "why, or size"], lines, [0, 1, 4]),
      ),
    );
  }
  const { stages } = page.cost,
    most = Math.max(...stages.map(stage => stage.seconds ?? 0), 1e-9),
    sum = key => stages.reduce((total, stage) => total + (stage[key] ?? 0), 0);
  const rows = stages.map(({ name, seconds, peak_gib: peak, mb, steps }) => [
    name,
    barCell(seconds ?? 0, most),
    figure(seconds),
    figure(peak, 2),
    figure(mb),
    steps
      .slice(0, 3)
      .map(([step, spent]) => `${step} ${figure(spent, 2)} s`)
      .join(", "),
  ]);
  host.append(
    tableCard(
      "Cost of each stage",
      ["artefact", "", "seconds", "peak GiB", "file MB", "longest steps"],
      [...rows, ["total", "", figure(sum("seconds")), "", figure(sum("mb"), 4), ""]],
      [0, 5],
    ),
  );
}
