#pragma once
/// `simulate`: the motion from its initial state, its events and its energy balance; compared with a measured
/// motion if there is one.

#include <utility>
#include <vector>

#include "scenarios/analysis.hpp"

namespace dualdamp::scenarios {

/// A measured motion, with which the simulated one is compared.
struct MeasuredMotion {
  std::vector<double> times;  ///< s, ascending from 0
  std::vector<double> x;      ///< m
  double noise = 0.0;         ///< standard deviation of the sensor's noise [m]; 0: to be estimated
};

class SimulateQuestion final : public Question {
 public:
  SimulateQuestion(double duration, double sample_rate, MeasuredMotion measured = {})
      : duration_(duration), sample_rate_(sample_rate), measured_(std::move(measured)) {}

  [[nodiscard]] double duration() const { return duration_; }        ///< s
  [[nodiscard]] double sample_rate() const { return sample_rate_; }  ///< 1/s; 0: no history
  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  double duration_;
  double sample_rate_;
  MeasuredMotion measured_;  ///< without samples: none
};

[[nodiscard]] const Analysis& simulate_analysis();

}  // namespace dualdamp::scenarios
