// SPDX-License-Identifier: GPL-3.0-or-later
// Elements of the page.

/** An element with attributes (functions become listeners: onclick) and children (elements or texts). */
function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === "function") made.addEventListener(name.slice(2), value);
    else if (name === "style") made.style.cssText = value;
    else made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children.flat().filter(child => child !== null && child !== undefined));
  return made;
}

/** A section of the page; `short` is its name in the navigation. */
function section(id, short, title, lead) {
  const made = element(
    "section",
    { id, "aria-label": title, "data-short": short },
    element("h2", {}, title),
    lead ? element("p", { class: "lead" }, lead) : null,
  );
  document.getElementById("main").append(made);
  return made;
}

function grid(...children) {
  return element("div", { class: "grid" }, ...children);
}

/** Sentences as a list: [state, text] or text. A number stays with its unit. */
function wordList(sentences) {
  return element(
    "ul",
    { class: "words" },
    sentences.map(one => {
      const [state, text] = Array.isArray(one) ? one : ["good", one];
      return element(
        "li",
        { class: { note: "note-state", bad: "bad" }[state] },
        text.replace(/ (%|dB|Hz|rpm|N|µm)(?![a-z])/g, "\u00a0$1"),
      );
    }),
  );
}

function card(title, ...children) {
  return element("div", { class: "card" }, title ? element("h3", {}, title) : null, ...children);
}

/** A card with a table, whose cells are saved as CSV; further children are below it. */
function tableCard(title, head, rows, texts, ...children) {
  const made = table(head, rows, texts);
  const cells = row => [...row.children].map(cell => cell.textContent);
  const columns = () => {
    const lines = [...made.querySelectorAll("tbody tr")].map(cells);
    return cells(made.querySelector("thead tr"))
      .map((name, k) => ({ name, values: lines.map(line => line[k]) }))
      .filter(one => one.name || one.values.some(Boolean));
  };
  return element(
    "div",
    { class: "card" },
    element("div", { class: "title" }, element("h3", {}, title), saveButtons(title, null, columns)),
    made,
    ...children,
  );
}

/** Buttons of which one is pressed; `choose` gets its value. Returns { element, set(value) }. */
function choices(name, options, first, choose) {
  const buttons = options.map(([value, label]) =>
    element(
      "button",
      {
        type: "button",
        class: "choice",
        "data-value": value,
        onclick: () => {
          set(value);
          choose(value);
        },
      },
      label,
    ),
  );
  function set(value) {
    for (const button of buttons) button.setAttribute("aria-pressed", button.dataset.value === String(value));
  }
  set(first);
  return { element: element("span", { class: "choices", role: "group", "aria-label": name }, buttons), set };
}

/** A list to select from, with its label; options are [value, label]. */
function selection(label, options, choose) {
  const list = element(
    "select",
    { onchange: () => choose(list.value) },
    options.map(([value, text]) => element("option", { value }, text)),
  );
  return { element: element("label", {}, label, list), list };
}

/** A slider with its label; `move` gets the number. */
function slider(label, { min, max, step = 1, value = min }, move, more = {}) {
  const input = element("input", { type: "range", min, max, step, ...more, oninput: () => move(Number(input.value)) });
  input.value = value;
  return { element: element("label", { class: "wide" }, label, input), input };
}

function checkbox(label, checked, change) {
  const input = element("input", { type: "checkbox", onchange: () => change(input.checked) });
  input.checked = checked;
  return { element: element("label", {}, input, label), input };
}

/** A table; cells of the named columns are texts, of the others numbers. */
function table(head, rows, texts = [0]) {
  const kind = column => (texts.includes(column) ? { class: "text" } : {});
  return element(
    "div",
    { class: "scroll" },
    element(
      "table",
      {},
      element(
        "thead",
        {},
        element(
          "tr",
          {},
          head.map((cell, k) => element("th", { scope: "col", ...kind(k) }, cell)),
        ),
      ),
      element(
        "tbody",
        {},
        rows.map(row =>
          element(
            "tr",
            {},
            row.map((cell, k) =>
              cell instanceof Element ? cell : element("td", kind(k), cell === null ? "–" : String(cell)),
            ),
          ),
        ),
      ),
    ),
  );
}
