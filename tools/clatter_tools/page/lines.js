// SPDX-License-Identifier: GPL-3.0-or-later
// Lines of plots on a canvas.

function stroke(context, points, width) {
  context.lineWidth = width;
  context.beginPath();
  points.forEach(([x, y], k) => (k ? context.lineTo(x, y) : context.moveTo(x, y)));
  context.stroke();
}

/** Of labelled ticks as many as there is space for. */
function thinned(ticks, count) {
  const every = Math.max(1, Math.ceil(ticks.length / Math.max(1, count)));
  return ticks.filter((_, k) => k % every === 0);
}

/** Index of the value of a line that belongs to x. */
function nearest({ x, y, kind }, at) {
  let low = 0,
    high = x.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (x[middle] <= at) low = middle;
    else high = middle;
  }
  if (kind === "stairs") return Math.min(low, y.length - 1);
  return Math.abs(x[high] - at) < Math.abs(x[low] - at) ? high : low;
}

const USUAL_FONT_PX = 12; // with which widths of lines are as they are given; on a wall screen letters and lines are larger

function paintLine(context, line, colour, sx, sy, box) {
  context.strokeStyle = context.fillStyle = colour;
  context.lineJoin = "round";
  context.setLineDash(line.dash ?? []);
  context.lineWidth = ((line.wide ?? 1.5) * drawingFont().size) / USUAL_FONT_PX;
  const { x, y, kind } = line;
  if (kind === "points") {
    for (let k = 0; k < y.length; ++k) {
      context.beginPath();
      context.arc(sx.to(x[k]), sy.to(y[k]), 3.4, 0, 7);
      context.fill();
    }
  } else if (kind === "area") {
    context.globalAlpha = 0.25;
    context.beginPath();
    for (let k = 0; k < y.length; ++k) context.lineTo(sx.to(x[k]), sy.to(y[k]));
    for (let k = y.length - 1; k >= 0; --k) context.lineTo(sx.to(x[k]), sy.to(line.low[k]));
    context.fill();
    context.globalAlpha = 1;
  } else if (kind === "stairs") {
    context.beginPath();
    for (let k = 0; k < y.length; ++k) {
      const at = Math.min(sy.to(y[k]), box.bottom + 9);
      context.lineTo(sx.to(x[k]), at);
      context.lineTo(sx.to(x[k + 1]), at);
    }
    context.stroke();
  } else tracePolyline(context, x, y, sx, sy, box);
  context.setLineDash([]);
}

/** A polyline; of many values in one column of pixels only the least and the largest. Values that are not numbers are gaps. */
function tracePolyline(context, x, y, sx, sy, box) {
  context.beginPath();
  let pen = false,
    column = NaN,
    low = 0,
    high = 0,
    last = 0;
  const flush = () => {
    if (low !== high) {
      context.lineTo(column, low);
      context.lineTo(column, high);
    }
    context.lineTo(column, last);
  };
  const clip = value => Math.min(box.bottom + 2000, Math.max(box.top - 2000, value));
  for (let k = 0; k < y.length; ++k) {
    const px = sx.to(x[k]);
    if (!Number.isFinite(y[k])) {
      if (pen) flush();
      pen = false;
      column = NaN;
      continue;
    }
    if (px < box.left - 50 && sx.to(x[Math.min(k + 1, y.length - 1)]) < box.left - 50) continue;
    const py = clip(sy.to(y[k])),
      at = Math.round(2 * px) / 2;
    if (!pen) {
      context.moveTo(at, py);
      pen = true;
    } else if (at !== column) flush();
    if (at !== column) {
      column = at;
      low = high = py;
    } else {
      low = Math.min(low, py);
      high = Math.max(high, py);
    }
    last = py;
    if (px > box.right + 50) break;
  }
  if (pen) flush();
  context.stroke();
}
