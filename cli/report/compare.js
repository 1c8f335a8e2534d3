// Builds the page of a comparison: one chart, and the differences between the scenarios.

function comparison() {
  const { title, chart: drawn, results, differing } = run;
  document.title = `${title} – dualdamp`;
  const axisOf = ({ label, unit, log, whole }) => ({ label, unit, log, whole, asWritten: true });
  document.getElementById("head").append(
    make("div", { class: "row" }, make("span", { class: "soft" }, `dualdamp ${run.program.version} · comparison of ${run.analysis}`)),
    make("div", { class: "row" }, make("h1", {}, title)),
    make("p", { class: "soft" }, `${results.length} results; the numbers are in compare.csv`));
  const rows = differing.map(({ key, values: list }) => [{ text: key, class: "text" }, ...list.map((text) => ({ text, class: "text" }))]);
  document.getElementById("main").append(
    make("div", { class: "charts", style: "margin-top:1rem" }, chart({ title: `${drawn.y.label} over ${drawn.x.label}`, wide: true, x: axisOf(drawn.x), y: axisOf(drawn.y), series: drawn.series })),
    heading("What differs"),
    rows.length ? grid(["key", ...results.map(({ label }) => label)], rows, { caption: "Keys that differ; numbers without a unit are SI" }) : make("p", {}, "The scenarios do not differ."),
    heading("Results"),
    grid(["legend", "title", "directory", "computed"], results.map((r) => [{ text: r.label, class: "text" }, { text: r.title, class: "text" }, { text: r.directory, class: "text" }, { text: r.started, class: "text" }])));
}

comparison();
drawAll();
let resizing = 0;
addEventListener("resize", () => { clearTimeout(resizing); resizing = setTimeout(drawAll, 150); });
document.documentElement.dataset.ready = "true";
