// Builds the page.

/** Scalars of the result with their paths, without lists and the certificate. */
function scalars(value, path = "") {
  if (value === null || typeof value !== "object") return [{ name: path, value, path }];
  if (Array.isArray(value)) return [];
  return Object.entries(value).filter(([key]) => key !== "certificate")
    .flatMap(([key, item]) => scalars(item, path ? `${path}.${key}` : key));
}

const unitsOfScalars = { peak: "m", trough: "m", amplitude: "m", phase: "rad", period: "s", max_speed: "m/s", "final.t": "s", "final.x": "m", "final.v": "m/s", "residual.rms": "m", "residual.noise": "m" };
const unitOfScalar = (path) => unitAt(path, unitsOfScalars[path] ?? (path.startsWith("energy.") ? "J" : ""));

const verdicts = { 0: ["done", "good"], 1: ["a check failed", "bad"], 4: ["no result", "bad"], 5: ["some cases failed", "caution"] };

function head() {
  const title = run.scenario?.title ?? run.provenance?.source ?? "dualdamp";
  document.title = `${title} – dualdamp`;
  const [words, mood] = verdicts[run.status] ?? ["failed", "bad"];
  const theme = make("button", { type: "button", class: "tools" }, "light / dark");
  theme.addEventListener("click", () => {
    const root = document.documentElement;
    const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
    drawAll();
  });
  return [
    make("div", { class: "row" }, make("span", { class: "soft" }, `dualdamp ${run.program.version} · ${run.analysis}`), theme),
    make("div", { class: "row" }, make("h1", {}, title), make("span", { class: `badge ${mood}` }, words)),
    make("p", { class: "soft" }, `${run.provenance?.source ?? ""} · ${run.provenance?.started ?? ""} · ${short(run.provenance?.duration ?? 0, 3)} s`),
  ];
}

function checks() {
  if (!run.checks.length) return [];
  return [heading("Checks"), grid(["value", "expected", "found", "difference", "", "source"], run.checks.map((c) => [
    c.value, c.expected, { text: c.found, title: String(c.found) }, c.difference ?? null, { text: c.ok ? "✓" : "✗ off", class: c.ok ? "good" : "bad" }, { text: c.source ?? "", class: "long" }]))];
}

/** The outcome of the verification, if there is one. */
function verification() {
  const v = run.verification;
  if (!v) return [];
  const rows = [["computed again by", v.engine], ["quantities compared", v.quantities], ["largest difference", v.largest_difference],
    ["of", v.quantity ?? "–"], ["allowed", v.tolerance ?? "–"], ["", { text: v.agrees ? "✓ agrees" : "✗ does not agree", class: v.agrees ? "good" : "bad" }]];
  if (v.rows_left_out) rows.push(["rows with a number in only one of the two computations", v.rows_left_out]);
  if (v.rows_without_numbers) rows.push(["rows without a number in both", v.rows_without_numbers]);
  if (v.times_left_out) rows.push(["times of events, not compared, at which the mass hardly moves", v.times_left_out]);
  if (v.multipliers_left_out) rows.push(["Floquet multipliers that depend on a slider which only just reaches its limit", v.multipliers_left_out]);
  if (v.others_left_out) rows.push(["other steady states that only one of the two computations knows", v.others_left_out]);
  if (v.time_shift) rows.push(["shift of events whose errors add up, by which numbers at a given time were compared [s]", v.time_shift]);
  if (v.reason) rows.push(["reason", { text: v.reason, class: "long" }]);
  return [heading("Verification"), grid(["", ""], rows)];
}

function provenance() {
  const { program } = run;
  const rows = [["program", `${program.name} ${program.version}`], ["commit", program.commit], ["compiler", program.compiler],
    ["libraries", Object.entries(program.libraries).map((l) => l.join(" ")).join(", ")], ...Object.entries(run.provenance ?? {}).map(([k, v]) => [k, typeof v === "string" ? v : JSON.stringify(v)])];
  return [heading("Where this comes from"),
    make("details", { id: "provenance" }, make("summary", {}, "Provenance"), grid(["", ""], rows.map(([k, v]) => [{ text: k, class: "text" }, { text: v, class: "long" }]))),
    make("details", {}, make("summary", {}, "Scenario as it was run (SI)"), make("pre", { tabindex: 0 }, JSON.stringify(run.scenario, null, 2)))];
}

function body() {
  const result = run.result ?? {};
  const parts = [];
  for (const error of run.errors) parts.push(make("p", { class: "note bad" }, error.message));
  const view = run.result ? (run.result.sweep ? views.sweep : views[run.analysis] ?? { charts: viewOfTables }) : {};
  parts.push(...(view.opens?.(result) ?? []));
  if (result.verdict) parts.push(make("p", { class: "verdict" }, result.verdict));
  const said = view.said?.(result) ?? [];
  for (const warning of run.warnings.filter((text) => !said.includes(text))) parts.push(make("p", { class: "note" }, warning));
  parts.push(...(view.before?.(result) ?? []));
  const shown = new Set(view.shown ?? []);
  const single = scalars(result).filter(({ path }) => !shown.has(path.split(".")[0])).filter(({ path }) => !path.startsWith("fit.") && path !== "verdict" && path !== "" && path !== "fit" && !path.startsWith("severities."));
  if (single.length) parts.push(heading("Numbers"), numbers(single.map((item) => ({ ...item, unit: unitOfScalar(item.path) }))));
  const drawn = (view.charts?.(result) ?? []).filter(Boolean);
  if (drawn.length) parts.push(make("div", { class: "charts", style: "margin-top:1rem" }, drawn));
  parts.push(...(view.after?.(result) ?? []), ...checks(), ...verification());
  if (Object.keys(tables).length) parts.push(make("div", { class: "screen" }, heading("Tables"), Object.entries(tables).map(([name, t]) => folded(name, t))));
  return [...parts, ...provenance()];
}

document.getElementById("head").append(...head());
document.getElementById("main").append(...body());
drawAll();
let resizing = 0;
addEventListener("resize", () => { clearTimeout(resizing); resizing = setTimeout(drawAll, 150); });

/** On paper: light, as wide as a sheet, with the provenance. */
function forPaper(isPaper) {
  document.documentElement.toggleAttribute("data-paper", isPaper);
  document.getElementById("provenance").open = isPaper;
  drawAll();
}
addEventListener("beforeprint", () => forPaper(true));
addEventListener("afterprint", () => forPaper(false));
document.documentElement.dataset.ready = "true";
