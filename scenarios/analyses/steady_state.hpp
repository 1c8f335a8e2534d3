#pragma once
/// `steady_state`: the periodic motion approached from the initial state.

#include "scenarios/analysis.hpp"

namespace dualdamp::scenarios {

class SteadyStateQuestion final : public Question {
 public:
  [[nodiscard]] Answer run(const RunContext& context) const override;
  /// The transient from the initial state over the periods of the answer, integrated without Newton's method.
  [[nodiscard]] std::optional<OtherWay> other_way(const RunContext& context, const Answer& answer) const override;
};

[[nodiscard]] const Analysis& steady_state_analysis();

}  // namespace dualdamp::scenarios
