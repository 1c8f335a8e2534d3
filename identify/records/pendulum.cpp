#include "identify/records/pendulum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "identify/statistics/median.hpp"

namespace dualdamp::identify {

namespace {

/// Si(A) = A - A^3/(3 3!) + A^5/(5 5!) - ...
double sine_integral(double angle) {
  double term = angle;
  double sum = angle;
  for (int n = 1; n < 40 && std::abs(term) > 1e-18 * std::abs(sum); ++n) {
    term *= -angle * angle / (2.0 * n * (2.0 * n + 1.0));
    sum += term / (2.0 * n + 1.0);
  }
  return sum;
}

/// Middle of the swings, by the weights 1 3 3 1 over four neighbours, which cancel an alternating smooth decay.
double middle_of(const std::vector<double>& extremes) {
  std::vector<double> middles;
  for (std::size_t i = 0; i + 3 < extremes.size(); ++i)
    middles.push_back((extremes[i] + 3.0 * (extremes[i + 1] + extremes[i + 2]) + extremes[i + 3]) / 8.0);
  return middles.empty() ? 0.0 : upper_median(std::move(middles));
}

/// xi(A). `angle`: A [rad]; `share`: G/k.
double linear_extreme(double angle, double share) { return (1.0 - share) * angle + share * sine_integral(angle); }

/// T(A)/T(0).
double relative_period(double angle, double share) {
  constexpr int nodes = 64;  // of the midpoint rule, which converges fast for this periodic integrand
  constexpr double pi = std::numbers::pi;
  if (!(std::abs(angle) > 1e-8) || !(std::abs(angle) < pi)) return 1.0;
  double sum = 0.0;
  for (int i = 0; i < nodes; ++i) {
    const double x = angle * std::sin((i + 0.5) * 0.5 * pi / nodes);
    // 2 (V(A) - V(x))/k. The product in place of cos x - cos A avoids cancellation.
    const double fallen = (1.0 - share) * (angle - x) * (angle + x) +
                          4.0 * share * std::sin(0.5 * (angle + x)) * std::sin(0.5 * (angle - x));
    const double linear = (angle - x) * (angle + x);
    sum += std::sqrt(linear / fallen);
  }
  return sum / nodes;
}

void linearise(DecayRecord& decay, double share) {
  const double middle = middle_of(decay.extremes);
  const std::vector<double> times = decay.times;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double amplitude =
        0.5 * (std::abs(decay.extremes[i - 1] - middle) + std::abs(decay.extremes[i] - middle));
    decay.times[i] = decay.times[i - 1] + (times[i] - times[i - 1]) / relative_period(amplitude, share);
  }
  for (double& extreme : decay.extremes) extreme = middle + linear_extreme(extreme - middle, share);
}

}  // namespace

void linearise_pendulum(Record& record, double stiffness, double gravity_stiffness,
                        std::vector<std::string>& warnings) {
  if (!(gravity_stiffness > 0.0)) return;
  if (record.decay) {
    linearise(*record.decay, gravity_stiffness / stiffness);
    warnings.emplace_back(
        "the extremes and their times are converted to those of a linear spring that loses the same to friction "
        "(gravity_stiffness)");
  }
  for (History& history : record.histories) {
    if (history.x.empty()) continue;
    history.force.resize(history.x.size(), 0.0);
    for (std::size_t i = 0; i < history.x.size(); ++i)
      history.force[i] += gravity_stiffness * (history.x[i] - std::sin(history.x[i]));
  }
}

}  // namespace dualdamp::identify
