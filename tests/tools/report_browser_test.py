# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of `clatter report --html` in Debian's Chromium without a window: it is drawn, without errors and without requests; it
turns, slides, plays, saves; from a phone to a wall screen, light and dark, by keys."""
import base64
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import browser
import synthetic_page

SAMPLE = pathlib.Path(os.environ.get("CLATTER_SAMPLE", pathlib.Path(__file__).resolve().parents[2] / "samples/truck_diesel"))
CLATTER = pathlib.Path(__file__).resolve().parents[2] / "tools/clatter"
if not browser.PROGRAM:
    print("skipped: Chromium is not installed; `tools/setup browser` installs it, about 120 MB to load")
    sys.exit(77)

# Catches what a click on a button saves: [name, type, size, text].
SAVED = """(async () => {{ const button = {0}; let blob; const make = URL.createObjectURL, click = HTMLAnchorElement.prototype.click; let name;
  URL.createObjectURL = one => {{ blob = one; return make.call(URL, one); }}; HTMLAnchorElement.prototype.click = function () {{ name = this.download; }};
  button.click(); for (let k = 0; k < 100 && !blob; ++k) await new Promise(done => setTimeout(done, 20));
  URL.createObjectURL = make; HTMLAnchorElement.prototype.click = click;
  return [name, blob.type, blob.size, blob.type === "text/csv" ? await blob.text() : ""]; }})()"""


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        folder = pathlib.Path(cls.scratch.name)
        synthetic_page.write_folder(folder)
        subprocess.run([CLATTER, "report", "--html"], cwd=folder, check=True, capture_output=True)
        cls.path = folder / "report.html"
        cls.browser = browser.Browser(1280, 900)
        cls.browser.__enter__()

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()
        cls.scratch.cleanup()

    def setUp(self):
        self.page = self.browser
        self.page.problems.clear()
        self.page.resize(1280, 900)
        self.page.colours("light")
        self.page.goto(self.path)

    def tearDown(self):
        self.assertEqual(self.page.problems, [], "errors, warnings or requests")

    def click(self, text):
        self.page.evaluate(f"[...document.querySelectorAll('button')].find(one => one.textContent === {text!r}).click()")
        self.page.settle()

    def pause(self):
        self.page.evaluate("[...document.querySelectorAll('#surface button')].find(one => one.textContent.includes('pause'))?.click()")
        self.page.settle()

    def shown(self, selector):
        """A picture of an element as it is on the screen."""
        left, top, width, height = self.page.rectangle(selector)
        self.page.settle()
        clip = {"x": left + self.page.evaluate("scrollX"), "y": top + self.page.evaluate("scrollY"), "width": width, "height": height, "scale": 1}
        return self.page.call("Page.captureScreenshot", format="png", clip=clip, captureBeyondViewport=True)["data"]

    def slide(self, selector, value):
        self.page.evaluate(f"""(() => {{ const one = document.querySelector({selector!r}); one.value = {value}; one.dispatchEvent(new Event("input")); }})()""")
        self.page.settle()

    def caption(self):
        return self.page.evaluate("document.querySelector('.caption').textContent")

    def test_all_sections_are_there_and_every_plot_is_drawn(self):
        self.assertEqual(self.page.evaluate("[...document.querySelectorAll('main > section')].map(one => one.id)"),
                         ["summary", "surface", "radiation", "sound", "sensors", "mechanism", "film", "drive", "speeds", "models", "accuracy", "certificates", "cost"])
        blank = self.page.evaluate("""(async () => { const found = [];
          for (const one of document.querySelectorAll("figure.plot canvas")) {
            if (!one.clientHeight) continue;
            one.scrollIntoView({ block: "center", behavior: "instant" });
            let colours = new Set();
            for (let k = 0; k < 100 && colours.size < 12; ++k) {
              await new Promise(done => setTimeout(done, 20));
              colours = new Set(new Uint32Array(one.getContext("2d").getImageData(0, 0, one.width, one.height).data.buffer));
            }
            if (colours.size < 12) found.push(one.getAttribute("aria-label"));
          } return found; })()""")
        self.assertEqual(blank, [])

    def test_the_first_screen_has_the_loudest_runs_bar_its_level_and_the_skin_in_motion(self):
        rows = self.page.evaluate("""[...document.querySelectorAll('.loud')].map(row => [row.querySelector('.name').textContent,
          Number(row.querySelector('b').textContent), parseFloat(row.querySelector('.track i').style.width), getComputedStyle(row).getPropertyValue('--colour')])""")
        self.assertGreaterEqual(len(rows), 2)
        levels, widths = [row[1] for row in rows], [row[2] for row in rows]
        self.assertEqual(sorted(range(len(rows)), key=levels.__getitem__), sorted(range(len(rows)), key=widths.__getitem__))
        self.assertAlmostEqual(max(widths), 100.0)
        self.assertEqual(len({row[3] for row in rows}), len(rows))
        below = self.page.evaluate("Math.max(...['loud', 'moving'].map(id => document.getElementById(id).getBoundingClientRect().bottom))")
        self.assertLess(below, 900)
        before = self.shown("#moving canvas")
        self.page.wait_for("new Promise(done => setTimeout(() => done(true), 300))")
        self.assertNotEqual(self.shown("#moving canvas"), before)

    def test_it_is_printed_on_two_light_pages(self):
        self.page.colours("dark")
        found = base64.b64decode(self.page.call("Page.printToPDF", printBackground=True, preferCSSPageSize=True)["data"])
        self.assertEqual(len(re.findall(rb"/Type /Page\b", found)), 2)
        self.page.evaluate("dispatchEvent(new Event('beforeprint'))")
        self.assertEqual(self.page.evaluate("document.documentElement.dataset.theme"), "light")
        self.page.evaluate("dispatchEvent(new Event('afterprint'))")
        self.assertEqual(self.page.evaluate("document.documentElement.dataset.theme"), "dark")

    def test_two_folders_scroll_together(self):
        both = self.path.parent / "both.html"
        subprocess.run([CLATTER, "report", "--html", self.path.parent, self.path.parent, "-o", both], check=True, capture_output=True)
        self.page.goto(both)
        self.click("Power")
        tops = self.page.evaluate("[...document.querySelectorAll('iframe')].map(one => one.contentDocument.getElementById('radiation').getBoundingClientRect().top)")
        self.assertTrue(all(-10 < top < 300 for top in tops), tops)

    def test_the_view_turns_by_pointer_and_by_keys_and_magnifies(self):
        self.pause()
        before = self.shown("#skin")
        self.page.drag("#skin", (0.4, 0.5), (0.6, 0.4))
        turned = self.shown("#skin")
        self.assertNotEqual(before, turned)
        self.page.evaluate("document.getElementById('skin').focus()")
        for key in ("ArrowLeft", "+"):
            self.page.press(key)
            moved = self.shown("#skin")
            self.assertNotEqual(moved, turned, key)
            turned = moved
        self.page.press("Home")
        self.assertEqual(self.shown("#skin"), before)

    def test_a_click_shows_the_spectrum_of_that_point(self):
        self.pause()
        left, top, width, height = self.page.rectangle("#skin")
        for kind in ("mousePressed", "mouseReleased"):
            self.page.call("Input.dispatchMouseEvent", type=kind, x=left + 0.5 * width, y=top + 0.5 * height, button="left", clickCount=1)
        self.page.wait_for("document.querySelector('#surface').textContent.includes('Velocity at (')")

    def test_sliders_change_shape_and_film(self):
        self.pause()
        seen = [self.shown("#skin")]
        for line in (9, 20):
            self.slide("#skin-step", line)
            seen.append(self.shown("#skin"))
            self.assertIn(f"{line * 1000 / 60:.5g} Hz, order {line / 2:g}", self.caption())
        self.assertEqual(len(set(seen)), 3)
        first = self.shown("#film canvas")
        self.slide("#film-step", 3)
        self.assertNotEqual(self.shown("#film canvas"), first)

    def test_a_line_moves_when_it_plays_and_stands_when_it_does_not(self):
        self.pause()
        self.assertEqual(self.shown("#skin"), self.shown("#skin"))
        self.page.evaluate("[...document.querySelectorAll('#surface button')].find(one => one.textContent.includes('play')).click()")
        first = self.shown("#skin")
        self.page.settle()
        self.assertNotEqual(first, self.shown("#skin"))

    def test_instants_modes_and_panels_are_shown(self):
        self.pause()
        for text, expected in (("at an instant", "crank angle"), ("mode shapes", "elastic mode 1: 200 Hz"), ("panels", "smallest panel")):
            self.click(text)
            self.page.wait_for(f"document.querySelector('.caption').textContent.includes({expected!r})")
        self.assertEqual(self.page.evaluate("document.querySelectorAll('#surface table tbody tr').length"), 4)

    def test_runs_are_hidden_and_shown_in_all_plots(self):
        names = "[...document.querySelectorAll('#radiation figure .legend')][0].textContent"
        self.page.rectangle("#radiation figure canvas")
        self.page.wait_for(f"{names}.includes('dry')")
        self.page.evaluate("document.querySelector('.chip').click()")
        self.page.wait_for(f"!{names}.includes('dry')")
        self.assertEqual(self.page.evaluate("document.querySelector('.chip').getAttribute('aria-pressed')"), "false")

    def test_a_plot_is_read_magnified_and_reset_by_keys(self):
        self.page.rectangle("#radiation figure:nth-of-type(2) canvas")
        legend = "document.querySelectorAll('#radiation figure')[1].querySelector('.legend').textContent"
        self.page.evaluate("document.querySelectorAll('#radiation figure canvas')[1].focus()")
        before = self.page.evaluate(legend)
        self.page.press("ArrowRight")
        self.page.wait_for(f"{legend} !== {before!r}")
        hidden = "document.querySelectorAll('#radiation figure')[1].querySelector('.save button').hidden"
        self.page.press("+")
        self.page.wait_for(f"!{hidden}")
        self.page.press("Escape")
        self.page.wait_for(hidden)

    def test_pictures_and_numbers_are_saved(self):
        for section in ("surface", "radiation", "film"):
            self.page.rectangle(f"#{section} figure canvas")
            self.page.settle()
            button = f"[...document.querySelectorAll('#{section} figure .save button')].find(one => one.textContent === '%s')"
            name, kind, size, _ = self.page.evaluate(SAVED.format(button % "PNG"))
            self.assertEqual((kind, name[-4:]), ("image/png", ".png"))
            self.assertGreater(size, 5000)
            name, kind, size, text = self.page.evaluate(SAVED.format(button % "CSV"))
            self.assertEqual((kind, name[-4:]), ("text/csv", ".csv"))
            rows = text.strip().split("\n")
            self.assertGreater(len(rows), 10)
            self.assertEqual({row.count(",") for row in rows[1:]}, {rows[1].count(",")})
            self.assertIn("[", rows[0], "units")

    def test_the_sound_is_five_seconds_of_the_cycle(self):
        self.page.rectangle("#sensors audio")
        self.page.wait_for("document.querySelector('#sensors audio').src")
        head = self.page.evaluate("""fetch(document.querySelector("#sensors audio").src).then(one => one.arrayBuffer()).then(one => {
          const view = new DataView(one), values = new Int16Array(one, 44);
          return [view.getUint32(24, true), values.length, Math.max(...values.subarray(0, 5000)), view.getUint32(0)]; })""")
        self.assertEqual((head[0], head[3]), (48000, 0x52494646))
        self.assertEqual(head[1] % 2880 % 1920, 0)  # whole cycles of 60 or 40 ms
        self.assertGreaterEqual(head[1], 5 * 48000)
        self.assertGreater(head[2], 1000)

    def test_a_browser_without_webgl_shows_the_rest(self):
        number = self.page.call("Page.addScriptToEvaluateOnNewDocument", source="""const own = HTMLCanvasElement.prototype.getContext;
            HTMLCanvasElement.prototype.getContext = function (kind, ...more) { return kind === "webgl2" ? null : own.call(this, kind, ...more); };""")
        self.page.goto(self.path)
        self.page.call("Page.removeScriptToEvaluateOnNewDocument", identifier=number["identifier"])
        self.assertIn("this browser has no WebGL2", self.page.evaluate("document.getElementById('surface').textContent"))
        self.assertEqual(self.page.evaluate("document.querySelectorAll('main > section').length"), 13)

    @unittest.skipUnless((SAMPLE / "slap.field.h5").exists(), "make demo has not been run")
    def test_the_page_of_the_demo_is_smaller_than_40_mb_and_has_the_figures_of_the_report(self):
        path = self.path.parent / "demo.html"
        subprocess.run([CLATTER, "report", "--html", SAMPLE, "-o", path], check=True, capture_output=True)
        self.assertLess(path.stat().st_size, 40e6)
        self.page.goto(path)
        print(f"{path.stat().st_size / 1e6:.1f} MB, drawn after {self.page.evaluate('document.documentElement.dataset.drawn')} ms")
        printed = subprocess.run([CLATTER, "report", SAMPLE], check=True, capture_output=True, text=True).stdout
        powers = re.findall(r"^  slap\S* .* (\d+\.\d) +\d+\.\d$", printed.split("power over the cycle")[1].split("cost of")[0], re.M)
        self.assertEqual(self.page.evaluate("[...document.querySelectorAll('.loud b')].map(one => one.textContent)")[:len(powers)], powers)

    def test_no_width_needs_a_horizontal_scroll_bar(self):
        for width, height, phone in ((360, 740, True), (768, 1024, True), (1280, 900, False), (3840, 2160, False)):
            self.page.resize(width, height, phone)
            self.page.goto(self.path)
            self.assertLessEqual(self.page.evaluate("document.documentElement.scrollWidth"), width)
            self.assertGreater(self.page.evaluate("document.getElementById('skin').clientWidth"), 0.4 * min(width, 2560))

    def test_dark_and_light_follow_the_system_and_the_switch(self):
        ground = "getComputedStyle(document.body).backgroundColor"
        light = self.page.evaluate(ground)
        self.page.colours("dark")
        self.page.wait_for(f"{ground} !== {light!r}")
        self.page.evaluate("document.querySelector('header .row button').click()")  # light, whatever the system has
        self.page.wait_for(f"{ground} === {light!r}")
        self.page.evaluate("document.querySelector('header .row button').click(); document.querySelector('header .row button').click()")

    def test_controls_have_names(self):
        nameless = self.page.evaluate("""[...document.querySelectorAll("button, input, select, canvas[tabindex], iframe, audio")]
          .filter(one => !(one.textContent.trim() && one.tagName === "BUTTON") && !one.getAttribute("aria-label") && !one.title && !one.closest("label")?.textContent.trim())
          .map(one => one.outerHTML.slice(0, 120))""")
        self.assertEqual(nameless, [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
