// The stress test: accuracy, power and attainable power of the methods.

const metricMeanings = {
  interval_score: "mean of the interval scores of zeta and F0, relative to the truth; smaller is better; saying nothing scores 2",
  coverage_zeta: "95 % intervals that hold the true zeta",
  coverage_F0: "95 % intervals that hold the true F0",
  power: "cases with a departure that the method rejects",
  attainable_power: "the same of the best test which knows the departure and the noise",
  false_alarm: "cases without a departure that the method rejects",
  prediction_error: "mean relative error of the amplitudes that the estimate predicts in two tests that no record holds: at 1.5 times the largest input amplitude, and at 0.9 times the lowest frequency",
  selective_risk_area: "mean loss (largest relative error, 1 at most) over coverage, the cases in the order of the method's own confidence",
};
const isShare = (name) => !name.startsWith("interval_score") && name !== "selective_risk_area";

/** Rows of a table as objects. */
function rowsOf(name) {
  const { columns } = tables[name];
  return columns[0].values.map((_, i) => Object.fromEntries(columns.map((column) => [column.name, column.isText ? column.texts[i] : column.values[i]])));
}

/** In percent: whole ones, but small errors of predictions with a digit more. */
function percent(share, name) {
  const digits = name === "prediction_error" && share < 0.1 ? 1 : 0;
  return (100 * share).toFixed(digits);
}

/** A number to the last digit that its standard error leaves: "0.75 ± 0.07". */
function withError(value, se) {
  const decimals = Math.max(0, -Math.floor(Math.log10(se)));
  return decimals > 5 ? `${short(value, 3)} ± ${short(se, 1)}` : `${value.toFixed(decimals)} ± ${se.toFixed(decimals)}`;
}

/** A metric and its standard error: "94 % ± 2". */
function metricText(row, name) {
  const [value, se] = [row[name], row[`${name}_se`]];
  if (value === null || value === undefined) return "–";
  if (isShare(name)) return `${percent(value, name)} %${se ? ` ± ${(100 * se).toFixed(100 * se < 1 ? 1 : 0)}` : ""}`;
  return se ? withError(value, se) : short(value, 3);
}

/** A colour from calm to alarming for a number between 0 and 1; the text says the number too. */
function heat(share) {
  if (share === null || share === undefined) return null;
  const level = Math.min(1, Math.max(0, share));
  return `background:hsl(${Math.round(150 - 145 * level)} 60% ${92 - 42 * level}%);color:#111`;
}

/** In words: who leads, and what rejections are worth. */
function stressVerdict() {
  const ranking = rowsOf("ranking");
  const leaders = ranking.filter((row) => row.rank_from === 1).map((row) => row.method);
  const sharp = ranking.filter((row) => row.power !== null && row.false_alarm !== null).sort((a, b) => b.power - b.false_alarm - (a.power - a.false_alarm))[0];
  return make("p", { class: "verdict" },
    leaders.length === 1 ? `Of ${ranking.length} methods ${leaders[0]} has the best intervals, by more than two standard errors. `
      : `Of ${ranking.length} methods none has intervals better by two standard errors than these: ${leaders.join(", ")}. `,
    sharp ? `${sharp.method} tells departures from Coulomb + viscous friction best: it rejects ${metricText(sharp, "power")} of the cases with a departure, where the best possible test reaches ${metricText(sharp, "attainable_power")}, and ${metricText(sharp, "false_alarm")} of those without.` : null);
}

function rankingTable() {
  const rows = rowsOf("ranking");
  const keys = Object.keys(metricMeanings);
  return [heading("Ranking"),
    grid(["method", "rank", ...keys], rows.map((row) => [row.method, row.rank_from === row.rank_to ? `${row.rank_from}` : `${row.rank_from}–${row.rank_to}`,
      ...keys.map((key) => ({ text: metricText(row, key), title: metricMeanings[key] }))]), { caption: "Ranking of the methods" }),
    make("p", { class: "soft" }, "Means over families of departures, ± one standard error over departures, rigs and noise. A rank is a range where differences are below two standard errors. ",
      Object.entries(metricMeanings).map(([key, text]) => `${key}: ${text}`).join("; ") + ".")];
}

/** Family by method: one metric. */
function familyMap(title, metric, colour, text, only = null) {
  const rows = rowsOf("families").filter((row) => row[metric] !== null);
  if (!rows.length) return [];
  const families = [...new Set(rows.map((row) => row.family))];
  const methods = rowsOf("ranking").map((row) => row.method).slice(0, only ? 1 : undefined);
  const body = methods.map((method) => [{ text: only ?? method, class: "text" }, ...families.map((family) => {
    const row = rows.find((item) => item.family === family && item.method === method);
    return row ? { text: metricText(row, metric), class: "heat", style: heat(colour(row[metric], row)), title: `${family}, ${method}` } : { text: "–" };
  })]);
  return [heading(title), make("p", { class: "soft" }, text), grid(["method", ...families], body, { caption: title })];
}

function departureTable() {
  return [make("details", {}, make("summary", {}, "What the departures and their severities are"),
    grid(["departure", "family", "severity"], rowsOf("departures").map(({ departure, family, severity }) => [{ text: departure, class: "text" }, { text: family, class: "text" }, { text: severity, class: "long" }]), { caption: "Departures" }))];
}

/** What a departure comes to: harm over distance, one point a motion. */
function consequenceChart() {
  // Distances far below the noise are rounding.
  const rows = rowsOf("consequences").filter((row) => row.distance > 1e-3 && row.harm > 1e-6);
  if (!rows.length) return [];
  const familyOf = Object.fromEntries(rowsOf("departures").map((row) => [row.departure, row.family]));
  const families = [...new Set(rows.map((row) => familyOf[row.law]))];
  return [chart({
    title: "What departures cost, and what could be known of them",
    note: "Harm: relative error of zeta or F0 of the nearest Coulomb + viscous motion, that of a perfect fit. Distance: of its readings from those measured, in units of noise. Left of 1.6 even the best test finds a departure in less than half of the cases.",
    x: { label: "distance", unit: "", log: true }, y: { label: "harm", unit: "", log: true },
    series: families.map((family, i) => {
      const here = rows.filter((row) => familyOf[row.law] === family);
      return { label: family, x: here.map((row) => row.distance), y: here.map((row) => row.harm), colour: i, kind: "points" };
    }),
  })];
}

/** One metric of each method over distance or harm: points in the middle of their intervals. */
function overConsequence(of, metric, title, note, further = []) {
  const all = rowsOf("by_consequence").filter((row) => row.of === of && row[metric] !== null && row.from > 0);
  if (!all.length) return [];
  const middle = (row) => row.from * Math.sqrt((row.to ?? 3 * row.from) / row.from);
  const line = (rows, key, label, colour, extra = {}) =>
    ({ label, x: rows.map(middle), y: rows.map((row) => 100 * row[key]), colour, ...extra });
  const methods = rowsOf("ranking").map((row) => row.method);
  const rowsOfMethod = (method) => all.filter((row) => row.method === method);
  return [chart({
    title, note, x: { label: of, unit: "", log: true }, y: { label: metric.replace("_", " of "), unit: "%" },
    // There are seven colours.
    series: [...methods.map((method, i) => line(rowsOfMethod(method), metric, method, i, { kind: i < 7 ? "line" : "dashed" })).filter((series) => series.x.length),
      ...further.map((key) => line(rowsOfMethod(methods[0]), key, "best possible test", 6, { kind: "dashed", width: 4 }))],
  })];
}

function consequenceCharts() {
  return [...consequenceChart(),
    ...overConsequence("distance", "power", "Who knows: power over distance", "Departures of equal distance are equally easy to see, whatever their severities. Means over departures and families; by_consequence.csv has the standard errors.", ["attainable_power"]),
    ...overConsequence("harm", "coverage_F0", "Who is right: coverage of F0 over harm", "Departures of equal harm bias a perfect fit equally. 95 % is what the intervals promise.")];
}

/** What the campaign says in tables. */
function stressTables() {
  if (!tables.ranking) return [];
  return [stressVerdict(), ...rankingTable(),
    ...familyMap("Who is right: interval score by family", "interval_score_F0", (value) => value / 10, "Mean interval score of F0, relative to the truth. 0 is best; an interval from 0 to twice the truth scores 2; an answer that is off by its whole 40."),
    ...familyMap("Coverage by family", "coverage_F0", (value) => (0.95 - value) / 0.95, "Share of 95 % intervals that hold the true F0."),
    ...familyMap("Who predicts: error of amplitudes not measured, by family", "prediction_error", (value) => value / 0.3, "Mean relative error of the amplitudes that Coulomb + viscous friction with the estimate predicts at 1.5 times the largest input amplitude, and at 0.9 times the lowest frequency. Departures without a true zeta or F0 count here too."),
    ...familyMap("Who knows: power by family", "power", (value, row) => row.attainable_power - value, "Share of cases with a departure that the method rejects. The colour is the distance to the power of the best test that knows the departure: what could be known and is not said."),
    ...familyMap("What nobody can know: attainable power by family", "attainable_power", (value) => 1 - value, "Power of the best test that knows the departure and the noise of the sensors.", "best possible test"),
    ...departureTable()];
}

views.stress_test = { before: stressTables, charts: consequenceCharts };
