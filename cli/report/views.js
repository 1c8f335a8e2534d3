// What each analysis shows, top to bottom. A view gets the result and returns charts.

const values = (name, column) => tables[name]?.get(column)?.values;

/** A series from two columns of a table; nothing when one is missing or no text would be a number. */
function series(name, x, y, more = {}) {
  const [xs, ys] = [values(name, x), values(name, y)];
  return xs && ys ? { label: y, x: xs, y: ys, ...more } : { label: y, x: [], y: [], ...more };
}

/** The rows of a table that satisfy a condition, as a series. */
function part(name, x, y, keep, more) {
  const [xs, ys] = [values(name, x) ?? [], values(name, y) ?? []];
  const rows = xs.map((_, i) => i).filter((i) => ys[i] !== null && keep((column) => values(name, column)?.[i] ?? tables[name].get(column)?.texts[i]));
  return { x: rows.map((i) => xs[i]), y: rows.map((i) => ys[i]), ...more };
}

/** A line broken where it jumps from one row to the next: what lies between two samples is not known. */
function broken({ x, y, ...more }) {
  const [low, high] = y.reduce(([a, b], v) => (v === null ? [a, b] : [Math.min(a, v), Math.max(b, v)]), [Infinity, -Infinity]);
  const line = { x: [], y: [], ...more };
  y.forEach((v, i) => {
    if (i > 0 && v !== null && y[i - 1] !== null && Math.abs(v - y[i - 1]) > 0.25 * (high - low)) { line.x.push(null); line.y.push(null); }
    line.x.push(x[i]);
    line.y.push(v);
  });
  return line;
}

const unitOf = (name, column) => tables[name]?.get(column)?.unit ?? "";
const axis = (name, column, label = column) => ({ label, unit: unitOf(name, column) });

function simulateView() {
  if (!tables.history) return [];
  const time = axis("history", "t", "time t");
  const over = (column, title, label, more = {}) =>
    chart({ title, x: time, y: axis("history", column, label), series: [series("history", "t", column)], ...more });
  return [
    chart({ title: "Motion", x: time, y: axis("history", "x", "displacement"), wide: true,
      series: [series("history", "t", "x", { label: "mass x" }), series("history", "t", "y", { label: "base y", kind: "dashed" }),
        { ...part("events", "t", "x", () => true, {}), label: "events", kind: "points", colour: 2 }] }),
    over("v", "Velocity", "velocity v"),
    chart({ title: "Phase plane", x: axis("history", "x", "displacement x"), y: axis("history", "v", "velocity v"), series: [series("history", "x", "v")] }),
    chart({ title: "Friction over velocity", note: "the force against the motion; jumps between two samples are left open", x: axis("history", "v", "velocity v"), y: axis("history", "friction", "friction force"),
      series: [broken(series("history", "v", "friction"))] }),
    chart({ title: "Friction over displacement", x: axis("history", "x", "displacement x"), y: axis("history", "friction", "friction force"),
      series: [series("history", "x", "friction")] }),
  ];
}

/** Output amplitude over a column, points that rest apart from those that slide, unstable ones dashed. */
function curveView(name, over, label) {
  const kinds = [
    { label: "slides through", kind: "points", colour: 0, keep: (get) => get("sticks") === 0 && get("stable") !== 0 },
    { label: "rests in each period", kind: "open", colour: 1, keep: (get) => get("sticks") > 0 && get("stable") !== 0 },
    { label: "does not attract", kind: "open", colour: 3, keep: (get) => get("stable") === 0 },
  ];
  const size = (values(name, over)?.length ?? 0) > 200 ? 1.5 : 3;
  const amplitude = chart({
    title: "Output amplitude", wide: true, x: axis(name, over, label), y: axis(name, "x", "output amplitude x"),
    series: [series(name, over, "x", { label: "steady state", width: 1, colour: 6 }),
      ...kinds.map(({ keep, ...more }) => part(name, over, "x", keep, { size, ...more }))],
  });
  const phase = values(name, "phase") && chart({
    title: "Phase", note: "lag of the fundamental behind the excitation", x: axis(name, over, label), y: axis(name, "phase", "phase"), series: [series(name, over, "phase")] });
  const stops = values(name, "stops") && chart({
    title: "Stops in a period", x: axis(name, over, label), y: { label: "stops", unit: "", whole: true }, series: [series(name, over, "stops", { kind: "points", size })] });
  return [amplitude, phase, stops];
}

function branchView(over, label) {
  const branch = tables.branch;
  if (!branch) return [];
  const stable = branch.get("stable").values;
  const where = (wanted) => ({ x: values("branch", over), y: values("branch", "x").map((x, i) => ((stable[i] === 1) === wanted ? x : null)) });
  const changes = tables.changes;
  const kinds = changes ? [...new Set(changes.get("kind").texts)] : [];
  return [chart({
    title: "Branch of steady states", wide: true, note: "found by arc length; what changes along it is marked",
    x: axis("branch", over, label), y: axis("branch", "x", "output amplitude x"),
    series: [{ label: "attracts", ...where(true), colour: 0 }, { label: "does not attract", kind: "dashed", ...where(false), colour: 3 },
      ...kinds.map((kind, i) => part("changes", over, "x", (get) => get("kind") === kind, { label: kind, kind: "points", colour: i + 1 }))],
  }), ...curveView("branch", over, label).slice(1)];
}

function mapView() {
  const { map, boundary } = tables;
  if (!map) return [];
  const [omega, Y, stops] = ["omega", "Y", "stops"].map((name) => map.get(name).values);
  const lines = { x: distinct(omega), y: distinct(Y) };
  const found = distinct(stops.filter((n) => n !== null));
  const log = { x: isGeometric(omega), y: isGeometric(Y) };
  const inside = (Y) => Y !== null && Y >= lines.y[0] && Y <= lines.y[lines.y.length - 1];
  return [chart({
    title: "Stops in a period", wide: true, note: "over forcing frequency and input amplitude",
    x: { ...axis("map", "omega", "frequency"), log: log.x }, y: { ...axis("map", "Y", "input amplitude Y"), log: log.y },
    series: [...found.map((n, i) => part("map", "omega", "Y", (get) => get("stops") === n, { label: n === 0 ? "no stop" : `${n} stops`, kind: "cells", lines, colour: i })),
      ...(boundary ? [{ label: "never sticks above", x: values("boundary", "omega"), y: values("boundary", "Y").map((Y) => (inside(Y) ? Y : null)), width: 2.5, colour: "--ink" }] : [])],
  })];
}

/** The 95 % ellipse of (zeta, F0). */
function ellipse(estimate) {
  const c = estimate.diagnostics.covariance;
  if (!c || c.flat().some((v) => v === null)) return null;
  const reach = Math.sqrt(5.991);  // chi-square with two degrees of freedom
  const l = Math.sqrt(Math.max(c[0][0], 0));
  if (!(l > 0)) return null;
  const m = c[0][1] / l;
  const n = Math.sqrt(Math.max(c[1][1] - m * m, 0));
  const angles = Array.from({ length: 121 }, (_, i) => (2 * Math.PI * i) / 120);
  return { x: angles.map((a) => estimate.zeta + reach * l * Math.cos(a)), y: angles.map((a) => estimate.F0 + reach * (m * Math.cos(a) + n * Math.sin(a))) };
}

function estimateTable(estimates) {
  const both = (value, interval, path) => ({
    text: value === null ? "–" : make("span", {}, short(value, 5),
      interval && interval[0] !== null ? make("small", { class: "under" }, ` ${short(interval[0], 4)} to ${short(interval[1], 4)}`) : null), path, value });
  return grid(["method", "", "ζ (95 %)", "c [N.s/m] (95 %)", "x_f [m]", "F0 [N] (95 %)", "because"],
    estimates.map((e, i) => [
      { text: e.method, class: "text" },
      { text: e.usable ? "✓ usable" : "✗ not usable", class: `text ${e.usable ? "good" : "bad"}` },
      both(e.zeta, e.interval95?.zeta, `estimates[${i}].zeta`), both(e.c, e.interval95?.c, `estimates[${i}].c`),
      both(e.x_f, null, `estimates[${i}].x_f`), both(e.F0, e.interval95?.F0, `estimates[${i}].F0`),
      { text: e.diagnostics.reason, class: "long" }]), { caption: "Estimates" });
}

/** Curves that came with the estimates: METHOD_NAME.csv, the first column against each of the others. */
function estimateCurves(estimates) {
  const out = [];
  for (const { method } of estimates) for (const [name, { columns }] of Object.entries(tables)) {
    if (!name.startsWith(`${method}_`) || columns.length < 2) continue;
    const [x, ...rest] = columns;
    out.push(chart({ title: `${name.slice(method.length + 1).replaceAll("_", " ")}, ${method}`,
      x: { label: x.name, unit: x.unit }, y: { label: rest.map((column) => column.name).join(", "), unit: rest[0].unit },
      series: rest.map((column, i) => ({ label: column.name, x: x.values, y: column.values, width: 1.1,
        kind: column.name === "measured" ? "points" : i > 0 ? "dashed" : "line" })) }));
  }
  return out;
}

function fitCharts({ fit, estimates }) {
  if (!fit?.points?.length) return [];
  const { points } = fit;
  const chosen = estimates.find((e) => e.method === fit.method);
  const excluded = new Set(chosen.diagnostics.excluded.map((e) => e.number));
  const isPairs = points[0].Y !== undefined;
  const x = (p) => (isPairs ? p.Y : p.number);
  const sorted = [...points].sort((a, b) => x(a) - x(b));
  const used = points.filter((p) => !excluded.has(p.number));
  const left = points.filter((p) => excluded.has(p.number));
  const label = isPairs ? { label: "input amplitude Y", unit: "m" } : { label: "number of the extreme", unit: "", whole: true };
  const pick = (list, get) => ({ x: list.map(x), y: list.map(get) });
  return [
    chart({ title: isPairs ? "x-Y data and fit" : "Extremes and fit", note: fit.method, wide: true, x: label, y: { label: isPairs ? "output amplitude x" : "extreme x", unit: "m" },
      series: [{ label: "fit", ...pick(sorted, (p) => p.fitted), colour: 0 }, { label: "used", kind: "points", ...pick(used, (p) => p.x), colour: 1 },
        { label: "left out", kind: "open", ...pick(left, (p) => p.x), colour: 6 }] }),
    chart({ title: "Residuals", note: fit.method, x: label, y: { label: "data − fit", unit: "m" },
      series: [{ label: "used", kind: "points", ...pick(used, (p) => (p.fitted === null ? null : p.x - p.fitted)), colour: 1 }] }),
  ];
}

function subsetCharts(estimates) {
  return estimates.filter((e) => e.diagnostics.subsets?.length > 1).map((e) => {
    const { subsets } = e.diagnostics;
    const at = subsets.map((_, i) => i + 1);
    const damping = subsets.some((s) => s.zeta !== null) ? ["zeta", "ζ", ""] : ["c", "c", "N.s/m"];
    return [damping, ["F0", "F0", "N"]].map(([key, label, unit], colour) => chart({
      title: `${label} from parts of the data`, note: `${e.method}; ${subsets.map((s, i) => `${i + 1}: ${s.label}`).join(", ")}`,
      x: { label: "part", unit: "", whole: true }, y: { label, unit }, series: [{ label, x: at, y: subsets.map((s) => s[key]), kind: "points", colour }] }));
  }).flat();
}

function identifyView(result) {
  const { estimates } = result;
  // The covariance is that of the damping ratio: without a spring there is none.
  const known = estimates.filter((e) => e.zeta !== null && e.F0 !== null);
  const series = known.flatMap((e, i) => {
    const around = ellipse(e);
    return [{ label: e.method, kind: e.usable ? "points" : "open", x: [e.zeta], y: [e.F0], colour: i },
      ...(around ? [{ label: e.method, ...around, width: 1, colour: i }] : [])];
  });
  return [...fitCharts(result),
    known.length ? chart({ title: "Damping ratio and friction force", note: "the 95 % ellipse: the two are correlated; open where the method does not stand by its number",
      x: { label: "ζ", unit: "" }, y: { label: "F0", unit: "N" }, series }) : null,
    ...estimateCurves(estimates), ...subsetCharts(estimates)];
}

function furtherTables({ estimates }) {
  const out = [];
  for (const e of estimates ?? []) {
    const { others, candidates } = e.diagnostics;
    if (others?.length)
      out.push(heading(`Further parameters, ${e.method}`), grid(["parameter", "value", "unit", "standard error", "95 %"],
        others.map((o) => [o.name, o.value, o.unit, o.std, o.interval95 ? `${short(o.interval95[0], 5)} to ${short(o.interval95[1], 5)}` : null])));
    if (candidates?.length)
      out.push(heading(`Laws compared, ${e.method}`), grid(["law", "weight", "AICc", "BIC", "residual deviation [m]", "parameters"],
        candidates.map((c) => [c.law, c.weight, c.AICc, c.BIC, c.residual_deviation, c.parameters.map((p) => `${p.name} ${short(p.value, 4)} ${p.unit}`).join(", ")])));
  }
  return out;
}

const views = {
  simulate: simulateView,
  steady_state: () => orbitView(),
  xy_curve: () => curveView("curve", "Y", "input amplitude Y"),
  frequency_response: () => curveView("curve", "omega", "frequency"),
  regime_map: mapView,
  xy_branch: () => branchView("Y", "input amplitude Y"),
  frequency_branch: () => branchView("omega", "frequency"),
  free_decay: () => [chart({ title: "Extremes", wide: true, x: axis("peaks", "t", "time"), y: axis("peaks", "x", "extreme x"),
    series: [series("peaks", "t", "x", { label: "extremes", kind: "points" }), series("peaks", "t", "x", { label: "extremes", width: 1, colour: 6 })] })],
  identify: identifyView,
  stress_test: severityCharts,
  mechanisms: mechanismCharts,
};

function orbitView() {
  if (!tables.orbit) return [];
  const plot = (title, x, y, labels, more = {}) => chart({ title, x: axis("orbit", x, labels[0]), y: axis("orbit", y, labels[1]), series: [series("orbit", x, y)], ...more });
  return [
    chart({ title: "One period", wide: true, x: axis("orbit", "t", "time t"), y: axis("orbit", "x", "displacement"),
      series: [series("orbit", "t", "x", { label: "mass x" }), series("orbit", "t", "y", { label: "base y", kind: "dashed" })] }),
    plot("Phase plane", "x", "v", ["displacement x", "velocity v"]),
    plot("Friction over velocity", "v", "friction", ["velocity v", "friction force"], { note: "the force against the motion" }),
    plot("Friction over displacement", "x", "friction", ["displacement x", "friction force"]),
  ];
}
