#include "identify/records/history_energy.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "identify/statistics/noise_level.hpp"

namespace dualdamp::identify {

namespace {

/// The path int |dx| between two samples.
double path_between(double x0, double v0, double x1, double v1, double dt) {
  if (v0 * v1 >= 0.0) return std::abs(x1 - x0);
  // One parabola from each sample to the turning point, because the acceleration may jump there.
  const double until = dt * v0 / (v0 - v1);
  return 0.5 * std::abs(v0) * until + 0.5 * std::abs(v1) * (dt - until);
}

}  // namespace

std::vector<WindowEnergy> energy_of(const PreparedHistory& motion, const KnownConstants& constants, int windows) {
  const std::vector<double>&x = motion.x, &v = motion.v, &a = motion.a;
  const double dt = 1.0 / motion.sample_rate;
  std::vector<double> drive(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) drive[i] = constants.stiffness * motion.y[i] + motion.force[i];
  const std::vector<double> drive_rate = central_difference(drive, motion.sample_rate);
  const auto stored = [&](std::size_t i) {
    return 0.5 * (constants.mass * v[i] * v[i] + constants.stiffness * x[i] * x[i]);
  };
  const auto hermite = [dt](double f0, double slope0, double f1, double slope1) {
    return 0.5 * dt * (f0 + f1) + dt * dt / 12.0 * (slope0 - slope1);
  };
  std::vector<WindowEnergy> list;
  const std::size_t steps = x.size() - 1;
  const auto count = static_cast<std::size_t>(windows);
  for (std::size_t w = 0; w < count; ++w) {
    const std::size_t begin = w * steps / count;
    const std::size_t end = (w + 1) * steps / count;
    WindowEnergy sum{.duration = static_cast<double>(end - begin) * dt, .stored = stored(end) - stored(begin)};
    const auto [lowest, highest] = std::minmax_element(x.begin() + static_cast<std::ptrdiff_t>(begin),
                                                       x.begin() + static_cast<std::ptrdiff_t>(end) + 1);
    sum.range = *highest - *lowest;
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t j = i + 1;
      sum.input += hermite(drive[i] * v[i], drive_rate[i] * v[i] + drive[i] * a[i], drive[j] * v[j],
                           drive_rate[j] * v[j] + drive[j] * a[j]);
      sum.square_speed += hermite(v[i] * v[i], 2.0 * v[i] * a[i], v[j] * v[j], 2.0 * v[j] * a[j]);
      sum.path += path_between(x[i], v[i], x[j], v[j], dt);
    }
    list.push_back(sum);
  }
  return list;
}

PreparedHistory sharply_prepared(const History& history, double cutoff) {
  History full = history;
  if (full.a.empty())
    full.a = full.v.empty() ? sharp_second_difference(full.x, full.sample_rate)
                            : sharp_difference(full.v, full.sample_rate);
  if (full.v.empty()) full.v = sharp_difference(full.x, full.sample_rate);
  return prepared_history(full, cutoff);
}

double speed_noise(const History& history, double cutoff) {
  const double rate = history.sample_rate;
  std::optional<ZeroPhaseFilter> filter;
  if (cutoff > 0.0) filter.emplace(cutoff, rate);
  const std::size_t middle = filter ? filter->edge() + 4 : 4;
  std::vector<double> response(2 * middle + 1, 0.0);
  response[middle] = 1.0;
  if (filter) response = (*filter)(response);
  if (history.v.empty()) response = sharp_difference(response, rate);
  double squares = 0.0;
  for (const double value : response) squares += value * value;
  return noise_level(history.v.empty() ? history.x : history.v) * std::sqrt(squares);
}

}  // namespace dualdamp::identify
