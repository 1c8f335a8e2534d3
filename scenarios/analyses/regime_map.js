// Regimes in the plane of frequency and amplitude: never moves, rests (and how often), slides through, no steady state.

function mapView() {
  const { map, boundary } = tables;
  if (!map) return [];
  const [omega, Y, stops, sticks] = ["omega", "Y", "stops", "sticks"].map((name) => map.get(name).values);
  const lines = { x: distinct(omega), y: distinct(Y) };
  // Numbers in the order of the legend; a mass that never moves sticks once and does not stop.
  const kind = (stops, sticks) => (sticks === null ? 1e6 : sticks === 1 && stops === 0 ? 1e5 : sticks);
  const label = (n) => (n === 1e6 ? "no steady state" : n === 1e5 ? "never moves" : n === 0 ? "slides through" : n === 1 ? "rests once" : `rests ${n} times`);
  const found = distinct(stops.map((n, i) => kind(n, sticks[i])));
  // Rests are yellow to dark red by their number, so that the colours of other regimes never appear twice.
  const rests = found.filter((n) => n > 0 && n < 1e5);
  const warm = (t) => `hsl(${52 - 47 * t}, 85%, ${68 - 40 * t}%)`;
  const colourOf = (n) => (n === 1e6 ? 3 : n === 1e5 ? 6 : n === 0 ? 0 : warm(rests.indexOf(n) / Math.max(1, rests.length - 1)));
  const log = { x: isGeometric(omega), y: isGeometric(Y) };
  const inside = (Y) => Y !== null && Y >= lines.y[0] && Y <= lines.y[lines.y.length - 1];
  return [chart({
    title: "Rests in a period", wide: true, note: "over forcing frequency and input amplitude",
    x: { ...axis("map", "omega", "frequency"), log: log.x }, y: { ...axis("map", "Y", "input amplitude Y"), log: log.y },
    series: [...found.map((n) => part("map", "omega", "Y", (get) => kind(get("stops") ?? null, get("sticks") ?? null) === n, { label: label(n), kind: "cells", lines, colour: colourOf(n) })),
      ...(boundary ? [{ label: "never sticks above", x: values("boundary", "omega"), y: values("boundary", "Y").map((Y) => (inside(Y) ? Y : null)), width: 2.5, colour: "--ink" }] : [])],
  })];
}

views.regime_map = { charts: mapView };
