#pragma once
/// `simulate`: the motion from its initial state, its events and its energy account.

#include "scenarios/analyses/analysis.hpp"

namespace dualdamp::scenarios {

class SimulateQuestion final : public Question {
 public:
  SimulateQuestion(double duration, double sample_rate) : duration_(duration), sample_rate_(sample_rate) {}

  [[nodiscard]] double duration() const { return duration_; }        ///< s
  [[nodiscard]] double sample_rate() const { return sample_rate_; }  ///< 1/s; 0: no history
  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  double duration_;
  double sample_rate_;
};

[[nodiscard]] const Analysis& simulate_analysis();

}  // namespace dualdamp::scenarios
