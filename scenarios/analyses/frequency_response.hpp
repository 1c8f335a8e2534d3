#pragma once
/// `frequency_response`: output amplitude over frequency, as steady states.

#include "scenarios/analysis.hpp"
#include "sim/curves/stepped_curves.hpp"

namespace dualdamp::scenarios {

class FrequencyResponseQuestion final : public Question {
 public:
  /// Without `stepping` each level starts from the model's initial state.
  explicit FrequencyResponseQuestion(std::vector<double> frequencies,
                                     std::optional<sim::Stepping> stepping = std::nullopt)
      : frequencies_(std::move(frequencies)), stepping_(stepping) {}

  [[nodiscard]] const std::vector<double>& frequencies() const { return frequencies_; }  ///< rad/s
  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  std::vector<double> frequencies_;
  std::optional<sim::Stepping> stepping_;
};

[[nodiscard]] const Analysis& frequency_response_analysis();

}  // namespace dualdamp::scenarios
