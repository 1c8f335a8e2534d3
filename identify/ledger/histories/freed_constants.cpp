#include "identify/ledger/histories/freed_constants.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/ledger/histories/history_rows.hpp"

namespace dualdamp::identify {

namespace {

/// Deviation of what a fit leaves over that of x from its mean, over all histories. Noise of x does not count.
double share_missed(ForwardFit& fit) {
  double moved = 0.0;
  double noise = 0.0;
  for (const ForwardTest& test : fit.tests()) {
    const std::vector<double>& measured = test.history->x;
    const Eigen::Map<const Eigen::ArrayXd> x(measured.data(), static_cast<Eigen::Index>(measured.size()));
    const double deviation = sensor_noise_of(measured);
    moved += (x - x.mean()).square().sum();
    noise += deviation * deviation * static_cast<double>(x.size());
  }
  const double length = fit.layout().length();
  const double left = fit.found().sum_of_squares * length * length;
  return moved > 0.0 ? std::sqrt(std::max(0.0, left - noise) / moved) : 0.0;
}

constexpr double good_part = 0.2;  ///< of the motion

/// Mean of x - y - f/k: the middle that the motion would have about a right zero is zero.
double middle_of(const History& history, double stiffness) {
  double sum = 0.0;
  for (std::size_t i = 0; i < history.x.size(); ++i)
    sum += history.x[i] - (history.y.empty() ? 0.0 : history.y[i]) -
           (history.force.empty() ? 0.0 : history.force[i] / stiffness);
  return history.x.empty() ? 0.0 : sum / static_cast<double>(history.x.size());
}

/// Are all histories driven by a measured drive? What is off in x beside the motion of its drive is then known.
bool is_driven(const Record& record) { return std::ranges::all_of(record.histories, &History::has_drive); }

/// The signal later by some samples, or earlier; its ends are held.
void shift(std::vector<double>& signal, std::ptrdiff_t samples) {
  const std::vector<double> before = signal;
  const auto count = static_cast<std::ptrdiff_t>(before.size());
  for (std::ptrdiff_t i = 0; i < count; ++i)
    signal[static_cast<std::size_t>(i)] =
        before[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i - samples, 0, count - 1))];
}

}  // namespace

std::optional<FreedFit> FreedConstants::fitted(const Record& record, const KnownConstants& constants) {
  Estimate unused;
  ForwardFit fit(record, constants, {}, unused);
  if (!fit.problem().empty() || fit.tests().size() != stated_.tests().size()) return std::nullopt;
  const ForceParameters force = fit.layout().force(fit.found().parameters);
  const double change = std::isnan(constants.mass)        ? force.m - constants_.mass
                        : std::isnan(constants.stiffness) ? force.k - constants_.stiffness
                                                          : 0.0;
  std::vector<ForwardTest> tests = stated_.tests();
  return FreedFit{fit.as_start(stated_.layout(), tests), change, share_missed(fit)};
}

std::optional<FreedFit> FreedConstants::with_constant(By by) {
  KnownConstants constants = constants_;
  double& own = by == By::mass ? constants.mass : constants.stiffness;
  if (std::isnan(own)) return std::nullopt;
  own = unknown;
  return fitted(record_, constants);
}

/// The middle of a short history is its zero but for a part of a swing; steps lead on from there.
std::optional<FreedFit> FreedConstants::with_zero() {
  if (!is_driven(record_) || missed_as_stated() < good_part || !(constants_.stiffness > 0.0)) return std::nullopt;
  Record moved = record_;
  const std::vector<ForwardTest>& tests = stated_.tests();
  const std::vector<Eigen::Index>& records = stated_.layout().records();
  Eigen::VectorXd zeros = Eigen::VectorXd::Zero(records.back() + 1);
  for (std::size_t t = 0; t < tests.size(); ++t)
    zeros[records[t]] += middle_of(*tests[t].history, constants_.stiffness) /
                         static_cast<double>(std::ranges::count(records, records[t]));
  for (std::size_t t = 0; t < tests.size(); ++t)
    for (double& x : moved.histories[static_cast<std::size_t>(tests[t].number) - 1].x) x -= zeros[records[t]];
  std::optional<FreedFit> fit = fitted(moved, constants_);
  if (!fit) return fit;
  stated_.layout().add_zeros(fit->p, zeros);
  fit->change = zeros.mean() / stated_.layout().length();
  return fit;
}

/// A drive that is later by the delay moves the mass as much later. Steps of this delay lead to the best one.
std::optional<FreedFit> FreedConstants::with_delay() {
  constexpr double some = 0.05;  // of the motion
  constexpr double step = 0.03;  // of a natural period
  constexpr int most = 5;
  if (!is_driven(record_) || missed_as_stated() < some) return std::nullopt;
  if (!(constants_.stiffness > 0.0) || !(constants_.mass > 0.0)) return std::nullopt;
  constexpr double most_of_it = 0.25;  // each delay needs a fit: not where another constant explains what is missed
  const FreedFit* other = best({Kind::zero, Kind::constant});
  if (other != nullptr && other->missed < most_of_it * missed_as_stated()) return std::nullopt;
  const double rate = record_.histories.front().sample_rate;
  const double samples = step * rate * core::two_pi / constants_.natural_frequency();
  std::optional<FreedFit> best;
  for (const int direction : {1, -1})
    for (int i = 1; i <= most; ++i) {
      const std::ptrdiff_t by = std::lround(direction * std::max(1.0, samples) * i);
      Record moved = record_;
      for (History& history : moved.histories)
        for (std::vector<double>* drive : {&history.y, &history.force}) shift(*drive, by);
      std::optional<FreedFit> fit = fitted(moved, constants_);
      if (!fit || (best && fit->missed >= best->missed)) break;
      best = std::move(fit);
      best->change = static_cast<double>(by) / rate;
    }
  return best;
}

const FreedFit* FreedConstants::with(const FreedPart& part) {
  const bool is_of_x = part.sensor == MotionSensor::x;
  const bool has_fit =
      part.kind == Kind::constant || (is_of_x && (part.kind == Kind::zero || part.kind == Kind::delay));
  if (!has_fit) return nullptr;
  const auto [item, is_new] = found_.try_emplace({part.kind, part.by});
  if (is_new)
    item->second = part.kind == Kind::zero    ? with_zero()
                   : part.kind == Kind::delay ? with_delay()
                                              : with_constant(part.by);
  return item->second ? &*item->second : nullptr;
}

double FreedConstants::missed_as_stated() {
  if (!missed_) missed_ = share_missed(stated_);
  return *missed_;
}

const FreedFit* FreedConstants::best(std::initializer_list<Kind> kinds) {
  const FreedFit* best = nullptr;
  for (const Kind kind : kinds)
    for (const By by : {By::mass, By::stiffness}) {
      const FreedFit* other = with({.kind = kind, .by = kind == Kind::constant ? by : By::mass});
      if (other != nullptr && (best == nullptr || other->missed < best->missed)) best = other;
    }
  return best;
}

const FreedFit* FreedConstants::much_nearer() {
  constexpr double much = 0.5;
  const double stated = missed_as_stated();
  const FreedFit* other = stated < good_part ? nullptr : best({Kind::constant, Kind::zero, Kind::delay});
  return other != nullptr && other->missed < much * stated ? other : nullptr;
}

std::string FreedConstants::fault() {
  constexpr double most = 0.5;
  double least = missed_as_stated();
  if (least < most) return {};
  if (const FreedFit* other = best({Kind::constant, Kind::zero, Kind::delay}))
    least = std::min(least, other->missed);
  if (least < most) return {};
  constexpr int digits = 2;
  return "the simulated motion misses " + core::percent(least, digits) +
         " of the measured one, whatever the mass, the stiffness, the zero of x and its delay";
}

}  // namespace dualdamp::identify
