#pragma once
/// `xy_curve`: output amplitude over input amplitude, as steady states.

#include "scenarios/analyses/analysis.hpp"

namespace dualdamp::scenarios {

class XyCurveQuestion final : public Question {
 public:
  explicit XyCurveQuestion(std::vector<double> amplitudes) : amplitudes_(std::move(amplitudes)) {}

  [[nodiscard]] const std::vector<double>& amplitudes() const { return amplitudes_; }  ///< m or N
  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  std::vector<double> amplitudes_;
};

[[nodiscard]] const Analysis& xy_curve_analysis();

}  // namespace dualdamp::scenarios
