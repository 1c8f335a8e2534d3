#include "identify/records/faults/drive_work.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "core/constants.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/noise_level.hpp"

namespace dualdamp::identify {

namespace {

using Signal = std::span<const double>;

/// int f dx.
double work_of(Signal f, Signal x) {
  double work = 0.0;
  for (std::size_t i = 1; i < x.size(); ++i) work += 0.5 * (f[i] + f[i - 1]) * (x[i] - x[i - 1]);
  return work;
}

/// How much the work changes if x is one sample late.
double change_by_sample(Signal f, Signal x) {
  const std::size_t n = x.size() - 1;
  return 0.5 * (work_of(f.first(n), x.last(n)) - work_of(f.last(n), x.first(n)));
}

double middle_of(Signal signal) {
  double sum = 0.0;
  for (const double value : signal) sum += value;
  return sum / static_cast<double>(signal.size());
}

/// Differences over a sixteenth of a period: shorter ones are mostly noise. [m/s]
std::vector<double> speeds_of(const std::vector<double>& x, double rate, double period) {
  constexpr double share = 1.0 / 16.0;
  const std::size_t step = std::max<std::size_t>(1, static_cast<std::size_t>(share * period * rate));
  std::vector<double> v;
  for (std::size_t i = step; i < x.size(); ++i)
    v.push_back((x[i] - x[i - step]) * rate / static_cast<double>(step));
  return v;
}

/// What the sum of f dx makes of noise in f and x.
double error_by_noise(Signal f, Signal x) {
  double of_f = 0.0, of_x = 0.0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    of_f += (f[i] - f[i - 1]) * (f[i] - f[i - 1]);
    of_x += (x[i] - x[i - 1]) * (x[i] - x[i - 1]);
  }
  return std::hypot(robust_noise_level(x) * std::sqrt(of_f), robust_noise_level(f) * std::sqrt(of_x));
}

struct Motion {
  const std::vector<double>& x;
  std::vector<double> v;
  double mass, stiffness;  ///< 0 where unknown
};

/// The largest energy within the first samples; the zero of x may be that of the sensor or the mean.
double first_energy(const Motion& motion, std::size_t samples) {
  const double middle = middle_of(motion.x);
  double stretch = 0.0, speed = 0.0;
  for (const double x : Signal(motion.x).first(std::min(samples, motion.x.size())))
    stretch = std::max({stretch, std::abs(x), std::abs(x - middle)});
  for (const double v : Signal(motion.v).first(std::min(samples, motion.v.size())))
    speed = std::max(speed, std::abs(v));
  return 0.5 * std::max(motion.stiffness * stretch * stretch, motion.mass * speed * speed);
}

/// Whether f is in phase with what spring and inertia need, where these need a force.
bool is_in_phase(const Motion& motion, Signal f) {
  if (motion.mass == 0.0 || motion.stiffness == 0.0) return false;
  const double middle_of_f = middle_of(f);
  const double middle_of_x = middle_of(motion.x);
  double given = 0.0, spring = 0.0, inertia = 0.0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    const double x = motion.x[i] - middle_of_x;
    given += (f[i] - middle_of_f) * x;
    spring += motion.stiffness * x * x;
  }
  for (const double v : motion.v) inertia += motion.mass * v * v;
  const double needed = spring - inertia;
  constexpr double clearly = 0.1;
  constexpr double half = 0.5;
  return std::abs(needed) > clearly * spring && given * needed > half * needed * needed;
}

/// The motion without its mean: x, or the integral of v without its trend, which is that of the sensor's zero.
std::vector<double> path_of(const History& history) {
  std::vector<double> x = history.x;
  if (x.empty()) {
    x.push_back(0.0);
    for (std::size_t i = 1; i < history.v.size(); ++i)
      x.push_back(x.back() + 0.5 * (history.v[i] + history.v[i - 1]) / history.sample_rate);
    const double slope = (x.back() - x.front()) / static_cast<double>(x.size() - 1);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= slope * static_cast<double>(i);
  }
  const double middle = middle_of(x);
  for (double& value : x) value -= middle;
  return x;
}

/// How often x goes from one quarter of its range beyond the middle to the other.
int strokes_of(const std::vector<double>& x) {
  const auto [low, high] = std::ranges::minmax(x);
  constexpr double quarter = 0.25;
  int strokes = 0;
  int side = 0;
  for (const double value : x) {
    const double place = (value - low) / (high - low);
    const int now = place < quarter ? -1 : place > 1.0 - quarter ? 1 : 0;
    if (now == 0 || now == side) continue;
    strokes += side == 0 ? 0 : 1;
    side = now;
  }
  return strokes;
}

}  // namespace

std::optional<double> impossible_losses(const History& history) {
  const std::vector<double> x = path_of(history);
  const Signal f = history.force;
  constexpr std::size_t fewest = 16;
  constexpr int closed_loop = 3;
  if (f.size() != x.size() || x.size() < fewest) return std::nullopt;
  const int strokes = strokes_of(x);
  if (strokes < closed_loop) return std::nullopt;
  const auto count = static_cast<Eigen::Index>(x.size());
  const double period = 2.0 * static_cast<double>(x.size() - 1) / strokes;  // in samples
  const auto reach = std::max<Eigen::Index>(1, static_cast<Eigen::Index>(period / 32.0));
  constexpr Eigen::Index terms = 5;
  Eigen::MatrixXd columns(count, terms);
  Eigen::VectorXd work(count);
  double sum = 0.0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto at = [&](Eigen::Index j) {
      return x[static_cast<std::size_t>(std::clamp<Eigen::Index>(j, 0, count - 1))];
    };
    if (i > 0)
      sum += 0.5 * (f[static_cast<std::size_t>(i)] + f[static_cast<std::size_t>(i - 1)]) * (at(i) - at(i - 1));
    work[i] = sum;
    const double v = at(i + reach) - at(i - reach);
    columns.row(i) << 1.0, at(i), at(i) * at(i), v * v, static_cast<double>(i) / static_cast<double>(count - 1);
  }
  const Eigen::VectorXd line = pivoted_least_squares(columns, work);
  const double losses = line[terms - 1];
  constexpr double far = 4.0;
  constexpr double of_delay = 0.02;  // of a period
  const double room = far * std::sqrt((work - columns * line).squaredNorm() / static_cast<double>(count)) +
                      far * error_by_noise(f, x) + of_delay * period * std::abs(change_by_sample(f, x));
  if (!(losses + room < 0.0)) return std::nullopt;
  return losses;
}

std::optional<double> impossible_work(const History& history, const KnownConstants& constants, double omega) {
  const bool is_force = !history.force.empty();
  const double spring = std::fmax(constants.stiffness, 0.0);  // either may be unknown
  const double mass = std::fmax(constants.mass, 0.0);
  if (history.x.empty() || is_force != history.y.empty() || (spring == 0.0 && mass == 0.0) || history.x.size() < 3)
    return std::nullopt;
  std::vector<double> f = is_force ? history.force : history.y;
  if (!is_force)
    for (double& value : f) value *= spring;
  const double period = core::two_pi / omega;
  const Motion motion{history.x, speeds_of(history.x, history.sample_rate, period), mass, spring};
  const double slowest = std::fmin(omega, mass > 0.0 && spring > 0.0 ? constants.natural_frequency() : omega);
  const auto samples_in = [&](double time) {
    return static_cast<std::size_t>(std::ceil(time * history.sample_rate));
  };
  constexpr double of_constants = 2.0;
  constexpr double of_noise = 4.0;
  constexpr double of_zero = 0.2;    // of the largest force
  constexpr double of_delay = 0.01;  // of a period
  const double largest = std::abs(*std::ranges::max_element(f, {}, [](double value) { return std::abs(value); }));
  const double room = of_constants * first_energy(motion, samples_in(core::two_pi / slowest)) +
                      of_delay * period * history.sample_rate * std::abs(change_by_sample(f, history.x)) +
                      of_noise * error_by_noise(f, history.x) +
                      of_zero * largest * std::abs(history.x.back() - history.x.front());
  const double work = work_of(f, history.x);
  if (!(work + room < 0.0) || is_in_phase(motion, f)) return std::nullopt;
  return work;
}

}  // namespace dualdamp::identify
