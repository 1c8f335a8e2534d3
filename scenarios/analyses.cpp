#include "scenarios/analyses.hpp"

#include "scenarios/analysis.hpp"

// The analyses, one line each, in the order in which lists show them. The source of each defines NAME_analysis().
#define DUALDAMP_ANALYSES(ANALYSIS) \
  ANALYSIS(simulate)                \
  ANALYSIS(steady_state)            \
  ANALYSIS(xy_curve)                \
  ANALYSIS(frequency_response)      \
  ANALYSIS(regime_map)              \
  ANALYSIS(xy_branch)               \
  ANALYSIS(frequency_branch)        \
  ANALYSIS(free_decay)              \
  ANALYSIS(identify)                \
  ANALYSIS(fit)                     \
  ANALYSIS(predict)                 \
  ANALYSIS(design)                  \
  ANALYSIS(formula)

namespace dualdamp::scenarios {

#define DUALDAMP_DECLARE(name) const Analysis& name##_analysis();
DUALDAMP_ANALYSES(DUALDAMP_DECLARE)
#undef DUALDAMP_DECLARE

const AnalysisList& analyses() {
#define DUALDAMP_ENTRY(name) &name##_analysis(),
  static const AnalysisList list = {DUALDAMP_ANALYSES(DUALDAMP_ENTRY)};
#undef DUALDAMP_ENTRY
  return list;
}

}  // namespace dualdamp::scenarios
