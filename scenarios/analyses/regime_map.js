// Where in the plane of frequency and amplitude the mass stops how often.

function mapView() {
  const { map, boundary } = tables;
  if (!map) return [];
  const [omega, Y, stops] = ["omega", "Y", "stops"].map((name) => map.get(name).values);
  const lines = { x: distinct(omega), y: distinct(Y) };
  const found = distinct(stops.filter((n) => n !== null));
  const log = { x: isGeometric(omega), y: isGeometric(Y) };
  const inside = (Y) => Y !== null && Y >= lines.y[0] && Y <= lines.y[lines.y.length - 1];
  return [chart({
    title: "Stops in a period", wide: true, note: "over forcing frequency and input amplitude",
    x: { ...axis("map", "omega", "frequency"), log: log.x }, y: { ...axis("map", "Y", "input amplitude Y"), log: log.y },
    series: [...found.map((n, i) => part("map", "omega", "Y", (get) => get("stops") === n, { label: n === 0 ? "no stop" : `${n} stops`, kind: "cells", lines, colour: i })),
      ...(boundary ? [{ label: "never sticks above", x: values("boundary", "omega"), y: values("boundary", "Y").map((Y) => (inside(Y) ? Y : null)), width: 2.5, colour: "--ink" }] : [])],
  })];
}

views.regime_map = { charts: mapView };
