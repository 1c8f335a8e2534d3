#pragma once
/// A branch of steady states over the amplitude or the frequency of the excitation. `xy_branch` and
/// `frequency_branch` differ in this parameter only.

#include "scenarios/analysis.hpp"
#include "scenarios/results/motion.hpp"
#include "sim/curves/continuation.hpp"

namespace dualdamp::scenarios {

class BranchQuestion final : public Question {
 public:
  /// Amplitudes in m or N, frequencies in rad/s.
  BranchQuestion(sim::BranchParameter parameter, double from, double to)
      : parameter_(parameter), from_(from), to_(to) {}

  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  sim::BranchParameter parameter_;
  double from_;
  double to_;
};

/// The fields of the result; `parameter`: name, unit and meaning of the parameter of the branch.
[[nodiscard]] ResultFields branch_fields(const ResultField& parameter);

}  // namespace dualdamp::scenarios
