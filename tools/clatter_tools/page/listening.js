// SPDX-License-Identifier: GPL-3.0-or-later
// Sound of boundary elements: power beside ERP, pressure at microphones, to hear.

async function listeningSection() {
  if (!page.sound) return;
  const runs = page.sound,
    host = section(
      "sound",
      "Sound",
      "Radiated sound",
      `Sound power and pressure by boundary elements up to ${figure(Math.min(...runs.map(run => run.to_hz)), 4)} Hz; above, the power is the ERP.`,
    );
  for (const run of runs) {
    run.axis = await readBands(run.bands);
    [run.hz, run.watt, run.erpWatt, run.b, run.a, run.erpB, run.erpA] = await allNumbers(
      run.frequency,
      run.power,
      run.erp,
      run.power_bands,
      run.power_bands_dba,
      run.erp_bands,
      run.erp_bands_dba,
    );
    for (const one of run.microphones) [one.re, one.im, one.levels] = await allNumbers(...one.lines, one.bands);
  }
  const ticks = {
    label: "third-octave band [Hz]",
    log: true,
    name: "band",
    ticks: runs[0].axis.ticks,
    names: runs[0].axis.names,
  };
  const bands = new Plot({ title: "", x: ticks, y: { range: 70 }, lines: [] });
  const lines = new Plot({
    title: "Sound power of each line, dashed: ERP of the exposed faces",
    x: { label: "frequency [Hz]" },
    y: { label: "power [dB re 1 pW]", range: 90 },
    lines: runs.flatMap(run => [
      { run: run.run, name: runName(run.run), wide: 1, x: run.hz, y: decibel(run.watt, PICO_WATT) },
      { run: run.run, wide: 1, dash: [4, 3], x: run.hz, y: decibel(run.erpWatt, PICO_WATT) },
    ]),
  });
  const weight = weighted =>
    bands.update({
      title: `Sound power in third octaves, ${weighted ? "A-weighted" : "unweighted"}, dashed: ERP of the exposed faces`,
      y: { label: `power [${weighted ? "dB(A)" : "dB"} re 1 pW]`, range: 70 },
      lines: runs.flatMap(run => [
        {
          run: run.run,
          kind: "stairs",
          name: `${runName(run.run)}, ${(weighted ? run.dba : run.db).toFixed(1)} ${weighted ? "dB(A)" : "dB"}`,
          x: run.axis.edges,
          y: weighted ? run.a : run.b,
        },
        { run: run.run, kind: "stairs", dash: [4, 3], x: run.axis.edges, y: weighted ? run.erpA : run.erpB },
      ]),
    });
  weight(true);
  host.append(
    element(
      "div",
      { class: "controls" },
      choices(
        "weighting",
        [
          ["a", "A-weighted"],
          ["none", "unweighted"],
        ],
        "a",
        value => weight(value === "a"),
      ).element,
    ),
    grid(bands.element, lines.element),
  );
  if (runs.some(run => run.microphones.length)) host.append(...microphoneParts(runs, ticks));
}

/** Levels at a microphone, and its pressure to hear. */
function microphoneParts(runs, ticks) {
  const names = [...new Set(runs.flatMap(run => run.microphones.map(one => one.name)))],
    state = { name: names[0], run: 0 };
  const levels = new Plot({ title: "", x: ticks, y: { label: "sound pressure [dB re 20 µPa]", range: 80 }, lines: [] });
  const player = new Player();
  const at = run => run.microphones.find(one => one.name === state.name);
  const refresh = () => {
    levels.update({
      title: `Sound pressure in third octaves at microphone “${state.name}”`,
      lines: runs.filter(at).map(run => ({
        run: run.run,
        kind: "stairs",
        name: `${runName(run.run)}, ${at(run).dba.toFixed(1)} dB(A)`,
        x: run.axis.edges.subarray(0, at(run).levels.length + 1),
        y: at(run).levels,
      })),
    });
    const run = runs[state.run],
      one = at(run);
    if (!one || !run.duration) return player.refuse("There is no complete cycle of this microphone.");
    player.show({
      text: `Sound pressure at microphone “${state.name}”, ${runName(run.run)}.`,
      file: `pressure ${state.name} ${page.runs[run.run].stem}`,
      note: `One cycle (${figure(1e3 * run.duration)} ms), repeated for ${SOUND_SECONDS} s; lines from ${SOUND_FROM_HZ} Hz to ${figure(run.to_hz, 4)} Hz. All runs at the same gain.`,
      load: () => ({
        cycle: cycleSamples(run.hz, one.re, one.im, run.duration),
        duration: run.duration,
        full: Math.max(
          ...runs
            .filter(at)
            .map(other => largest(cycleSamples(other.hz, at(other).re, at(other).im, other.duration).samples)),
        ),
      }),
    });
  };
  refresh();
  return [
    element(
      "div",
      { class: "controls" },
      selection(
        "microphone",
        names.map(name => [name, name]),
        value => {
          state.name = value;
          refresh();
        },
      ).element,
      selection(
        "sound of",
        runs.map((run, k) => [k, runName(run.run)]),
        value => {
          state.run = Number(value);
          refresh();
        },
      ).element,
    ),
    grid(levels.element, player.element),
  ];
}
