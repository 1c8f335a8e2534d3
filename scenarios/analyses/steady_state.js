// One period, in time and in the phase plane, and its friction.

function orbitView() {
  if (!tables.orbit) return [];
  const plot = (title, x, y, labels, more = {}) => chart({ title, x: axis("orbit", x, labels[0]), y: axis("orbit", y, labels[1]), series: [series("orbit", x, y)], ...more });
  return [
    chart({ title: "One period", wide: true, x: axis("orbit", "t", "time t"), y: axis("orbit", "x", "displacement"),
      series: [series("orbit", "t", "x", { label: "mass x" }), series("orbit", "t", "y", { label: "base y", kind: "dashed" })] }),
    plot("Phase plane", "x", "v", ["displacement x", "velocity v"]),
    plot("Friction over velocity", "v", "friction", ["velocity v", "friction force"], { note: "the force against the motion" }),
    plot("Friction over displacement", "x", "friction", ["displacement x", "friction force"]),
  ];
}

views.steady_state = { charts: orbitView };
