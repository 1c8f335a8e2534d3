views.frequency_response = { charts: () => curveView("curve", "omega", "frequency") };
