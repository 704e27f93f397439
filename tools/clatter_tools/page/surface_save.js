// SPDX-License-Identifier: GPL-3.0-or-later
// What the 3-D view shows, as a picture and as numbers.

function surfacePicture(surface) {
  const made = element("canvas"),
    { size, css } = drawingFont(),
    scene = surface.scene(),
    ratio = surface.canvas.width / surface.canvas.clientWidth,
    head = 3.4 * size;
  surface.renderer.draw(scene);
  const [width, height] = [surface.canvas.clientWidth, surface.canvas.clientHeight];
  made.width = surface.canvas.width;
  made.height = surface.canvas.height + head * ratio;
  const context = made.getContext("2d");
  context.fillStyle = scene.ink.card;
  context.fillRect(0, 0, made.width, made.height);
  context.drawImage(surface.canvas, 0, head * ratio);
  context.scale(ratio, ratio);
  context.font = drawingFont("bold").css;
  context.fillStyle = scene.ink.text;
  context.fillText(surface.caption.firstChild.textContent, size, 1.3 * size);
  context.font = css;
  context.fillText(surface.caption.lastChild.textContent, size, 2.7 * size);
  if (scene.bar.colours)
    barInto(context, { left: 0, top: head, width, height }, scene.bar, { size, css, tone: scene.ink });
  return made;
}

function surfaceColumns(surface) {
  const axis = (values, k) => Array.from({ length: values.length / 3 }, (_, node) => values[3 * node + k]);
  const named = (name, values) =>
    ["x", "y", "z"].map((letter, k) => ({ name: name.replace("*", letter), values: axis(values, k) }));
  const unit = surface.kind === "mode" ? "" : " [m/s]";
  return [
    ...named("* [m]", surface.skin.points),
    ...named(`velocity *${surface.im ? ", real" : ""}${unit}`, surface.re),
    ...(surface.im ? named(`velocity *, imaginary${unit}`, surface.im) : []),
  ];
}
