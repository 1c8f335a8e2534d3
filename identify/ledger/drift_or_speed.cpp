#include "identify/ledger/drift_or_speed.hpp"

#include <algorithm>

namespace dualdamp::identify {

void name_speed_beside_drift(const JointModel& model, const std::vector<RelaxationTest>& tests,
                             FoundDeparture& departure) {
  const auto is_of_speed = [&](const RelaxationTest& test) {
    return model.relaxations[test.index].assumption == Assumption::friction_velocity;
  };
  const auto is_like_speed = [&](const RelaxationTest& test) {
    return model.relaxations[test.index].is_like_speed;
  };
  if (std::ranges::none_of(departure.explanations, is_like_speed) ||
      std::ranges::any_of(departure.explanations, is_of_speed))
    return;
  const RelaxationTest* best = nullptr;
  for (const RelaxationTest& test : tests)
    if (is_of_speed(test) && (best == nullptr || test.explained > best->explained)) best = &test;
  if (best != nullptr) departure.explanations.push_back(*best);
}

}  // namespace dualdamp::identify
