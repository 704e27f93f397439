// SPDX-License-Identifier: GPL-3.0-or-later
// What is beside the 3-D view: plots that choose a line, an instant or a mode, the panels, the spectrum of a point.

function buildBeside(surface) {
  surface.plot = null;
  const makers = {
    line: () => [spectrumPlot(surface), surface.run.mac ? macPlot(surface) : null],
    instant: () => instantPlot(surface),
    mode: () => macPlot(surface),
    panels: () => panelTable(surface),
  };
  surface.beside.replaceChildren(...[makers[surface.kind]()].flat().filter(Boolean));
  if (surface.node !== null && surface.run?.re && surface.kind !== "panels") surface.beside.prepend(nodePlot(surface));
}

function spectrumPlot(surface) {
  const { run } = surface,
    values = Float32Array.from(
      { length: run.frequency.length },
      (_, k) => 20 * Math.log10(lineSize(run, k, surface.skin.corners) / 5e-8),
    );
  surface.plot = new Plot({
    title: "Elastic velocity of the skin by line",
    height: 22,
    x: { label: "frequency [Hz]" },
    y: { label: "level [dB re 50 nm/s, RMS over nodes and time]", range: 90 },
    lines: [{ run: run.run, x: run.frequency, y: values, wide: 1.1 }],
    pick: hz => surface.goTo("line", nearestIndex(run.frequency, hz)),
    note: "Click a line, or move through them by the arrow keys, to see its shape.",
  });
  return surface.plot.element;
}

function instantPlot(surface) {
  const { run } = surface,
    angle = run.angle ?? Float32Array.from(run.time, one => 1e3 * one);
  surface.plot = new Plot({
    title: "Velocity of the skin over the cycle",
    height: 22,
    x: { label: run.angle ? `crank angle [deg], 0 = ${page.zero}` : "time [ms]", angles: Boolean(run.angle) },
    y: { label: "RMS over nodes, without rigid motion [mm/s]", min: 0 },
    lines: [{ run: run.run, x: angle, y: surface.sizes().map(one => 1e3 * one), wide: 1.2 }],
    pick: at => {
      surface.play(false);
      surface.goTo("instant", nearestIndex(angle, at));
    },
    note: "Click an instant to see it.",
  });
  return surface.plot.element;
}

function macPlot(surface) {
  const { mac } = surface.run ?? {},
    { hz } = surface.part.modes;
  if (!mac)
    return tableCard(
      "Elastic modes",
      ["mode", "natural frequency [Hz]"],
      hz.map((one, k) => [k + 1, figure(one, 5)]),
    );
  const heat = new Heat({
    title: "Which modes the strongest lines are made of",
    height: 22,
    x: {
      label: "mode number",
      edges: evenEdges(0.5, 1, hz.length),
      names: hz.map((one, k) => `${k + 1}, ${figure(one, 4)} Hz`),
    },
    y: {
      label: "line [Hz]",
      edges: evenEdges(-0.5, 1, mac.hz.length),
      ticks: mac.hz.map((one, k) => [k, one.toFixed(0)]),
      names: mac.hz.map(one => `${one.toFixed(0)} Hz`),
    },
    z: { label: "MAC", colours: "viridis", min: 0, max: 1 },
    cells: mac.values.flat(),
    pick: (i, j) => surface.goTo("mode", i),
    note: "MAC: modal assurance criterion of the operating shape (elastic part) and the mode shapes; 1: the same shape. Click a cell to see the mode.",
  });
  return heat.element;
}

function panelTable(surface) {
  const { names, labels } = surface.part.panels,
    run = page.radiation?.runs.find(one => one.run === surface.run?.run);
  const rows = names.map((name, k) => {
    const panel = run?.panels.find(one => one.name === name),
      power = panel?.measures.erp;
    return [
      element(
        "td",
        { class: "text" },
        element("i", {
          style: `display:inline-block;width:.9em;height:.9em;border-radius:.2em;margin-right:.5em;background:${surface.panelColour(k)}`,
        }),
        labels[k],
      ),
      panel ? figure(1e4 * panel.area_m2) : "–",
      power ? power.dba.toFixed(1) : "–",
    ];
  });
  return tableCard("Panels", ["panel", "area [cm²]", "ERP [dB(A) re 1 pW]"], rows);
}

/** The spectrum of the chosen node: as exact as the shapes are. */
function nodePlot(surface) {
  const { run, node } = surface,
    at = [0, 1, 2].map(k => (1e3 * surface.skin.points[3 * node + k]).toFixed(0)).join(", ");
  const component = k =>
    Float32Array.from({ length: run.frequency.length }, (_, line) => {
      let [a, b] = [0, 0];
      const [re, im] = [run.re.row(line), run.im.row(line)];
      for (let j = surface.withRigid ? 0 : RIGID; j < re.length; ++j) {
        const shape = surface.shapes.factor[j] * surface.shapes.row(j)[3 * node + k];
        a += run.re.factor[line] * re[j] * shape;
        b += run.im.factor[line] * im[j] * shape;
      }
      return 1e3 * Math.hypot(a, b);
    });
  return new Plot({
    title: `Velocity at (${at}) mm`,
    height: 16,
    x: { label: "frequency [Hz]" },
    y: { label: "amplitude [mm/s], peak", log: true, range: 1e5 },
    pick: hz => surface.goTo("line", nearestIndex(run.frequency, hz)),
    lines: ["x", "y", "z"].map((name, k) => ({ name, number: k, wide: 1, x: run.frequency, y: component(k) })),
    note: surface.withRigid ? "With the rigid motion." : "Without the rigid motion.",
  }).element;
}

/** RMS over nodes and time of a line's elastic velocity [m/s]. */
function lineSize(run, k, corners) {
  let sum = 0;
  for (const rows of [run.re, run.im]) {
    const row = rows.row(k),
      factor = rows.factor[k];
    for (let j = RIGID; j < row.length; ++j) sum += (factor * row[j]) ** 2;
  }
  return Math.sqrt((0.5 * sum) / corners);
}

/** The frequency of a run's loudest line; without a spectrum of the strongest above 300 Hz, where a part moves elastically. */
function strongestLine(run, frequency) {
  return run.loudest ?? run.strongest.find(hz => hz > 300) ?? run.strongest[0] ?? frequency[0];
}
