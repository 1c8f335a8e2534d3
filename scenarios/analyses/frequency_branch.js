views.frequency_branch = { charts: () => branchView("omega", "frequency") };
