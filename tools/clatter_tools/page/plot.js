// SPDX-License-Identifier: GPL-3.0-or-later
// Curves over one axis: a cursor reads their values, a drag magnifies, keys do both.

const PLOT_HEIGHT_REM = 17;

/** A plot { title, note, x: { label, log, angles, ticks, min, max }, y: { label, log, min, max, range }, lines, marks, pick }.
    A line is { name, run, x, y, low, kind: "line" | "stairs" | "points" | "area", colour, dash, wide }; of stairs x has one value more
    than y. `marks` are values of x with a thin line; `pick` is called with the x that was clicked. */
class Plot {
  constructor(spec) {
    this.spec = spec;
    this.cursor = null;
    this.zoom = null;
    this.drag = null;
    this.canvas = element("canvas", {
      tabindex: 0,
      role: "img",
      style: `flex-basis: ${spec.height ?? PLOT_HEIGHT_REM}rem`,
      "aria-label": `${spec.title}. Arrow keys move the cursor, plus and minus magnify, Escape shows everything.`,
    });
    this.legend = element("div", { class: "legend" });
    const save = saveButtons(
      spec.title,
      () => this.picture(),
      () => this.columns(),
    );
    this.reset = element("button", { type: "button", hidden: true, onclick: () => this.show(null) }, "all");
    save.prepend(this.reset);
    this.element = element(
      "figure",
      { class: "plot" },
      element("figcaption", {}, element("h3", {}, spec.title), save),
      this.legend,
      this.canvas,
      (this.note = element("p", { class: "note" })),
    );
    this.redraw = whenVisible(this.canvas, () => this.draw());
    this.update({});
    this.listen();
  }

  /** Replaces parts of the specification and draws again. */
  update(changes) {
    Object.assign(this.spec, changes);
    this.note.textContent = this.spec.note ?? "";
    if (changes.lines) this.legend.style.minHeight = "";
    if (changes.title) this.element.querySelector("h3").textContent = changes.title;
    this.redraw();
  }

  lines() {
    return this.spec.lines.filter(
      line => line.y && line.y.length && (line.run === undefined || shownRuns.has(line.run)),
    );
  }

  colour(line, k) {
    return line.colour ?? (line.run === undefined ? colourOf(line.number ?? k) : runColour(line.run));
  }

  show(zoom) {
    this.zoom = zoom;
    this.reset.hidden = !zoom;
    this.redraw();
  }

  /** Limits of x: what is magnified, what is prescribed, or all values. */
  limitsX(lines) {
    let { min, max } = this.spec.x;
    for (const { x } of lines) {
      const [first, last] = [x[0], x[x.length - 1]];
      if (this.spec.x.min === undefined) min = Math.min(min ?? Infinity, first, last);
      if (this.spec.x.max === undefined) max = Math.max(max ?? -Infinity, first, last);
    }
    if (this.spec.x.log && !(min > 0)) min = max / 1e3;
    if (lines.some(line => line.kind === "points")) [min, max] = [min - 0.02 * (max - min), max + 0.02 * (max - min)];
    const whole = { min: min ?? 0, max: max > min ? max : (min ?? 0) + 1, log: this.spec.x.log };
    if (this.spec.x.angles && whole.max - whole.min > 300)
      Object.assign(whole, { min: 90 * Math.round(whole.min / 90), max: 90 * Math.round(whole.max / 90) });
    return this.zoom ? { ...whole, ...this.zoom } : whole;
  }

  limitsY(lines, { min: left, max: right }) {
    let low = Infinity,
      high = -Infinity;
    const take = value => {
      if (Number.isFinite(value)) {
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    };
    for (const { x, y, low: lower } of lines)
      for (let k = 0; k < y.length; ++k)
        if (x[Math.min(k + 1, x.length - 1)] >= left && x[k] <= right) {
          take(y[k]);
          if (lower) take(lower[k]);
        }
    const { y } = this.spec;
    if (!(low <= high)) [low, high] = [y.log ? 0.1 : 0, 1];
    if (y.log)
      return { min: y.min ?? Math.max(low, high / (y.range ?? 1e6)) * 0.8, max: y.max ?? high * 1.25, log: true };
    if (y.range) low = Math.max(low, high - y.range);
    const margin = 0.06 * (high - low) || 0.05 * Math.abs(high) || 1;
    return { min: y.min ?? low - margin, max: y.max ?? high + margin };
  }

  draw() {
    const context = this.canvas.getContext("2d");
    const size = fitCanvas(this.canvas, context);
    if (size.width < 40) return;
    context.clearRect(0, 0, size.width, size.height);
    this.frame = this.paint(context, { left: 0, top: 0, ...size });
    this.writeLegend();
  }

  /** Draws axes and lines into a part of a canvas; returns the scales. */
  paint(context, { left, top, width, height }) {
    const lines = this.lines(),
      colours = ink(),
      { size, css } = drawingFont();
    const x = this.limitsX(lines),
      y = this.limitsY(lines, x);
    context.font = css;
    const ticksY = y.log ? logTicks(y.min, y.max) : linearTicks(y.min, y.max, (height - 4 * size) / (2.8 * size));
    const stepY = ticksY.length > 1 ? ticksY[1] - ticksY[0] : 1;
    const labelsY = ticksY.map(tick => tickText(tick, stepY));
    const box = {
      left: left + 1.9 * size + Math.max(...labelsY.map(label => context.measureText(label).width), size),
      right: left + width - 1.7 * size,
      top: top + 0.7 * size,
      bottom: top + height - 3.1 * size,
    };
    const sx = axisScale(x, box.left, box.right),
      sy = axisScale(y, box.bottom, box.top);
    this.paintAxes(context, { x, y, sx, sy, box, ticksY, labelsY, colours, size });
    context.save();
    context.beginPath();
    context.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
    context.clip();
    for (const mark of this.spec.marks ?? []) {
      context.strokeStyle = colours.quiet;
      context.setLineDash([2, 3]);
      stroke(
        context,
        [
          [sx.to(mark), box.top],
          [sx.to(mark), box.bottom],
        ],
        1,
      );
      context.setLineDash([]);
    }
    lines
      .map((line, k) => [line, this.colour(line, k)])
      .reverse()
      .forEach(([line, colour]) => paintLine(context, line, colour, sx, sy, box));
    this.paintCursor(context, sx, sy, box, lines, colours);
    context.restore();
    return { sx, sy, box };
  }

  paintAxes(context, { x, sx, sy, box, ticksY, labelsY, colours, size }) {
    context.lineWidth = 1;
    context.textBaseline = "middle";
    context.textAlign = "right";
    ticksY.forEach((tick, k) => {
      context.strokeStyle = colours.grid;
      stroke(
        context,
        [
          [box.left, sy.to(tick)],
          [box.right, sy.to(tick)],
        ],
        1,
      );
      context.fillStyle = colours.quiet;
      context.fillText(labelsY[k], box.left - 0.5 * size, sy.to(tick));
    });
    const count = (box.right - box.left) / (5.2 * size);
    const own = this.spec.x.ticks;
    const ticks = own
      ? thinned(
          own.filter(([value]) => value >= x.min && value <= x.max),
          count,
        )
      : (x.log ? logTicks(x.min, x.max) : linearTicks(x.min, x.max, count, this.spec.x.angles)).map((tick, k, all) => [
          tick,
          tickText(tick, all.length > 1 ? all[1] - all[0] : 1),
        ]);
    context.textAlign = "center";
    context.textBaseline = "top";
    for (const [tick, label] of ticks) {
      context.strokeStyle = colours.grid;
      stroke(
        context,
        [
          [sx.to(tick), box.top],
          [sx.to(tick), box.bottom],
        ],
        1,
      );
      context.fillStyle = colours.quiet;
      context.fillText(label, sx.to(tick), box.bottom + 0.4 * size);
    }
    context.strokeStyle = colours.line;
    stroke(
      context,
      [
        [box.left, box.top],
        [box.left, box.bottom],
        [box.right, box.bottom],
      ],
      1.2,
    );
    context.fillStyle = colours.text;
    context.fillText(this.spec.x.label, 0.5 * (box.left + box.right), box.bottom + 1.75 * size, box.right - box.left);
    context.save();
    context.translate(
      box.left - (1.9 * size + Math.max(...labelsY.map(label => context.measureText(label).width), size)) + 0.1 * size,
      0.5 * (box.top + box.bottom),
    );
    context.rotate(-Math.PI / 2);
    context.fillText(this.spec.y.label, 0, 0, box.bottom - box.top + 2 * size);
    context.restore();
  }

  paintCursor(context, sx, sy, box, lines, colours) {
    if (this.drag?.moved) {
      context.fillStyle = colours.accent + "33";
      context.fillRect(
        sx.to(this.drag.from),
        box.top,
        sx.to(this.drag.to) - sx.to(this.drag.from),
        box.bottom - box.top,
      );
    }
    if (this.cursor === null) return;
    context.strokeStyle = colours.text;
    stroke(
      context,
      [
        [sx.to(this.cursor), box.top],
        [sx.to(this.cursor), box.bottom],
      ],
      1,
    );
    lines.forEach((line, k) => {
      const at = nearest(line, this.cursor);
      context.fillStyle = this.colour(line, k);
      context.beginPath();
      context.arc(line.kind === "stairs" ? sx.to(this.cursor) : sx.to(line.x[at]), sy.to(line.y[at]), 3.2, 0, 7);
      context.fill();
    });
  }

  writeLegend() {
    const lines = this.lines();
    const values =
      this.cursor === null
        ? []
        : [element("span", {}, `${this.spec.x.name ?? "at"} `, element("b", {}, this.cursorText(lines)))];
    this.legend.replaceChildren(
      ...values,
      ...lines
        .filter(line => line.name)
        .map(line => {
          const k = lines.indexOf(line);
          return element(
            "span",
            {},
            element("i", { class: line.dash ? "dashed" : null, style: `--colour: ${this.colour(line, k)}` }),
            line.name,
            this.cursor === null ? null : element("b", {}, figure(line.y[nearest(line, this.cursor)])),
          );
        }),
    );
    // With values the legend may need one more row: it keeps it, so that the plot does not jump.
    if (this.cursor !== null) this.legend.style.minHeight = `${this.legend.offsetHeight}px`;
  }

  cursorText(lines) {
    if (this.spec.x.ticks && lines[0]?.kind === "stairs")
      return this.spec.x.names?.[nearest(lines[0], this.cursor)] ?? figure(this.cursor);
    return figure(lines[0] ? lines[0].x[nearest(lines[0], this.cursor)] : this.cursor, 4);
  }

  listen() {
    const { canvas } = this;
    const valueAt = event => {
      const { sx, box } = this.frame,
        at = event.clientX - canvas.getBoundingClientRect().left;
      return sx.from(Math.min(box.right, Math.max(box.left, at)));
    };
    canvas.addEventListener("pointerdown", event => {
      if (this.frame) this.drag = { from: valueAt(event), to: valueAt(event), at: event.clientX, moved: false };
    });
    canvas.addEventListener("pointermove", event => {
      if (!this.frame) return;
      this.cursor = valueAt(event);
      if (this.drag) {
        this.drag.to = this.cursor;
        this.drag.moved ||= Math.abs(event.clientX - this.drag.at) > 6;
        if (this.drag.moved) canvas.setPointerCapture(event.pointerId);
      }
      this.redraw();
    });
    canvas.addEventListener("pointerup", () => {
      const { drag } = this;
      this.drag = null;
      if (drag?.moved) this.show({ min: Math.min(drag.from, drag.to), max: Math.max(drag.from, drag.to) });
      else if (drag && this.spec.pick) this.spec.pick(drag.from);
      this.redraw();
    });
    for (const name of ["pointerleave", "pointercancel", "blur"])
      canvas.addEventListener(name, () => {
        if (!this.drag || name !== "pointerleave") {
          this.drag = null;
          this.cursor = null;
          this.redraw();
        }
      });
    canvas.addEventListener("dblclick", () => this.show(null));
    canvas.addEventListener("keydown", event => this.key(event));
  }

  key(event) {
    const line = this.lines()[0];
    if (!line || !this.frame) return;
    const limits = this.limitsX(this.lines()),
      { sx, box } = this.frame;
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key],
      factor = { "+": 0.5, "-": 2 }[event.key];
    const now = this.cursor ?? sx.from(0.5 * (box.left + box.right));
    if (step) {
      const skip = event.shiftKey ? Math.max(1, Math.round(line.y.length / 40)) : 1;
      const at = Math.min(line.y.length - 1, Math.max(0, nearest(line, now) + step * skip));
      this.cursor = line.kind === "stairs" ? Math.sqrt(line.x[at] * line.x[at + 1]) : line.x[at];
      this.spec.pick?.(this.cursor);
    } else if (factor && !limits.log) {
      const half = 0.5 * factor * (limits.max - limits.min);
      this.show({ min: now - half, max: now + half });
    } else if (event.key === "Escape") {
      this.cursor = null;
      this.show(null);
    } else return;
    event.preventDefault();
    this.redraw();
  }

  /** The plot with its title and legend as a picture. */
  picture() {
    return picture(
      this.spec.title,
      this.canvas,
      this.lines()
        .filter(line => line.name)
        .map(line => [line.name, this.colour(line, this.lines().indexOf(line))]),
      (context, box) => this.paint(context, box),
    );
  }

  columns() {
    const found = [];
    let before = null;
    for (const line of this.lines()) {
      if (!sameValues(line.x, before))
        found.push({
          name: line.kind === "stairs" ? `${this.spec.x.label}, lower edge` : this.spec.x.label,
          values: line.kind === "stairs" ? (line.x.subarray?.(0, line.y.length) ?? line.x.slice(0, -1)) : line.x,
        });
      before = line.x;
      const name = line.name ? `${line.name}: ${this.spec.y.label}` : this.spec.y.label;
      if (line.low) found.push({ name: `${name}, lowest`, values: line.low });
      found.push({ name: line.low ? `${name}, highest` : name, values: line.y });
    }
    return found;
  }
}

/** Whether two axes are the same, so that a table has them once. */
function sameValues(a, b) {
  return a === b || (b !== null && a.length === b.length && a.every((one, k) => one === b[k]));
}
