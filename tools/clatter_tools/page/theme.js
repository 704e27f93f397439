// SPDX-License-Identifier: GPL-3.0-or-later
// Light or dark: as the system has it, or as chosen. Drawings follow the event "appearance".

const THEMES = { auto: "as the system", light: "light", dark: "dark" };
const systemDark = matchMedia("(prefers-color-scheme: dark)");

function remembered(key, value) {
  try {
    if (value !== undefined) localStorage.setItem(key, value);
    return localStorage.getItem(key);
  } catch {
    return null; // a browser may refuse to remember anything for a file
  }
}

let theme = remembered("clatter-theme") in THEMES ? remembered("clatter-theme") : "auto";

let printing = false; // on white paper
for (const [name, on] of [["beforeprint", true], ["afterprint", false]])
  addEventListener(name, () => {
    printing = on;
    applyTheme();
  });

function dark() {
  return !printing && (theme === "dark" || (theme === "auto" && systemDark.matches));
}

function applyTheme() {
  document.documentElement.dataset.theme = dark() ? "dark" : "light";
  document.dispatchEvent(new Event("appearance"));
}

function themeSwitch() {
  const button = element("button", {
    type: "button",
    onclick: () => {
      const names = Object.keys(THEMES);
      theme = names[(names.indexOf(theme) + 1) % names.length];
      remembered("clatter-theme", theme);
      label();
      applyTheme();
    },
  });
  const label = () => {
    button.textContent = { auto: "◐", light: "☀", dark: "☾" }[theme];
    button.title = `colours: ${THEMES[theme]}`;
    button.setAttribute("aria-label", button.title);
  };
  label();
  return button;
}

/** The colours of a drawing, as style sheets have them. */
function ink() {
  const style = getComputedStyle(document.documentElement);
  const get = name => style.getPropertyValue(`--${name}`).trim();
  return {
    text: get("text"),
    quiet: get("quiet"),
    line: get("line"),
    grid: get("grid"),
    card: get("card"),
    metal: get("metal"),
    accent: get("accent"),
  };
}

/** "#rrggbb" as [r, g, b] from 0 to 1. */
function rgb(colour) {
  return [1, 3, 5].map(k => parseInt(colour.slice(k, k + 2), 16) / 255);
}

systemDark.addEventListener("change", applyTheme);
applyTheme();
