// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of plots for saving.

/** A picture for saving: title, legend of [name, colour], and what `paint` draws. */
function picture(title, canvas, legend, paint) {
  const ratio = 2,
    { size } = drawingFont(),
    { clientWidth: width, clientHeight: height } = canvas;
  const rows = [[]];
  const made = element("canvas"),
    context = made.getContext("2d");
  context.font = drawingFont().css;
  let used = 0;
  for (const entry of legend) {
    const wide = context.measureText(entry[0]).width + 4 * size;
    if (used + wide > width && rows[rows.length - 1].length) {
      rows.push([]);
      used = 0;
    }
    rows[rows.length - 1].push([...entry, used]);
    used += wide;
  }
  const head = 2.4 * size + 1.5 * size * rows.length;
  made.width = ratio * width;
  made.height = ratio * (height + head);
  context.scale(ratio, ratio);
  const colours = ink();
  context.fillStyle = colours.card;
  context.fillRect(0, 0, width, height + head);
  context.fillStyle = colours.text;
  context.textBaseline = "top";
  context.font = drawingFont("bold").css;
  context.fillText(title, 0.6 * size, 0.6 * size, width - size);
  context.font = drawingFont().css;
  rows.forEach((row, k) =>
    row.forEach(([name, colour, at]) => {
      context.fillStyle = colour;
      context.fillRect(0.6 * size + at, (2.75 + 1.5 * k) * size, 1.2 * size, 0.3 * size);
      context.fillStyle = colours.text;
      context.fillText(name, 2.3 * size + at, (2.35 + 1.5 * k) * size);
    }),
  );
  paint(context, { left: 0, top: head, width, height });
  return made;
}
