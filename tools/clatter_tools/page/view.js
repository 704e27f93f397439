// SPDX-License-Identifier: GPL-3.0-or-later
// A canvas with a skin that is turned, moved and magnified by pointer, fingers and keys.

const CLICK_PIXELS = 4; // less is no drag
const TURN = 0.008; // rad per pixel
const VIEWS = { "three-quarter": [40, 25], "along x": [0, 0], "along y": [90, 0], "from above": [0, 89.9] };

class View {
  /** `paint` is called to draw, `choose` with the pixel that is clicked; `keys` maps further keys to functions. */
  constructor(canvas, paint, choose, keys) {
    this.canvas = canvas;
    this.choose = choose;
    this.redraw = whenVisible(canvas, paint);
    this.fingers = new Map();
    this.turnTo("three-quarter");
    this.listen(keys);
  }

  turnTo(name) {
    [this.azimuth, this.elevation] = VIEWS[name].map(angle => (angle * Math.PI) / 180);
    this.zoom = 1;
    this.middle = [0, 0];
    this.redraw();
  }

  turn(right, up) {
    this.azimuth -= right;
    this.elevation = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, this.elevation + up));
    this.redraw();
  }

  magnify(factor) {
    this.zoom = Math.min(40, Math.max(0.3, this.zoom * factor));
    this.redraw();
  }

  /** Matrices that show a box from low to high, beside a strip of so many pixels on the right. */
  matrices(low, high, reserved) {
    const centre = low.map((one, k) => 0.5 * (one + high[k])),
      radius = 0.5 * Math.hypot(...low.map((one, k) => high[k] - one));
    const { clientWidth: width, clientHeight: height } = this.canvas,
      free = Math.max(1, Math.min(width - reserved, height));
    this.metresPerPixel = (2 * 0.93 * radius) / (this.zoom * free);
    const [wide, tall] = [0.5 * width * this.metresPerPixel, 0.5 * height * this.metresPerPixel];
    // The middle moves aside only where there is no space beside the part anyway.
    const aside = 0.5 * Math.max(0, Math.min(reserved, reserved - (width - free - reserved)));
    return {
      view: viewMatrix(this.azimuth, this.elevation, centre),
      projection: parallelMatrix(wide, tall, 4 * radius, [
        this.middle[0] + aside * this.metresPerPixel,
        this.middle[1],
      ]),
    };
  }

  listen(keys) {
    const { canvas, fingers } = this;
    canvas.addEventListener("pointerdown", event => {
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, [event.clientX, event.clientY]);
      this.moved = false;
    });
    canvas.addEventListener("pointerup", event => {
      if (!this.moved && fingers.size === 1) this.choose(event.offsetX, event.offsetY);
    });
    for (const name of ["pointerup", "pointercancel"])
      canvas.addEventListener(name, event => fingers.delete(event.pointerId));
    canvas.addEventListener("pointermove", event => this.pointer(event));
    canvas.addEventListener(
      "wheel",
      event => {
        if (document.activeElement !== canvas) return; // the page scrolls until the view is chosen
        event.preventDefault();
        this.magnify(Math.exp(-0.0015 * event.deltaY));
      },
      { passive: false },
    );
    canvas.addEventListener("dblclick", () => this.turnTo("three-quarter"));
    const own = {
      ArrowLeft: () => this.turn(-0.1, 0),
      ArrowRight: () => this.turn(0.1, 0),
      ArrowUp: () => this.turn(0, 0.1),
      ArrowDown: () => this.turn(0, -0.1),
      "+": () => this.magnify(1.2),
      "-": () => this.magnify(1 / 1.2),
      Home: () => this.turnTo("three-quarter"),
      ...keys,
    };
    canvas.addEventListener("keydown", event => {
      if (own[event.key]) {
        own[event.key]();
        event.preventDefault();
      }
    });
  }

  pointer(event) {
    const before = this.fingers.get(event.pointerId);
    if (!before) return;
    const [dx, dy] = [event.clientX - before[0], event.clientY - before[1]];
    if (!this.moved && Math.hypot(dx, dy) < CLICK_PIXELS) return;
    this.moved = true;
    if (this.fingers.size === 2) {
      const [other] = [...this.fingers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
      const length = at => Math.hypot(at[0] - other[0], at[1] - other[1]);
      this.magnify(length([event.clientX, event.clientY]) / Math.max(1, length(before)));
      this.shift(0.5 * dx, 0.5 * dy);
    } else if (event.shiftKey || event.buttons === 2 || event.buttons === 4) this.shift(dx, dy);
    else this.turn(TURN * dx, TURN * dy);
    this.fingers.set(event.pointerId, [event.clientX, event.clientY]);
  }

  shift(dx, dy) {
    this.middle = [this.middle[0] - dx * this.metresPerPixel, this.middle[1] + dy * this.metresPerPixel];
    this.redraw();
  }
}

/** A colour bar beside a view, as high as its canvas. */
function paintBar(canvas, { colours, range, label }) {
  const context = canvas.getContext("2d"),
    { width, height } = fitCanvas(canvas, context),
    { size, css } = drawingFont(),
    tone = ink();
  context.clearRect(0, 0, width, height);
  if (!colours) return;
  barInto(context, { left: 0, top: 0, width, height }, { colours, range, label }, { size, css, tone });
}

function barInto(context, { left, top, width, height }, { colours, range, label }, { size, css, tone }) {
  const begin = top + 0.75 * height,
    end = top + 0.12 * height,
    steps = 64,
    colour = colourMap(colours),
    scale = axisScale({ min: range[0], max: range[1] }, begin, end);
  context.font = css;
  for (let k = 0; k < steps; ++k) {
    context.fillStyle = cssColour(colour((k + 0.5) / steps));
    context.fillRect(
      left + width - 4.6 * size,
      begin + ((end - begin) * (k + 1)) / steps,
      0.8 * size,
      (begin - end) / steps + 0.7,
    );
  }
  context.fillStyle = tone.quiet;
  context.textAlign = "left";
  context.textBaseline = "middle";
  const ticks = linearTicks(...range, 6);
  for (const tick of ticks)
    context.fillText(tickText(tick, ticks[1] - ticks[0]), left + width - 3.5 * size, scale.to(tick));
  context.fillStyle = tone.text;
  context.save();
  context.translate(left + width - 5 * size, 0.5 * (begin + end));
  context.rotate(-Math.PI / 2);
  context.textAlign = "center";
  context.textBaseline = "bottom";
  context.fillText(label, 0, 0);
  context.restore();
}
