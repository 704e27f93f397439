// SPDX-License-Identifier: GPL-3.0-or-later
// Maps of the oil film over the pads of the skirt, instant by instant.

const FILM_STEP_MS = 90;

async function filmSection() {
  if (!page.film) return;
  const host = section(
    "film",
    "Film",
    "Oil film and contact",
    "What stands between skirt and liner, on each pad of the piston: a slider moves through the cycle.",
  );
  const { contacts, quantities } = page.film;
  const state = { contact: 0, quantity: quantities[0], instant: 0, timer: 0, common: true };
  const pads = [0, 1].map(
    () =>
      new Heat({
        title: "",
        x: { edges: [0, 1], label: "" },
        y: { edges: [0, 1], label: "" },
        z: { label: "", colours: "viridis" },
        cells: new Float32Array(1),
      }),
  );
  const over = new Plot({
    title: "Largest and mean over the cycle",
    x: { label: `crank angle [deg], 0 = ${page.zero}`, angles: true },
    y: {},
    lines: [],
    pick: angle => go(nearestIndex(state.angle, angle)),
  });
  const caption = element("strong", { "aria-live": "off" });
  const own = () => contacts[state.contact];
  const draw = () => {
    const { quantity, instant } = state;
    caption.textContent = `${state.angle[instant].toFixed(0)}° crank angle`;
    pads.forEach((heat, k) => {
      const pad = own().pads[k],
        values = state.values[k];
      heat.element.hidden = !values;
      if (!values) return;
      const [columns, rows] = [pad.angle.length, pad.axial.length],
        cells = new Float32Array(columns * rows),
        from = instant * columns * rows;
      for (let i = 0; i < columns; ++i)
        for (let j = 0; j < rows; ++j) cells[j * columns + i] = values[from + i * rows + j];
      heat.update({
        title: `${capital(quantity.name)}, ${words(pad.name)} side, at ${state.angle[instant].toFixed(0)}°: ${contactName(own())}`,
        cells,
        x: { label: "angle about the piston's axis [deg]", edges: edgesAround(pad.angle) },
        y: { label: "along the skirt, from the pin [mm]", edges: edgesAround(pad.axial) },
        z: {
          label: `${words(quantity.key)} [${quantity.unit}]`,
          unit: quantity.unit,
          colours: quantity.colours,
          ...(state.common ? state.range : { min: undefined, max: undefined }),
        },
      });
    });
    over.update({ marks: [0, state.angle[instant]] });
    move.input.value = instant;
  };
  const load = async () => {
    const present = quantities.filter(({ key }) => own().pads.some(pad => pad.maps[key]));
    if (!present.includes(state.quantity)) state.quantity = present[0];
    kinds.set(state.quantity.key);
    const { quantity } = state;
    state.angle = await numbers(own().angle);
    state.values = await Promise.all(own().pads.map(pad => numbers(pad.maps[quantity.key])));
    state.range = {
      min: 0,
      max: quantity.key === "fill" ? 1 : Math.max(...state.values.filter(Boolean).map(highest), 1e-6),
    };
    state.instant = Math.min(state.instant, state.angle.length - 1);
    move.input.max = state.angle.length - 1;
    over.update({
      title: `${capital(quantity.name)} of each pad over the cycle`,
      y: { label: `${words(quantity.key)} [${quantity.unit}]`, min: 0 },
      lines: own().pads.flatMap((pad, k) =>
        state.values[k] ? padLines(pad, state.values[k], state.angle, quantity, k) : [],
      ),
    });
    const absent = quantities.filter(one => !present.includes(one));
    missing.textContent = absent.length
      ? `This contact is dry: it has no ${absent.map(one => one.name).join(" and no ")}.`
      : "";
    draw();
  };
  const go = instant => {
    state.instant = (instant + state.angle.length) % state.angle.length;
    draw();
  };
  const play = on => {
    clearInterval(state.timer);
    state.timer = on ? setInterval(() => go(state.instant + 1), FILM_STEP_MS) : 0;
    button.textContent = on ? "❚❚ pause" : "▶ play";
  };
  const button = element("button", { type: "button", onclick: () => play(!state.timer) }, "▶ play");
  const move = slider(
    "crank angle",
    { min: 0, max: 1 },
    value => {
      play(false);
      go(value);
    },
    { id: "film-step" },
  );
  const kinds = choices(
    "quantity",
    quantities.map(quantity => [quantity.key, quantity.name]),
    quantities[0].key,
    key => {
      state.quantity = quantities.find(one => one.key === key);
      load();
    },
  );
  const missing = element("p", { class: "note" });
  const contactList = selection(
    "run",
    contacts.map((one, k) => [k, contactName(one)]),
    value => {
      state.contact = Number(value);
      load();
    },
  );
  host.append(
    element("div", { class: "controls" }, contactList.element, kinds.element),
    element(
      "div",
      { class: "controls" },
      button,
      move.element,
      caption,
      checkbox("one scale for the cycle", true, on => {
        state.common = on;
        draw();
      }).element,
    ),
    missing,
    element(
      "div",
      { class: "grid thirds" },
      pads.map(pad => pad.element),
      over.element,
    ),
  );
  state.instant = await nearFiring(own());
  await load();
}

function contactName({ run, cylinder }) {
  return cylinder ? `${runName(run)}, ${cylinder}` : runName(run);
}

/** Index of the instant 10 deg after firing TDC, where the slap is over and the film carries. */
async function nearFiring(contact) {
  return nearestIndex(await numbers(contact.angle), 10);
}

function highest(values) {
  let most = 0;
  for (const value of values) most = Math.max(most, value);
  return most;
}

/** Of a pad the largest value (of a gap the smallest) and the mean at each instant. */
function padLines(pad, values, angle, quantity, k) {
  const count = values.length / angle.length,
    extreme = new Float32Array(angle.length),
    mean = new Float32Array(angle.length),
    least = quantity.key === "gap" || quantity.key === "fill";
  for (let at = 0; at < angle.length; ++at) {
    extreme[at] = least ? Infinity : 0;
    for (let i = at * count; i < (at + 1) * count; ++i) {
      extreme[at] = least ? Math.min(extreme[at], values[i]) : Math.max(extreme[at], values[i]);
      mean[at] += values[i] / count;
    }
  }
  return [
    { name: `${words(pad.name)} side, ${least ? "smallest" : "largest"}`, number: k, x: angle, y: extreme },
    { name: `${words(pad.name)} side, mean`, number: k, x: angle, y: mean, dash: [5, 3] },
  ];
}
