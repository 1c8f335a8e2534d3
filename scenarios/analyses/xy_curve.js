views.xy_curve = { charts: () => curveView("curve", "Y", "input amplitude Y") };
