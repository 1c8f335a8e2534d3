#pragma once
/// `steady_state`: the periodic motion approached from the initial state.

#include "scenarios/analyses/analysis.hpp"

namespace dualdamp::scenarios {

class SteadyStateQuestion final : public Question {
 public:
  [[nodiscard]] Answer run(const RunContext& context) const override;
};

[[nodiscard]] const Analysis& steady_state_analysis();

}  // namespace dualdamp::scenarios
