// SPDX-License-Identifier: GPL-3.0-or-later
// The first screen: how loud, which run, which part, which frequency; the loudest run in motion.

const MOST_BARS = 8; // of many runs the loudest are shown

/** Of each run its sound power, or else its ERP: {run, dba, error, cycles, sound, erp}; of a mean over cycles with its standard error. */
const levels = (() => {
  const panelOf = run => ["exposed", "skin"].map(name => run.panels.find(one => one.name === name)).find(Boolean);
  const sounds = new Map((page.sound ?? []).map(one => [one.run, one]));
  return (page.radiation?.runs ?? []).flatMap(one => {
    const [sound, panel] = [sounds.get(one.run), panelOf(one)];
    const erp = panel?.mean ?? panel?.measures.erp,
      found = sound ? (sound.mean ?? sound) : erp;
    if (!found) return [];
    return { run: one.run, dba: found.dba, error: found.error, cycles: found.cycles, sound: Boolean(sound), erp: erp?.dba };
  });
})();

const loudestRun = levels.reduce((found, one) => (one.dba > (found?.dba ?? -Infinity) ? one : found), null)?.run;

/** "+9.3 dB", of means with their spread, against the level of the run that is the base of the others. */
function change(level, base) {
  if (!base || base.run === level.run || base.sound !== level.sound) return ["", ""];
  const value = level.dba - base.dba,
    spread = Math.hypot(level.error ?? 0, base.error ?? 0),
    text = `${value < 0 ? "−" : "+"}${Math.abs(value).toFixed(1)}${spread ? ` ± ${spread.toFixed(1)}` : ""} dB`;
  return Math.abs(value) < 2 * spread ? [text, "within the spread of the cycles"] : [text, ""];
}

/** A row for each run: its colour and name, a bar with its spread, level, change; below them what is loudest of it. */
function loudnessCard() {
  if (!levels.length) return null;
  const shown = page.many ? [...levels].sort((a, b) => b.dba - a.dba).slice(0, MOST_BARS) : levels;
  const reach = one => one.error ?? 0;
  const low = 10 * Math.floor((Math.min(...shown.map(one => one.dba - reach(one))) - 5) / 10),
    high = Math.max(...shown.map(one => one.dba + reach(one)));
  const share = dba => `${((100 * (dba - low)) / (high - low)).toFixed(2)}%`;
  const base = levels.find(one => one.run === page.summary.base);
  const rows = shown.map(one => loudnessRow(one, change(one, base), low, share));
  const notes = [
    `Bars begin at ${low} dB(A).`,
    base && shown.length > 1 ? `Changes are against ${runName(base.run)}.` : "",
    shown.some(one => one.error) ? "A line across the end of a bar is the standard error of a mean over cycles." : "",
    shown.length < levels.length ? `The loudest ${shown.length} of ${levels.length} runs.` : "",
  ];
  const found = card(
    shown.every(one => one.sound) ? "How loud: sound power, dB(A) re 1 pW" : "How loud: dB(A) re 1 pW",
    element("div", { class: "bars" }, rows),
    element("p", { class: "note" }, notes.filter(Boolean).join(" ")),
  );
  found.id = "loud";
  return found;
}

function loudnessRow(one, [text, hint], low, share) {
  const spread = one.error
    ? element("s", { style: `left: ${share(one.dba - one.error)}; right: calc(100% - ${share(one.dba + one.error)})` })
    : null;
  const row = element(
    "div",
    { class: "loud" },
    element("span", { class: "name" }, element("i"), runName(one.run)),
    element("span", { class: "track", "aria-hidden": "true" }, element("i", { style: `width: ${share(one.dba)}` }), spread),
    element("b", {}, `${one.dba.toFixed(1)}${one.error ? ` ± ${one.error.toFixed(1)}` : ""}`),
    element("span", { class: "change", title: hint }, text),
    element("small", {}, loudestText(one, hint)),
  );
  const paint = () => row.style.setProperty("--colour", runColour(one.run));
  paint();
  document.addEventListener("appearance", paint);
  return row;
}

/** "third octave of 2000 Hz, line at 1850 Hz; most from the anti thrust side, 31 %; ERP 85.8". */
function loudestText(one, hint) {
  const own = page.summary.loudest.find(found => found.run === one.run);
  const parts = [
    own?.band ? `third octave of ${own.band} Hz${own.line ? `, line at ${Math.round(own.line)} Hz` : ""}` : "",
    own?.part ? `most from “${own.part}”${own.share === null ? "" : `, ${Math.round(100 * own.share)} %`}` : "",
    one.sound ? (one.erp === undefined ? "" : `ERP ${one.erp.toFixed(1)}`) : "ERP, an upper estimate",
    one.cycles ? `mean of ${one.cycles} cycles` : "",
    hint,
  ];
  return parts.filter(Boolean).join("; ");
}

/** Where the surface section shows its loudest line too; empty until it is drawn. */
function movingFigure() {
  if (!page.surface) return null;
  return element(
    "figure",
    { id: "moving", hidden: true },
    element("a", { href: "#surface", "aria-label": "to the surface in motion" }, element("canvas")),
    element("figcaption", {}),
  );
}

/** Copies what the surface section draws, picture by picture, into the first screen. */
function mirror(surface) {
  const figure = document.getElementById("moving");
  if (!figure) return;
  const canvas = figure.querySelector("canvas"),
    context = canvas.getContext("2d");
  figure.hidden = false;
  surface.preview = canvas;
  surface.drawn = () => {
    const bounds = canvas.getBoundingClientRect();
    if (bounds.bottom < 0 || !bounds.width || !surface.canvas.clientWidth) return;
    const { width, height } = surface.canvas,
      free = 1 - surface.bar.clientWidth / Math.max(1, surface.canvas.clientWidth); // without the bar of colours
    [canvas.width, canvas.height] = [bounds.width * devicePixelRatio, bounds.height * devicePixelRatio];
    const scale = Math.min(canvas.width / (width * free), canvas.height / height);
    const [w, h] = [width * free * scale, height * scale];
    context.drawImage(surface.canvas, 0, 0, width * free, height, (canvas.width - w) / 2, (canvas.height - h) / 2, w, h);
    const text = surface.caption.querySelector("strong")?.textContent ?? "";
    if (figure.lastChild.textContent !== text) figure.lastChild.textContent = text;
  };
  surface.draw();
}
