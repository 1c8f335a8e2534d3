// A sweep: single numbers over the swept key, or as maps over two keys; curves of all points in one chart.

/** The swept keys that have more than one value; columns of sweep.csv. */
const sweptKeys = () => Object.keys(run.scenario.sweep).filter((key) => distinct(values("sweep", key)).length > 1);

/** Swept numbers are in the unit that the user wrote. */
const sweptAxis = (key) => ({ label: key, unit: unitOf("sweep", key), asWritten: true, log: isGeometric(values("sweep", key)) });

/** The first columns with numbers that change; those that the chart of the analysis shows come first. */
function sweptNumbers() {
  const swept = Object.keys(run.scenario.sweep);
  const numbers = tables.sweep.columns.slice(swept.length + 1).filter(({ name, isText, values: list }) => !isText && name !== "reason" && !name.startsWith("certificate.") && list.some(isNumber));
  const changing = numbers.filter(({ values: list }) => distinct(list.filter(isNumber)).length > 1);
  return (changing.length ? changing : numbers).slice(0, 6);
}

function overOneKey(key) {
  return sweptNumbers().map(({ name }, i) => chart({
    title: name, wide: i === 0, x: sweptAxis(key), y: axis("sweep", name),
    series: [inOrder(series("sweep", key, name, { label: name, width: 1, colour: 6 })), series("sweep", key, name, { label: name, kind: "points" })],
  }));
}

/** Curves over one key, one for each of the few values of the other. */
function curvesOverKeys([key, other]) {
  const few = distinct(values("sweep", other));
  return sweptNumbers().map(({ name }, i) => chart({
    title: name, wide: i === 0, x: sweptAxis(key), y: axis("sweep", name),
    series: few.flatMap((value, n) => ["line", "points"].map((kind) => inOrder(part("sweep", key, name, (get) => get(other) === value,
      { label: `${other.split(".").pop()} = ${short(value)} ${unitOf("sweep", other)}`.trim(), colour: n, kind, width: 1 })))),
  }));
}

function overTwoKeys(keys) {
  const counts = keys.map((key) => distinct(values("sweep", key)).length);
  if (Math.min(...counts) > 6) return sweptNumbers().slice(0, 4).map((column) => mapOf(column, keys));
  return curvesOverKeys(counts[0] < counts[1] ? [keys[1], keys[0]] : keys);
}

/** Colour from violet to yellow for 0 to 1, visible on light and dark backgrounds. */
const ramp = (t) => `hsl(${Math.round(265 - 210 * t)} 60% ${Math.round(35 + 25 * t)}%)`;

/** A number over two keys, as cells in steps of colour. */
function mapOf({ name, unit, values: list }, keys) {
  const [x, y] = keys.map((key) => values("sweep", key));
  const lines = { x: distinct(x), y: distinct(y) };
  const [low, high] = [Math.min(...list.filter(isNumber)), Math.max(...list.filter(isNumber))];
  const steps = Math.min(9, distinct(list.filter(isNumber)).length);
  const step = (v) => (high > low ? Math.min(steps - 1, Math.floor((steps * (v - low)) / (high - low))) : 0);
  const { unit: shown, factor } = readable(unit, largest([list]), name);
  const edge = (i) => short(factor * (low + (i * (high - low)) / steps), 3);
  const cells = (keep, more) => {
    const rows = list.map((_, i) => i).filter((i) => keep(list[i]));
    return { kind: "cells", lines, x: rows.map((i) => x[i]), y: rows.map((i) => y[i]), ...more };
  };
  return chart({
    title: name + (shown && shown !== "1" ? ` [${shown}]` : ""), wide: true, x: sweptAxis(keys[0]), y: sweptAxis(keys[1]),
    series: [...Array.from({ length: steps }, (_, i) => cells((v) => v !== null && step(v) === i, { label: `${edge(i)} to ${edge(i + 1)}`, colour: ramp(steps > 1 ? i / (steps - 1) : 0) })),
      cells((v) => v === null, { label: "no result", colour: "--ink" })].filter((s) => s.x.length > 0),
  });
}

/** A selection of the curves, if there are many. */
function curvesOf({ name, x, y, by_x: isByX, points }) {
  const swept = Object.keys(run.scenario.sweep);
  const all = distinct(values(name, "point"));
  const shown = all.filter((point) => points.includes(point));
  const label = (point) => swept.map((key) => `${key.split(".").pop()} = ${short(values("sweep", key)[point])} ${unitOf("sweep", key)}`.trim()).join(", ");
  return chart({
    title: `${y} over ${x}`, wide: true, note: shown.length < all.length ? `${shown.length} of ${all.length} curves; all are in ${name}.csv` : null,
    x: axis(name, x), y: axis(name, y),
    series: shown.map((point, i) => part(name, x, y, (get) => get("point") === point, { label: label(point), colour: shown.length <= 7 ? i : ramp(i / (shown.length - 1)) })).map((one) => (isByX ? inOrder(one) : one)),
  });
}

function sweepView() {
  if (!tables.sweep) return [];
  const keys = sweptKeys();
  const numbers = keys.length === 2 ? overTwoKeys(keys) : keys.length === 1 ? overOneKey(keys[0]) : [];
  const curves = run.swept_curves;
  return curves && tables[curves.name] ? [curvesOf(curves), ...numbers] : numbers;
}

views.sweep = { charts: sweepView };
