// The motion over time, in the phase plane, and its friction.

function simulateView() {
  if (!tables.history) return [];
  const time = axis("history", "t", "time t");
  const over = (column, title, label, more = {}) =>
    chart({ title, x: time, y: axis("history", column, label), series: [series("history", "t", column)], ...more });
  return [
    chart({ title: "Motion", x: time, y: axis("history", "x", "displacement"), wide: true,
      series: [series("history", "t", "x", { label: "mass x" }), series("history", "t", "y", { label: "base y", kind: "dashed" }),
        { ...part("events", "t", "x", () => true, {}), label: "events", kind: "points", colour: 2 }] }),
    over("v", "Velocity", "velocity v"),
    chart({ title: "Phase plane", x: axis("history", "x", "displacement x"), y: axis("history", "v", "velocity v"), series: [series("history", "x", "v")] }),
    chart({ title: "Friction over velocity", note: "the force against the motion; jumps between two samples are left open", x: axis("history", "v", "velocity v"), y: axis("history", "friction", "friction force"),
      series: [broken(series("history", "v", "friction"))] }),
    chart({ title: "Friction over displacement", x: axis("history", "x", "displacement x"), y: axis("history", "friction", "friction force"),
      series: [series("history", "x", "friction")] }),
  ];
}

views.simulate = { charts: simulateView };
