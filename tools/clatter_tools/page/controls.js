// SPDX-License-Identifier: GPL-3.0-or-later
// The controls of the 3-D view.

function buildControls(surface) {
  surface.kindButtons = choices("what is shown", surface.kinds(), surface.kind, kind => surface.chooseKind(kind));
  const parts = selection(
    "part",
    surface.data.parts.map((part, k) => [k, part.name]),
    k => surface.choosePart(Number(k)),
  );
  parts.list.value = surface.data.parts.indexOf(surface.part);
  const runs = selection(
    "run",
    surface.part.runs.map((run, k) => [k, runName(run.run)]),
    async k => {
      await surface.chooseRun(Number(k));
      surface.chooseKind(surface.kind);
    },
  );
  if (surface.run) runs.list.value = surface.part.runs.findIndex(run => run.run === surface.run.run);
  surface.steps = element("div", { class: "controls" });
  surface.playButton = element("button", { type: "button", onclick: () => surface.play(!surface.playing) });
  const shown = selection(
    "colours",
    Object.entries(SHOWN).map(([key, [name]]) => [key, name]),
    key => {
      surface.shown = key;
      surface.draw();
    },
  );
  surface.controls.replaceChildren(
    element(
      "div",
      { class: "controls" },
      surface.kindButtons.element,
      surface.data.parts.length > 1 ? parts.element : null,
      surface.part.runs.length > 1 ? runs.element : null,
    ),
    surface.steps,
    element(
      "div",
      { class: "controls" },
      surface.playButton,
      slider("speed", { min: -3, max: 3, step: 0.1, value: Math.log2(surface.speed) }, value => {
        surface.speed = 2 ** value;
      }).element,
      slider("enlargement", { min: -3, max: 4, step: 0.1, value: Math.log2(surface.enlargement) }, value => {
        surface.enlargement = 2 ** value;
        surface.draw();
      }).element,
      slider("contrast", { min: 0, max: 5, step: 0.1, value: Math.log2(surface.contrast) }, value => {
        surface.contrast = 2 ** value;
        surface.draw();
      }).element,
    ),
    element(
      "div",
      { class: "controls" },
      shown.element,
      checkbox("rigid motion", surface.withRigid, on => {
        surface.withRigid = on;
        surface.update();
      }).element,
      checkbox("outline at rest", surface.outline, on => {
        surface.outline = on;
        surface.draw();
      }).element,
      checkbox("edges", surface.edges, on => {
        surface.edges = on;
        surface.draw();
      }).element,
      element(
        "span",
        { class: "choices", role: "group", "aria-label": "direction of view" },
        Object.keys(VIEWS).map(name =>
          element("button", { type: "button", onclick: () => surface.view.turnTo(name) }, name),
        ),
      ),
    ),
    element(
      "p",
      { class: "note" },
      "Drag turns, shift and drag moves, two fingers or the wheel magnify (the wheel after a click into the picture). ",
      surface.run?.re ? "A click chooses a point and shows its spectrum. " : "",
      "Shape and colours are velocities; outward is positive.",
    ),
  );
  surface.play(surface.playing);
}

function buildSteps(surface) {
  const [count, name] = surface.range();
  surface.steps.replaceChildren();
  if (!count) return;
  const label = { line: "frequency", instant: "crank angle", mode: "mode" }[surface.kind];
  const made = slider(
    label,
    { min: 0, max: count - 1, value: surface[name] },
    value => {
      if (surface.kind === "instant") surface.play(false);
      surface[name] = value;
      surface.update();
    },
    { id: "skin-step" },
  );
  surface.stepInput = made.input;
  surface.steps.append(
    element("button", { type: "button", "aria-label": "previous", onclick: () => surface.step(-1) }, "‹"),
    made.element,
    element("button", { type: "button", "aria-label": "next", onclick: () => surface.step(1) }, "›"),
  );
  if (surface.kind === "line" && surface.run.strongest.length)
    surface.steps.append(
      element(
        "span",
        { class: "choices", role: "group", "aria-label": "strongest lines" },
        surface.run.strongest.map(hz =>
          element(
            "button",
            {
              type: "button",
              title: "one of the strongest lines",
              onclick: () => surface.goTo("line", nearestIndex(surface.run.frequency, hz)),
            },
            `${hz.toFixed(0)} Hz`,
          ),
        ),
      ),
    );
  if (surface.kind === "instant")
    surface.steps.append(
      checkbox("one scale for the cycle", surface.common, on => {
        surface.common = on;
        surface.update();
      }).element,
    );
}
