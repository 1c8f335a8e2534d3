// The study of mechanisms: which mechanism explains bent estimates, and the effect of each at plausible values.

/** Below a ten-thousandth of a per cent a change is rounding. */
function signedPercent(share) {
  if (share === null || share === undefined) return "–";
  return Math.abs(share) < 1e-6 ? "0 %" : `${share < 0 ? "−" : "+"}${short(Math.abs(100 * share), 3)} %`;
}

const rounded = (value, digits) => (Math.abs(value) >= 100 ? String(Math.round(value)) : short(value, digits));

/** A bar to the left or right of the middle, on a scale that is linear up to a hundredth of a per cent and logarithmic beyond. */
function bar(share) {
  if (share === null || share === undefined) return null;
  const knee = 1e-4;
  const length = Math.min(50, (50 * Math.log(1 + Math.abs(share) / knee)) / Math.log(1 + 1 / knee));
  const [from, to] = share < 0 ? [50 - length, 50] : [50, 50 + length];
  const paint = share < 0 ? "var(--c3)" : "var(--c0)";
  return `background:linear-gradient(to right,transparent ${from}%,${paint} ${from}% ${to}%,transparent ${to}%);min-width:10rem`;
}

const parameterText = (parameters) => quantitiesText(parameters, 3, ({ at_bound: atBound }) => (atBound ? " (as far as the search goes)" : ""));

function fitTable({ mechanisms }) {
  const of = (key) => mechanisms.map((m) => m[key]);
  const F0 = shownUnit("N", of("F0"));
  const c = shownUnit("N.s/m", of("c"));
  const ends = mechanisms.flatMap(({ levels }) => (levels ? [levels[0].Y, levels[levels.length - 1].Y] : []));
  const length = readable("m", largest([ends]));
  const levelText = (levels) => [levels[0], levels[levels.length - 1]].map(({ Y }) => short(Y * length.factor, 3)).join(" to ");
  const rows = mechanisms.map((m, i) => {
    const at = (key, digits, factor = 1) => (m[key] === undefined || m[key] === null ? "–" : { text: rounded(m[key] * factor, digits), path: `mechanisms[${i}].${key}`, value: m[key] });
    return [{ text: m.mechanism, class: "text", title: m.meaning }, m.chi2 === undefined ? { text: m.reason, class: "long" } : at("chi2", 3), at("unknowns"),
      m.misfit === undefined ? "–" : { text: `${short(100 * m.misfit, 2)} %`, path: `mechanisms[${i}].misfit`, value: m.misfit },
      { text: m.parameters ? parameterText(m.parameters) : "", class: "long" }, at("stretch", 2), m.levels ? levelText(m.levels) : "–", at("F0", 3, F0.factor), at("c", 3, c.factor), signedPercent(m.decay?.bend)];
  });
  return [heading("Fitted to the estimates"),
    make("p", { class: "soft" }, "Times plausible: the largest ratio between a fitted parameter and a value that the rig may well have. Bend of the free decay: ζ of its first four extremes over that of its last four, less 1."),
    grid(["mechanism", "χ²", "unknowns", "largest misfit", "parameters", "times plausible", `levels Y [${length.unit}]`, `F0 [${F0.unit}]`, `c [${c.unit}]`, "bend of the free decay"], rows, { caption: "Mechanisms fitted to the estimates" })];
}

function effectTable({ explained, effects }) {
  const row = (name, which, because, share, path) => [{ text: name, class: "text" }, { text: which, class: "text" },
    path ? { text: signedPercent(share), path, value: share } : signedPercent(share), { text: "", style: bar(share) }, { text: because, class: "long" }];
  return [heading("At plausible values"),
    make("p", { class: "soft" }, "ζ of the smallest part over that of all data, less 1. Bars are logarithmic beyond 0.01 %; to the right: as measured."),
    grid(["mechanism", "", "ζ changes by", "", "values"], [row("measured", "", "", explained.bend, "explained.bend"),
      ...effects.map((e, i) => row(e.mechanism, e.case ?? "", [parameterText(e.parameters), e.because, e.sticks ? "the mass sticks at a level" : ""].filter(Boolean).join("; "),
        e.bend, e.bend === undefined ? null : `effects[${i}].bend`))], { caption: "Effect of each mechanism at plausible values" })];
}

/** Fits worth a look: the closest, and friction without any mechanism. */
function shownFits({ mechanisms }) {
  const fits = mechanisms.filter((m) => m.chi2 !== undefined);
  const close = fits.filter((m) => m.mechanism !== "coulomb_viscous").slice(0, 6);
  return [...close, ...fits.filter((m) => m.mechanism === "coulomb_viscous")];
}

function mechanismCharts(result) {
  const fits = shownFits(result);
  const decays = fits.filter((m) => m.decay);
  const ends = ({ high, low }) => ({ x: [high.x_f, low.x_f], y: [high.zeta, low.zeta] });
  return [
    chart({ title: "x-Y curves of the fits", wide: true, note: "points: levels that the estimates lead to", x: axis("curves", "Y", "input amplitude Y"), y: axis("curves", "x", "output amplitude x"),
      series: [...fits.map((m, i) => part("curves", "Y", "x", (get) => get("mechanism") === m.mechanism, { label: m.mechanism, colour: i, kind: m.mechanism === "coulomb_viscous" ? "dashed" : "line" })),
        part("levels", "Y", "x", (get) => get("mechanism") === "measured", { label: "measured", kind: "points", colour: 6 })] }),
    result.explained.decay ? chart({ title: "Free decay of the fits", wide: true, note: "ζ over x_f; dots: from the first four extremes, ends without a dot: from the last four",
      x: { label: "friction displacement x_f", unit: "m" }, y: { label: "ζ", unit: "" },
      series: [...decays.map((m, i) => ({ label: m.mechanism, ...ends(m.decay), colour: i })), { label: "measured", ...ends(result.explained.decay), colour: 6, width: 3 },
        { label: "first four extremes", kind: "points", colour: 6, x: [result.explained.decay, ...decays.map((m) => m.decay)].map((d) => d.high.x_f), y: [result.explained.decay, ...decays.map((m) => m.decay)].map((d) => d.high.zeta) }] }) : null,
  ];
}

views.mechanisms = { before: (result) => [...fitTable(result), ...effectTable(result)], charts: mechanismCharts };
