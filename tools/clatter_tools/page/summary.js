// SPDX-License-Identifier: GPL-3.0-or-later
// Summary: the figures that a reader wants first, in sentences and tables.

function summarySection() {
  const { sentences, tables, checks, worries, stale } = page.summary;
  const host = section("summary", "Summary", "Summary");
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
  const [loud, moving] = [loudnessCard(), movingFigure()];
  if (loud || moving) host.append(element("div", { class: moving ? "first" : "" }, element("div", {}, loud, verdict), moving));
  const found = sentences.length ? card("What was found", wordList(sentences)) : null;
  if (found || !(loud || moving)) host.append(grid(found, loud || moving ? null : verdict));
  for (const { title, head, rows } of tables) host.append(tableCard(title, head, rows));
}

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
