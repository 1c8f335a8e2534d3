// Views: the parts of the page of an analysis. Each view is a file with the name of the analysis, beside its header and
// source, and adds itself here: {before, charts, after, said}, functions of the result. `before` and `after` return elements
// above and below the charts; `said` returns the warnings that another part of the page shows. All but `charts` may be absent.
// Without a result they are not called.

const values = (name, column) => tables[name]?.get(column)?.values;

/** A series from two columns of a table; nothing if a column is missing or holds texts. */
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

/** A series in the order of x: steady states stand in their table in any order. */
function inOrder({ x, y, ...more }) {
  const rows = x.map((_, i) => i).sort((a, b) => x[a] - x[b]);
  return { x: rows.map((i) => x[i]), y: rows.map((i) => y[i]), ...more };
}

/** A line with a gap where it jumps from one row to the next, since the motion between two samples is not known. */
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
const axis = (name, column, label = column) => ({ label, unit: unitOf(name, column), column });

/** A stepped curve: the way up and the way down, with their points. */
function steppedView(name, over, label) {
  const ways = [["up", 0, "line"], ["down", 1, "dashed"]].filter(([way]) => tables[name].get("direction").texts.includes(way));
  const ofBoth = (column) => ways.flatMap(([way, colour, kind]) => {
    const here = (get) => get("direction") === way;
    const shown = inOrder(part(name, over, column, here, { label: way, colour, kind }));
    return [shown, { ...shown, kind: "points", size: shown.x.length > 200 ? 1 : 2.5 }];
  });
  return [["x", "Output amplitude", "output amplitude x"], ["phase", "Phase", "phase"], ["stops", "Stops in a period", "stops"]]
    .filter(([column]) => values(name, column)).map(([column, title, text], i) => chart({
      title, wide: i === 0, note: i === 0 ? "each level starts from the steady state of the level before" : null,
      x: axis(name, over, label), y: { ...axis(name, column, text), whole: column === "stops" }, series: ofBoth(column),
    }));
}

/** Output amplitude over a column. Points with sticks are a series of their own; unstable parts are dashed. A branch joins its points in the order of its rows. */
function curveView(name, over, label) {
  const line = name === "branch" ? (one) => one : inOrder;
  const directions = tables[name]?.get("direction")?.texts;
  if (directions) return steppedView(name, over, label);
  const kinds = [
    { label: "slides through", kind: "points", colour: 0, keep: (get) => get("sticks") === 0 && get("stable") !== 0 },
    { label: "sticks in each period", kind: "open", colour: 1, keep: (get) => get("sticks") > 0 && get("stable") !== 0 },
    { label: "does not attract", kind: "open", colour: 3, keep: (get) => get("stable") === 0 },
  ];
  const size = (values(name, over)?.length ?? 0) > 200 ? 1.5 : 3;
  const amplitude = chart({
    title: "Output amplitude", wide: true, x: axis(name, over, label), y: axis(name, "x", "output amplitude x"),
    series: [line(series(name, over, "x", { label: "steady state", width: 1, colour: 6 })),
      ...kinds.map(({ keep, ...more }) => part(name, over, "x", keep, { size, ...more }))],
  });
  const phase = values(name, "phase") && chart({
    title: "Phase", note: "lag of the fundamental behind the excitation", x: axis(name, over, label), y: axis(name, "phase", "phase"), series: [line(series(name, over, "phase"))] });
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

/** The view of an analysis without its own: for each table, the next column of numbers over the first column. */
function viewOfTables() {
  return Object.entries(tables).flatMap(([name, { columns }]) => {
    const [x, y] = columns.filter(({ isText }) => !isText);
    return y ? [chart({ title: name, x: axis(name, x.name), y: axis(name, y.name), series: [series(name, x.name, y.name)] })] : [];
  });
}

const views = {};
