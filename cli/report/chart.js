// One kind of chart: curves and points over any x, drawn by uPlot in its mode for unordered data.
//
// A series is {label, x, y, kind, colour}: kind "line", "dashed", "points", "open" (excluded data), "bars" (with
// `low` and `high`), "cells" (of a grid whose lines are `lines.x` and `lines.y`). Series of one label share a key of the legend.
// Drag zooms, a double click or the button shows all; with the keyboard +, -, 0 and the arrows.

const charts = [];

const ink = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
/** Of a series: by number, or a colour of the page by its name. */
const colour = (which) => ink(typeof which === "string" ? which : `--c${which % 7}`);

/** Smallest and largest of the finite numbers, with a little room; a factor of room on a logarithmic axis. */
function extent(lists, isLog) {
  let low = Infinity;
  let high = -Infinity;
  for (const list of lists) for (const value of list) {
    if (value === null || !Number.isFinite(value)) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  if (low > high) return [0, 1];
  if (isLog) return [low / 1.05, high * 1.05];
  const room = high > low ? 0.05 * (high - low) : Math.abs(high) * 0.1 || 1;
  return [low - room, high + room];
}

/** Distinct numbers in order. */
const distinct = (list) => [...new Set(list)].sort((a, b) => a - b);

/** Numbers spread by a factor rather than by a distance: a logarithmic axis shows them better. */
function isGeometric(list) {
  const steps = distinct(list.filter((v) => v !== null));
  if (steps.length < 4 || steps[0] <= 0 || steps[steps.length - 1] < 8 * steps[0]) return false;
  return Math.abs(Math.log((steps[1] / steps[0]) / (steps[steps.length - 1] / steps[steps.length - 2]))) < 0.2;
}

/** Where cell number i of the grid lines ends on the screen: half way to the neighbours. */
function sides(places, i) {
  const before = i > 0 ? (places[i] + places[i - 1]) / 2 : places[i] - (places[1] - places[0]) / 2;
  const after = i + 1 < places.length ? (places[i] + places[i + 1]) / 2 : places[i] + (places[i] - places[i - 1]) / 2;
  return [before, after - before];
}

function drawSeries(spec) {
  return (u, index) => {
    uPlot.orient(u, index, (series, xs, ys, scaleX, scaleY, toX, toY, left, top, width, height) => {
      const { ctx } = u;
      const px = window.devicePixelRatio;
      const at = (i) => [toX(xs[i], scaleX, width, left), toY(ys[i], scaleY, height, top)];
      ctx.save();
      ctx.beginPath();
      ctx.rect(left, top, width, height);
      ctx.clip();
      ctx.strokeStyle = ctx.fillStyle = colour(spec.colour);
      ctx.lineWidth = (spec.width ?? 1.6) * px;
      ctx.lineCap = spec.kind === "dashed" ? "butt" : "round";
      ctx.beginPath();
      if (spec.kind === "line" || spec.kind === "dashed") {
        if (spec.kind === "dashed") ctx.setLineDash([6 * px, 4 * px]);
        let pen = false;
        for (let i = 0; i < xs.length; i += 1) {
          if (xs[i] === null || ys[i] === null) { pen = false; continue; }
          const [x, y] = at(i);
          if (!pen) ctx.moveTo(x, y);
          ctx.lineTo(x, y);
          pen = true;
        }
        ctx.stroke();
      } else if (spec.kind === "cells") {
        const [columns, rows] = [spec.lines.x.map((v) => toX(v, scaleX, width, left)), spec.lines.y.map((v) => toY(v, scaleY, height, top))];
        const [column, row] = [spec.lines.x, spec.lines.y].map((lines) => new Map(lines.map((v, i) => [v, i])));
        for (let i = 0; i < xs.length; i += 1) {
          const [x, w] = sides(columns, column.get(xs[i]));
          const [y, h] = sides(rows, row.get(ys[i]));
          ctx.fillRect(x, y, w + Math.sign(w) * 0.5, h + Math.sign(h) * 0.5);
        }
      } else {
        const radius = (spec.size ?? 3) * px;
        for (let i = 0; i < xs.length; i += 1) {
          if (xs[i] === null || ys[i] === null) continue;
          const [x, y] = at(i);
          if (spec.kind === "bars") {
            ctx.moveTo(x, toY(spec.low[i], scaleY, height, top));
            ctx.lineTo(x, toY(spec.high[i], scaleY, height, top));
          }
          ctx.moveTo(x + radius, y);
          ctx.arc(x, y, radius, 0, 2 * Math.PI);
        }
        if (spec.kind === "open") ctx.stroke(); else { ctx.stroke(); ctx.fill(); }
      }
      ctx.restore();
    });
    return null;
  };
}

/** x and y in readable units, the axes' labels with them. */
function scaled(spec) {
  const x = readable(spec.x.unit, largest(spec.series.map((s) => s.x)));
  const y = readable(spec.y.unit, largest(spec.series.map((s) => s.y)));
  const times = (list, factor) => list?.map((v) => (v === null ? null : v * factor));
  const label = (axis, { unit }) => axis.label + (unit && unit !== "1" ? ` [${unit}]` : "");
  return {
    xLabel: label(spec.x, x), yLabel: label(spec.y, y), xLog: spec.x.log ?? false, yLog: spec.y.log ?? false,
    xWhole: spec.x.whole ?? false, yWhole: spec.y.whole ?? false,
    series: spec.series.map((s) => ({
      ...s, x: times(s.x, x.factor), y: times(s.y, y.factor), low: times(s.low, y.factor), high: times(s.high, y.factor),
      lines: s.lines && { x: times(s.lines.x, x.factor), y: times(s.lines.y, y.factor) },
    })),
  };
}

/** 1, 2 and 5 times the powers of ten inside a range; only the powers where that would be too many. */
function decades([low, high]) {
  const steps = high / low > 1e4 ? [1] : [1, 2, 5];
  const list = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.log10(high); power += 1)
    for (const step of steps) list.push(Number(`${step}e${power}`));
  return list.filter((v) => v >= low && v <= high);
}

const wholeSteps = [1, 2, 5].map((n) => [n, 10 * n, 100 * n, 1000 * n, 1e4 * n, 1e5 * n]).flat().sort((a, b) => a - b);

/** The labels of an axis, with as many digits as its steps need to differ. */
function tickTexts(splits) {
  const [first, last] = [splits[0], splits[splits.length - 1]];
  const step = Math.abs(last - first) / Math.max(splits.length - 1, 1);
  const digits = Math.min(15, Math.max(6, Math.ceil(Math.log10(Math.max(Math.abs(first), Math.abs(last)) / step)) + 2)) || 6;
  return splits.map((v) => (v === null ? "" : Math.abs(v) < 1e-12 * Math.abs(last - first) ? "0" : short(v, digits)));
}

function options(shape, ranges, width, height) {
  const axis = (label, side, isLog, isWhole, range) => ({
    // uPlot's own go astray between the powers of ten.
    ...(isLog ? { splits: () => decades(range()), filter: (u, splits) => splits } : {}),
    ...(isWhole ? { incrs: wholeSteps } : {}),
    label, labelSize: 22, space: side ? 34 : 80,
    size: (u, texts) => (side ? Math.max(40, 22 + 7 * Math.max(0, ...(texts ?? []).map((text) => text?.length ?? 0))) : 34), stroke: () => ink("--soft"), font: "12px system-ui", labelFont: "13px system-ui",
    grid: { stroke: () => ink("--line"), width: 1 }, ticks: { stroke: () => ink("--line"), width: 1 },
    values: (u, splits) => tickTexts(splits),
  });
  return {
    mode: 2, width, height, legend: { show: false }, padding: [8, 12, 0, 0],
    scales: { x: { time: false, distr: shape.xLog ? 3 : 1, range: () => ranges.x }, y: { distr: shape.yLog ? 3 : 1, range: () => ranges.y } },
    axes: [axis(shape.xLabel, false, shape.xLog, shape.xWhole, () => ranges.x), axis(shape.yLabel, true, shape.yLog, shape.yWhole, () => ranges.y)],
    cursor: { drag: { x: false, y: false, setScale: false }, points: { show: false }, x: false, y: false },
    series: [{}, ...shape.series.map((s) => ({
      label: s.label, show: true, stroke: () => colour(s.colour), paths: drawSeries(s), points: { show: false },
      facets: [{ scale: "x", auto: true }, { scale: "y", auto: true }],
    }))],
  };
}

/** The point nearest to a place on the screen, for the readout. */
function nearest(u, shape, left, top) {
  let best = null;
  shape.series.forEach((s, index) => {
    if (!u.series[index + 1].show) return;
    for (let i = 0; i < s.x.length; i += 1) {
      if (s.x[i] === null || s.y[i] === null) continue;
      const d = Math.hypot(u.valToPos(s.x[i], "x") - left, u.valToPos(s.y[i], "y") - top);
      if (!best || d < best.d) best = { d, s, x: s.x[i], y: s.y[i] };
    }
  });
  return best && best.d < 40 ? best : null;
}

/** Zoom and pan: `ranges` is what the scales show. */
function navigation(u, ranges, full, plot, redraw) {
  const set = (x, y) => { ranges.x = x; ranges.y = y; redraw(); };
  const all = () => set(full.x, full.y);
  // Both act on what the axis is linear in.
  const moved = (k, change) => {
    const isLog = u.scales[k].distr === 3;
    return change(ranges[k].map((v) => (isLog ? Math.log(v) : v))).map((v) => (isLog ? Math.exp(v) : v));
  };
  const zoom = (factor) => set(...["x", "y"].map((k) => moved(k, ([a, b]) => [a, b].map((v) => (a + b) / 2 + (v - (a + b) / 2) * factor))));
  const pan = (dx, dy) => set(...[["x", dx], ["y", dy]].map(([k, by]) => moved(k, ([a, b]) => [a + by * (b - a), b + by * (b - a)])));
  const keys = {
    "+": () => zoom(0.7), "=": () => zoom(0.7), "-": () => zoom(1 / 0.7), 0: all,
    ArrowLeft: () => pan(-0.1, 0), ArrowRight: () => pan(0.1, 0), ArrowUp: () => pan(0, 0.1), ArrowDown: () => pan(0, -0.1),
  };
  plot.onkeydown = (event) => {
    if (!keys[event.key] || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    keys[event.key]();
  };
  plot.ondblclick = all;
  let from = null;
  u.over.addEventListener("pointerdown", (event) => { from = { x: event.offsetX, y: event.offsetY, pointer: event.pointerType }; });
  u.over.addEventListener("pointermove", (event) => {
    if (!from || from.pointer === "touch") return;
    const [l, t] = [Math.min(from.x, event.offsetX), Math.min(from.y, event.offsetY)];
    u.setSelect({ left: l, top: t, width: Math.abs(event.offsetX - from.x), height: Math.abs(event.offsetY - from.y) }, false);
  });
  u.over.addEventListener("pointerup", (event) => {
    if (!from) return;
    const [w, h] = [Math.abs(event.offsetX - from.x), Math.abs(event.offsetY - from.y)];
    if (from.pointer !== "touch" && w > 8 && h > 8) {
      const sorted = (a, b) => (a < b ? [a, b] : [b, a]);
      set(sorted(u.posToVal(from.x, "x"), u.posToVal(event.offsetX, "x")), sorted(u.posToVal(from.y, "y"), u.posToVal(event.offsetY, "y")));
    }
    from = null;
    u.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
  });
  return { all, zoom };
}

/** A figure with a chart; spec {title, note, x: {label, unit, log, whole}, y likewise, series, wide}. */
function chart(spec) {
  const used = spec.series.filter((s) => s.y.some((v) => v !== null)).map((s, i) => ({ kind: "line", colour: i, ...s }));
  if (used.length === 0) return null;
  const shape = scaled({ ...spec, series: used });
  const full = { x: extent(shape.series.map((s) => s.x), shape.xLog), y: extent(shape.series.flatMap((s) => [s.y, s.low ?? [], s.high ?? []]), shape.yLog) };
  const ranges = { ...full };
  const count = used.reduce((sum, s) => sum + s.x.length, 0);
  const plot = make("div", {
    class: "plot", tabindex: 0, role: "img",
    "aria-label": `${spec.title}: ${shape.yLabel} over ${shape.xLabel}, ${count} points. Keys: plus and minus zoom, arrows move, 0 shows all.`,
  });
  const readout = make("div", { class: "readout", "aria-hidden": true });
  const legend = make("div", { class: "legend" });
  const tools = make("span", { class: "tools" });
  const figure = make("figure", { class: spec.wide ? "wide" : null },
    make("figcaption", {}, make("span", { class: "row" }, spec.title, tools), spec.note ? make("small", {}, spec.note) : null),
    plot, readout, legend);
  const draw = () => {
    plot.replaceChildren();
    const width = Math.max(240, plot.clientWidth);
    const u = new uPlot(options(shape, ranges, width, Math.min(420, Math.max(260, width * (spec.wide ? 0.4 : 0.62)))),
      [null, ...shape.series.map((s) => [s.x, s.y])], plot);
    const redraw = () => { u.setScale("x", { min: ranges.x[0], max: ranges.x[1] }); u.setScale("y", { min: ranges.y[0], max: ranges.y[1] }); };
    const { all, zoom } = navigation(u, ranges, full, plot, redraw);
    const button = (text, label, action) => {
      const element = make("button", { type: "button", "aria-label": `${label}: ${spec.title}` }, text);
      element.addEventListener("click", action);
      return element;
    };
    tools.replaceChildren(button("+", "zoom in", () => zoom(0.7)), " ", button("−", "zoom out", () => zoom(1 / 0.7)), " ", button("all", "show all", all));
    u.over.addEventListener("mousemove", (event) => {
      const found = nearest(u, shape, event.offsetX, event.offsetY);
      readout.textContent = found ? `${found.s.label}: ${short(found.x)}, ${short(found.y)}` : "";
    });
    const labels = [...new Set(shape.series.map((s) => s.label))];
    legend.replaceChildren(...(labels.length < 2 ? [] : labels.map((label) => {
      const colourOf = colour(shape.series.find((s) => s.label === label).colour);
      const key = make("button", { type: "button", "aria-pressed": "true" }, make("i", { style: `background:${colourOf}` }), label);
      key.addEventListener("click", () => {
        const show = key.getAttribute("aria-pressed") !== "true";
        key.setAttribute("aria-pressed", String(show));
        shape.series.forEach((s, i) => { if (s.label === label) u.setSeries(i + 1, { show }); });
      });
      return key;
    })));
  };
  charts.push(draw);
  return figure;
}

function drawAll() {
  for (const draw of charts) draw();
}
