// SPDX-License-Identifier: GPL-3.0-or-later
// Saving of pictures and numbers.

function download(name, blob) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

function fileName(title, ending) {
  return `${title
    .toLowerCase()
    .replace(/[^a-z0-9]+/g, "_")
    .replace(/^_|_$/g, "")
    .slice(0, 80)}.${ending}`;
}

function csvCell(value) {
  if (typeof value === "number") return Number.isFinite(value) ? String(Number(value.toPrecision(7))) : "";
  return /[",\n]/.test(value) ? `"${value.replaceAll('"', '""')}"` : value;
}

/** Columns [{ name, values }] of possibly different lengths as text. */
function csvText(columns) {
  const rows = Math.max(0, ...columns.map(column => column.values.length));
  const lines = [columns.map(column => csvCell(column.name)).join(",")];
  for (let k = 0; k < rows; ++k)
    lines.push(columns.map(column => (k < column.values.length ? csvCell(column.values[k]) : "")).join(","));
  return lines.join("\n") + "\n";
}

/** Buttons that save what a drawing shows: `picture` returns a canvas (null: there is none), `columns` the columns of a table. */
function saveButtons(title, picture, columns) {
  const png = () => picture().toBlob(blob => download(fileName(title, "png"), blob), "image/png");
  const csv = () => download(fileName(title, "csv"), new Blob([csvText(columns())], { type: "text/csv" }));
  return element(
    "span",
    { class: "save" },
    picture
      ? element("button", { type: "button", onclick: png, "aria-label": `save the picture: ${title}` }, "PNG")
      : null,
    element("button", { type: "button", onclick: csv, "aria-label": `save the numbers: ${title}` }, "CSV"),
  );
}
