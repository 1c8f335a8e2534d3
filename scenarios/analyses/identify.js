// The estimates, the assumptions they rest on, and further results of the methods.

/** The 95 % ellipse of (zeta, F0). */
function ellipse(estimate) {
  const c = estimate.diagnostics.covariance;
  if (!c || c.flat().some((v) => v === null)) return null;
  const reach = Math.sqrt(5.991);  // chi-square with two degrees of freedom
  const l = Math.sqrt(Math.max(c[0][0], 0));
  if (!(l > 0)) return null;
  const m = c[0][1] / l;
  const n = Math.sqrt(Math.max(c[1][1] - m * m, 0));
  const angles = Array.from({length: 121}, (_, i) => (2 * Math.PI * i) / 120);
  return {
    x: angles.map((a) => estimate.zeta + reach * l * Math.cos(a)),
    y: angles.map((a) => estimate.F0 + reach * (m * Math.cos(a) + n * Math.sin(a)))
  };
}

/** The interval of each number by itself, where the two have no covariance. */
function cross({zeta, F0, interval95}) {
  const known = (ends) => ends && ends[0] !== null && ends[1] !== null;
  if (!known(interval95?.zeta) || !known(interval95?.F0)) return null;
  return {x: [...interval95.zeta, null, zeta, zeta], y: [F0, F0, null, ...interval95.F0]};
}

/** Numbers of the estimates in the unit that the user wrote, else in SI. */
const unitsOfEstimates = {c: 'N.s/m', F0: 'N', x_f: 'm'};
const shownAs = (key, list) =>
    key in unitsOfEstimates ? shownUnit(unitAt(`estimates[].${key}`, unitsOfEstimates[key]), list) : {unit: '', factor: 1};

const range = (interval, {unit, factor}) =>
    (interval && interval[0] !== null ?
         `95 %: ${short(interval[0] * factor, 4)} to ${short(interval[1] * factor, 4)}${unit && ` ${unit}`}` :
         'no interval');

/** Beyond the interval: what no test excludes. */
const notExcluded = ({interval95, range: whole}, key, {unit, factor}) =>
    (whole && whole[key][0] !== null && `${whole[key]}` !== `${interval95?.[key]}` ?
         make('small', {class: 'under', 'data-path': `answer.range.${key}`},
              `not excluded: ${short(whole[key][0] * factor, 4)} to ${short(whole[key][1] * factor, 4)}${unit && ` ${unit}`}`) :
         '');

/** The answer with its ranges, or that there is none and why. */
function answerBox({answer, answer_reason: reason}) {
  if (!answer)
    return make(
        'section', {class: 'answer'}, make('h2', {}, 'No answer'),
        make('p', {'data-path': 'answer_reason'}, reason));
  const shown =
      [['ζ', 'zeta'], ['F0', 'F0'], ['c', 'c']].filter(([, key]) => answer[key] !== null)
          .map(([label, key]) => [label, key, shownAs(key, [answer[key], ...(answer.interval95?.[key] ?? []), ...(answer.range?.[key] ?? [])])]);
  return make(
      'section', {class: 'answer'}, make('h2', {}, 'Answer'),
      make(
          'dl', {class: 'numbers'},
          shown.map(
              ([label, key, unit]) => make(
                  'div', {}, make('dt', {}, label),
                  make(
                      'dd', {
                        'data-path': `answer.${key}`,
                        'data-value': JSON.stringify(answer[key]),
                        title: String(answer[key])
                      },
                      short(answer[key] * unit.factor, 5) + (unit.unit && ` ${unit.unit}`),
                      make('small', {class: 'under'}, range(answer.interval95?.[key], unit)),
                      notExcluded(answer, key, unit))))),
      make('p', {}, `By ${answer.method}: ${reason}.`));
}

/** A p-value below the smallest number is none, not zero. */
const pText = (p) => (p === 0 ? 'p < 1e-300' : `p = ${short(p, 2)}`);

const standings = {
  holds: ['✓ holds', 'good'],
  violated: ['✗ violated', 'bad'],
  untested: ['? untested', 'soft']
};
const shareOf = (value) => {
  if (value === null || value === undefined) return null;
  // Rounding errors of zero count as zero.
  const size = Math.abs(value);
  return size < 1e-6 ? '0 %' : `${value < 0 ? '−' : '+'}${short(100 * size, size < 1 ? 2 : 3)} %`;
};

/** One line of the ledger: it wraps on a narrow screen instead of running out of it. */
function ledgerLine(entry) {
  const [words, mood] = standings[entry.status];
  const changes = [['ζ', entry.zeta_change], ['F0', entry.F0_change]].filter(
      ([, value]) => value !== null && value !== undefined);
  const facts = [
    entry.test, entry.p_value === null ? null : pText(entry.p_value),
    changes.length ? `relaxed: ${changes.map(([name, value]) => `${name} ${shareOf(value)}`).join(', ')}` : null
  ].filter(Boolean);
  return make(
      'div', {}, make('dt', {}, entry.name.replaceAll('_', ' '), ' ', make('span', {class: mood}, words)),
      make(
          'dd', {}, facts.length ? make('span', {}, facts.join('; ')) : null,
          entry.reason ? make('small', {class: 'under'}, entry.reason) : null));
}

/** What 1 % of each constant would do to the answer. */
function sensitivityLine(sensitivities) {
  if (!sensitivities?.length) return null;
  const parts = sensitivities.map(
      (one) => `${one.constant} (ζ ${shareOf(one.zeta_change) ?? '–'}, F0 ${shareOf(one.F0_change) ?? '–'})`);
  return make('p', {class: 'soft'}, `1 % more of a constant moves the answer by: ${parts.join(', ')}.`);
}

function ledger({assumptions, family_level: level, tested, sensitivities}) {
  return [
    heading('Ledger of assumptions'),
    make(
        'p', {class: 'soft'},
        tested ?
            `Tested in ${tested}; all tests together reject wrongly in ${short(100 * level, 2)} % of records.` :
            'Nothing could be tested in this record.'),
    make('dl', {class: 'ledger'}, assumptions.map(ledgerLine)), sensitivityLine(sensitivities)
  ].filter(Boolean);
}

/** A cell with a length: what is shown is scaled, what it stands for is SI. */
const lengthCell = (value, {factor}, path) =>
    ({text: typeof value === 'number' ? value * factor : value, title: `${value}`, path, value});

function estimateTable(estimates) {
  const length = shownAs('x_f', estimates.map((e) => e.x_f));
  const [c, F0] = ['c', 'F0'].map((key) => shownAs(key, estimates.flatMap((e) => [e[key], ...(e.interval95?.[key] ?? [])])));
  const both = (value, interval, path, {factor} = {factor: 1}) => ({
    text: value === null ?
        '–' :
        make(
            'span', {}, short(value * factor, 5),
            interval && interval[0] !== null ?
                make('small', {class: 'under'}, ` ${short(interval[0] * factor, 4)} to ${short(interval[1] * factor, 4)}`) :
                null),
    path,
    value
  });
  return grid(
      ['method', '', 'ζ (95 %)', `c [${c.unit}] (95 %)`, `x_f [${length.unit}]`, `F0 [${F0.unit}] (95 %)`, 'because'],
      estimates.map(
          (e, i) =>
              [{text: e.method, class: 'text'},
               {text: e.usable ? '✓ usable' : '✗ not usable', class: `text ${e.usable ? 'good' : 'bad'}`},
               both(e.zeta, e.interval95?.zeta, `estimates[${i}].zeta`),
               both(e.c, e.interval95?.c, `estimates[${i}].c`, c), lengthCell(e.x_f, length, `estimates[${i}].x_f`),
               both(e.F0, e.interval95?.F0, `estimates[${i}].F0`, F0), {text: e.diagnostics.reason, class: 'long'}]),
      {caption: 'Estimates'});
}

/** The straight lines x = a + b Y behind the estimates. */
function lineTable(estimates) {
  const at = (i, key) => `estimates[${i}].diagnostics.line.${key}`;
  const length = shownAs('x_f', estimates.map(({diagnostics: {line}}) => line?.intercept));
  const rows = estimates.flatMap(({method, diagnostics: {line}}, i) => (line ? [[
    {text: method, class: 'text'}, {text: line.slope, path: at(i, 'slope')},
    lengthCell(line.intercept, length, at(i, 'intercept')), {text: line.G, path: at(i, 'G')}
  ]] : []));
  return rows.length ? [grid(['x = a + b Y by', 'slope b', `intercept a [${length.unit}]`, 'G'], rows, {caption: 'Lines'})] : [];
}

const namesOfCurves = {F_abel: 'F by Abel inversion, which needs no basis'};

/** Curves that came with the estimates: METHOD_NAME.csv, the first column against each of the others. */
function estimateCurves(estimates) {
  const out = [];
  for (const {method} of estimates)
    for (const [name, {columns}] of Object.entries(tables)) {
      if (!name.startsWith(`${method}_`) || columns.length < 2) continue;
      const [x, ...rest] = columns;
      out.push(chart({
        title: `${name.slice(method.length + 1).replaceAll('_', ' ')}, ${method}`,
        x: {label: x.name, unit: x.unit},
        y: {label: rest.map(({name}) => name).filter((name) => !(name in namesOfCurves)).join(', '), unit: rest[0].unit},
        series: rest.map((column, i) => ({
                           label: namesOfCurves[column.name] ?? column.name,
                           x: x.values,
                           y: column.values,
                           width: 1.1,
                           kind: column.name === 'measured' ? 'points' :
                               i > 0                        ? 'dashed' :
                                                              'line'
                         }))
      }));
    }
  return out;
}

function fitCharts({fit, estimates}) {
  if (!fit?.points?.length) return [];
  const {points} = fit;
  const chosen = estimates.find((e) => e.method === fit.method);
  const excluded = new Set(chosen.diagnostics.excluded.map((e) => e.number));
  const isPairs = points[0].Y !== undefined;
  const x = (p) => (isPairs ? p.Y : p.number);
  const sorted = [...points].sort((a, b) => x(a) - x(b));
  const used = points.filter((p) => !excluded.has(p.number));
  const left = points.filter((p) => excluded.has(p.number));
  const label =
      isPairs ? {label: 'input amplitude Y', unit: unitAt('fit.points[].x', 'm')} : {label: 'number of the extreme', unit: '', whole: true};
  const pick = (list, get) => ({x: list.map(x), y: list.map(get)});
  return [
    chart({
      title: isPairs ? 'x-Y data and fit' : 'Extremes and fit',
      note: fit.method,
      wide: true,
      x: label,
      y: {label: isPairs ? 'output amplitude x' : 'extreme x', unit: unitAt('fit.points[].x', 'm')},
      series: [
        {label: 'fit', ...pick(sorted, (p) => p.fitted), colour: 0},
        {label: 'used', kind: 'points', ...pick(used, (p) => p.x), colour: 1},
        {label: 'left out', kind: 'open', ...pick(left, (p) => p.x), colour: 6}
      ]
    }),
    chart({
      title: 'Residuals',
      note: fit.method,
      x: label,
      y: {label: 'data − fit', unit: unitAt('fit.points[].x', 'm')},
      series: [{
        label: 'used',
        kind: 'points',
        ...pick(used, (p) => (p.fitted === null ? null : p.x - p.fitted)),
        colour: 1
      }]
    }),
  ];
}

function subsetCharts(estimates) {
  return estimates.filter((e) => e.diagnostics.subsets?.length > 1)
      .map((e) => {
        const {subsets} = e.diagnostics;
        const at = subsets.map((_, i) => i + 1);
        const damping = subsets.some((s) => s.zeta !== null) ? ['zeta', 'ζ', ''] : ['c', 'c', unitAt('estimates[].c', 'N.s/m')];
        return [damping, ['F0', 'F0', unitAt('estimates[].F0', 'N')]].map(
            ([key, label, unit], colour) => chart({
              title: `${label} from parts of the data`,
              note: `${e.method}; ${subsets.map((s, i) => `${i + 1}: ${s.label}`).join(', ')}`,
              x: {label: 'part', unit: '', whole: true},
              y: {label, unit},
              series: [{label, x: at, y: subsets.map((s) => s[key]), kind: 'points', colour}]
            }));
      })
      .flat();
}

/** The 95 % region of each law that the record allows, one above the other: their union is the hull. */
function lawCharts(estimates) {
  return estimates.filter((e) => e.laws)
      .flatMap((e) => {
        const allowed = e.laws.filter((law) => !law.rejected);
        const end = (key, i) => {
          const {unit, factor} = shownAs(key, e.hull95[key]);
          return `${short(e.hull95[key][i] * factor, 4)}${unit && ` ${unit}`} (${e.hull_ends[key][i]})`;
        };
        return [['zeta', 'ζ', ''], ['F0', 'F0', unitAt('estimates[].F0', 'N')]].map(
            ([key, label, unit]) => {
              const rows = allowed.map((_, i) => allowed.length - i);  // the best law on top
              return chart({
                title: `${label}, law by law`,
                note: `${allowed.length} of ${e.laws.length} laws are allowed; the hull goes from ${end(key, 0)} to ${end(key, 1)}`,
                x: {label, unit},
                y: {label: 'law, best first', unit: '', names: allowed.map(({name}) => name).reverse()},
                series: [
                  {
                    label: '95 %',
                    x: allowed.flatMap((law) => [law[`${key}_interval95`][0], law[key], law[`${key}_interval95`][1], null]),
                    y: rows.flatMap((row) => [row, row, row, null]),
                    width: 3,
                    colour: 5
                  },
                  {label: 'best fit of the law', kind: 'points', x: allowed.map((law) => law[key]), y: rows, colour: 1}
                ]
              });
            });
      });
}

function identifyView(result) {
  const {estimates, answer} = result;
  // The covariance contains the damping ratio, which does not exist without a spring.
  const known = estimates.filter((e) => e.zeta !== null && e.F0 !== null);
  const others = known.filter((e) => e.method !== answer?.method);
  const series = [...known.filter((e) => e.method === answer?.method), ...others].flatMap((e, i) => {
    const around = ellipse(e) ?? cross(e);
    const isAnswer = e.method === answer?.method;
    const [label, colour] = [isAnswer ? `${e.method} (the answer)` : e.method, isAnswer ? '--ink' : i];
    return [
      {label, kind: e.usable ? 'points' : 'open', x: [e.zeta], y: [e.F0], size: isAnswer ? 5 : 3, colour},
      ...(around ? [{label, ...around, width: isAnswer ? 2.4 : 1, colour}] : [])
    ];
  });
  return [
    ...fitCharts(result),
    known.length ? chart({
      title: 'Damping ratio and friction force',
      note: 'the 95 % ellipse: the two are correlated; a cross: the 95 % interval of each; open where the method does not stand by its number',
      x: {label: 'ζ', unit: ''},
      y: {label: 'F0', unit: unitAt('estimates[].F0', 'N')},
      series
    }) :
                   null,
    ...lawCharts(estimates),
    ...estimateCurves(estimates), ...subsetCharts(estimates)
  ];
}

function furtherTables({estimates}) {
  const out = [];
  for (const e of estimates) {
    const {others, candidates} = e.diagnostics;
    if (others?.length)
      out.push(
          heading(`Further parameters, ${e.method}`),
          grid(
              ['parameter', 'value', 'unit', 'standard error', '95 %'],
              others.map((o) => {
                const {unit, factor} = shownUnit(o.unit, [o.value, ...(o.interval95 ?? [])], o.name);
                const scaled = (value) => (value === null ? null : value * factor);
                return [
                  o.name, scaled(o.value), unit, scaled(o.std),
                  o.interval95 ? o.interval95.map((value) => short(scaled(value), 5)).join(' to ') : null
                ];
              })));
    if (candidates?.length) {
      const length = shownAs('x_f', candidates.map((c) => c.residual_deviation));
      out.push(
          heading(`Laws compared, ${e.method}`),
          grid(
              ['law', 'weight', 'AICc', 'BIC', `residual deviation [${length.unit}]`, 'parameters'],
              candidates.map(
                  (c) =>
                      [c.law, c.weight, c.AICc, c.BIC, lengthCell(c.residual_deviation, length),
                       quantitiesText(c.parameters, 4)])));
    }
  }
  return out;
}

views.identify = {
  opens: (result) => [answerBox(result), ...ledger(result)],
  before: ({estimates}) => [heading('Estimates'), estimateTable(estimates), ...lineTable(estimates)],
  shown: ['answer', 'answer_reason', 'family_level', 'tested'],
  charts: identifyView,
  after: furtherTables,
  // The reason why an estimate is not usable is shown beside it.
  said: ({estimates}) => estimates.map((e) => `${e.method} is not usable: ${e.diagnostics.reason}`),
};
