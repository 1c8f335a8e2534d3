#include "identify/methods/histories/friction_samples.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include "identify/conclusion.hpp"

namespace dualdamp::identify {

namespace {

PreparedHistory motion_for(const History& history, const RegressionOptions& options) {
  if (!history.v.empty() || history.a.empty() || !options.cutoffs.empty())
    return prepared_history(history, cutoffs_for(history, options).front());
  History differentiated = history;
  differentiated.v = five_point_average(central_difference(history.x, history.sample_rate));
  return prepared_history(differentiated, 0.0);
}

}  // namespace

std::vector<FrictionSamples> friction_samples(const Record& record, const KnownConstants& constants,
                                              const RegressionOptions& options, Estimate& estimate) {
  std::vector<FrictionSamples> list;
  if (std::string lack = lacks_histories(record); !lack.empty()) {
    refuse(estimate, std::move(lack));
    return list;
  }
  if (!(constants.mass > 0.0) || !std::isfinite(constants.mass)) {
    refuse(estimate, "the method needs the mass");
    return list;
  }
  if (!(constants.stiffness >= 0.0) || !std::isfinite(constants.stiffness)) {
    refuse(estimate, "the method needs the stiffness");
    return list;
  }
  for (const NumberedHistory& item : usable_histories(record, options, estimate)) {
    FrictionSamples samples{item.number, motion_for(*item.history, options), {}};
    const PreparedHistory& motion = samples.motion;
    samples.force.resize(motion.v.size());
    for (std::size_t i = 0; i < motion.v.size(); ++i)
      samples.force[i] =
          constants.stiffness * (motion.y[i] - motion.x[i]) + motion.force[i] - constants.mass * motion.a[i];
    list.push_back(std::move(samples));
  }
  return list;
}

double least_speed_for(const std::vector<FrictionSamples>& histories, const RegressionOptions& options) {
  constexpr double share = 0.05;
  double fastest = 0.0;
  for (const FrictionSamples& samples : histories) fastest = std::max(fastest, largest_speed(samples.motion));
  return least_speed_for(fastest, share, options);
}

}  // namespace dualdamp::identify
