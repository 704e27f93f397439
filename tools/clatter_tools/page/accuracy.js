// SPDX-License-Identifier: GPL-3.0-or-later
// What accuracy costs: studies of settings, effects, proved proposals.

function accuracySection() {
  if (!page.accuracy) return;
  const host = section(
    "accuracy",
    "Accuracy",
    "What accuracy costs",
    "By clatter study: the error of each result along each setting, what a smaller one costs, and what each effect changes.",
  );
  for (const one of page.accuracy) {
    if (one.quantities.length) host.append(studyCard(one));
    if (one.effects) host.append(rowsCard(`${one.name}: effects`, one.effects));
    if (one.proofs) host.append(rowsCard(`${one.name}: settings for an error, and their proof`, one.proofs));
  }
}

function rowsCard(title, [head, ...rows]) {
  return tableCard(
    title,
    head,
    rows,
    head.map((_, k) => k),
  );
}

/** A study: buttons for its quantities; of the chosen one its diagram, the base, the budget, and a sentence for each setting. */
function studyCard({ name, quantities }) {
  const shown = element("div", {});
  const show = number => {
    const { name: what, sentences, picture } = quantities[number];
    const drawn = picture && element("img", { src: `data:image/png;base64,${picture}`, alt: `Errors, seconds and budget: ${what}` });
    shown.replaceChildren(...[drawn, wordList(sentences)].filter(Boolean));
  };
  const chosen = choices(
    "quantity",
    quantities.map((own, k) => [k, own.name]),
    0,
    show,
  );
  show(0);
  return card(name, element("div", { class: "controls" }, chosen.element), shown);
}
