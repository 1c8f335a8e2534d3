#include "scenarios/analyses/analyses.hpp"

#include "scenarios/analyses/formula.hpp"
#include "scenarios/analyses/free_decay.hpp"
#include "scenarios/analyses/frequency_branch.hpp"
#include "scenarios/analyses/frequency_response.hpp"
#include "scenarios/analyses/identify.hpp"
#include "scenarios/analyses/regime_map.hpp"
#include "scenarios/analyses/simulate.hpp"
#include "scenarios/analyses/steady_state.hpp"
#include "scenarios/analyses/xy_branch.hpp"
#include "scenarios/analyses/xy_curve.hpp"

namespace dualdamp::scenarios {

const AnalysisList& analyses() {
  static const AnalysisList list = {
      &simulate_analysis(),         &steady_state_analysis(),
      &xy_curve_analysis(),         &frequency_response_analysis(),
      &regime_map_analysis(),       &xy_branch_analysis(),
      &frequency_branch_analysis(), &free_decay_analysis(),
      &identify_analysis(),         &formula_analysis(),
  };
  return list;
}

}  // namespace dualdamp::scenarios
