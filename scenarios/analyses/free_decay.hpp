#pragma once
/// `free_decay`: extremes of the free vibration from the initial state.

#include "scenarios/analysis.hpp"

namespace dualdamp::scenarios {

class FreeDecayQuestion final : public Question {
 public:
  explicit FreeDecayQuestion(int peaks) : peaks_(peaks) {}

  [[nodiscard]] Answer run(const RunContext& context) const override;

 private:
  int peaks_;
};

[[nodiscard]] const Analysis& free_decay_analysis();

}  // namespace dualdamp::scenarios
