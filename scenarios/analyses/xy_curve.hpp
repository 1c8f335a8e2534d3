#pragma once
/// `xy_curve`: output amplitude over input amplitude, as steady states.

#include "scenarios/analysis.hpp"
#include "sim/curves/stepped_curves.hpp"

namespace dualdamp::scenarios {

class XyCurveQuestion final : public Question {
 public:
  /// Without `stepping` each level starts from the model's initial state.
  explicit XyCurveQuestion(std::vector<double> amplitudes, std::optional<sim::Stepping> stepping = std::nullopt)
      : amplitudes_(std::move(amplitudes)), stepping_(stepping) {}

  [[nodiscard]] const std::vector<double>& amplitudes() const { return amplitudes_; }  ///< m or N
  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  std::vector<double> amplitudes_;
  std::optional<sim::Stepping> stepping_;
};

[[nodiscard]] const Analysis& xy_curve_analysis();

}  // namespace dualdamp::scenarios
