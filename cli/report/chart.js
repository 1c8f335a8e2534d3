// One kind of chart: lines, points and cells over any x, drawn as SVG by d3 (copyright 2010-2016 Michael Bostock, BSD 3-clause license).
//
// A series is {label, x, y, kind, colour}: kind "line", "dashed", "points", "open" (excluded data), "bars" (with
// `low` and `high`), "cells" (of a grid whose lines are `lines.x` and `lines.y`). Series of one label share a key of the legend.
// A drag with the mouse zooms; a double click or the button shows all; keys: +, -, 0 and the arrows.

const charts = [];

const ink = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
/** The colour of a series: a number, the name of a colour of the page, or any colour of CSS. */
const colour = (which) => (typeof which === "number" ? `var(--c${which % 14})` : which.startsWith("--") ? `var(${which})` : which);

const isNumber = (value) => value !== null && Number.isFinite(value);

/** The smallest and the largest finite number, with a margin; on a logarithmic axis the margin is a factor. */
function extent(lists, { log, whole, names, isTime }) {
  if (names) return [0.5, names.length + 0.5];
  let low = Infinity;
  let high = -Infinity;
  for (const list of lists) for (const value of list) {
    if (!isNumber(value)) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (low > high) return [0, 1];
  if (log) return [low / 1.05, high * 1.05];
  const span = Math.max(high - low, 1);
  if (whole) return [low - 0.05 * span, low + 1.05 * span]; // counts that are all 0 have no negative part
  // The labels of a narrower span would have more digits than fit, and its curve is one of rounding. Times may be counted from long ago.
  const size = Math.max(Math.abs(low), Math.abs(high));
  const room = high - low > (isTime ? 0 : 1e-5 * size) ? 0.05 * (high - low) : 0.1 * size || 1;
  return [low - room, high + room];
}

/** The distinct numbers in ascending order. */
const distinct = (list) => [...new Set(list)].sort((a, b) => a - b);

/** Whether a logarithmic axis suits the numbers: their ratios, rather than their differences, are even. */
function isGeometric(list) {
  const steps = distinct(list.filter((v) => v !== null));
  if (steps.length < 4 || steps[0] <= 0 || steps[steps.length - 1] < 8 * steps[0]) return false;
  return Math.abs(Math.log((steps[1] / steps[0]) / (steps[steps.length - 1] / steps[steps.length - 2]))) < 0.2;
}

/** x and y in readable units, the axes' labels with them. */
function scaled(spec) {
  const axisOf = (axis, lists) => {
    const { unit, factor } = axis.asWritten ? { unit: axis.unit, factor: 1 } : readable(axis.unit, largest(lists), axis.column);
    const shown = unit && unit !== "1" ? unit : "";
    return { unit: shown, factor, text: axis.label + (shown ? ` [${shown}]` : ""), log: axis.log ?? false, whole: axis.whole ?? false, names: axis.names, isTime: axis.unit === "s" };
  };
  const x = axisOf(spec.x, spec.series.map((s) => s.x));
  const y = axisOf(spec.y, spec.series.map((s) => s.y));
  const times = (list, factor) => list?.map((v) => (v === null ? null : v * factor));
  return {
    x, y,
    series: spec.series.map((s) => ({
      ...s, x: times(s.x, x.factor), y: times(s.y, y.factor), low: times(s.low, y.factor), high: times(s.high, y.factor),
      lines: s.lines && { x: times(s.lines.x, x.factor), y: times(s.lines.y, y.factor) },
    })),
  };
}

/** 1, 2 and 5 times the powers of ten inside a range; only the powers if there would be too many. */
function decades([low, high]) {
  const steps = high / low > 1e4 ? [1] : [1, 2, 5];
  const list = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power += 1)
    for (const step of steps) list.push(Number(`${step}e${power}`));
  return list.filter((v) => v >= low && v <= high);
}

/** The positions of the labels of an axis: about `count` round numbers. */
function ticksOf(axis, range, count) {
  if (axis.names) return axis.names.map((_, i) => i + 1).filter((v) => v >= range[0] && v <= range[1]);
  const places = axis.log ? decades(range) : [];
  if (places.length > 2) return places;
  const round = d3.scale.linear().domain(range).ticks(count);
  return axis.whole ? round.filter(Number.isInteger) : round;
}

/** The labels of an axis: names, or numbers with as many digits as their steps need to differ. */
function tickTexts(splits, { names } = {}) {
  if (names) return splits.map((v) => names[v - 1]);
  const [first, last] = [splits[0], splits[splits.length - 1]];
  const step = Math.abs(last - first) / Math.max(splits.length - 1, 1);
  const digits = Math.min(15, Math.max(6, Math.ceil(Math.log10(Math.max(Math.abs(first), Math.abs(last)) / step)) + 2)) || 6;
  return splits.map((v) => (v === null ? "" : Math.abs(v) < 1e-12 * Math.abs(last - first) ? "0" : short(v, digits)));
}

/** A coordinate on the screen, to a hundredth of a pixel. Coordinates far outside the chart are limited. */
const pixel = (v) => Math.max(-1e5, Math.min(1e5, Math.round(100 * v) / 100));

/** The points of a series on the screen: [x, y, index]; null for a missing point. */
function places(s, scales) {
  return s.x.map((x, i) => {
    if (!isNumber(x) || !isNumber(s.y[i])) return null;
    const at = [scales.x(x), scales.y(s.y[i])];
    return at.every(Number.isFinite) ? [...at.map(pixel), i] : null;
  });
}

/** Begin and end of cell i of the grid lines on the screen: half way to the neighbours. */
function sides(lines, i) {
  const before = i > 0 ? (lines[i] + lines[i - 1]) / 2 : lines[i] - (lines[1] - lines[0]) / 2;
  const after = i + 1 < lines.length ? (lines[i] + lines[i + 1]) / 2 : lines[i] + (lines[i] - lines[i - 1]) / 2;
  return before < after ? [before, after] : [after, before];
}

function cellsPath(s, scales) {
  const [columns, rows] = ["x", "y"].map((k) => s.lines[k].map((v) => scales[k](v)));
  const [column, row] = ["x", "y"].map((k) => new Map(s.lines[k].map((v, i) => [v, i])));
  return s.x.map((x, i) => {
    const [left, right] = sides(columns, column.get(x)).map(pixel);
    const [top, bottom] = sides(rows, row.get(s.y[i])).map(pixel);
    return `M${left},${top}H${right}V${bottom}H${left}Z`;
  }).join("");
}

/** A ring around a point. */
const circle = ([x, y], r) => `M${x - r},${y}a${r},${r} 0 1,0 ${2 * r},0a${r},${r} 0 1,0 ${-2 * r},0`;

/** The whole path of a series as one element of the page, also for 5,000 points. */
function pathOf(s, scales) {
  if (s.kind === "cells") return cellsPath(s, scales);
  const at = places(s, scales);
  if (s.kind === "line" || s.kind === "dashed") {
    const alone = at.filter((p, i) => p && !at[i - 1] && !at[i + 1]);  // through one point there is no line
    return (d3.svg.line().defined((p) => p !== null)(at) ?? "") + alone.map((p) => circle(p, 2)).join("");
  }
  const bar = ([x, , i]) => `M${x},${pixel(scales.y(s.low[i]))}V${pixel(scales.y(s.high[i]))}`;
  const marks = at.filter((p) => p !== null);
  return marks.map((p) => (s.kind === "bars" ? bar(p) : "") + circle(p, s.size ?? 3)).join("");
}

/** The drawing function of each kind. */
function styleOf(s) {
  const paint = colour(s.colour);
  const line = { stroke: paint, "stroke-width": s.width ?? 1.6, fill: "none" };
  return {
    line: { ...line, "stroke-linejoin": "round" }, dashed: { ...line, "stroke-dasharray": "6 4" }, open: line,
    points: { stroke: paint, "stroke-width": 1, fill: paint }, bars: { ...line, fill: paint },
    cells: { stroke: paint, "stroke-width": 0.5, fill: paint },
  }[s.kind];
}

/** Axes with their grid; returns the scales and the inner size. */
function drawAxes(svg, shape, ranges, width, height) {
  const yTicks = ticksOf(shape.y, ranges.y, Math.max(3, Math.round(height / 45)));
  const yTexts = tickTexts(yTicks, shape.y);
  const left = 36 + 7 * Math.max(2, ...yTexts.map((text) => text.length));
  const inner = { left, top: 8, width: width - left - 14, height: height - 8 - 44 };
  const scale = (k, span) => (shape[k].log ? d3.scale.log() : d3.scale.linear()).domain(ranges[k]).range(span);
  const scales = { x: scale("x", [0, inner.width]), y: scale("y", [inner.height, 0]) };
  const xTicks = ticksOf(shape.x, ranges.x, Math.max(3, Math.round(inner.width / 85)));
  const place = svg.append("g").attr("transform", `translate(${left},8)`);
  const axis = (k, orient, ticks, texts, size) => place.append("g").attr("class", "axis").call(
    d3.svg.axis().scale(scales[k]).orient(orient).tickValues(ticks).tickFormat((v, i) => texts[i]).innerTickSize(-size).outerTickSize(0).tickPadding(7));
  axis("x", "bottom", xTicks, tickTexts(xTicks, shape.x), inner.height).attr("transform", `translate(0,${inner.height})`);
  axis("y", "left", yTicks, yTexts, inner.width);
  const label = (text, transform) => place.append("text").attr("class", "label").attr("transform", transform).text(text);
  label(shape.x.text, `translate(${inner.width / 2},${inner.height + 40})`);
  label(shape.y.text, `translate(${14 - left},${inner.height / 2}) rotate(-90)`);
  return { place, scales, inner };
}

/** The point nearest to a position on the screen, for the readout. */
function nearest(shape, scales, hidden, [left, top]) {
  let best = null;
  for (const s of shape.series) {
    if (hidden.has(s.label)) continue;
    for (const p of places(s, scales)) {
      const d = p === null ? Infinity : Math.hypot(p[0] - left, p[1] - top);
      if (d < (best?.d ?? 40)) best = { d, s, p, x: s.x[p[2]], y: s.y[p[2]] };
    }
  }
  return best;
}

const withUnit = (value, { unit, names }) => (names ? names[value - 1] : short(value) + (unit ? ` ${unit}` : ""));

/** Zoom and pan. `ranges`: the ranges that the scales show. */
function navigation(shape, ranges, full, redraw) {
  const set = (x, y) => { ranges.x = x; ranges.y = y; redraw(); };
  // Both act on the numbers, or on their logarithms on a logarithmic axis.
  const moved = (k, change) => {
    const isLog = shape[k].log;
    return change(ranges[k].map((v) => (isLog ? Math.log(v) : v))).map((v) => (isLog ? Math.exp(v) : v));
  };
  const zoom = (factor) => set(...["x", "y"].map((k) => moved(k, ([a, b]) => [a, b].map((v) => (a + b) / 2 + (v - (a + b) / 2) * factor))));
  const pan = (dx, dy) => set(...[["x", dx], ["y", dy]].map(([k, by]) => moved(k, ([a, b]) => [a + by * (b - a), b + by * (b - a)])));
  return { set, zoom, pan, all: () => set(full.x, full.y) };
}

function listenToKeys(plot, { zoom, pan, all }) {
  const keys = {
    "+": () => zoom(0.7), "=": () => zoom(0.7), "-": () => zoom(1 / 0.7), 0: all,
    ArrowLeft: () => pan(-0.1, 0), ArrowRight: () => pan(0.1, 0), ArrowUp: () => pan(0, 0.1), ArrowDown: () => pan(0, -0.1),
  };
  plot.addEventListener("keydown", (event) => {
    if (!keys[event.key] || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    keys[event.key]();
  });
  plot.addEventListener("dblclick", all);
}

/** A drag with the mouse selects the range to show. A finger scrolls the page. */
function listenToDrags({ place, scales }, set) {
  const brush = d3.svg.brush().x(scales.x).y(scales.y);
  brush.on("brushend", () => {
    const [[x0, y0], [x1, y1]] = brush.extent();
    const isDrag = Math.abs(scales.x(x1) - scales.x(x0)) > 8 && Math.abs(scales.y(y1) - scales.y(y0)) > 8;
    if (isDrag) set([x0, x1], [y0, y1]); else place.select(".brush").call(brush.clear());
  });
  place.append("g").attr("class", "brush").call(brush).on("touchstart.brush", null).selectAll(".resize").remove();
}

/** Values under the mouse, with their units, and a ring around their point. */
function listenToMouse(plot, readout, { place, scales }, shape, hidden) {
  const ring = place.append("circle").attr({ class: "ring", r: 6 }).style("display", "none");
  plot.onmousemove = ({ clientX, clientY }) => {
    const corner = place.node().getScreenCTM();
    const found = nearest(shape, scales, hidden, [(clientX - corner.e) / corner.a, (clientY - corner.f) / corner.d]);
    ring.style("display", found ? null : "none");
    if (found) ring.attr({ cx: found.p[0], cy: found.p[1] });
    readout.textContent = found ? `${found.s.label}: ${withUnit(found.x, shape.x)}, ${withUnit(found.y, shape.y)}` : "";
  };
}

/** The keys of the legend show and hide series; `hidden` holds the labels of those that are hidden. */
function fillLegend(legend, shape, hidden, redraw) {
  const labels = [...new Set(shape.series.map((s) => s.label))];
  if (labels.length < 2) return;
  legend.replaceChildren(...labels.map((label) => {
    const paint = colour(shape.series.find((s) => s.label === label).colour);
    const key = make("button", { type: "button", "aria-pressed": "true" }, make("i", { style: `background:${paint}` }), label);
    key.addEventListener("click", () => {
      if (!hidden.delete(label)) hidden.add(label);
      key.setAttribute("aria-pressed", String(!hidden.has(label)));
      redraw();
    });
    return key;
  }));
}

/** The drawing, as wide as its container. */
function drawPlot(plot, shape, ranges, hidden, isWide) {
  const width = Math.max(240, plot.clientWidth);
  const usual = Math.round(Math.min(420, Math.max(260, width * (isWide ? 0.4 : 0.62))));
  const height = Math.max(usual, 52 + 18 * (shape.y.names?.length ?? 0)); // a line of text for each name
  plot.replaceChildren();
  const svg = d3.select(plot).append("svg").attr({ viewBox: `0 0 ${width} ${height}`, width, height });
  const drawn = drawAxes(svg, shape, ranges, width, height);
  const clip = `clip${(drawPlot.count = (drawPlot.count ?? 0) + 1)}`;
  drawn.place.append("clipPath").attr("id", clip).append("rect").attr({ width: drawn.inner.width, height: drawn.inner.height });
  const series = drawn.place.append("g").attr("clip-path", `url(#${clip})`);
  for (const s of shape.series) if (!hidden.has(s.label)) series.append("path").attr({ class: "series", d: pathOf(s, drawn.scales) }).style(styleOf(s));
  return drawn;
}

/** A figure with a chart; spec {title, note, x: {label, unit, log, whole, names}, y likewise, series, wide}; `names` stand at 1, 2, ... */
function chart(spec) {
  const used = spec.series.filter((s) => s.y.some((v) => v !== null)).map((s, i) => ({ kind: "line", colour: i, ...s }));
  if (used.length === 0) return null;
  const shape = scaled({ ...spec, series: used });
  const full = { x: extent(shape.series.map((s) => s.x), shape.x), y: extent(shape.series.flatMap((s) => [s.y, s.low ?? [], s.high ?? []]), shape.y) };
  const [ranges, hidden] = [{ ...full }, new Set()];
  const count = used.reduce((sum, s) => sum + s.x.length, 0);
  const plot = make("div", {
    class: "plot", tabindex: 0, role: "img",
    "aria-label": `${spec.title}: ${shape.y.text} over ${shape.x.text}, ${count} points. Keys: plus and minus zoom, arrows move, 0 shows all.`,
  });
  const readout = make("div", { class: "readout", "aria-hidden": true });
  const legend = make("div", { class: "legend" });
  const draw = () => {
    const drawn = drawPlot(plot, shape, ranges, hidden, spec.wide);
    listenToDrags(drawn, move.set);
    listenToMouse(plot, readout, drawn, shape, hidden);
  };
  const move = navigation(shape, ranges, full, draw);
  listenToKeys(plot, move);
  fillLegend(legend, shape, hidden, draw);
  const button = (text, label, action) => {
    const element = make("button", { type: "button", "aria-label": `${label}: ${spec.title}` }, text);
    element.addEventListener("click", action);
    return element;
  };
  const tools = make("span", { class: "tools" }, button("+", "zoom in", () => move.zoom(0.7)), " ",
    button("−", "zoom out", () => move.zoom(1 / 0.7)), " ", button("all", "show all", move.all), " ",
    button("SVG", "save as SVG", () => saveSvg(plot, legend, spec.title)), " ", button("PNG", "save as PNG", () => savePng(plot, legend, spec.title)));
  charts.push(draw);
  return make("figure", { class: spec.wide ? "wide" : null },
    make("figcaption", {}, make("span", { class: "row" }, spec.title, tools), spec.note ? make("small", {}, spec.note) : null),
    plot, readout, legend);
}

function drawAll() {
  for (const draw of charts) draw();
}
