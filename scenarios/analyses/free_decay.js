views.free_decay = {
  charts: () => [chart({ title: "Extremes", wide: true, x: axis("peaks", "t", "time"), y: axis("peaks", "x", "extreme x"),
    series: [series("peaks", "t", "x", { label: "extremes", kind: "points" }), series("peaks", "t", "x", { label: "extremes", width: 1, colour: 6 })] })],
};
