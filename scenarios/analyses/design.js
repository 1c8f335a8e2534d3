// What to measure next: the advice, the measurements that were compared, and the present ranges law by law.

const amount = (share) => (share === null ? '–' : short(share, 2));
const span = ([low, high]) => `${amount(low)} to ${amount(high)}`;

function adviceBox({advice, hull95, inflation}) {
  const F0 = shownUnit('N', hull95.F0, 'F0');
  const hull = [['ζ', 'zeta', {unit: '', factor: 1}], ['F0', 'F0', F0]].map(
      ([label, key, {unit, factor}]) => make(
          'div', {}, make('dt', {}, `${label} now, over the laws that the record allows`),
          make('dd', {'data-path': `hull95.${key}`, 'data-value': JSON.stringify(hull95[key])},
               `${hull95[key].map((end) => short(end * factor, 4)).join(' to ')}${unit && ` ${unit}`}`)));
  return make(
      'section', {class: 'answer'}, make('h2', {}, 'What to measure next'), make('p', {'data-path': 'advice'}, advice),
      make('dl', {class: 'numbers'}, hull),
      inflation > 1 ? make('p', {class: 'soft'}, `The noise was raised by a factor of ${short(inflation, 3)} until the best law fits.`) : null);
}

function candidateTable({candidates}) {
  const at = (i, key) => `candidates[${i}].${key}`;
  const rows = candidates.map((one, i) => [
    {text: String(i + 1), class: 'text'}, {text: make('span', {}, one.measurement, make('small', {class: 'under'}, ` ${one.instruction}`)), class: 'long'}, {text: one.cost, path: at(i, 'cost')},
    ...['zeta', 'F0'].map((key) => ({
      text: make('span', {}, amount(one.hull_shrinks_to[key]), make('small', {class: 'under'}, ` ${span(one.hull_by_law[key])}`)),
      path: at(i, `hull_shrinks_to.${key}`), value: one.hull_shrinks_to[key]
    })),
    {text: amount(one.power), path: at(i, 'power'), value: one.power}
  ]);
  return [
    heading('Measurements, the best one first'),
    grid(['', 'measurement', 'states or releases', 'range of ζ shrinks to', 'range of F0 shrinks to', 'wrong laws rejected'], rows,
         {caption: 'Measurements'}),
    make('p', {class: 'soft'}, 'Shares of the present range: the mean over the true law, and the least and the largest of them.')
  ];
}

/** Each measurement: by how much the ranges shrink, from the best to the worst true law. */
function shrinkageChart({candidates}) {
  const rows = candidates.map((_, i) => candidates.length - i);
  const bars = (key) => ({
    x: candidates.flatMap(({hull_by_law: by, hull_shrinks_to: mean}) => [by[key][0], mean[key], by[key][1], null]),
    y: rows.flatMap((row) => [row, row, row, null])
  });
  const shifted = ({x, y}, by) => ({x, y: y.map((row) => (row === null ? null : row + by))});
  const means = (key, by) => ({x: candidates.map((one) => one.hull_shrinks_to[key]), y: rows.map((row) => row + by)});
  return chart({
    title: 'How far the ranges shrink',
    note: 'dot: mean over the true law; bar: from the least to the largest; 1: nothing is gained',
    x: {label: 'expected width over the present one', unit: ''},
    y: {label: 'measurement, as in the table', unit: '', names: candidates.map((_, i) => String(candidates.length - i))},
    series: [
      {label: 'ζ', ...shifted(bars('zeta'), 0.12), width: 2, colour: 0}, {label: 'ζ', kind: 'points', ...means('zeta', 0.12), colour: 0},
      {label: 'F0', ...shifted(bars('F0'), -0.12), width: 2, colour: 1}, {label: 'F0', kind: 'points', ...means('F0', -0.12), colour: 1}
    ]
  });
}

/** The laws that the record allows, as the charts of a range over laws take them. */
function presentLaws() {
  const of = (column) => values('any_law', column);
  const laws = of('law').map((name, i) => ({
    name, rejected: of('rejected')[i] === 'yes', zeta: of('zeta')[i], F0: of('F0')[i],
    zeta_interval95: [of('zeta_low')[i], of('zeta_high')[i]], F0_interval95: [of('F0_low')[i], of('F0_high')[i]]
  }));
  const allowed = laws.filter((law) => !law.rejected);
  const ends = (key) => {
    const extreme = (i, better) => allowed.reduce((a, b) => (better(b[`${key}_interval95`][i], a[`${key}_interval95`][i]) ? b : a));
    return [extreme(0, (a, b) => a < b), extreme(1, (a, b) => a > b)];
  };
  const hull = (key) => ends(key).map((law, i) => law[`${key}_interval95`][i]);
  return {
    laws, hull95: {zeta: hull('zeta'), F0: hull('F0')},
    hull_ends: {zeta: ends('zeta').map(({name}) => name), F0: ends('F0').map(({name}) => name)}
  };
}

views.design = {
  opens: (result) => [adviceBox(result)],
  before: candidateTable,
  shown: ['advice', 'hull95', 'inflation'],
  charts: (result) => [shrinkageChart(result), ...lawCharts([presentLaws()])],
};
