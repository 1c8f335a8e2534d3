#include "identify/records/free_part.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/numbers.hpp"
#include "identify/records/derived_records.hpp"
#include "identify/statistics/decompositions.hpp"

namespace dualdamp::identify {

namespace {

/// The first signal of x, v and a that was measured, as x.
History shown_motion(const History& history) {
  History shown;
  shown.start = history.start;
  shown.sample_rate = history.sample_rate;
  for (const std::vector<double>* signal : {&history.x, &history.v, &history.a})
    if (shown.x.empty()) shown.x = *signal;
  return shown;
}

/// Samples from the end of the hold until nine tenths of the path are done, for a mass that does not turn back.
double duration_of_move(const std::vector<double>& x, std::size_t held) {
  constexpr double most = 0.9;
  double path = 0.0;
  for (const double value : x) path = std::max(path, std::abs(value - x[0]));
  const auto arrived = std::ranges::find_if(x, [&](double value) { return std::abs(value - x[0]) >= most * path; });
  return static_cast<double>(arrived - x.begin()) - static_cast<double>(held);
}

/// Whether the first `count` samples, which last half of a half swing, hold no motion of the size of the record.
bool rests(const std::vector<double>& x, std::size_t count) {
  const auto n = static_cast<Eigen::Index>(count);
  const Eigen::Map<const Eigen::VectorXd> values(x.data(), n);
  const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(n, -1.0, 1.0);
  Eigen::MatrixXd columns(n, 3);
  columns << Eigen::VectorXd::Ones(n), u, u.cwiseAbs2();
  const Eigen::VectorXd parabola = columns * linear_least_squares(columns, values);
  const auto rms = [n](const Eigen::VectorXd& of) { return of.norm() / std::sqrt(static_cast<double>(n)); };
  const double bend = rms((parabola.array() - parabola.mean()).matrix());
  const double error = rms(values - parabola) / std::sqrt(static_cast<double>(n));
  const auto [low, high] = std::ranges::minmax(x);
  const double amplitude = 0.5 * (high - low);
  // A quarter of a period of cos, centred at its turning point, has a deviation of 0.088.
  constexpr double half_of_turn = 0.044;
  constexpr double known = 0.015;
  return bend < half_of_turn * amplitude && error < known * amplitude;
}

}  // namespace

FreePart free_part(const History& history) {
  const History shown = shown_motion(history);
  DerivedDecay decay = decay_of(shown);
  constexpr double fewest = 8.0;
  const bool turns = decay.half_period > 0.0;
  // It never moves, or not long enough to be read.
  if (decay.held == 0 || decay.held == shown.x.size()) return {};
  const double half = turns ? decay.half_period : duration_of_move(shown.x, decay.held);
  const double least = std::max(fewest, 0.5 * half);
  if (static_cast<double>(decay.held) <= least || !rests(shown.x, static_cast<std::size_t>(least))) return {};
  FreePart part{.held = decay.held};
  if (turns && decay.record.extremes.empty())
    part.fault = history.x.empty() ? "no free vibration follows" : std::move(decay.fault);
  else
    part.first = turns ? decay.first : decay.held;
  return part;
}

double end_of_hold(const History& history, const FreePart& part) {
  return history.start + static_cast<double>(part.held - 1) / history.sample_rate;
}

std::string leave_out_hold(History& history) {
  const FreePart part = free_part(history);
  if (part.held == 0) return {};
  const std::size_t size = std::max({history.x.size(), history.v.size(), history.a.size()});
  if (part.fault.empty()) return keep_free_motion(history, part.first, size);
  constexpr int digits = 4;
  return "the mass does not move until t = " + core::format_number(end_of_hold(history, part), digits) +
         " s, and moves later although nothing drives it, and its free motion cannot be read (" + part.fault +
         "): if it was held until then, cut the record there; if it was driven, state the drive";
}

}  // namespace dualdamp::identify
