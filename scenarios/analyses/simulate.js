// The motion over time, in the phase plane, and its friction.

/** What the residual of a measured motion amounts to. */
function residualNote() {
  const { rms, noise, noise_units: ratio } = run.result.residual;
  const { unit, factor } = readable(unitOf("history", "residual"), rms);
  const text = `root mean square ${short(rms * factor, 3)} ${unit}`;
  return noise === null ? text : `${text}: ${short(ratio, 3)} times the noise of the sensor, ${short(noise * factor, 3)} ${unit}`;
}

function simulateView() {
  if (!tables.history) return [];
  const time = axis("history", "t", "time t");
  const over = (column, title, label, more = {}) =>
    chart({ title, x: time, y: axis("history", column, label), series: [series("history", "t", column)], ...more });
  const measured = tables.history.columns.some((c) => c.name === "measured");
  return [
    chart({ title: "Motion", x: time, y: axis("history", "x", "displacement"), wide: true,
      series: [series("history", "t", "x", { label: measured ? "simulated x" : "mass x" }),
        ...(measured ? [series("history", "t", "measured", { label: "measured x", kind: "dashed", colour: 3 })] : []),
        series("history", "t", "y", { label: "base y", kind: "dashed", colour: 1 }),
        { ...part("events", "t", "x", () => true, {}), label: "events", kind: "points", colour: 2 }] }),
    ...(measured ? [over("residual", "Residual", "measured less simulated", { wide: true, note: residualNote() })] : []),
    over("v", "Velocity", "velocity v"),
    chart({ title: "Phase plane", x: axis("history", "x", "displacement x"), y: axis("history", "v", "velocity v"), series: [series("history", "x", "v")] }),
    chart({ title: "Friction over velocity", note: "the force against the motion; jumps between two samples are left open", x: axis("history", "v", "velocity v"), y: axis("history", "friction", "friction force"),
      series: [broken(series("history", "v", "friction"))] }),
    chart({ title: "Friction over displacement", x: axis("history", "x", "displacement x"), y: axis("history", "friction", "friction force"),
      series: [series("history", "x", "friction")] }),
  ];
}

views.simulate = { charts: simulateView };
