// SPDX-License-Identifier: GPL-3.0-or-later
// The page: its head, its sections in order, its navigation.

function head() {
  const common = commonWords.join(", ");
  document
    .getElementById("top")
    .append(
      element(
        "div",
        { class: "row" },
        element("h1", {}, `${page.title}${common ? `: ${common}` : ""}`),
        element("nav", { "aria-label": "sections" }),
        themeSwitch(),
      ),
      runChips(),
    );
}

function navigation() {
  const nav = document.querySelector("header nav"),
    links = new Map();
  for (const one of document.querySelectorAll("main > section")) {
    links.set(one, element("a", { href: `#${one.id}` }, one.dataset.short));
    nav.append(links.get(one));
  }
  const watch = new IntersectionObserver(
    entries => {
      for (const { target, isIntersecting } of entries) links.get(target).classList.toggle("here", isIntersecting);
    },
    { rootMargin: "-20% 0px -70% 0px" },
  );
  for (const one of links.keys()) watch.observe(one);
}

head();
summarySection();
document.documentElement.dataset.first = Math.round(performance.now());
await new Promise(done => requestAnimationFrame(() => setTimeout(done))); // the first screen is painted before the rest is made
await surfaceSection();
await radiationSection();
await listeningSection();
await sensorsSection();
await mechanismSection();
await filmSection();
await driveSection();
await speedsSection();
await modelsSection();
accuracySection();
certificatesSection();
costSection();
navigation();
document.getElementById("foot").textContent = `clatter ${page.version}. This page needs no network and no other file.`;
document.documentElement.dataset.drawn = Math.round(performance.now());
