// SPDX-License-Identifier: GPL-3.0-or-later
// Orders over the crank speed: Campbell diagram and cuts.

const CAMPBELL_RANGE_DB = 60;
const CAMPBELL_ROWS = 160;
const CUTS = 5;

async function speedsSection() {
  if (!page.speeds) return;
  const host = section(
    "speeds",
    "Orders",
    "Orders over speed",
    "Runs at several speeds together: which engine orders excite which frequencies.",
  );
  const map = new Heat({
    title: "Campbell diagram",
    x: { edges: [0, 1], label: "crank speed [rpm]" },
    y: { edges: [0, 1], label: "frequency [Hz]" },
    z: { label: "", colours: "viridis" },
    cells: new Float32Array(1),
  });
  const cuts = new Plot({ title: "Order cuts", x: { label: "crank speed [rpm]" }, y: {}, lines: [] });
  const choose = async number => {
    const signal = page.speeds[number],
      speeds = signal.spectra.map(one => one.rpm),
      spectra = await allNumbers(...signal.spectra.map(one => one.rms));
    const level = value => (signal.reference ? 20 * Math.log10(Math.max(value, 1e-30) / signal.reference) : value);
    const strong = strongestOrders(spectra);
    const resolved = Math.max(...spectra.map((rms, k) => (0.5 * rms.length * speeds[k]) / 60));
    const top = Math.min(resolved, (1.3 * strong[strong.length - 1] * speeds.at(-1)) / 60),
      step = top / CAMPBELL_ROWS,
      cells = new Float32Array(CAMPBELL_ROWS * speeds.length);
    for (let j = 0; j < CAMPBELL_ROWS; ++j)
      for (let i = 0; i < speeds.length; ++i)
        cells[j * speeds.length + i] = level(spectra[i][Math.round((2 * (j + 0.5) * step * 60) / speeds[i])] ?? NaN);
    const most = Math.max(...cells.filter(Number.isFinite));
    map.update({
      title: `Campbell diagram: ${signal.name}`,
      cells,
      x: {
        label: "crank speed [rpm]",
        edges: edgesAround(speeds),
        ticks: speeds.map(one => [one, one.toFixed(0)]),
        names: speeds.map(one => `${one.toFixed(0)} rpm`),
      },
      y: { label: "frequency [Hz]", edges: evenEdges(0, step, CAMPBELL_ROWS) },
      z: {
        label: signal.axis,
        colours: "viridis",
        ...(signal.reference ? { min: most - CAMPBELL_RANGE_DB, max: most } : { min: 0, max: most }),
      },
      lines: strong.map(order => ({
        x: [edgesAround(speeds)[0], edgesAround(speeds).at(-1)],
        y: [edgesAround(speeds)[0], edgesAround(speeds).at(-1)].map(rpm => (order * rpm) / 60),
      })),
      note: `Dashed: orders ${strong.join(", ")}. Bands are half an order wide.`,
    });
    cuts.update({
      title: `Order cuts: ${signal.name}`,
      y: { label: signal.axis, range: signal.reference ? 70 : undefined },
      lines: [
        {
          name: "all orders",
          number: 6,
          wide: 2,
          x: speeds,
          y: spectra.map(one => level(Math.sqrt(one.slice(1).reduce((sum, value) => sum + value * value, 0)))),
        },
        ...strong.map((order, k) => ({
          name: `order ${order}`,
          number: k,
          x: speeds,
          y: spectra.map(one => level(one[2 * order] ?? NaN)),
        })),
      ],
    });
  };
  const list = selection(
    "signal",
    page.speeds.map((signal, k) => [k, signal.name]),
    value => choose(Number(value)),
  );
  host.append(element("div", { class: "controls" }, list.element), grid(map.element, cuts.element, powerOverSpeed()));
  await choose(0);
}

/** Sound power, and radiated power of the exposed panel, at each speed; the first run of each speed counts. */
function powerOverSpeed() {
  const panelOf = run => run.panels.find(one => one.name === "exposed") ?? run.panels.find(one => one.name === "skin");
  const lines = [
    ...levelsOverSpeed("sound power", 0, page.sound ?? [], run => run, run => run.mean),
    ...levelsOverSpeed("ERP", 1, page.radiation?.runs ?? [], run => panelOf(run)?.measures.erp, run => panelOf(run)?.mean),
  ];
  if (!lines.length) return null;
  return new Plot({
    title: "Radiated power over speed, dashed: unweighted",
    x: { label: "crank speed [rpm]" },
    y: { label: "power [dB(A), dB re 1 pW]" },
    lines,
  }).element;
}

/** Lines of dB(A) and, dashed, dB over the speeds of runs, where there are at least two. */
function levelsOverSpeed(name, number, runs, levelsOf, meanOf) {
  const points = new Map();
  for (const run of runs) {
    const levels = meanOf(run) ?? levelsOf(run);
    if (levels && run.rpm && !points.has(Math.round(run.rpm))) points.set(Math.round(run.rpm), levels);
  }
  if (points.size < 2) return [];
  const speeds = [...points.keys()].sort((a, b) => a - b),
    at = key => speeds.map(speed => points.get(speed)[key]);
  return [
    { name: `${name}, dB(A)`, number, x: speeds, y: at("dba") },
    { name: `${name}, dB`, number, dash: [4, 3], wide: 1, x: speeds, y: at("db") },
  ];
}

/** The orders that are largest at any speed, ascending. */
function strongestOrders(spectra) {
  const most = [];
  for (const rms of spectra)
    rms.forEach((value, k) => {
      most[k] = Math.max(most[k] ?? 0, value);
    });
  return most
    .map((value, k) => [value, 0.5 * k])
    .slice(1)
    .sort((a, b) => b[0] - a[0])
    .slice(0, CUTS)
    .map(([, order]) => order)
    .sort((a, b) => a - b);
}
