// Measured and fitted curves, drawn over each other, and their differences.

const isSampled = ([{ name }]) => name === "t" || name === "number";

/** A computed curve: of steady states a line for each level, in the order of the abscissa. Levels that differ by up to 3 % are one. */
function curveOf(name, over, column, more) {
  const whole = series(name, over, column, more);
  const [at, beside] = tables[name].columns;
  if (isSampled([at])) return whole;
  if (beside.name === "measured") return inOrder(whole);
  const level = beside.values;
  const lines = [];
  let first = 0;
  for (const i of level.map((_, row) => row).sort((a, b) => level[a] - level[b])) {
    if (!lines.length || level[i] > 1.03 * first) { lines.push([]); first = level[i]; }
    lines[lines.length - 1].push(i);
  }
  const rows = lines.flatMap((line) => [-1, ...line.sort((a, b) => whole.x[a] - whole.x[b])]).slice(1);
  const taken = (list) => rows.map((i) => list[i] ?? null);
  return { ...whole, x: taken(whole.x), y: taken(whole.y) };
}

/** Of the tables PREFIX_RECORD_SIGNAL. A loop is drawn over its displacement. */
function overlays(prefix, word) {
  return Object.keys(tables).filter((name) => name.startsWith(`${prefix}_`)).flatMap((name) => {
    const [, record, signal] = name.match(/_(\d+)_(\w+)$/);
    const { columns } = tables[name];
    const at = columns[0].name;
    const over = isSampled(columns) && columns[1].name === "x" ? "x" : at;
    const isDense = isSampled(columns) && columns[0].values.length > 60;
    const title = `${signal}, record ${Number(record) + 1}`;
    return [
      chart({ title: `Measured and ${word}: ${title}`, wide: true, x: axis(name, over), y: axis(name, "measured", signal),
        series: [series(name, over, "measured", isDense ? { label: "measured", colour: 6 } : { label: "measured", kind: "points" }),
          curveOf(name, over, word, { label: word, colour: 1, width: 1 })] }),
      chart({ title: `Left between them: ${title}`, wide: true, x: axis(name, at), y: axis(name, "residual", "measured - " + word),
        series: [series(name, at, "residual", isDense ? { width: 1 } : { kind: "points" })] }),
    ];
  });
}

/** The fitted rig as a scenario, to copy. */
function scenarioBox({ scenario }) {
  return make("section", {}, make("h2", {}, "The fitted rig as a scenario"), make("pre", { "data-path": "scenario" }, scenario));
}

// The file of the compared laws states no unit of their residuals.
if (run.analysis === "fit" && run.result?.residual && tables.laws) tables.laws.get("rms").unit = run.result.residual.unit;

/** What was sought, first of all: values with their intervals, and how large the residuals are. */
function fittedNumbers({ parameters, residual }) {
  const digits = (one) => digitsWithin(one.value, one.interval95);
  const rows = parameters.map((one, i) => {
    const { unit, factor } = shownUnit(one.unit, [one.value, ...one.interval95], one.name);
    const range = one.interval95.includes(null) ? "–" : one.interval95.map((end) => short(end * factor, digits(one))).join(" to ");
    return [one.name,
      { text: make("span", { "data-path": `parameters[${i}].value`, "data-value": JSON.stringify(one.value) }, short(one.value * factor, digits(one)), make("small", { class: "under" }, range)), class: "text" },
      { text: unit, class: "text" }, { text: one.reason ?? "", class: "long" }];
  });
  const noise = residual.noise_units === null ? "" : `, ${short(residual.noise_units, 3)} times the noise`;
  const { unit, factor } = shownUnit(residual.unit, [residual.rms]);
  return [make("h2", {}, "Fitted numbers"), grid(["", "value (95 %)", "unit", ""], rows, { caption: "Fitted numbers" }),
    make("p", { class: "soft" }, `Residuals: ${short(residual.rms * factor, 4)} ${unit}${noise}.`)];
}

views.fit = { shown: ["rig", "scenario", "residual"], before: fittedNumbers, charts: () => [...overlays("fit", "fitted"), ...overlays("prediction", "predicted")], after: (result) => [scenarioBox(result)] };

views.predict = { charts: () => overlays("prediction", "predicted") };
