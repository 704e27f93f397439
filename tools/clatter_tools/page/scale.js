// SPDX-License-Identifier: GPL-3.0-or-later
// Axes: ticks, and values as texts.

const SETTLED_MS = 250;

function niceStep(span, count) {
  const raw = span / Math.max(1, count),
    power = 10 ** Math.floor(Math.log10(raw));
  return power * [1, 2, 5, 10].find(factor => factor * power >= 0.999 * raw);
}

/** Round values from min to max, about `count` of them; of angles multiples of 90, 45 .. deg. */
function linearTicks(min, max, count, angles = false) {
  const span = max - min;
  if (!(span > 0)) return [min];
  let step = niceStep(span, count);
  if (angles && span > 30) step = [10, 15, 30, 45, 90, 180, 360].find(one => span / one <= Math.max(2, count)) ?? 360;
  const ticks = [];
  for (let k = Math.ceil(min / step - 1e-9); k * step <= max + 1e-9 * step; ++k) ticks.push(k * step);
  return ticks;
}

function logTicks(min, max) {
  const ticks = [],
    wide = Math.log10(max / min) > 2.5;
  for (let power = Math.floor(Math.log10(min)); power <= Math.ceil(Math.log10(max)); ++power)
    for (const factor of wide ? [1] : [1, 2, 5]) {
      const tick = factor * 10 ** power;
      if (tick >= 0.999 * min && tick <= 1.001 * max) ticks.push(tick);
    }
  return ticks;
}

/** A number with as many digits as a reader needs. */
function figure(value, digits = 3) {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) return value.toExponential(Math.max(0, digits - 2)).replace("e+", "e");
  return String(Number(value.toPrecision(size >= 10 ** digits ? Math.ceil(Math.log10(size)) : digits)));
}

function tickText(value, step) {
  if (Math.abs(value) < 1e-9 * Math.abs(step || 1)) return "0";
  const size = Math.abs(value);
  if (size >= 1e5 || size < 1e-3) return value.toExponential(1).replace(".0e", "e").replace("e+", "e");
  return String(Number(value.toPrecision(6))).replace("-", "−");
}

function nearestIndex(values, wanted) {
  let best = 0;
  for (let k = 1; k < values.length; ++k) if (Math.abs(values[k] - wanted) < Math.abs(values[best] - wanted)) best = k;
  return best;
}

/** Maps values of an axis { min, max, log } to pixels from `begin` to `end` and back. */
function axisScale({ min, max, log }, begin, end) {
  const f = log ? Math.log : one => one,
    low = f(min),
    span = f(max) - low || 1;
  return {
    to: value => begin + ((f(value) - low) / span) * (end - begin),
    from: pixel => {
      const at = low + ((pixel - begin) / (end - begin)) * span;
      return log ? Math.exp(at) : at;
    },
  };
}

/** A canvas of its element's size and of the screen's resolution. */
function fitCanvas(canvas, context) {
  const ratio = devicePixelRatio || 1,
    { clientWidth: width, clientHeight: height } = canvas;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  context?.setTransform(ratio, 0, 0, ratio, 0, 0);
  return { width, height };
}

/** Font of drawings: the size of small text on this page. */
function drawingFont(weight = "") {
  const size = 0.78 * parseFloat(getComputedStyle(document.documentElement).fontSize);
  return { size, css: `${weight} ${size}px system-ui, "Segoe UI", "DejaVu Sans", sans-serif` };
}

const PRINTED = "#summary, #radiation"; // the sections that page.css leaves on paper

/** Calls back when a drawing comes near the window, and again whenever it must be drawn again while it is there. */
function whenVisible(host, draw) {
  let near = false,
    stale = true,
    waiting = false;
  // Plots in a row have one height, which legends change while others are drawn: no observer reports what changes and changes back.
  const paint = () => {
    const [width, height] = [host.clientWidth, host.clientHeight];
    stale = false;
    draw();
    setTimeout(() => {
      if (host.clientWidth !== width || host.clientHeight !== height) request();
    }, SETTLED_MS);
  };
  const request = () => {
    stale = true;
    if (!near || waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      if (stale && host.isConnected) paint();
    });
  };
  new IntersectionObserver(
    entries => {
      near = entries[entries.length - 1].isIntersecting;
      if (near && stale) request();
    },
    { rootMargin: "300px" },
  ).observe(host);
  new ResizeObserver(request).observe(host);
  for (const name of ["appearance", "runs"]) document.addEventListener(name, request);
  addEventListener("beforeprint", () => {
    if (host.isConnected && host.closest(PRINTED)) draw(); // at once: the browser does not wait for a frame
  });
  return request;
}
