// SPDX-License-Identifier: GPL-3.0-or-later
// Sensors: time, spectrum, third octaves, spectrogram, sound.

async function sensorsSection() {
  if (!page.sensors) return;
  const host = section("sensors", "Sensors", "Sensors", "Motion at the sensors of the part over one cycle.");
  const { runs } = page.sensors;
  for (const run of runs) {
    [run.t, run.deg, run.hz] = await allNumbers(run.time, run.angle, run.frequency);
    run.axis = await readBands(run.bands);
  }
  const labels = [...new Set(runs.flatMap(run => run.channels.map(channel => channel.label)))];
  const state = {
    label: runs[0].channels.find(channel => channel.thrust)?.label ?? labels[0],
    quantity: "acceleration",
    over: "angle",
    run: 0,
    limited: false,
  };
  const channelOf = run => run.channels.find(channel => channel.label === state.label);
  const signal = new Plot({ title: "Signal", x: {}, y: {}, lines: [] });
  const spectrum = new Plot({
    title: "Spectrum",
    x: { label: "frequency [Hz]" },
    y: { log: true, range: 1e5 },
    lines: [],
  });
  const bands = new Plot({
    title: "Third octaves",
    x: { label: "third-octave band [Hz]", log: true, name: "band" },
    y: { range: 80 },
    lines: [],
  });
  const map = new Heat({
    title: "Spectrogram",
    x: { edges: [0, 1], label: "" },
    y: { edges: [0, 1], label: "" },
    z: { label: "", colours: "viridis" },
    cells: new Float32Array(1),
  });
  const player = new Player();
  const turning = runs.every(run => run.deg);
  let angled = turning;
  const refresh = async () => {
    const { quantity } = state,
      drawn = [],
      span = runs.every(run => run.cycle) ? "over the cycle" : "over time";
    angled = state.over === "angle" && turning;
    for (const run of runs) {
      const data = channelOf(run)?.[quantity];
      if (!data) continue;
      const [whole, re, im, levels] = await allNumbers(data.signal, data.lines?.[0], data.lines?.[1], data.bands);
      const values = state.limited && re && run.cycle ? limited(run, re, im) : whole;
      drawn.push({ run, data, values, levels, size: re && re.map((one, k) => Math.hypot(one, im[k])) });
    }
    const unit = drawn[0]?.data.unit ?? "";
    signal.update({
      title: `${capital(quantity)} of ${state.label} ${span}${state.limited ? `, above ${page.sensors.from_hz} Hz` : ""}`,
      x: angled
        ? { label: `crank angle [deg], 0 = ${page.zero}`, angles: true }
        : { label: turning ? `time after ${page.zero} [ms]` : "time [ms]" },
      y: { label: `${quantity} [${unit}]` },
      marks: turning ? [0] : [],
      lines: drawn.map(({ run, values }) => ({
        run: run.run,
        name: runName(run.run),
        wide: 1,
        x: angled ? run.deg : Float32Array.from(run.t, one => 1e3 * one),
        y: values,
      })),
    });
    spectrum.update({
      title: `Spectrum of the ${quantity} of ${state.label}`,
      y: { label: `amplitude of each line [${unit}], peak`, log: true, range: 1e5 },
      lines: drawn.map(({ run, size }) => ({
        run: run.run,
        name: runName(run.run),
        wide: 1,
        x: run.hz,
        y: size ?? [],
      })),
    });
    bands.update({
      title: `Third octaves of the ${quantity} of ${state.label}`,
      x: { ...bands.spec.x, ticks: runs[0].axis.ticks, names: runs[0].axis.names },
      y: { label: `level [dB re ${drawn[0]?.data.reference}]`, range: 80 },
      lines: drawn.map(({ run, levels }) => ({
        run: run.run,
        name: runName(run.run),
        kind: "stairs",
        x: run.axis.edges,
        y: levels ?? [],
      })),
    });
    await refreshMap(map, runs[state.run], channelOf(runs[state.run]), state.label);
    refreshPlayer(player, runs[state.run], channelOf(runs[state.run]), state);
  };
  const list = selection(
    "channel",
    labels.map(label => [label, label]),
    value => {
      state.label = value;
      refresh();
    },
  );
  list.list.value = state.label;
  const runList = selection(
    "spectrogram and sound of",
    runs.map((run, k) => [k, runName(run.run)]),
    value => {
      state.run = Number(value);
      refresh();
    },
  );
  const firing = checkbox(`only around ${page.zero}`, false, on => signal.show(on ? aroundFiring(runs[0], state) : null));
  host.append(
    element(
      "div",
      { class: "controls" },
      list.element,
      runs.length > 1 ? runList.element : null,
      choices(
        "quantity",
        [
          ["acceleration", "acceleration"],
          ["velocity", "velocity"],
        ],
        state.quantity,
        value => {
          state.quantity = value;
          refresh();
        },
      ).element,
      !turning
        ? null
        : choices(
            "axis",
            [
              ["angle", "over crank angle"],
              ["time", "over time"],
            ],
            state.over,
            value => {
              state.over = value;
              refresh();
              signal.show(firing.input.checked ? aroundFiring(runs[0], state) : null);
            },
          ).element,
      turning ? firing.element : null,
      !runs.every(run => run.cycle)
        ? null
        : checkbox(`above ${page.sensors.from_hz} Hz`, false, on => {
            state.limited = on;
            refresh();
          }).element,
    ),
    grid(signal.element, spectrum.element, bands.element, map.element, player.element),
  );
  await refresh();
}

/** A window of the signal's axis in which the slap and its ringing are. */
function aroundFiring(run, { over }) {
  const [from, to] = [-0.5, 5]; // ms
  const degrees = run.deg ? (run.deg[1] - run.deg[0]) / (1e3 * (run.t[1] - run.t[0])) : 1;
  return over === "angle" && run.deg ? { min: from * degrees, max: to * degrees } : { min: from, max: to };
}

/** The part of a periodic signal above page.sensors.from_hz, as a sum of its lines. */
function limited(run, re, im) {
  const found = new Float32Array(run.t.length),
    begin = run.t[0],
    step = (run.t.at(-1) - begin) / (run.t.length - 1);
  for (let line = 0; line < run.hz.length; ++line) {
    if (run.hz[line] < page.sensors.from_hz) continue;
    const turn = 2 * Math.PI * run.hz[line],
      [c, s] = [Math.cos(turn * step), Math.sin(turn * step)],
      [c0, s0] = [Math.cos(turn * begin), Math.sin(turn * begin)];
    let [a, b] = [re[line] * c0 - im[line] * s0, re[line] * s0 + im[line] * c0];
    for (let k = 0; k < found.length; ++k) {
      found[k] += a;
      [a, b] = [a * c - b * s, a * s + b * c];
    }
  }
  return found;
}

function capital(text) {
  return text[0].toUpperCase() + text.slice(1);
}

async function refreshMap(map, run, channel, label) {
  map.element.hidden = !channel?.spectrogram;
  if (!channel?.spectrogram) return;
  const { levels, columns, rows, frequency_step: step, window_ms: window } = channel.spectrogram,
    cells = await numbers(levels);
  const turned = new Float32Array(cells.length);
  for (let i = 0; i < columns; ++i) for (let j = 0; j < rows; ++j) turned[j * columns + i] = cells[i * rows + j];
  const axis = run.deg ?? run.t,
    first = axis[0],
    span = ((axis.at(-1) - first) * axis.length) / (axis.length - 1),
    factor = run.deg ? 1 : 1e3;
  map.update({
    title: `Spectrogram of the acceleration of ${label}: ${runName(run.run)}`,
    x: {
      label: run.deg ? `crank angle [deg], 0 = ${page.zero}` : "time [ms]",
      angles: Boolean(run.deg),
      edges: evenEdges(factor * first, (factor * span) / columns, columns),
    },
    y: { label: "frequency [Hz]", edges: evenEdges(-0.5 * step, step, rows) },
    z: { label: "level [dB re 1e−6 m/s², RMS]", unit: "dB", colours: "viridis" },
    cells: turned,
    hint: `Hann windows of ${figure(window)} ms`,
  });
}

function refreshPlayer(player, run, channel, { label, quantity }) {
  const data = channel?.[quantity];
  if (!run.cycle || !data?.lines) {
    player.refuse("This channel has no spectrum over a complete cycle.");
    return;
  }
  player.show({
    text: `${capital(quantity)} of ${label}, ${runName(run.run)}.`,
    note:
      `The ${quantity} of one point of the surface, one cycle (${figure(1e3 * run.duration)} ms), repeated for ` +
      `${SOUND_SECONDS} s; it is not the sound at a listener's ear. Lines from ${SOUND_FROM_HZ} Hz to ` +
      `${figure(run.hz.at(-1), 4)} Hz. All runs at the same gain, so that they may be compared.`,
    file: `${quantity} ${label} ${page.runs[run.run].stem}`,
    load: async () => {
      const [re, im] = await allNumbers(...data.lines);
      return {
        cycle: cycleSamples(run.hz, re, im, run.duration),
        duration: run.duration,
        full: await loudest(label, quantity),
      };
    },
  });
}

/** The largest sample of a channel among all runs, which is full scale. */
async function loudest(label, quantity) {
  let most = 0;
  for (const run of page.sensors.runs) {
    const data = run.channels.find(channel => channel.label === label)?.[quantity];
    if (!data?.lines) continue;
    const [re, im] = await allNumbers(...data.lines);
    most = Math.max(most, largest(cycleSamples(run.hz, re, im, run.duration).samples));
  }
  return most;
}
