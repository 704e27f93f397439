// SPDX-License-Identifier: GPL-3.0-or-later
// Runs: each has its colour in all plots, and is shown or hidden in all of them at once.

const FIRST_SHOWN = 5; // of many runs

const shownRuns = new Set(
  page.many
    ? Array.from({ length: FIRST_SHOWN }, (_, k) => Math.round((k * (page.runs.length - 1)) / (FIRST_SHOWN - 1)))
    : page.runs.keys(),
);

/** The colour of a run; of many runs it is their place in the list. */
function runColour(run) {
  if (!page.many) return colourOf(run);
  const share = run / (page.runs.length - 1);
  return cssColour(colourMap("viridis")(dark() ? 0.2 + 0.8 * share : 0.9 * share));
}

/** Of the k-th line of a plot; on dark ground lighter. */
function colourOf(number) {
  const colour = page.run_colours[number % page.run_colours.length];
  if (!dark()) return colour;
  return (
    "#" +
    rgb(colour)
      .map(part =>
        Math.round(255 * (part + 0.35 * (1 - part) + (colour === "#000000" ? 0.5 : 0)))
          .toString(16)
          .padStart(2, "0"),
      )
      .join("")
  );
}

/** The words that the names of all runs have in common, which are said once, in the title. */
const commonWords = (() => {
  const [first, ...others] = page.runs.map(run => run.label.split(", "));
  return others.length ? first.filter(word => others.every(words => words.includes(word))) : [];
})();

/** A run's name without these words. */
function runName(number) {
  const { label, stem } = page.runs[number];
  if (page.many) return stem.replaceAll("_", " ");
  return (
    label
      .split(", ")
      .filter(word => !commonWords.includes(word))
      .join(", ") || (page.runs.length > 1 ? stem : label)
  );
}

function runChips() {
  const chips = page.runs.map((run, number) => {
    const chip = element(
      "button",
      {
        type: "button",
        class: "chip",
        "aria-pressed": String(shownRuns.has(number)),
        title: `${run.label} (${run.stem}): show or hide`,
        onclick: () => {
          if (shownRuns.has(number)) shownRuns.delete(number);
          else shownRuns.add(number);
          chip.setAttribute("aria-pressed", shownRuns.has(number));
          document.dispatchEvent(new Event("runs"));
        },
      },
      element("i"),
      runName(number),
    );
    return chip;
  });
  const paint = () => chips.forEach((chip, number) => chip.style.setProperty("--colour", runColour(number)));
  paint();
  document.addEventListener("appearance", paint);
  return element("div", { class: "chips", role: "group", "aria-label": "runs", hidden: chips.length < 2 }, chips);
}
