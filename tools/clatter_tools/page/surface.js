// SPDX-License-Identifier: GPL-3.0-or-later
// The 3-D view: operating shape at a line or an instant, mode shapes, panels.

const DRAWN_SHARE = 0.04; // of the part's size: how far the largest velocity is drawn at enlargement 1
const CYCLE_SECONDS = 1.6; // of an animated line at speed 1
const SHOWN = {
  normal: ["normal velocity", "diverging"],
  whole: ["magnitude", "viridis"],
  amplitude: ["normal amplitude", "viridis"],
};

class Surface {
  constructor(host, data) {
    Object.assign(this, {
      data,
      kind: "line",
      withRigid: false,
      outline: true,
      edges: true,
      shown: "normal",
      enlargement: 1,
      speed: 1,
      phase: 0,
      common: true,
      contrast: 1,
      node: null,
    });
    this.playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.canvas = element("canvas", {
      tabindex: 0,
      role: "img",
      id: "skin",
      "aria-label":
        "The skin in three dimensions. Arrow keys turn it, plus and minus magnify, space plays, page up and down step.",
    });
    this.caption = element("div", { class: "caption", "aria-live": "off" });
    this.bar = element("canvas");
    this.ruler = element("div", { class: "ruler" });
    this.beside = element("div");
    this.controls = element("div");
    host.append(
      element(
        "div",
        { class: "spread" },
        element(
          "figure",
          {},
          element(
            "figcaption",
            {},
            element("h3", {}, "The skin"),
            saveButtons(
              "skin",
              () => surfacePicture(this),
              () => surfaceColumns(this),
            ),
          ),
          this.caption,
          element("div", { class: "view" }, this.canvas, element("div", { class: "bar" }, this.bar), this.ruler),
        ),
        element("div", {}, element("div", { class: "card" }, this.controls), this.beside),
      ),
    );
    this.renderer = new Renderer(this.canvas);
    this.view = new View(
      this.canvas,
      () => this.draw(),
      (x, y) => this.probe(x, y),
      { " ": () => this.play(!this.playing), PageUp: () => this.step(1), PageDown: () => this.step(-1) },
    );
    this.part = data.parts[0];
    this.loaded = this.choosePart(0);
  }

  async choosePart(number) {
    this.part = this.data.parts[number];
    this.skin = await readSkin(this.part);
    this.renderer.load(this.skin);
    this.shapes = this.part.shapes ? await readRows(this.part.shapes) : null;
    [this.modes, this.node] = [null, null];
    await this.chooseRun(Math.max(0, this.part.runs.findIndex(run => run.run === loudestRun)));
    const possible = this.kinds().map(([kind]) => kind);
    buildControls(this);
    await this.chooseKind(possible.includes(this.kind) ? this.kind : possible[0]);
  }

  async chooseRun(number) {
    const run = this.part.runs[number];
    this.run = run ? { ...run } : null;
    if (!run) return;
    const [frequency, error, angle, time] = await allNumbers(run.frequency, run.line_error, run.angle, run.time);
    Object.assign(this.run, {
      frequency,
      error,
      angle,
      time,
      re: run.lines && (await readRows(run.lines[0])),
      im: run.lines && (await readRows(run.lines[1])),
      at: run.instants && (await readRows(run.instants)),
    });
    this.line = Math.max(
      0,
      nearestIndex(
        frequency ?? [0],
        run.loudest || run.strongest.length ? strongestLine(run, frequency) : (frequency?.[1] ?? 0),
      ),
    );
    this.instant = this.loudestInstant();
  }

  kinds() {
    return [
      ["line", "operating shape at a line", this.run?.re],
      ["instant", "at an instant", this.run?.at],
      ["mode", "mode shapes", this.part.modes?.hz.length],
      ["panels", "panels", this.part.panels?.names.length],
    ].filter(([, , present]) => present);
  }

  async chooseKind(kind) {
    this.kind = kind;
    if (kind === "mode" && !this.modes) this.modes = await readRows(this.part.modes.shapes);
    this.mode ??= 0;
    this.kindButtons?.set(kind);
    buildSteps(this);
    buildBeside(this);
    this.update();
  }

  /** What a slider steps through: lines, instants, modes. */
  range() {
    return {
      line: [this.run?.frequency?.length ?? 0, "line"],
      instant: [this.run?.at?.count ?? 0, "instant"],
      mode: [this.part.modes?.hz.length ?? 0, "mode"],
      panels: [0, "line"],
    }[this.kind];
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
    if (on && !this.ticking) {
      this.ticking = true;
      requestAnimationFrame(now => this.tick(now));
    }
  }

  tick(now) {
    if (!this.playing || this.kind === "panels") {
      this.ticking = false;
      return;
    }
    requestAnimationFrame(later => this.tick(later));
    const passed = Math.min(100, now - (this.last ?? now)) / 1000;
    this.last = now;
    if (!this.re || document.hidden || ![this.canvas, this.preview].some(inWindow)) return;
    if (this.kind === "instant") {
      this.rest = (this.rest ?? 0) + passed * 30 * this.speed;
      const whole = Math.floor(this.rest);
      this.rest -= whole;
      if (whole) {
        this.instant = (this.instant + whole) % this.run.at.count;
        this.update();
      }
      return;
    }
    this.phase = (this.phase + (2 * Math.PI * passed * this.speed) / CYCLE_SECONDS) % (2 * Math.PI);
    this.draw();
  }

  /** Velocities, scale and texts of what is chosen. */
  update() {
    if (!this.skin) return;
    const { run, skin } = this;
    if (this.kind === "line") {
      [this.re, this.im] = [run.re, run.im].map(rows =>
        combined(skin, this.shapes, rows.row(this.line), rows.factor[this.line], this.withRigid),
      );
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
    return (this.run.sizes[this.withRigid] ??= Float32Array.from({ length: at.count }, (_, k) => {
      let sum = 0;
      const row = at.row(k);
      for (let j = RIGID; j < row.length; ++j) sum += row[j] * row[j];
      if (this.withRigid) for (let j = 0; j < 3; ++j) sum += row[j] * row[j] * this.skin.corners;
      return at.factor[k] * Math.sqrt(sum / this.skin.corners);
    }));
  }

  loudestInstant() {
    if (!this.run?.at) return 0;
    const sizes = this.sizes();
    return sizes.indexOf(Math.max(...sizes));
  }

  unit() {
    return this.kind === "mode"
      ? [1 / this.limit.whole, "relative"]
      : this.limit.whole < 2e-5
        ? [1e6, "µm/s"]
        : [1e3, "mm/s"];
  }

  write() {
    const { run } = this,
      [factor, unit] = this.unit();
    const lines = {
      line: () => [
        `${figure(run.frequency[this.line], 5)} Hz${run.rpm ? `, order ${figure((60 * run.frequency[this.line]) / run.rpm, 4)}` : ""}`,
        `normal velocity up to ${figure(factor * this.limit.normal)} ${unit} (peak); ${shapesText(this.shapes, run.error[this.line])}`,
      ],
      instant: () => [
        run.angle
          ? `${run.angle[this.instant].toFixed(1)}° crank angle, ${figure(1e3 * run.time[this.instant])} ms`
          : `${figure(1e3 * run.time[this.instant], 4)} ms`,
        `${run.angle ? `after ${page.zero}; ` : ""}colours to ${figure(factor * this.limit.normal)} ${unit}; ${shapesText(this.shapes, run.instant_error, "at most ")}`,
      ],
      mode: () => [
        `elastic mode ${this.mode + 1}: ${figure(this.part.modes.hz[this.mode], 5)} Hz`,
        "free reduced part; relative to its largest motion",
      ],
      panels: () => ["panels", "each face in the colour of the smallest panel that has it"],
    }[this.kind]();
    this.words = lines[1];
    this.caption.replaceChildren(
      element(
        "strong",
        {},
        `${this.part.name}${run && this.kind !== "mode" && page.runs.length > 1 ? `, ${runName(run.run)}` : ""}: ${lines[0]}`,
      ),
      element("small", {}, lines[1]),
    );
  }

  scene() {
    const [name, colours] = SHOWN[this.shown],
      [factor, unit] = this.unit();
    const limit = (this.shown === "whole" ? this.limit.whole : this.limit.normal) / this.contrast,
      low = colours === "diverging" ? -limit : 0;
    const size = Math.max(...this.part.high.map((one, k) => one - this.part.low[k]));
    return {
      ...this.view.matrices(this.part.low, this.part.high, this.kind === "panels" ? 0 : this.bar.clientWidth),
      phase: this.phase,
      enlargement: (this.enlargement * DRAWN_SHARE * size) / this.limit.whole,
      shown: Object.keys(SHOWN).indexOf(this.shown),
      range: [low, limit],
      colours,
      outline: this.outline && this.kind !== "panels",
      edges: this.edges,
      panels: this.kind === "panels" ? this.part.panels.names.map((_, k) => this.panelColour(k)) : null,
      ink: ink(),
      bar:
        this.kind === "panels"
          ? {}
          : {
              colours,
              range: [factor * low, factor * limit],
              label: `${this.kind === "mode" ? name.replace("velocity", "component") : name} [${unit === "relative" ? "1" : unit}]`,
            },
    };
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
    this.drawn?.();
  }

  /** A length, and how long a velocity is drawn. */
  writeRuler({ enlargement }) {
    const length = niceStep(120 * this.view.metresPerPixel, 1),
      [factor, unit] = this.unit();
    this.ruler.style.width = `${length / this.view.metresPerPixel}px`;
    const drawn =
      this.kind === "panels" || this.kind === "mode"
        ? ""
        : `, 1 ${unit} drawn as ${figure((1e3 * enlargement) / factor)} mm`;
    this.ruler.textContent = `${figure(1e3 * length)} mm`;
    this.ruler.title = `${figure(1e3 * length)} mm${drawn}`;
    this.caption.lastChild.textContent = this.words + drawn;
  }

  /** Chooses the corner nearest to a point of the canvas [pixels], of the face that is seen there. */
  probe(x, y) {
    const scene = this.scene(),
      { clientWidth: width, clientHeight: height } = this.canvas;
    const [c, s] = [Math.cos(this.phase), Math.sin(this.phase)];
    const moved = this.skin.points.map(
      (one, k) => one + scene.enlargement * (c * this.re[k] - (this.im ? s * this.im[k] : 0)),
    );
    const seen = projected(moved, multiplied(scene.projection, scene.view), width, height);
    const face = faceAt(seen, this.skin.triangles, x, y);
    const corners = face === null ? [] : [0, 4, 8].map(k => this.skin.triangles[12 * face + k]); // of its first three parts
    const away = node => Math.hypot(seen[3 * node] - x, seen[3 * node + 1] - y);
    this.node = corners.sort((a, b) => away(a) - away(b))[0] ?? null;
    this.renderer.mark(this.node);
    buildBeside(this);
    this.mark();
    this.draw();
  }

  mark() {
    if (!this.plot) return;
    const at = {
      line: () => this.run.frequency[this.line],
      instant: () => (this.run.angle ? this.run.angle[this.instant] : 1e3 * this.run.time[this.instant]),
    }[this.kind]?.();
    this.plot.update({ marks: [at] });
  }
}

/** Whether a part of a canvas is in the window. */
function inWindow(canvas) {
  const bounds = canvas?.getBoundingClientRect();
  return Boolean(bounds?.height) && bounds.bottom > 0 && bounds.top < innerHeight;
}

function shapesText(shapes, error, before = "") {
  return `made of ${shapes.count - RIGID} shapes, which miss ${before}${figure(100 * error, 2)} %`;
}

async function surfaceSection() {
  if (!page.surface) return;
  const host = section(
    "surface",
    "Surface",
    "Surface in motion",
    "The skin as it moves at a spectral line, at an instant of the cycle or in a mode, and its panels.",
  );
  try {
    const surface = new Surface(host, page.surface);
    await surface.loaded;
    mirror(surface);
  } catch (error) {
    host.querySelector(".spread")?.remove();
    host.append(card("No 3-D view", element("p", { class: "note" }, error.message)));
  }
}
