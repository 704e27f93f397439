// SPDX-License-Identifier: GPL-3.0-or-later
// Runs: each has its colour in all plots, and is shown or hidden in all of them at once.

const shownRuns = new Set(page.runs.map((_, run) => run));

/** Of a run, or of the k-th line of a plot; on dark ground lighter. */
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

/** What the names of all runs begin with is said once, in the title. */
const commonWords = (() => {
  const names = page.runs.map(run => run.label.split(", "));
  let count = 0;
  while (names.length > 1 && names.every(words => words.length > count + 1 && words[count] === names[0][count]))
    ++count;
  return count;
})();

function runName(number) {
  return page.runs[number].label.split(", ").slice(commonWords).join(", ");
}

function runChips() {
  const chips = page.runs.map((run, number) => {
    const chip = element(
      "button",
      {
        type: "button",
        class: "chip",
        "aria-pressed": "true",
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
  const paint = () => chips.forEach((chip, number) => chip.style.setProperty("--colour", colourOf(number)));
  paint();
  document.addEventListener("appearance", paint);
  return element("div", { class: "chips", role: "group", "aria-label": "runs", hidden: chips.length < 2 }, chips);
}
