// The stress test: which method is wrong under which law, and whether its diagnostics say so.

const meanings = {
  worth: "trusted minus unwarned",
  trusted: "right within 5 %, no diagnostic",
  unwarned: "missed detections: wrong by more than 5 %, no diagnostic",
  wrong: "wrong by more than 5 %",
  knew: "of the wrong ones, those with a diagnostic",
  false_alarm: "false alarms: a diagnostic though friction is Coulomb + viscous",
  coverage: "95 % intervals that hold the true F0, where friction is Coulomb + viscous",
};

const percentText = (share) => (share === null ? "–" : `${Math.round(100 * share)} %`);

/** A colour from calm to alarming for a share between 0 and 1; the text says the number too. */
function heat(share) {
  if (share === null) return null;
  const light = 92 - 42 * share;
  return `background:hsl(${Math.round(150 - 145 * share)} 60% ${light}%)`;
}

/** Rows of a table as objects. */
function rowsOf(name) {
  const { columns } = tables[name];
  return columns[0].values.map((_, i) => Object.fromEntries(columns.map((column) => [column.name, column.isText ? column.texts[i] : column.values[i]])));
}

const mean = (list) => (list.length ? list.reduce((sum, v) => sum + v, 0) / list.length : null);

/** Share of missed detections, over all severities, ranges and sensors. */
const unwarnedUnder = (rows, law, method) =>
  mean(rows.filter((row) => row.law === law && row.method === method).map((row) => row.wrong * (1 - (row.wrong > 0 ? row.knew : 0))));

/** In words: the best method, the laws under which it misses most detections, and the method that misses most of all. */
function stressVerdict(rows) {
  const ranking = rowsOf("ranking");
  const best = ranking[0];
  const harmful = ranking.reduce((worst, row) => (row.unwarned > worst.unwarned ? row : worst));
  const silent = [...new Set(rows.map((row) => row.law))]
    .map((law) => ({ law, share: unwarnedUnder(rows, law, best.method) }))
    .filter(({ share }) => share >= 0.05).sort((a, b) => b.share - a.share).slice(0, 4)
    .map(({ law, share }) => `${law} (${percentText(share)})`);
  return make("p", { class: "verdict" },
    `Of ${ranking.length} methods ${best.method} is worth most: right within 5 % and without a diagnostic in ${percentText(best.trusted)} of the cases, missed detections in ${percentText(best.unwarned)}. `,
    silent.length ? `Its missed detections are most frequent under ${silent.join(", ")}. ` : "Under no law are they more than 5 % of the cases. ",
    harmful.method === best.method ? null : `${harmful.method} has the most: ${percentText(harmful.unwarned)}.`);
}

/** Law by method: the share of missed detections, over all severities, ranges and sensors. */
function heatMap(rows) {
  const laws = [...new Set(rows.map((row) => row.law))];
  const methods = [...new Set(rows.map((row) => row.method))];
  const body = laws.map((law) => [{ text: law, class: "text", title: run.result.severities[law] }, ...methods.map((method) => {
    const here = rows.filter((row) => row.law === law && row.method === method);
    const unwarned = unwarnedUnder(rows, law, method);
    const wrong = mean(here.map((row) => row.wrong));
    return { text: `${percentText(unwarned)} / ${percentText(wrong)}`, class: "heat", style: heat(unwarned), title: `${law}, ${method}` };
  })]);
  return [heading("Law by method"),
    make("p", { class: "soft" }, "Share of missed detections (the method is wrong by more than 5 % and has no diagnostic) / share of all wrong estimates; over all severities."),
    grid(["law", ...methods], body, { caption: "Law by method" })];
}

/** Law by method: the severity from which the friction force is off by more than 5 %. */
function breakdownMap(rows) {
  const laws = [...new Set(rows.map((row) => row.law))];
  const methods = [...new Set(rows.map((row) => row.method))];
  const severities = rowsOf("scores").map((row) => row.severity).filter((s) => s > 0);
  const [low, high] = [Math.min(...severities), Math.max(...severities)];
  const body = laws.map((law) => [{ text: law, class: "text", title: run.result.severities[law] }, ...methods.map((method) => {
    const here = rows.filter((row) => row.law === law && row.method === method).map((row) => row.F0_5);
    const least = here.some((v) => v !== null) ? Math.min(...here.filter((v) => v !== null)) : null;
    const place = least === null ? 0 : 1 - Math.log(least / low) / Math.log(high / low);
    return { text: least === null ? `> ${short(high, 2)}` : short(least, 2), class: "heat", style: heat(Math.min(1, Math.max(0, place))) };
  })]);
  return [heading("Breakdown"),
    make("p", { class: "soft" }, "Severity from which the friction force is off by more than 5 % in the median, the worst of all ranges and sensors."),
    grid(["law", ...methods], body, { caption: "Breakdown severity" })];
}

function rankingTable() {
  const rows = rowsOf("ranking");
  const keys = Object.keys(meanings);
  return [heading("Ranking"), grid(["method", ...keys], rows.map((row) => [row.method, ...keys.map((key) => ({ text: percentText(row[key]), title: meanings[key] }))]),
    { caption: "Ranking of the methods" }),
    make("p", { class: "soft" }, Object.entries(meanings).map(([key, text]) => `${key}: ${text}`).join("; ") + ".")];
}

function severityTable() {
  return [make("details", {}, make("summary", {}, "What severity means"),
    grid(["law", "severity"], Object.entries(run.result.severities).map(([law, text]) => [{ text: law, class: "text" }, { text, class: "long" }]), { caption: "Severities" }))];
}

/** Error of F0 over severity, one chart a law, one curve a method; first range and first sensors. */
function severityCharts() {
  const rows = rowsOf("scores").filter((row) => row.severity > 0);
  const first = rows.filter((row) => row.range === rows[0].range && row.sensors === rows[0].sensors);
  const laws = [...new Set(first.map((row) => row.law))];
  const methods = [...new Set(first.map((row) => row.method))];
  return laws.map((law) => chart({
    title: `Error of F0 under ${law}`, note: run.result.severities[law],
    x: { label: "severity", unit: "", log: isGeometric(first.map((row) => row.severity)) }, y: { label: "bias of F0 [%]", unit: "" },
    series: methods.map((method, i) => {
      const here = first.filter((row) => row.law === law && row.method === method);
      return { label: method, x: here.map((row) => row.severity), y: here.map((row) => (row.F0_bias === null ? null : 100 * row.F0_bias)), colour: i, kind: i < 7 ? "line" : "dashed" };
    }),
  }));
}

/** What the campaign says in tables. */
function stressTables() {
  if (!tables.ranking) return [];
  const rows = rowsOf("scores").filter((row) => row.severity > 0);
  return [stressVerdict(rows), ...rankingTable(), ...heatMap(rows), ...breakdownMap(rowsOf("breakdown")), ...severityTable()];
}

views.stress_test = { before: stressTables, charts: severityCharts };
