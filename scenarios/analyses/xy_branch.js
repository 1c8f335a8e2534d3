views.xy_branch = { charts: () => branchView("Y", "input amplitude Y") };
