// SPDX-License-Identifier: GPL-3.0-or-later
// Chain drives: the animation, and tension around the loop.

async function driveSection() {
  if (!page.drive) return;
  const host = section(
    "drive",
    "Chain",
    "Chain drive",
    "One engine cycle of the drive, links in the colour of their tension.",
  );
  if (page.drive.left_out)
    host.append(
      element(
        "p",
        { class: "note" },
        `Of many runs the slowest, that with the largest tension, and the fastest; ${page.drive.left_out} are left out.`,
      ),
    );
  for (const { run, name, page: film, loop, first } of page.drive.chains) {
    const frame = element("iframe", { title: `animation of ${name}`, loading: "lazy", sandbox: "allow-scripts" });
    const show = whenVisible(frame, () => {
      if (!frame.srcdoc) frame.srcdoc = film;
    });
    show();
    const [at, low, mean, high] = await allNumbers(loop.at, loop.low, loop.mean, loop.high);
    const plot = new Plot({
      title: `Tension along ${name}: ${page.runs[run].label}`,
      x: { label: `place along the loop in running direction, from ${first} [mm]` },
      y: { label: "tension of a joint [N]" },
      marks: loop.zones.flatMap(([, begin, end]) => [begin, end]),
      lines: [
        { name: "lowest to highest of the cycle", kind: "area", number: 5, x: at, y: high, low },
        { name: "mean of the cycle", number: 0, x: at, y: mean },
      ],
      note: `On parts between the thin lines: ${loop.zones.map(([part, begin, end]) => `${part} ${begin.toFixed(0)} to ${end.toFixed(0)} mm`).join(", ")}.`,
    });
    host.append(card(`${name}: ${page.runs[run].label}`, frame), grid(plot.element));
  }
}
