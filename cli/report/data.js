"use strict";
// The data of the page: the result document, and the tables by name.

const parse = (id) => JSON.parse(document.getElementById(id).textContent);

/** Fields of one line of CSV; a field in double quotes may hold commas, and a quote as two quotes. */
function fields(line) {
  const out = [];
  let at = 0;
  while (at <= line.length) {
    if (line[at] === '"') {
      let text = "";
      for (at += 1; at < line.length; at += 1) {
        if (line[at] !== '"') text += line[at];
        else if (line[at + 1] === '"') { text += '"'; at += 1; }
        else break;
      }
      out.push(text);
      at += 2;
    } else {
      let end = line.indexOf(",", at);
      if (end < 0) end = line.length;
      out.push(line.slice(at, end));
      at = end + 1;
    }
  }
  return out;
}

/** A table of the run: columns by name, each {name, unit, values, isText}; an empty field is null. */
function table({ csv, rows, step }) {
  const lines = csv.split("\n").filter((line) => line !== "");
  const columns = fields(lines[0]).map((heading) => {
    const [, name, unit] = heading.match(/^(.*?)(?: \[(.*)\])?$/);
    return { name, unit: unit ?? "", values: [] };
  });
  for (const line of lines.slice(1)) fields(line).forEach((text, i) => columns[i]?.values.push(text));
  for (const column of columns) {
    column.isText = column.values.some((text) => text !== "" && Number.isNaN(Number(text)));
    column.texts = column.values;
    if (!column.isText) column.values = column.texts.map((text) => (text === "" ? null : Number(text)));
  }
  const byName = Object.fromEntries(columns.map((column) => [column.name, column]));
  return { columns, rows, step, get: (name) => byName[name] };
}

const run = parse("document");

/** SI unit of a number of the result; `otherwise` if x is no angle. */
const unitAt = (path, otherwise) => run.units?.[path] ?? otherwise;
const tables = Object.fromEntries(Object.entries(parse("tables")).map(([name, text]) => [name, table(text)]));

/** A number with few digits. The exact one is in an attribute of the element. */
function short(value, digits = 6) {
  if (typeof value !== "number") return value === null || value === undefined ? "–" : String(value);
  const isTiny = value !== 0 && Math.abs(value) < 1e-4;
  const text = isTiny ? value.toExponential(digits - 1) : value.toPrecision(digits);
  // Only zeros after a decimal point are removed.
  return text.replace(/(\.\d*?)0+($|e)/, "$1$2").replace(/\.($|e)/, "$1").replace("-", "−").replace("e−", "e-");
}

/** Digits that show a value and its interval to a tenth of the half width or finer, so that the value stays inside. */
function digitsWithin(value, interval) {
  const [low, high] = interval ?? [];
  const half = (high - low) / 2;
  if (typeof low !== "number" || typeof high !== "number" || !(half > 0)) return 6;
  const largest = Math.max(Math.abs(value), Math.abs(low), Math.abs(high));
  return Math.min(15, Math.max(3, Math.floor(Math.log10(largest)) - Math.floor(Math.log10(half)) + 2));
}

const prefixes = [[1, ""], [1e-3, "m"], [1e-6, "µ"], [1e-9, "n"]];

/** The SI unit of a quantity, but "angular velocity" for that of an angle: its SI unit is also that of a frequency. */
const kindOf = (unit, name) => (unit === "rad/s" && /((^|\.)(v|max_speed)|velocity)(\[\d+\])?$/.test(name) ? "angular velocity" : unit);

/** The unit that the user wrote for such quantities, if numbers up to `largest` are legible in it. */
function written(unit, largest, name = "") {
  const told = run.shown_units?.[kindOf(unit, name)];
  const most = told ? largest * told.factor : 0;
  return told && (told.asked || most === 0 || (most >= 1e-3 && most < 1e6)) ? told : null;
}

/** Unit and factor for numbers up to `largest`: the unit that the user wrote, else a prefix: 0.004 m becomes 4 mm. */
function readable(unit, largest, name) {
  const told = written(unit, largest, name);
  if (told) return told;
  if (!["m", "m/s", "s", "N", "N.m", "J"].includes(unit) || !(largest > 0)) return { unit, factor: 1 };
  const [size, prefix] = prefixes.find(([scale]) => largest >= scale) ?? prefixes[prefixes.length - 1];
  return { unit: prefix + unit, factor: 1 / size };
}

function largest(lists) {
  let most = 0;
  for (const list of lists) for (const value of list) if (Math.abs(value) > most) most = Math.abs(value);
  return most;
}

/** Unit and factor for numbers of one quantity: the unit that the user wrote, else SI. */
const shownUnit = (unit, list, name) => written(unit, largest([list]), name) ?? { unit, factor: 1 };

/** "mass 1.2 kg, ratio 3": numbers of any quantities. */
function quantitiesText(list, digits, more = () => "") {
  return list.map((one) => {
    const { unit, factor } = shownUnit(one.unit, [one.value], one.name);
    return `${one.name} ${short(one.value * factor, digits)}${unit && unit !== "1" ? ` ${unit}` : ""}${more(one)}`;
  }).join(", ");
}

/** Numbers of a table whose unit is a text in their row. */
const hasUnitInRow = ({ name, unit, isText }) => !isText && unit === "" && /(^|\.)(value|std|rms|noise|(profile_)?(low|high)95|(interval|profile)95\[\d\])$/.test(name);

/** The column of these texts: beside `residual.rms` it is `residual.unit`. */
const unitColumnOf = ({ columns }, column) => (hasUnitInRow(column) ? columns.find(({ name, isText }) => isText && name === column.name.replace(/[^.]*$/, "unit")) : undefined);

/** For each column the unit and factor of its cells, by row. */
function unitsByRow(table) {
  const beside = table.columns.map((column) => unitColumnOf(table, column));
  const names = table.columns.find(({ name, isText }) => isText && name === "name");
  return table.columns.map((column, j) => {
    if (!beside[j]) {
      const whole = column.isText ? { unit: column.unit, factor: 1 } : shownUnit(column.unit, column.values, column.name);
      return () => whole;
    }
    const ofOneUnit = table.columns.filter((_, k) => beside[k] === beside[j]);
    return (i) => shownUnit(beside[j].texts[i], ofOneUnit.map(({ values: list }) => list[i]), names?.texts[i] ?? column.name);
  });
}
