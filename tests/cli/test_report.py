#!/usr/bin/env python3
"""The page of results in a browser: it loads offline without errors, its charts are drawn, its numbers are those of
result.json.

usage: test_report.py PROGRAM ROOT [TEST...]
"""

import html
import json
import re
import sys
import unittest

from browser import View
from page import ROOT, PageCase

# Says of each chart how many pixels of line are drawn in it.
PROBE = """
for (const plot of document.querySelectorAll(".plot"))
  plot.dataset.inked = Math.round([...plot.querySelectorAll("path.series")].reduce((sum, path) => sum + path.getTotalLength(), 0));
"""

# Helpers of the tests that use a chart as a reader does.
HANDS = """
  const plot = document.querySelector(".plot");
  const at = (x, y) => {
    const { left, top } = plot.querySelector(".brush .background").getBoundingClientRect();
    return { clientX: left + x, clientY: top + y, bubbles: true, cancelable: true, view: window };
  };
  const mouse = (type, x, y, target) => (target ?? plot.querySelector(".brush .background")).dispatchEvent(new MouseEvent(type, at(x, y)));
  const drag = (x0, y0, x1, y1) => { mouse("mousedown", x0, y0); mouse("mousemove", x1, y1, window); mouse("mouseup", x1, y1, window); };
  const ticks = (n) => [...plot.querySelectorAll(".axis")[n].querySelectorAll("text")].map((text) => text.textContent);
  const numbers = (n) => ticks(n).map((text) => Number(text.replace("−", "-")));
  const press = (key) => plot.dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true, cancelable: true }));
"""

# One of each kind, with the number of charts it shows at least.
EXAMPLES = {
    "simulate": 5,
    "steady_state": 4,
    "xy_curve": 2,
    "frequency_response": 3,
    "regime_map": 1,
    "xy_branch": 2,
    "frequency_branch": 2,
    "free_decay": 1,
    "identify_xy_curve": 3,
    "identify_free_decay": 3,
    "formula": 0,
    "fit": 2,
    "sweep": 4,
    "sweep_curves": 1,
    "stepped_response": 3,
}


def at(document, path):
    """The value at a path such as estimates[0].zeta."""
    for key in re.findall(r"[^.\[\]]+", path):
        document = document[int(key)] if isinstance(document, list) else document[key]
    return document


class Page(PageCase):
    def load(self, page):
        """The page after its scripts and the probe have run, and what the console said."""
        with View(self.browser, page, (1000, 800)) as view:
            view.value(PROBE)
            return view.value("document.documentElement.outerHTML"), view.console()

    def check(self, name, charts, folder="examples"):
        out = self.result_of(name, folder)
        page = out / "report.html"
        self.assertNotRegex(page.read_text(), r"""(src|href)=["']?(https?:)?//""", "the page is self-contained")
        dom, console = self.load(page)
        self.assertEqual(console, [])
        self.assertIn('data-ready="true"', dom)
        inked = [int(count) for count in re.findall(r'data-inked="(\d+)"', dom)]
        self.assertGreaterEqual(len(inked), charts)
        for count in inked:
            self.assertGreater(count, 15, "a chart is empty")
        result = json.loads((out / "result.json").read_text())["result"]
        shown = re.findall(r'data-path="([^"]+)" data-value="([^"]*)"', dom)
        for path, value in shown:
            self.assertEqual(json.loads(html.unescape(value)), at(result, path), path)
        return dom, shown

    def test_every_kind_of_analysis_has_its_page(self):
        for name, charts in EXAMPLES.items():
            with self.subTest(name):
                _, shown = self.check(name, charts)
                if name.startswith("identify"):
                    self.assertIn("estimates[0].zeta", [path for path, _ in shown])

    def test_a_stress_test_has_its_ranking_its_maps_and_a_chart_of_consequences(self):
        dom, _ = self.check("small", 1, "stress")
        for heading in ("Ranking", "Who is right", "Coverage by family", "Who knows", "What nobody can know"):
            self.assertIn(f"<h2>{heading}", dom)

    def test_a_map_of_two_swept_keys(self):
        out = self.folder / "swept_map"
        text = (ROOT / "scenarios/examples/sweep.yaml").read_text()
        (self.folder / "swept.yaml").write_text(text[: text.index("expect:")])  # that is about other points
        self.run_program("run", self.folder / "swept.yaml", "--out", out, "--quiet", "--set",
                         "sweep={system.friction.kinetic: {from: 1 N, to: 4 N, count: 8}, excitation.amplitude: {from: 10 cm, to: 30 cm, count: 7}}")
        dom, console = self.load(out / "report.html")
        self.assertEqual(console, [])
        self.assertIn("amplitude [cm]", dom)
        self.assertIn("excitation.amplitude [cm]", dom)

    def test_a_sweep_of_steady_states_opens_with_the_amplitude(self):
        """The sticks of a period are a list of each point, but no curve."""
        out = self.folder / "swept_states"
        (self.folder / "states.yaml").write_text("""schema: dualdamp/1
system: {mass: 1 kg, stiffness: 100 N/m, damping: 0.2 N.s/m, friction: {law: coulomb, kinetic: 2 N}}
excitation: {type: base_harmonic, frequency: 1 rad/s}
analysis: {type: steady_state}
sweep: {system.friction.static: [2 N, 2.5 N], excitation.amplitude: {from: 8 cm, to: 16 cm, count: 3, spacing: log}}
""")
        self.run_program("run", self.folder / "states.yaml", "--out", out, "--quiet", "--plot", self.folder / "states.svg")
        sticks = [line for line in (out / "sweep_sticks.csv").read_text().splitlines() if line[0] != "#"]
        self.assertGreater(len(sticks), 3 * 6, "many in a period")
        dom, console = self.load(out / "report.html")
        self.assertEqual(console, [])
        self.assertNotIn("duration over start", dom)
        self.assertIn("amplitude = 11.3137 cm", (self.folder / "states.svg").read_text())

    def test_charts_are_saved_as_files(self):
        svg, png, inside = self.ask("sweep_curves", """new Promise((done) => {
          const saved = {};
          window.save = async (blob, name) => {
            saved[name.split(".").pop()] = { name, type: blob.type, size: blob.size, text: await blob.text() };
            if (saved.svg && saved.png) {
              const svg = new DOMParser().parseFromString(saved.svg.text, "image/svg+xml");
              const series = [...svg.querySelectorAll("path.series")];
              done([saved.svg, saved.png, { faults: svg.querySelectorAll("parsererror").length, says: [...svg.querySelectorAll("text")].map((t) => t.textContent),
                                            strokes: series.map((path) => path.style.stroke) }]);
            }
          };
          for (const name of ["SVG", "PNG"]) [...document.querySelectorAll("figure button")].find((b) => b.textContent === name).click();
        })""")
        self.assertEqual([svg["name"], svg["type"]], ["x_over_omega.svg", "image/svg+xml"])
        self.assertEqual([png["name"], png["type"]], ["x_over_omega.png", "image/png"])
        self.assertGreater(png["size"], 5000)
        self.assertEqual([inside["faults"], len(inside["strokes"])], [0, 7])
        for text in ("x over omega", "omega [Hz]", "x [mm]", "kinetic = 6 N"):
            self.assertIn(text, inside["says"])
        self.assertNotIn("var", "".join(inside["strokes"]))

    def test_a_comparison_has_its_page(self):
        for friction in (1, 3):
            self.run_program("run", ROOT / "scenarios/examples/xy_curve.yaml", "--out", self.folder / f"friction{friction}", "--quiet",
                             "--set", f"system.friction.kinetic={friction} N")
        self.run_program("compare", self.folder / "friction1", self.folder / "friction3", "--out", self.folder / "both")
        page = self.folder / "both/compare.html"
        self.assertNotRegex(page.read_text(), r"""(src|href)=["']?(https?:)?//""", "the page is self-contained")
        dom, console = self.load(page)
        self.assertEqual(console, [])
        self.assertIn('data-ready="true"', dom)
        self.assertIn("input amplitude Y [mm]", dom)
        for text in ("kinetic = 1 N", "kinetic = 3 N", "system.friction.kinetic"):
            self.assertIn(text, dom)
        self.assertGreater(int(re.search(r'data-inked="(\d+)"', dom).group(1)), 500)

    def test_a_title_is_no_script(self):
        title = "<img src=x onerror=document.body.dataset.ran=1></script><script>document.body.dataset.ran=1</script>"
        for name in ("one", "two"):
            self.run_program("run", ROOT / "scenarios/examples/xy_curve.yaml", "--out", self.folder / name, "--quiet", "--set", f"title={title} {name}")
        self.run_program("compare", self.folder / "one", self.folder / "two", "--out", self.folder / "hostile")
        for page in ("one/report.html", "hostile/compare.html"):
            with self.subTest(page):
                dom, console = self.load(self.folder / page)
                self.assertEqual(console, [])
                self.assertNotRegex(dom, r"<body[^>]*data-ran")
                self.assertIn(html.escape(title, quote=False), dom)

    def test_an_angle_is_shown_as_the_user_or_the_data_have_it(self):
        dom, _ = self.check("torsional_pendulum", 1)
        self.assertIn("output amplitude x [deg]", dom)
        self.assertIn("input amplitude Y [deg]", dom)
        data = self.folder / "decay.csv"
        data.write_text("x [deg]\n20.000\n-18.006\n16.134\n-14.375\n12.724\n-11.173\n9.717\n")  # zeta 0.02, x_f 0.4 deg
        out = self.folder / "decay"
        self.run_program("identify", data, "--mass", "0.3 kg.m^2", "--stiffness", "12 N.m/rad", "--out", out, "--quiet")
        dom, console = self.load(out / "report.html")
        self.assertEqual(console, [])
        for text in ("c [N.m.s/rad] (95 %)", "f [deg]</th>", "F0 [N.m] (95 %)", "extreme x [deg]"):
            self.assertIn(text, dom)
        self.assertIn("x_f [rad],", (out / "estimates.csv").read_text())
        self.assertIn("F0 [N.m],", (out / "estimates.csv").read_text())
        self.assertEqual(self.ask("formula", '(run.shown_units = {"rad/s": {unit: "Hz", factor: 0.5, asked: true}}, [...["final.v", "max_speed", "omega"].map((path) => numbers([{path, name: "", value: 1, unit: "rad/s"}]).textContent), ...["v", "omega"].map((name) => folded("t", {columns: [{name, unit: "rad/s", values: [1], texts: ["1"]}], rows: 1}).querySelector("th").textContent), ...["v", "omega"].map((column) => scaled({x: {unit: "rad/s", column}, y: {unit: ""}, series: [{x: [1], y: [1]}]}).x.unit)])'), ["1 rad/s", "1 rad/s", "0.5 Hz", "v [rad/s]", "omega [Hz]", "rad/s", "Hz"])

    def test_each_key_of_a_legend_has_its_own_name(self):
        legends = '[...document.querySelectorAll(".legend")].map((l) => [...l.children].map((key) => key.textContent))'
        for name in ("xy_curve", "free_decay", "identify_xy_curve", "regime_map"):
            with self.subTest(name):
                found = self.ask(name, legends)
                for keys in found:
                    self.assertNotIn("", keys)
                    self.assertEqual(len(set(keys)), len(keys), keys)
                if name == "xy_curve":
                    self.assertEqual(found[0], ["steady state", "slides through", "sticks in each period"])

    def test_tables_and_charts_fit_the_window(self):
        """The table of estimates on a desk, and the whole page on a telephone."""
        wide = '[...document.querySelectorAll(".scroll")].filter((e) => e.checkVisibility() && e.scrollWidth > e.clientWidth).length'
        self.assertEqual(self.ask("identify_xy_curve", wide, size=(1280, 900)), 0)
        self.assertLessEqual(self.ask("identify_xy_curve", "document.documentElement.scrollWidth - innerWidth", size=(390, 800)), 0)

    def test_a_fit_opens_with_its_numbers(self):
        """Not with the text of the fitted scenario in a card, the residual in its unit, and each value inside its interval."""
        heading, close, damping, cards = self.ask(
            "fit", 'document.querySelector("h2").textContent',
            'fittedNumbers({ parameters: [{ value: 2.00000449, interval95: [2.0000043, 2.0000047] }], residual: { noise_units: null } })[1].textContent',
            'document.querySelector("[data-path=\'parameters[0].value\']").textContent', 'document.querySelectorAll("dl [data-path=scenario]").length')
        self.assertEqual(heading, "Fitted numbers")
        self.assertIn("2.000004492.0000043 to 2.0000047", close)
        self.assertRegex(damping, r"^1\.000\d+.* to ")
        self.assertEqual(cards, 0)

    def test_paper_is_light_and_says_where_the_numbers_come_from(self):
        light, open_, ground = self.ask("simulate", """(() => {
            document.documentElement.dataset.theme = "dark";
            dispatchEvent(new Event("beforeprint"));
            const seen = [ink("--ground"), document.getElementById("provenance").open];
            dispatchEvent(new Event("afterprint"));
            return [...seen, ink("--ground")];
        })()""")
        self.assertEqual((light, open_, ground), ("#ffffff", True, "#14171a"))

    def test_a_study_of_mechanisms_shows_fits_effects_and_decays(self):
        dom, shown = self.check("mechanisms", 2)
        for heading in ("Fitted to the estimates", "At plausible values"):
            self.assertIn(f"<h2>{heading}</h2>", dom)
        paths = [path for path, _ in shown]
        for path in ("mechanisms[0].chi2", "mechanisms[2].misfit", "effects[0].bend", "explained.bend"):
            self.assertIn(path, paths)

    def use(self, name, actions, **options):
        return self.ask(name, "(() => {" + HANDS + actions + "})()", **options)

    def test_a_drag_zooms_and_a_double_click_shows_all(self):
        before, zoomed, reset, clicked = self.use("simulate", """
            const all = numbers(0);
            drag(100, 60, 300, 160);
            const zoomed = numbers(0);
            plot.dispatchEvent(new MouseEvent("dblclick", { bubbles: true }));
            const reset = numbers(0);
            drag(100, 60, 103, 62);
            return [all, zoomed, reset, numbers(0)];""")
        self.assertLess(zoomed[-1] - zoomed[0], 0.5 * (before[-1] - before[0]))
        self.assertEqual(reset, before)
        self.assertEqual(clicked, before, "a click is no drag")

    def test_buttons_and_keys_zoom_and_move(self):
        before, smaller, moved, reset = self.use("simulate", """
            const span = () => [numbers(0)[0], numbers(0).at(-1)];
            const all = span();
            document.querySelector(".tools button[aria-label^='zoom in']").click();
            const smaller = span();
            for (let i = 0; i < 5; i += 1) press("ArrowRight");
            const moved = span();
            press("0");
            return [all, smaller, moved, span()];""")
        self.assertLess(smaller[1] - smaller[0], before[1] - before[0])
        self.assertGreater(moved[0], smaller[0])
        self.assertEqual(reset, before)

    def test_the_readout_says_values_with_units(self):
        near, far = self.use("simulate", """
            const { left, top } = plot.querySelector(".brush .background").getBoundingClientRect();
            const path = plot.querySelector("path.series");
            const [x, y] = path.getAttribute("d").match(/^M([-\\d.]+),([-\\d.]+)/).slice(1).map(Number);
            const readout = plot.parentElement.querySelector(".readout");
            mouse("mousemove", x, y);
            const near = readout.textContent;
            mouse("mousemove", x + 3, 5);
            return [near, readout.textContent];""")
        self.assertRegex(near, r"^mass x: 0 s, \S+ mm$")
        self.assertEqual(far, "")

    def test_a_map_has_cells_of_each_category_on_logarithmic_axes(self):
        frequencies, amplitudes, cells, line = self.use("regime_map", """
            const paths = [...plot.querySelectorAll("path.series")];
            return [ticks(0), ticks(1), paths.slice(0, 4).map((path) => path.getAttribute("d").split("M").length - 1), paths[4].style.fill];""")
        self.assertEqual(frequencies, ["1", "2", "5", "10"])
        self.assertEqual(amplitudes, ["1", "2", "5", "10", "20", "50", "100"])
        self.assertGreater(min(cells), 3)
        self.assertGreater(sum(cells), 3000)
        self.assertEqual(line, "none")

    def test_bars_reach_from_low_to_high(self):
        path = self.ask("formula", """pathOf({ kind: "bars", x: [1, 2], y: [5, null], low: [4, null], high: [7, null], size: 2 },
            { x: (v) => 10 * v, y: (v) => 100 - v })""")
        self.assertEqual(path, "M10,96V93M8,95a2,2 0 1,0 4,0a2,2 0 1,0 -4,0")

    def test_a_key_of_the_legend_hides_its_series(self):
        self.assertEqual(self.use("simulate", """
            const count = () => plot.querySelectorAll("path.series").length;
            const key = plot.parentElement.querySelector(".legend button");
            const seen = [count()];
            for (let i = 0; i < 2; i += 1) { key.click(); seen.push(count(), key.getAttribute("aria-pressed")); }
            return seen;"""), [3, 2, "false", 3, "true"])

    def test_dark_pages_have_light_lines(self):
        light, dark = self.use("simulate", """
            const paint = () => getComputedStyle(plot.querySelector("path.series")).stroke;
            return ["light", "dark"].map((theme) => { document.documentElement.dataset.theme = theme; return paint(); });""")
        self.assertEqual((light, dark), ("rgb(0, 114, 178)", "rgb(86, 180, 233)"))

    def test_charts_are_drawn_for_the_width_of_the_sheet(self):
        sheet, drawn, back = self.use("simulate", """
            const width = () => plot.querySelector("svg").getBoundingClientRect().width;
            const screen = width();
            dispatchEvent(new Event("beforeprint"));
            const paper = [document.querySelector("main").clientWidth, width()];
            dispatchEvent(new Event("afterprint"));
            return [...paper, width() === screen];""", size=(1280, 900))
        self.assertTrue(0.9 * sheet < drawn <= sheet, (sheet, drawn))
        self.assertTrue(back)

    def test_a_title_cannot_become_markup(self):
        scenario = self.folder / "markup.yaml"
        scenario.write_text(
            "schema: dualdamp/1\ntitle: '</script><script>throw 1</script><b>bold</b>'\n"
            "system: {mass: 1 kg, stiffness: 100 N/m, damping: 4 N.s/m}\n"
            "excitation: {type: base_harmonic, amplitude: 0.1 m, frequency: 10 rad/s}\nanalysis: {type: steady_state}\n")
        self.run_program("run", scenario, "--out", self.folder / "markup", "--quiet")
        dom, console = self.load(self.folder / "markup/report.html")
        self.assertEqual(console, [])
        self.assertIn("&lt;b&gt;bold&lt;/b&gt;", dom)
        self.assertNotIn("<b>bold</b>", dom)

    def test_no_other_script_runs(self):
        """The policy of the page lets its own script run and no other, however it came into the page."""
        page = self.result_of("xy_curve") / "report.html"
        dom, console = self.load(page)
        self.assertEqual(console, [])
        self.assertIn('data-ready="true"', dom)
        text = page.read_text()
        for number, foreign in enumerate(['<script>document.body.dataset.foreign = 1</script>', '<img src="data:," onerror="document.body.dataset.foreign = 1">',
                                          '<script src="data:text/javascript,document.body.dataset.foreign = 1"></script>',
                                          '<iframe srcdoc="<script>parent.document.body.dataset.foreign = 1</script>"></iframe>']):
            with self.subTest(foreign):
                other = self.folder / f"other{number}.html"
                other.write_text(text.replace("</body>", foreign + "</body>"))
                dom, console = self.load(other)
                self.assertIn('data-ready="true"', dom)
                self.assertNotIn('data-foreign', dom.split(">", 20)[0] + "".join(re.findall("<body[^>]*>", dom)))
                self.assertTrue(any("Content Security Policy" in line for line in console), console)

    def test_names_cannot_become_markup(self):
        """Names of columns, of laws and of reasons, in a result that somebody has changed."""
        out = self.folder / "names"
        self.run_program("run", ROOT / "scenarios/examples/xy_curve.yaml", "--out", out, "--quiet")
        script = '<img src=x onerror="throw 1">'
        result = json.loads((out / "result.json").read_text())
        result["warnings"] = [script]
        result["scenario"]["title"] = script
        result["scenario"]["system"]["friction"]["law"] = script
        result["analysis"] = script
        result["provenance"]["source"] = script
        del result["provenance"]["tables"]  # who changes a table changes its sum, too
        (out / "result.json").write_text(json.dumps(result))
        table = (out / "curve.csv").read_text()
        (out / "curve.csv").write_text(re.sub("^# source: .*$", "# source: " + script, table, flags=re.M).replace("\nY [m]", "\n" + script))
        self.run_program("report", out)
        dom, console = self.load(out / "report.html")
        self.assertNotIn("<img", dom)
        self.assertIn("&lt;img", dom)
        self.assertFalse([line for line in console if "Uncaught 1" in line], console)

    def test_an_error_in_the_page_would_be_seen(self):
        self.run_program("run", ROOT / "scenarios/examples/formula.yaml", "--out", self.folder / "broken", "--quiet")
        page = self.folder / "broken/report.html"
        page.write_text(page.read_text().replace("function head()", "function not_head()"))
        dom, console = self.load(page)
        self.assertEqual(len(console), 1)
        self.assertNotIn('data-ready="true"', dom)

    def test_report_writes_the_same_page_anew(self):
        out = self.folder / "anew"
        self.run_program("run", ROOT / "scenarios/examples/xy_curve.yaml", "--out", out, "--quiet")
        first = (out / "report.html").read_bytes()
        (out / "report.html").unlink()
        self.run_program("report", out)
        self.assertEqual((out / "report.html").read_bytes(), first)

    def test_a_long_table_is_thinned_out_and_the_page_says_so(self):
        out = self.folder / "long"
        self.run_program("run", ROOT / "scenarios/examples/simulate.yaml", "--set", "analysis.sample_rate=100000", "--out", out, "--quiet")
        dom, console = self.load(out / "report.html")
        self.assertEqual(console, [])
        rows = sum(1 for line in (out / "history.csv").read_text().splitlines() if not line.startswith("#")) - 1
        self.assertIn(f"of {rows} rows, every {rows // 50000 + 1}th; all are in history.csv", dom)

    def test_a_directory_without_a_result_is_refused(self):
        empty = self.folder / "empty"
        empty.mkdir()
        self.assertIn("there is no result here", self.run_program("report", empty, status=3).stderr)
        (empty / "result.json").write_text("{")
        self.assertIn("not a whole JSON document", self.run_program("report", empty, status=3).stderr)
        (empty / "result.json").write_text("{}")
        self.assertIn("no result of dualdamp", self.run_program("report", empty, status=3).stderr)
        self.assertIn("no such directory", self.run_program("report", self.folder / "nowhere", status=3).stderr)
        self.assertEqual(sorted(path.name for path in empty.iterdir()), ["result.json"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
