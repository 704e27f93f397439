// SPDX-License-Identifier: GPL-3.0-or-later
// The 3-D view: operating shape at a line or an instant, mode shapes, panels.

const DRAWN_SHARE = 0.04;   // of the part's size: how far the largest velocity is drawn at enlargement 1
const CYCLE_SECONDS = 1.6;  // of an animated line at speed 1
const SHOWN = { normal: ["normal velocity", "diverging"], whole: ["magnitude", "viridis"], amplitude: ["normal amplitude", "viridis"] };

class Surface {
  constructor(host, data) {
    Object.assign(this, { data, kind: "line", withRigid: false, outline: true, edges: true, shown: "normal", enlargement: 1, speed: 1, phase: 0, common: true, contrast: 1, node: null });
    this.playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.canvas = element("canvas", { tabindex: 0, role: "img", id: "skin", "aria-label": "The skin in three dimensions. Arrow keys turn it, plus and minus magnify, space plays, page up and down step." });
    this.caption = element("div", { class: "caption", "aria-live": "off" });
    this.bar = element("canvas");
    this.ruler = element("div", { class: "ruler" });
    this.beside = element("div");
    this.controls = element("div");
    host.append(element("div", { class: "spread" }, element("figure", {},
      element("figcaption", {}, element("h3", {}, "The skin"), saveButtons("skin", () => this.picture(), () => this.columns())),
      this.caption, element("div", { class: "view" }, this.canvas, element("div", { class: "bar" }, this.bar), this.ruler)), element("div", {}, element("div", { class: "card" }, this.controls), this.beside)));
    this.renderer = new Renderer(this.canvas);
    this.view = new View(this.canvas, () => this.draw(), (x, y) => this.probe(x, y), { " ": () => this.play(!this.playing), PageUp: () => this.step(1), PageDown: () => this.step(-1) });
    this.part = data.parts[0];
    this.loaded = this.choosePart(0);
  }

  async choosePart(number) {
    this.part = this.data.parts[number];
    this.skin = await readSkin(this.part);
    this.renderer.load(this.skin);
    this.shapes = this.part.shapes ? await readRows(this.part.shapes) : null;
    [this.modes, this.node] = [null, null];
    await this.chooseRun(0);
    const possible = this.kinds().map(([kind]) => kind);
    this.build();
    await this.chooseKind(possible.includes(this.kind) ? this.kind : possible[0]);
  }

  async chooseRun(number) {
    const run = this.part.runs[number];
    this.run = run ? { ...run } : null;
    if (!run) return;
    const [frequency, error, angle, time] = await allNumbers(run.frequency, run.line_error, run.angle, run.time);
    Object.assign(this.run, { frequency, error, angle, time, re: run.lines && await readRows(run.lines[0]), im: run.lines && await readRows(run.lines[1]),
      at: run.instants && await readRows(run.instants) });
    this.line = Math.max(0, nearestIndex(frequency ?? [0], run.strongest.at(-1) !== undefined ? strongestLine(run, frequency) : frequency?.[1] ?? 0));
    this.instant = this.loudestInstant();
  }

  kinds() {
    return [["line", "operating shape at a line", this.run?.re], ["instant", "at an instant", this.run?.at], ["mode", "mode shapes", this.part.modes?.hz.length],
      ["panels", "panels", this.part.panels?.names.length]].filter(([, , present]) => present);
  }

  async chooseKind(kind) {
    this.kind = kind;
    if (kind === "mode" && !this.modes) this.modes = await readRows(this.part.modes.shapes);
    this.mode ??= 0;
    this.kindButtons?.set(kind);
    this.buildSteps();
    this.buildBeside();
    this.update();
  }

  build() {
    this.kindButtons = choices("what is shown", this.kinds(), this.kind, kind => this.chooseKind(kind));
    const parts = selection("part", this.data.parts.map((part, k) => [k, part.name]), k => this.choosePart(Number(k)));
    parts.list.value = this.data.parts.indexOf(this.part);
    const runs = selection("run", this.part.runs.map((run, k) => [k, runName(run.run)]), async k => { await this.chooseRun(Number(k)); this.chooseKind(this.kind); });
    if (this.run) runs.list.value = this.part.runs.findIndex(run => run.run === this.run.run);
    this.steps = element("div", { class: "controls" });
    this.playButton = element("button", { type: "button", onclick: () => this.play(!this.playing) });
    const shown = selection("colours", Object.entries(SHOWN).map(([key, [name]]) => [key, name]), key => { this.shown = key; this.draw(); });
    this.controls.replaceChildren(
      element("div", { class: "controls" }, this.kindButtons.element, this.data.parts.length > 1 ? parts.element : null, this.part.runs.length > 1 ? runs.element : null),
      this.steps,
      element("div", { class: "controls" }, this.playButton, slider("speed", { min: -3, max: 3, step: 0.1, value: 0 }, value => { this.speed = 2 ** value; }).element,
        slider("enlargement", { min: -3, max: 4, step: 0.1, value: 0 }, value => { this.enlargement = 2 ** value; this.draw(); }).element,
        slider("contrast", { min: 0, max: 5, step: 0.1, value: 0 }, value => { this.contrast = 2 ** value; this.draw(); }).element),
      element("div", { class: "controls" }, shown.element,
        checkbox("rigid motion", this.withRigid, on => { this.withRigid = on; this.update(); }).element,
        checkbox("outline at rest", this.outline, on => { this.outline = on; this.draw(); }).element,
        checkbox("edges", this.edges, on => { this.edges = on; this.draw(); }).element,
        element("span", { class: "choices", role: "group", "aria-label": "direction of view" }, Object.keys(VIEWS).map(name => element("button", { type: "button", onclick: () => this.view.turnTo(name) }, name)))),
      element("p", { class: "note" }, "Drag turns, shift and drag moves, two fingers or the wheel magnify (the wheel after a click into the picture). A click chooses a point and shows its spectrum. Shape and colours are velocities; outward is positive."));
    this.play(this.playing);
  }

  /** What a slider steps through: lines, instants, modes. */
  range() {
    return { line: [this.run?.frequency?.length ?? 0, "line"], instant: [this.run?.at?.count ?? 0, "instant"], mode: [this.part.modes?.hz.length ?? 0, "mode"], panels: [0, "line"] }[this.kind];
  }

  buildSteps() {
    const [count, name] = this.range();
    this.steps.replaceChildren();
    if (!count) return;
    const label = { line: "frequency", instant: "crank angle", mode: "mode" }[this.kind];
    const made = slider(label, { min: 0, max: count - 1, value: this[name] }, value => { if (this.kind === "instant") this.play(false); this[name] = value; this.update(); }, { id: "skin-step" });
    this.stepInput = made.input;
    this.steps.append(element("button", { type: "button", "aria-label": "previous", onclick: () => this.step(-1) }, "‹"), made.element, element("button", { type: "button", "aria-label": "next", onclick: () => this.step(1) }, "›"));
    if (this.kind === "line" && this.run.strongest.length)
      this.steps.append(element("span", { class: "choices", role: "group", "aria-label": "strongest lines" }, this.run.strongest.map(hz => element("button", { type: "button", title: "one of the strongest lines",
        onclick: () => this.goTo("line", nearestIndex(this.run.frequency, hz)) }, `${hz.toFixed(0)} Hz`))));
    if (this.kind === "instant") this.steps.append(checkbox("one scale for the cycle", this.common, on => { this.common = on; this.update(); }).element);
  }

  async goTo(kind, index) {
    if (this.kind !== kind) await this.chooseKind(kind);
    this[this.range()[1]] = index;
    this.update();
  }

  step(by) {
    const [count, name] = this.range();
    if (!count) return;
    this[name] = (this[name] + by + count) % count;
    this.update();
  }

  play(on) {
    this.playing = on;
    this.playButton.textContent = on ? "❚❚ pause" : "▶ play";
    this.last = null;
    if (on && !this.ticking) { this.ticking = true; requestAnimationFrame(now => this.tick(now)); }
  }

  tick(now) {
    if (!this.playing || this.kind === "panels") { this.ticking = false; return; }
    requestAnimationFrame(later => this.tick(later));
    const bounds = this.canvas.getBoundingClientRect(), passed = Math.min(100, now - (this.last ?? now)) / 1000;
    this.last = now;
    if (!this.re || bounds.bottom < 0 || bounds.top > innerHeight || document.hidden) return;
    if (this.kind === "instant") {
      this.rest = (this.rest ?? 0) + passed * 30 * this.speed;
      const whole = Math.floor(this.rest);
      this.rest -= whole;
      if (whole) { this.instant = (this.instant + whole) % this.run.at.count; this.update(); }
      return;
    }
    this.phase = (this.phase + 2 * Math.PI * passed * this.speed / CYCLE_SECONDS) % (2 * Math.PI);
    this.draw();
  }

  /** Velocities, scale and texts of what is chosen. */
  update() {
    if (!this.skin) return;
    const { run, skin } = this;
    if (this.kind === "line") {
      [this.re, this.im] = [run.re, run.im].map(rows => combined(skin, this.shapes, rows.row(this.line), rows.factor[this.line], this.withRigid));
    } else if (this.kind === "instant") {
      this.re = combined(skin, this.shapes, run.at.row(this.instant), run.at.factor[this.instant], this.withRigid);
      [this.im, this.phase] = [null, 0];
    } else if (this.kind === "mode") {
      [this.re, this.im] = [single(skin, this.modes, this.mode), null];
    } else [this.re, this.im] = [new Float32Array(skin.points.length), null];
    this.limit = limits(skin, this.re, this.im);
    if (this.kind === "instant" && this.common) {
      const ratio = Math.max(...this.sizes()) / (this.sizes()[this.instant] || 1);
      this.limit = { normal: this.limit.normal * ratio, whole: this.limit.whole * ratio };
    }
    this.renderer.move(this.re, this.im);
    if (this.stepInput) this.stepInput.value = this[this.range()[1]];
    this.mark();
    this.write();
    this.draw();
    if (this.playing && !this.ticking) this.play(true);
  }

  /** RMS over the nodes of the elastic velocity at each instant [m/s]. */
  sizes() {
    const { at } = this.run;
    this.run.sizes ??= {};
    return this.run.sizes[this.withRigid] ??= Float32Array.from({ length: at.count }, (_, k) => {
      let sum = 0;
      const row = at.row(k);
      for (let j = RIGID; j < row.length; ++j) sum += row[j] * row[j];
      if (this.withRigid) for (let j = 0; j < 3; ++j) sum += row[j] * row[j] * this.skin.corners;
      return at.factor[k] * Math.sqrt(sum / this.skin.corners);
    });
  }

  loudestInstant() {
    if (!this.run?.at) return 0;
    const sizes = this.sizes();
    return sizes.indexOf(Math.max(...sizes));
  }

  unit() {
    return this.kind === "mode" ? [1 / this.limit.whole, "relative"] : this.limit.whole < 2e-5 ? [1e6, "µm/s"] : [1e3, "mm/s"];
  }

  write() {
    const { run } = this, [factor, unit] = this.unit();
    const lines = {
      line: () => [`${figure(run.frequency[this.line], 5)} Hz${run.rpm ? `, order ${figure(60 * run.frequency[this.line] / run.rpm, 4)}` : ""}`,
        `normal velocity up to ${figure(factor * this.limit.normal)} ${unit} (peak); ${shapesText(this.shapes, run.error[this.line])}`],
      instant: () => [run.angle ? `${run.angle[this.instant].toFixed(1)}° crank angle, ${figure(1e3 * run.time[this.instant])} ms` : `${figure(1e3 * run.time[this.instant], 4)} ms`,
        `after firing TDC; colours to ${figure(factor * this.limit.normal)} ${unit}; ${shapesText(this.shapes, run.instant_error, "at most ")}`],
      mode: () => [`elastic mode ${this.mode + 1}: ${figure(this.part.modes.hz[this.mode], 5)} Hz`, "free reduced part; relative to its largest motion"],
      panels: () => ["panels", "each face in the colour of the smallest panel that has it"],
    }[this.kind]();
    this.words = lines[1];
    this.caption.replaceChildren(element("strong", {}, `${this.part.name}${run && this.kind !== "mode" && page.runs.length > 1 ? `, ${runName(run.run)}` : ""}: ${lines[0]}`), element("small", {}, lines[1]));
  }

  scene() {
    const [name, colours] = SHOWN[this.shown], [factor, unit] = this.unit();
    const limit = (this.shown === "whole" ? this.limit.whole : this.limit.normal) / this.contrast, low = colours === "diverging" ? -limit : 0;
    const size = Math.max(...this.part.high.map((one, k) => one - this.part.low[k]));
    return { ...this.view.matrices(this.part.low, this.part.high), phase: this.phase, enlargement: this.enlargement * DRAWN_SHARE * size / this.limit.whole,
      shown: Object.keys(SHOWN).indexOf(this.shown), range: [low, limit], colours, outline: this.outline && this.kind !== "panels", edges: this.edges,
      panels: this.kind === "panels" ? this.part.panels.names.map((_, k) => this.panelColour(k)) : null, ink: ink(),
      bar: this.kind === "panels" ? {} : { colours, range: [factor * low, factor * limit], label: `${this.kind === "mode" ? name.replace("velocity", "component") : name} [${unit === "relative" ? "1" : unit}]` } };
  }

  panelColour(k) {
    const { names } = this.part.panels;
    if (names[k] === "skin" || names[k] === "exposed") return ink().metal;
    return colourOf(names.filter(name => name !== "skin" && name !== "exposed").indexOf(names[k]));
  }

  draw() {
    if (!this.re) return;
    const scene = this.scene();
    this.renderer.draw(scene);
    paintBar(this.bar, scene.bar);
    this.writeRuler(scene);
  }

  /** A length, and how long a velocity is drawn. */
  writeRuler({ enlargement }) {
    const length = niceStep(120 * this.view.metresPerPixel, 1), [factor, unit] = this.unit();
    this.ruler.style.width = `${length / this.view.metresPerPixel}px`;
    const drawn = this.kind === "panels" || this.kind === "mode" ? "" : `, 1 ${unit} drawn as ${figure(1e3 * enlargement / factor)} mm`;
    this.ruler.textContent = `${figure(1e3 * length)} mm`;
    this.ruler.title = `${figure(1e3 * length)} mm${drawn}`;
    this.caption.lastChild.textContent = this.words + drawn;
  }

  buildBeside() {
    this.plot = null;
    const makers = { line: () => [this.spectrumPlot(), this.run.mac ? this.macPlot() : null], instant: () => this.instantPlot(), mode: () => this.macPlot(), panels: () => this.panelTable() };
    this.beside.replaceChildren(...[makers[this.kind]()].flat().filter(Boolean));
    if (this.node !== null && this.run?.re && this.kind !== "panels") this.beside.prepend(this.nodePlot());
  }

  /** Chooses the corner nearest to a point of the canvas [pixels], of the face that is seen there. */
  probe(x, y) {
    const scene = this.scene(), { clientWidth: width, clientHeight: height } = this.canvas;
    const [c, s] = [Math.cos(this.phase), Math.sin(this.phase)];
    const moved = this.skin.points.map((one, k) => one + scene.enlargement * (c * this.re[k] - (this.im ? s * this.im[k] : 0)));
    const seen = projected(moved, multiplied(scene.projection, scene.view), width, height);
    const face = faceAt(seen, this.skin.triangles, x, y);
    const corners = face === null ? [] : [0, 4, 8].map(k => this.skin.triangles[12 * face + k]);  // of its first three parts
    const away = node => Math.hypot(seen[3 * node] - x, seen[3 * node + 1] - y);
    this.node = corners.sort((a, b) => away(a) - away(b))[0] ?? null;
    this.renderer.mark(this.node);
    this.buildBeside();
    this.mark();
    this.draw();
  }

  /** The spectrum of the chosen node: as exact as the shapes are. */
  nodePlot() {
    const { run, node } = this, at = [0, 1, 2].map(k => (1e3 * this.skin.points[3 * node + k]).toFixed(0)).join(", ");
    const component = k => Float32Array.from({ length: run.frequency.length }, (_, line) => {
      let [a, b] = [0, 0];
      const [re, im] = [run.re.row(line), run.im.row(line)];
      for (let j = this.withRigid ? 0 : RIGID; j < re.length; ++j) {
        const shape = this.shapes.factor[j] * this.shapes.row(j)[3 * node + k];
        a += run.re.factor[line] * re[j] * shape;
        b += run.im.factor[line] * im[j] * shape;
      }
      return 1e3 * Math.hypot(a, b);
    });
    return new Plot({ title: `Velocity at (${at}) mm`, height: 16, x: { label: "frequency [Hz]" }, y: { label: "amplitude [mm/s], peak", log: true, range: 1e5 }, pick: hz => this.goTo("line", nearestIndex(run.frequency, hz)),
      lines: ["x", "y", "z"].map((name, k) => ({ name, number: k, wide: 1, x: run.frequency, y: component(k) })), note: this.withRigid ? "With the rigid motion." : "Without the rigid motion." }).element;
  }

  spectrumPlot() {
    const { run } = this, values = Float32Array.from({ length: run.frequency.length }, (_, k) => 20 * Math.log10(lineSize(run, k, this.skin.corners) / 5e-8));
    this.plot = new Plot({ title: "Elastic velocity of the skin by line", height: 22, x: { label: "frequency [Hz]" }, y: { label: "level [dB re 50 nm/s, RMS over nodes and time]", range: 90 },
      lines: [{ run: run.run, x: run.frequency, y: values, wide: 1.1 }], pick: hz => this.goTo("line", nearestIndex(run.frequency, hz)), note: "Click a line, or move through them by the arrow keys, to see its shape." });
    return this.plot.element;
  }

  instantPlot() {
    const { run } = this, angle = run.angle ?? Float32Array.from(run.time, one => 1e3 * one);
    this.plot = new Plot({ title: "Velocity of the skin over the cycle", height: 22, x: { label: run.angle ? "crank angle [deg], 0 = firing TDC" : "time [ms]", angles: Boolean(run.angle) }, y: { label: "RMS over nodes, without rigid motion [mm/s]", min: 0 },
      lines: [{ run: run.run, x: angle, y: this.sizes().map(one => 1e3 * one), wide: 1.2 }], pick: at => { this.play(false); this.goTo("instant", nearestIndex(angle, at)); }, note: "Click an instant to see it." });
    return this.plot.element;
  }

  macPlot() {
    const { mac } = this.run ?? {}, { hz } = this.part.modes;
    if (!mac) return card("Modes", element("p", { class: "note" }, `${hz.length} elastic modes up to ${figure(hz.at(-1), 4)} Hz; this part has no field whose shapes could be compared.`));
    const heat = new Heat({ title: "Which modes the strongest lines are made of", height: 22, x: { label: "mode number", edges: evenEdges(0.5, 1, hz.length), names: hz.map((one, k) => `${k + 1}, ${figure(one, 4)} Hz`) },
      y: { label: "line [Hz]", edges: evenEdges(-0.5, 1, mac.hz.length), ticks: mac.hz.map((one, k) => [k, one.toFixed(0)]), names: mac.hz.map(one => `${one.toFixed(0)} Hz`) },
      z: { label: "MAC", colours: "viridis", min: 0, max: 1 }, cells: mac.values.flat(), pick: (i, j) => this.goTo("mode", i),
      note: "MAC: modal assurance criterion of the operating shape (elastic part) and the mode shapes; 1: the same shape. Click a cell to see the mode." });
    return heat.element;
  }

  panelTable() {
    const { names, labels } = this.part.panels, run = page.radiation?.runs.find(one => one.run === this.run?.run);
    const rows = names.map((name, k) => {
      const panel = run?.panels.find(one => one.name === name), power = panel?.measures.erp;
      return [element("td", { class: "text" }, element("i", { style: `display:inline-block;width:.9em;height:.9em;border-radius:.2em;margin-right:.5em;background:${this.panelColour(k)}` }), labels[k]), panel ? figure(1e4 * panel.area_m2) : "–", power ? power.dba.toFixed(1) : "–"];
    });
    return tableCard("Panels", ["panel", "area [cm²]", "ERP [dB(A) re 1 pW]"], rows);
  }

  mark() {
    if (!this.plot) return;
    const at = { line: () => this.run.frequency[this.line], instant: () => (this.run.angle ? this.run.angle[this.instant] : 1e3 * this.run.time[this.instant]) }[this.kind]?.();
    this.plot.update({ marks: [at] });
  }

  picture() {
    const made = element("canvas"), { size, css } = drawingFont(), scene = this.scene(), ratio = this.canvas.width / this.canvas.clientWidth, head = 3.4 * size;
    this.renderer.draw(scene);
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    made.width = this.canvas.width;
    made.height = this.canvas.height + head * ratio;
    const context = made.getContext("2d");
    context.fillStyle = scene.ink.card;
    context.fillRect(0, 0, made.width, made.height);
    context.drawImage(this.canvas, 0, head * ratio);
    context.scale(ratio, ratio);
    context.font = drawingFont("bold").css;
    context.fillStyle = scene.ink.text;
    context.fillText(this.caption.firstChild.textContent, size, 1.3 * size);
    context.font = css;
    context.fillText(this.caption.lastChild.textContent, size, 2.7 * size);
    if (scene.bar.colours) barInto(context, { left: 0, top: head, width, height }, scene.bar, { size, css, tone: scene.ink });
    return made;
  }

  columns() {
    const axis = (values, k) => Array.from({ length: values.length / 3 }, (_, node) => values[3 * node + k]);
    const named = (name, values) => ["x", "y", "z"].map((letter, k) => ({ name: name.replace("*", letter), values: axis(values, k) }));
    const unit = this.kind === "mode" ? "" : " [m/s]";
    return [...named("* [m]", this.skin.points), ...named(`velocity *${this.im ? ", real" : ""}${unit}`, this.re), ...(this.im ? named(`velocity *, imaginary${unit}`, this.im) : [])];
  }
}

function shapesText(shapes, error, before = "") {
  return `made of ${shapes.count - RIGID} shapes, which miss ${before}${figure(100 * error, 2)} %`;
}

function nearestIndex(values, wanted) {
  let best = 0;
  for (let k = 1; k < values.length; ++k) if (Math.abs(values[k] - wanted) < Math.abs(values[best] - wanted)) best = k;
  return best;
}

/** RMS over nodes and time of a line's elastic velocity [m/s]. */
function lineSize(run, k, corners) {
  let sum = 0;
  for (const rows of [run.re, run.im]) {
    const row = rows.row(k), factor = rows.factor[k];
    for (let j = RIGID; j < row.length; ++j) sum += (factor * row[j]) ** 2;
  }
  return Math.sqrt(0.5 * sum / corners);
}

/** The frequency of the strongest of a run's lines above 300 Hz, where a part moves elastically; else of its first. */
function strongestLine(run, frequency) {
  return run.strongest.find(hz => hz > 300) ?? run.strongest[0] ?? frequency[0];
}

async function surfaceSection() {
  if (!page.surface) return;
  const host = section("surface", "Surface", "Surface in motion", "The skin as it moves at a spectral line, at an instant of the cycle or in a mode, and its panels.");
  try {
    const surface = new Surface(host, page.surface);
    await surface.loaded;
  } catch (error) {
    host.append(card("No 3-D view", element("p", { class: "note" }, error.message)));
  }
}
