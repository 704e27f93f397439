// SPDX-License-Identifier: GPL-3.0-or-later
// Summary: the figures that a reader wants first, in sentences and tables.

function summarySection() {
  const { sentences, tables, checks, worries, stale } = page.summary;
  const host = section("summary", "Summary", "Summary");
  const keys = element("div", { class: "keys" });
  for (const run of page.many ? [] : (page.radiation?.runs ?? [])) {
    const panel = run.panels.find(one => one.name === "exposed") ?? run.panels.find(one => one.name === "skin");
    if (!panel) continue;
    const box = element(
      "div",
      {},
      element("b", {}, levelText(panel.measures.erp, panel.mean)),
      element("span", {}, `${runName(run.run)}: equivalent radiated power, ${panel.label}, re 1 pW${cyclesText(panel.mean)}`),
    );
    const paint = () => box.style.setProperty("--colour", runColour(run.run));
    paint();
    document.addEventListener("appearance", paint);
    keys.append(box);
  }
  for (const run of page.many ? [] : (page.sound ?? [])) {
    const found = `${runName(run.run)}: sound power by boundary elements, re 1 pW${cyclesText(run.mean)}`;
    keys.append(element("div", {}, element("b", {}, levelText(run, run.mean)), element("span", {}, found)));
  }
  if (keys.children.length) host.append(keys);
  const state = checks.bad
    ? ["bad", "✗", `${checks.bad} of the certificates say that a result must not be trusted`]
    : checks.note
      ? ["note-state", "!", `certificates: ${checks.good} without remarks, ${checks.note} with remarks`]
      : checks.good
        ? ["good", "✓", `all ${checks.good} certificates are good`]
        : ["note-state", "!", "there is nothing yet that proves a result: no reduced model, no run"];
  const verdict = card(
    "Can it be trusted?",
    element("p", { class: `state ${state[0]}` }, element("span", { "aria-hidden": "true" }, state[1]), state[2]),
    wordList([...worries, ...stale]),
    page.certificates.length
      ? element("p", { class: "note" }, element("a", { href: "#certificates" }, "all certificates in words"))
      : null,
  );
  host.append(grid(sentences.length ? card("What was found", wordList(sentences)) : null, verdict));
  for (const { title, head, rows } of tables) host.append(tableCard(title, head, rows));
}

/** "92.7 dB(A)" of a cycle; of a mean over several, where there is one, "92.7 ± 0.26 dB(A)". */
const levelText = (cycle, mean) => (mean ? `${mean.dba.toFixed(1)} ± ${mean.error.toFixed(2)} dB(A)` : `${cycle.dba.toFixed(1)} dB(A)`);
const cyclesText = mean => (mean ? `, mean of ${mean.cycles} cycles` : "");

const STATES = { good: ["good", "✓ good"], note: ["note-state", "! remarks"], bad: ["bad", "✗ not proved"] };

function certificatesSection() {
  if (!page.certificates.length) return;
  const host = section(
    "certificates",
    "Certificates",
    "Certificates in words",
    "What each program proved or estimated about its result, and what it did not.",
  );
  host.append(
    grid(
      page.certificates.map(({ title, run, state, sentences, table: rows }) =>
        card(
          run === undefined ? title : `${title}: ${page.runs[run].label}`,
          element("span", { class: `state ${STATES[state][0]}` }, STATES[state][1]),
          wordList(sentences),
          rows.length
            ? element(
                "details",
                {},
                element("summary", {}, "all figures"),
                table(["group", "figure", "value", "meaning"], rows, [0, 1, 3]),
              )
            : null,
        ),
      ),
    ),
  );
}
