// SPDX-License-Identifier: GPL-3.0-or-later
// Reduced against full models, mode by mode.

function modelsSection() {
  if (!page.models) return;
  const host = section(
    "models",
    "Models",
    "Reduced against full models",
    "Free modes of the reduced part beside those of its full finite element model.",
  );
  for (const { name, rows, conclusion } of page.models) {
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
