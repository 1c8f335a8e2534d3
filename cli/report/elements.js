// Small helpers that make parts of the page.

/** An element with attributes, and children that are elements or text. */
function make(name, attributes = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(attributes))
    if (value !== undefined && value !== null && value !== false) element.setAttribute(key, value === true ? "" : value);
  element.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return element;
}

/** A name that may break after its underscores. */
const breakable = (name) => String(name).split(/(?<=_)/).flatMap((part, i) => (i ? [make("wbr"), part] : [part]));

const heading = (text) => make("h2", {}, text);

/** Name, value and unit in boxes; each item {name, value, unit, path}. */
function numbers(items) {
  return make("dl", { class: "numbers" }, items.map(({ name, value, unit, path }) => {
    const shown = (typeof value === "number" && written(unit, Math.abs(value), path ?? name)) || { unit, factor: 1 };
    return make("div", {}, make("dt", {}, name),
      make("dd", { "data-path": path, "data-value": JSON.stringify(value), title: `${value}${unit && unit !== "1" ? ` ${unit}` : ""}` },
        short(typeof value === "number" ? value * shown.factor : value), shown.unit && shown.unit !== "1" ? ` ${shown.unit}` : ""));
  }));
}

/** A table with a head; cells are text, numbers, or {text, class, path, value}. */
function grid(head, rows, { tall = false, caption } = {}) {
  const cell = (content, tag, isText) => {
    const item = typeof content === "object" && content !== null && !(content instanceof Node) ? content : { text: content };
    const text = typeof item.text === "number" ? short(item.text) : item.text ?? "–";
    // Names of files may be longer than a window is wide.
    const isLong = tag === "td" && typeof text === "string" && text.length > 40;
    return make(tag, {
      class: [isText ? "text" : "", item.class ?? "", isLong && item.class !== "long" ? "long" : ""].join(" ").trim() || null, style: item.style, title: item.title,
      "data-path": item.path, "data-value": item.path ? JSON.stringify(item.value ?? item.text) : null,
      scope: tag === "th" ? "col" : null,
    }, tag === "th" ? breakable(text) : text);
  };
  const texts = head.map((_, i) => rows.every((row) => {
    const content = row[i]?.text ?? row[i];
    return typeof content !== "number" && content !== null && content !== undefined;
  }));
  return make("div", { class: tall ? "scroll tall" : "scroll", tabindex: 0, role: "region", "aria-label": caption ?? "table" },
    make("table", {}, make("thead", {}, make("tr", {}, head.map((name, i) => cell(name, "th", texts[i])))),
      make("tbody", {}, rows.map((row) => make("tr", {}, row.map((content, i) => cell(content, "td", texts[i])))))));
}

/** A table of the run, folded. A long table shows only its first rows. */
function folded(name, table, most = 500) {
  const { columns, rows, step } = table;
  const shown = Math.min(columns[0]?.values.length ?? 0, most);
  const all = shown === rows;
  const note = all ? "" : ` The page shows ${shown} of ${rows} rows${step > 1 ? `, every ${step}th` : ""}; all are in ${name}.csv.`;
  const units = unitsByRow(table);
  const besides = columns.map((column) => unitColumnOf(table, column));
  const text = (i, j) => {
    const numbersBeside = besides.indexOf(columns[j]);
    return numbersBeside < 0 ? columns[j].texts[i] : units[numbersBeside](i).unit;
  };
  const cell = (i, j) => (columns[j].isText ? text(i, j) : { text: columns[j].values[i] === null ? null : columns[j].values[i] * units[j](i).factor, title: columns[j].texts[i] });
  const body = Array.from({ length: shown }, (_, i) => columns.map((_, j) => cell(i, j)));
  const unitInHead = (j) => (besides[j] ? "" : units[j](0).unit);
  return make("details", {}, make("summary", {}, `${name}.csv, ${rows} row${rows === 1 ? "" : "s"}`),
    note ? make("p", { class: "soft" }, note.trim()) : null,
    grid(columns.map(({ name: title }, j) => title + (unitInHead(j) ? ` [${unitInHead(j)}]` : "")), body,
      { tall: true, caption: `${name}.csv` }));
}
