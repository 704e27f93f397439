// SPDX-License-Identifier: GPL-3.0-or-later
// Values over two axes as colours.

/** A function from 0 .. 1 to [r, g, b] from 0 to 255. */
function colourMap(name) {
  const table = page.colours[name];
  return share => {
    const at = Math.min(1, Math.max(0, share)) * (table.length - 1),
      k = Math.min(table.length - 2, Math.floor(at)),
      part = at - k;
    return table[k].map((one, channel) => one + part * (table[k + 1][channel] - one));
  };
}

function cssColour(parts) {
  return `rgb(${parts.map(Math.round).join(" ")})`;
}

/** A map { title, note, x: { label, edges, ticks, angles }, y: the same, z: { label, colours, min, max }, cells, lines, pick, height }: cells
    row by row from the lowest y; `lines` [{ x, y, name }] are drawn over it. */
class Heat {
  constructor(spec) {
    this.spec = spec;
    this.at = null;
    this.canvas = element("canvas", {
      tabindex: 0,
      role: "img",
      style: `flex-basis: ${spec.height ?? PLOT_HEIGHT_REM}rem`,
      "aria-label": `${spec.title}. Arrow keys move from cell to cell.`,
    });
    this.legend = element("div", { class: "legend" });
    this.element = element(
      "figure",
      { class: "plot" },
      element(
        "figcaption",
        {},
        element("h3", {}, spec.title),
        saveButtons(
          spec.title,
          () => this.picture(),
          () => this.columns(),
        ),
      ),
      this.legend,
      this.canvas,
      (this.note = element("p", { class: "note" })),
    );
    this.redraw = whenVisible(this.canvas, () => this.draw());
    this.update({});
    this.listen();
  }

  update(changes) {
    Object.assign(this.spec, changes);
    this.note.textContent = this.spec.note ?? "";
    if (changes.title) this.element.querySelector("h3").textContent = changes.title;
    this.redraw();
  }

  draw() {
    const context = this.canvas.getContext("2d"),
      size = fitCanvas(this.canvas, context);
    if (size.width < 40) return;
    context.clearRect(0, 0, size.width, size.height);
    this.frame = this.paint(context, { left: 0, top: 0, ...size });
    this.writeLegend();
  }

  range() {
    let { min, max } = this.spec.z;
    if (min === undefined || max === undefined) {
      let low = Infinity,
        high = -Infinity;
      for (const value of this.spec.cells)
        if (Number.isFinite(value)) {
          low = Math.min(low, value);
          high = Math.max(high, value);
        }
      min ??= low;
      max ??= high;
    }
    return { min, max: max > min ? max : min + 1 };
  }

  paint(context, { left, top, width, height }) {
    const { x, y, z } = this.spec,
      colours = ink(),
      { size, css } = drawingFont();
    context.font = css;
    const limitsX = { min: x.edges[0], max: x.edges[x.edges.length - 1] },
      limitsY = { min: y.edges[0], max: y.edges[y.edges.length - 1] };
    const ticksY = y.ticks
      ? thinned(y.ticks, height / (1.6 * size))
      : linearTicks(limitsY.min, limitsY.max, height / (3 * size), y.angles).map((one, k, all) => [
          one,
          tickText(one, all[1] - all[0]),
        ]);
    const wide = Math.max(...ticksY.map(([, label]) => context.measureText(label).width), size);
    const box = {
      left: left + wide + 2 * size,
      right: left + width - 5.6 * size,
      top: top + 0.7 * size,
      bottom: top + height - 3.1 * size,
    };
    if (x.slanted) box.bottom -= 1.2 * size;
    const sx = axisScale(limitsX, box.left, box.right),
      sy = axisScale(limitsY, box.bottom, box.top);
    const range = this.range();
    this.paintCells(context, box, sx, sy, range);
    context.save();
    context.beginPath();
    context.rect(box.left, box.top, box.right - box.left, box.bottom - box.top);
    context.clip();
    for (const line of this.spec.lines ?? []) {
      context.strokeStyle = "rgb(255 255 255 / .75)";
      context.setLineDash([6, 4]);
      stroke(
        context,
        line.x.map((one, k) => [sx.to(one), sy.to(line.y[k])]),
        1,
      );
      context.setLineDash([]);
    }
    context.restore();
    this.paintAxes(context, { sx, sy, box, ticksY, wide, colours, size, limitsX });
    this.paintBar(context, box, range, colours, size);
    if (this.at) {
      const [i, j] = this.at;
      context.strokeStyle = colours.text;
      context.lineWidth = 2;
      context.strokeRect(
        sx.to(x.edges[i]),
        sy.to(y.edges[j + 1]),
        sx.to(x.edges[i + 1]) - sx.to(x.edges[i]),
        sy.to(y.edges[j]) - sy.to(y.edges[j + 1]),
      );
    }
    return { sx, sy, box };
  }

  paintCells(context, box, sx, sy, { min, max }) {
    const { x, y, z, cells } = this.spec,
      columns = x.edges.length - 1,
      rows = y.edges.length - 1,
      colour = colourMap(z.colours);
    const image = new ImageData(columns, rows);
    for (let j = 0; j < rows; ++j)
      for (let i = 0; i < columns; ++i) {
        const value = cells[j * columns + i],
          to = 4 * ((rows - 1 - j) * columns + i);
        if (!Number.isFinite(value)) continue;
        const parts = colour((value - min) / (max - min));
        for (let k = 0; k < 3; ++k) image.data[to + k] = parts[k];
        image.data[to + 3] = 255;
      }
    if (evenly(x.edges) && evenly(y.edges)) {
      const small = element("canvas", { width: columns, height: rows });
      small.getContext("2d").putImageData(image, 0, 0);
      context.imageSmoothingEnabled = false;
      context.drawImage(small, box.left, box.top, box.right - box.left, box.bottom - box.top);
      return;
    }
    for (let j = 0; j < rows; ++j)
      for (let i = 0; i < columns; ++i) {
        const from = 4 * ((rows - 1 - j) * columns + i);
        if (!image.data[from + 3]) continue;
        context.fillStyle = `rgb(${image.data[from]} ${image.data[from + 1]} ${image.data[from + 2]})`;
        const [a, b] = [sx.to(x.edges[i]), sy.to(y.edges[j + 1])];
        context.fillRect(a, b, sx.to(x.edges[i + 1]) - a + 0.5, sy.to(y.edges[j]) - b + 0.5);
      }
  }

  paintAxes(context, { sx, sy, box, ticksY, wide, colours, size, limitsX }) {
    const { x, y } = this.spec;
    context.strokeStyle = colours.line;
    context.lineWidth = 1;
    context.strokeRect(box.left, box.top, box.right - box.left, box.bottom - box.top);
    context.textAlign = "right";
    context.textBaseline = "middle";
    context.fillStyle = colours.quiet;
    for (const [tick, label] of ticksY) context.fillText(label, box.left - 0.5 * size, sy.to(tick));
    context.textAlign = "center";
    context.textBaseline = "top";
    const count = (box.right - box.left) / (5.2 * size);
    const ticks = x.ticks
      ? thinned(x.ticks, (box.right - box.left) / (3.4 * size))
      : linearTicks(limitsX.min, limitsX.max, count, x.angles).map((one, k, all) => [
          one,
          tickText(one, all[1] - all[0]),
        ]);
    for (const [tick, label] of ticks) context.fillText(label, sx.to(tick), box.bottom + 0.4 * size);
    context.fillStyle = colours.text;
    context.fillText(x.label, 0.5 * (box.left + box.right), box.bottom + 1.75 * size, box.right - box.left);
    context.save();
    context.translate(box.left - wide - 1.9 * size, 0.5 * (box.top + box.bottom));
    context.rotate(-Math.PI / 2);
    context.fillText(y.label, 0, 0, box.bottom - box.top + size);
    context.restore();
  }

  paintBar(context, box, range, colours, size) {
    const scale = axisScale(range, box.bottom, box.top),
      colour = colourMap(this.spec.z.colours),
      left = box.right + 0.8 * size,
      wide = 0.8 * size;
    const steps = 64,
      high = (box.bottom - box.top) / steps;
    for (let k = 0; k < steps; ++k) {
      context.fillStyle = cssColour(colour((k + 0.5) / steps));
      context.fillRect(left, box.bottom - (k + 1) * high, wide, high + 0.6);
    }
    context.fillStyle = colours.quiet;
    context.textAlign = "left";
    context.textBaseline = "middle";
    const ticks = linearTicks(range.min, range.max, (box.bottom - box.top) / (3 * size));
    for (const tick of ticks)
      context.fillText(tickText(tick, ticks[1] - ticks[0]), left + wide + 0.3 * size, scale.to(tick));
    context.save();
    context.fillStyle = colours.text;
    context.translate(box.right + 5.4 * size, 0.5 * (box.top + box.bottom));
    context.rotate(-Math.PI / 2);
    context.textAlign = "center";
    context.textBaseline = "bottom";
    context.fillText(this.spec.z.label, 0, 0, box.bottom - box.top + 2 * size);
    context.restore();
  }

  writeLegend() {
    if (!this.at) {
      this.legend.textContent = this.spec.hint ?? "point at a cell to read it";
      return;
    }
    const [i, j] = this.at,
      { x, y, cells } = this.spec,
      columns = x.edges.length - 1;
    const name = (axis, k) => axis.names?.[k] ?? figure(0.5 * (axis.edges[k] + axis.edges[k + 1]), 4);
    this.legend.replaceChildren(
      element("span", {}, `${x.label}: `, element("b", {}, name(x, i))),
      element("span", {}, `${y.label}: `, element("b", {}, name(y, j))),
      element("b", {}, `${figure(cells[j * columns + i])} ${this.spec.z.unit ?? ""}`),
    );
  }

  listen() {
    const find = (edges, value) => {
      for (let k = 0; k + 1 < edges.length; ++k) if (value >= edges[k] && value <= edges[k + 1]) return k;
      return -1;
    };
    const cellAt = event => {
      const bounds = this.canvas.getBoundingClientRect();
      const i = find(this.spec.x.edges, this.frame.sx.from(event.clientX - bounds.left)),
        j = find(this.spec.y.edges, this.frame.sy.from(event.clientY - bounds.top));
      return i < 0 || j < 0 ? null : [i, j];
    };
    this.canvas.addEventListener("pointermove", event => {
      if (this.frame) {
        this.at = cellAt(event);
        this.redraw();
      }
    });
    for (const name of ["pointerleave", "blur"])
      this.canvas.addEventListener(name, () => {
        this.at = null;
        this.redraw();
      });
    this.canvas.addEventListener("click", event => {
      const cell = this.frame && cellAt(event);
      if (cell) this.spec.pick?.(...cell);
    });
    this.canvas.addEventListener("keydown", event => {
      const step = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] }[event.key];
      if (event.key === "Enter" && this.at) this.spec.pick?.(...this.at);
      if (!step) return;
      const inside = (value, edges) => Math.min(edges.length - 2, Math.max(0, value));
      const [i, j] = this.at ?? [-step[0], -step[1]];
      this.at = [inside(i + step[0], this.spec.x.edges), inside(j + step[1], this.spec.y.edges)];
      event.preventDefault();
      this.redraw();
    });
  }

  picture() {
    return picture(this.spec.title, this.canvas, [], (context, box) => this.paint(context, box));
  }

  columns() {
    const { x, y, cells, z } = this.spec,
      columns = x.edges.length - 1;
    const centre = axis =>
      Array.from(
        { length: axis.edges.length - 1 },
        (_, k) => axis.names?.[k] ?? 0.5 * (axis.edges[k] + axis.edges[k + 1]),
      );
    const [xs, ys] = [centre(x), centre(y)];
    return [
      { name: x.label, values: ys.flatMap(() => xs) },
      { name: y.label, values: ys.flatMap(one => xs.map(() => one)) },
      { name: z.label, values: Array.from(cells.slice(0, columns * ys.length)) },
    ];
  }
}

function evenly(edges) {
  const step = (edges[edges.length - 1] - edges[0]) / (edges.length - 1);
  return edges.every((edge, k) => Math.abs(edge - edges[0] - k * step) < 0.02 * Math.abs(step));
}

/** Edges of cells around centres. */
function edgesAround(centres) {
  const middle = Array.from(centres)
    .slice(1)
    .map((one, k) => 0.5 * (one + centres[k]));
  const first = centres.length > 1 ? centres[0] - (middle[0] - centres[0]) : centres[0] - 0.5;
  const last = centres.length > 1 ? 2 * centres[centres.length - 1] - middle[middle.length - 1] : centres[0] + 0.5;
  return [first, ...middle, last];
}

/** Edges of so many cells of one step. */
function evenEdges(first, step, count) {
  return Array.from({ length: count + 1 }, (_, k) => first + k * step);
}
