// SPDX-License-Identifier: GPL-3.0-or-later
// Reduced against full models, mode by mode.

async function modelsSection() {
  if (!page.models) return;
  const host = section(
    "models",
    "Models",
    "Reduced against full models",
    "Free modes of the reduced part beside those of its full finite element model.",
  );
  for (const { name, rows, conclusion, mac: matrix } of page.models) {
    const [number, full, , error, mac] = [0, 1, 2, 3, 4].map(k => Float32Array.from(rows, row => row[k]));
    host.append(
      element(
        "div",
        { class: "card" },
        element("h3", {}, name),
        element("p", { class: "note" }, conclusion),
        grid(
          new Plot({
            title: `${name}: error of each natural frequency`,
            height: 13,
            x: { label: "natural frequency [Hz]" },
            y: { label: "error [%]" },
            lines: [{ kind: "points", number: 0, x: full, y: error }],
          }).element,
          new Plot({
            title: `${name}: MAC of each pair of modes`,
            height: 13,
            x: { label: "natural frequency [Hz]" },
            y: { label: "1 − MAC [1e−6]" },
            lines: [{ kind: "points", number: 1, x: full, y: mac.map(one => 1e6 * (1 - one)) }],
          }).element,
          matrix ? await macMatrix(name, matrix) : null,
        ),
        element(
          "details",
          {},
          element("summary", {}, "all modes"),
          table(
            ["mode", "full [Hz]", "reduced [Hz]", "error [%]", "MAC"],
            rows.map((row, k) => [number[k], ...row.slice(1)]),
          ),
        ),
      ),
    );
  }
}

/** MAC of each mode of the full model with each of the reduced one. */
async function macMatrix(name, { rows, columns, values }) {
  const [cells] = await allNumbers(values);
  const axis = (label, hz) => ({
    label,
    edges: evenEdges(0.5, 1, hz.length),
    ticks: hz.map((_, k) => [k + 1, `${k + 1}`]),
    names: hz.map((one, k) => `${k + 1} (${figure(one, 5)} Hz)`),
  });
  return new Heat({
    title: `${name}: MAC of all pairs of modes`,
    height: 26,
    x: axis("elastic mode of the reduced model", columns),
    y: axis("elastic mode of the full model", rows),
    z: { label: "MAC", colours: "viridis", min: 0, max: 1 },
    cells,
  }).element;
}
