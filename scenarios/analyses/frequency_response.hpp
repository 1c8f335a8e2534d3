#pragma once
/// `frequency_response`: output amplitude over frequency, as steady states.

#include "scenarios/analyses/analysis.hpp"

namespace dualdamp::scenarios {

class FrequencyResponseQuestion final : public Question {
 public:
  explicit FrequencyResponseQuestion(std::vector<double> frequencies) : frequencies_(std::move(frequencies)) {}

  [[nodiscard]] const std::vector<double>& frequencies() const { return frequencies_; }  ///< rad/s
  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  std::vector<double> frequencies_;
};

[[nodiscard]] const Analysis& frequency_response_analysis();

}  // namespace dualdamp::scenarios
