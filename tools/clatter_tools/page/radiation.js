// SPDX-License-Identifier: GPL-3.0-or-later
// Radiated power: runs against each other, panels against each other.

const PICO_WATT = 1e-12;
const SILENCE_DB = -900; // the level of nothing at all is lower

/** Ticks of third octaves: every third band by its name. */
function bandAxis({ lower, upper, names }) {
  const edges = Float32Array.from([...lower, upper.at(-1)]);
  const start = Math.max(
    0,
    names.findIndex(name => ["31.5", "63", "125", "250", "500", "1k"].includes(name)),
  );
  const middle = k => Math.sqrt(lower[k] * upper[k]);
  return { edges, names, ticks: names.map((name, k) => [middle(k), name]).filter((_, k) => k % 3 === start % 3) };
}

async function readBands(bands) {
  const [lower, upper] = await allNumbers(bands.lower, bands.upper);
  return bandAxis({ lower, upper, names: bands.names });
}

async function radiationSection() {
  if (!page.radiation) return;
  const host = section(
    "radiation",
    "Power",
    "Radiated power",
    "Equivalent radiated power takes every face as a piston in an infinite wall: an upper estimate at low frequencies.",
  );
  const { runs, measures } = page.radiation;
  for (const run of runs) {
    run.axis = await readBands(run.bands);
    [run.hz, run.deg, run.ms] = await allNumbers(run.frequency, run.angle, run.time);
    for (const panel of run.panels) {
      panel.rms = (await numbers(panel.instants))?.map(one => 1e3 * Math.sqrt(one));
      for (const measure of Object.values(panel.measures))
        [measure.power, measure.db_bands, measure.dba_bands] = await allNumbers(
          measure.lines,
          measure.bands,
          measure.bands_dba,
        );
    }
  }
  const turning = runs.every(run => run.deg);
  const names = [...new Set(runs.flatMap(run => run.panels.map(panel => panel.name)))];
  const state = {
    panel: names.includes("exposed") ? "exposed" : names[0],
    run: 0,
    weighted: true,
    measure: measures[0],
  };
  const bands = new Plot({
    title: "Third octaves",
    x: { label: "third-octave band [Hz]", log: true, name: "band" },
    y: { range: 70 },
    lines: [],
  });
  const lines = new Plot({ title: "Lines", x: { label: "frequency [Hz]" }, y: { range: 90 }, lines: [] });
  const perPanel = new Plot({
    title: "Third octaves of the panels",
    x: { label: "third-octave band [Hz]", log: true, name: "band" },
    y: { range: 70 },
    lines: [],
  });
  const over = new Plot({
    title: "Velocity over the cycle",
    x: { label: `crank angle [deg], 0 = ${page.zero}`, angles: true },
    y: { min: 0 },
    marks: turning ? [0] : [],
    lines: [],
  });
  const ranking = element("div");
  const refresh = () => {
    const { measure, weighted } = state,
      weight = weighted ? "A-weighted" : "unweighted",
      unit = weighted ? "dB(A)" : "dB";
    const level = `${measure.name.replace(/.*\((.*)\)/, "$1")} [${unit} re ${measure.reference}]`,
      label = state.panel.replaceAll("_", " ");
    const pick = (panel, key) => panel?.measures[measure.key]?.[key];
    const stairs = (run, panel, more) => ({
      kind: "stairs",
      x: run.axis.edges,
      y: pick(panel, weighted ? "dba_bands" : "db_bands"),
      ...more,
    });
    const panelOf = run => run.panels.find(panel => panel.name === state.panel);
    const ticks = { ticks: runs[0].axis.ticks, names: runs[0].axis.names };
    bands.update({
      title: `Power in third octaves, ${weight}, panel “${label}”`,
      x: { ...bands.spec.x, ...ticks },
      y: { label: level, range: 70 },
      lines: runs.map(run =>
        stairs(run, panelOf(run), {
          run: run.run,
          name: `${runName(run.run)}, ${pick(panelOf(run), weighted ? "dba" : "db")?.toFixed(1)} ${unit}`,
        }),
      ),
    });
    lines.update({
      title: `Power of each line, unweighted, panel “${label}”`,
      y: { label: `${measure.name.replace(/.*\((.*)\)/, "$1")} [dB re ${measure.reference}]`, range: 90 },
      lines: runs.map(run => ({
        run: run.run,
        name: runName(run.run),
        wide: 1,
        x: run.hz,
        y: panelOf(run) ? decibel(pick(panelOf(run), "power"), PICO_WATT) : [],
      })),
    });
    const run = runs[state.run],
      own = run.panels.filter(panel => panel.name !== "skin" && panel.name !== "exposed");
    perPanel.update({
      title: `Panels in third octaves, ${weight}: ${runName(run.run)}`,
      x: { ...perPanel.spec.x, ticks: run.axis.ticks, names: run.axis.names },
      y: { label: level, range: 70 },
      lines: own.map((panel, k) =>
        stairs(run, panel, { number: k, name: panel.label, dash: k > 5 ? [5, 3] : undefined }),
      ),
    });
    over.update({
      title: `Normal velocity of panel “${label}” over ${runs.every(one => one.piece === "cycle") ? "the cycle" : "time"}`,
      x: turning ? over.spec.x : { label: "time [ms]" },
      y: { label: "RMS over the panel [mm/s]", min: 0 },
      lines: runs.map(one => ({
        run: one.run,
        name: runName(one.run),
        wide: 1.1,
        x: turning ? one.deg : one.ms,
        y: panelOf(one)?.rms ?? [],
      })),
    });
    ranking.replaceChildren(panelRanking(run, own, measure, weighted));
  };
  const panelList = selection(
    "panel",
    names.map(name => [name, name.replaceAll("_", " ")]),
    value => {
      state.panel = value;
      refresh();
    },
  );
  panelList.list.value = state.panel;
  const runList = selection(
    "panels of",
    runs.map((run, k) => [k, runName(run.run)]),
    value => {
      state.run = Number(value);
      refresh();
    },
  );
  host.append(
    element(
      "div",
      { class: "controls" },
      choices(
        "weighting",
        [
          ["a", "A-weighted"],
          ["none", "unweighted"],
        ],
        "a",
        value => {
          state.weighted = value === "a";
          refresh();
        },
      ).element,
      panelList.element,
      runs.length > 1 ? runList.element : null,
    ),
    grid(bands.element, lines.element, perPanel.element, ranking, over.element),
  );
  refresh();
}

/** Panels by falling power, with bars and their share of the power of the entire skin. */
function panelRanking(run, panels, measure, weighted) {
  const level = panel => {
      const found = panel.measures[measure.key]?.[weighted ? "dba" : "db"];
      return found > SILENCE_DB ? found : NaN;
    },
    whole = run.panels.find(panel => panel.name === "skin");
  const share = panel => 100 * 10 ** (0.1 * (level(panel) - level(whole ?? panels[0])));
  const sorted = panels.slice().sort((a, b) => (level(b) || -Infinity) - (level(a) || -Infinity)),
    most = Math.max(...sorted.map(panel => share(panel) || 0), 1e-9);
  const rows = sorted.map(panel => [
    panel.label,
    element(
      "td",
      { class: "bar-cell" },
      element("i", {
        style: `width:${(100 * (share(panel) || 0)) / most}%; --colour:${colourOf(panels.indexOf(panel))}`,
      }),
    ),
    level(panel) ? level(panel).toFixed(1) : "–",
    level(panel) ? `${figure(share(panel), 2)} %` : "–",
    figure(1e4 * panel.area_m2),
  ]);
  return tableCard(
    `Panels by their power, ${weighted ? "A-weighted" : "unweighted"}: ${runName(run.run)}`,
    ["panel", "", `[${weighted ? "dB(A)" : "dB"} re ${measure.reference}]`, "of the entire skin", "area [cm²]"],
    rows,
    [0],
    element(
      "p",
      { class: "note" },
      "Panels are groups of exposed faces. The entire skin also has faces inside, which cannot radiate outward.",
    ),
  );
}
