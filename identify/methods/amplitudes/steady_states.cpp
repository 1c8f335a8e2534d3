#include "identify/methods/amplitudes/steady_states.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/models/force_parameters.hpp"
#include "identify/models/sticking.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/statistics.hpp"
#include "sim/analytic/den_hartog.hpp"

namespace dualdamp::identify {

namespace analytic = sim::analytic;
using std::numbers::pi;

std::string lacks_phases(const Record& record) {
  if (std::string lack = lacks_pairs(record); !lack.empty()) return lack;
  const auto known =
      std::ranges::count_if(record.pairs->pairs, [](const Pair& pair) { return !std::isnan(pair.phase); });
  return known >= 2 ? "" : "the record holds no x-Y pairs with phases";
}

namespace {

std::string exclusion_reason(const Pair& pair, bool phases) {
  if (!(pair.Y > 0.0) || !std::isfinite(pair.Y)) return "the input amplitude is not positive and finite";
  if (!(pair.x > 0.0) || !std::isfinite(pair.x)) return "the output amplitude is not positive and finite";
  if (!phases) return {};
  if (std::isnan(pair.phase)) return "its phase was not measured";
  if (!(std::sin(pair.phase) > 0.0)) return "its phase says that the mass drives the base";
  return {};
}

}  // namespace

double fundamental(const Pair& pair) { return std::isnan(pair.fundamental) ? pair.x : pair.fundamental; }

std::optional<std::vector<Pair>> take_states(const Record& record, const KnownConstants& constants, bool phases,
                                             Estimate& estimate) {
  const auto refused = [&estimate](std::string reason) {
    refuse(estimate, std::move(reason));
    return std::nullopt;
  };
  if (std::string lack = phases ? lacks_phases(record) : lacks_pairs(record); !lack.empty())
    return refused(std::move(lack));
  if (std::isnan(constants.stiffness)) return refused("the method needs the stiffness");
  if (!(constants.stiffness > 0.0) || !std::isfinite(constants.stiffness))
    return refused("the stiffness must be positive and finite");
  std::vector<Pair> states;
  for (std::size_t i = 0; i < record.pairs->pairs.size(); ++i) {
    Pair pair = record.pairs->pairs[i];
    if (pair.number <= 0) pair.number = static_cast<int>(i) + 1;
    pair.omega = frequency_of(pair, constants);
    if (std::isnan(pair.omega)) return refused("the method needs the forcing frequency");
    if (std::string reason = exclusion_reason(pair, phases); !reason.empty())
      estimate.excluded.push_back({pair.number, std::move(reason)});
    else
      states.push_back(std::move(pair));
  }
  return states;
}

bool drop_sticking(std::vector<Pair>& states, const ParameterSet& value, const KnownConstants& constants,
                   Estimate& estimate) {
  if (!(value.zeta > 0.0) || !(value.x_f > 0.0)) return false;
  Sticking sticking(value.zeta, value.x_f);
  const double natural = constants.natural_frequency();
  const auto slides = [&](const Pair& pair) { return !sticking.sticks(pair.x, pair.omega / natural); };
  const auto left = std::ranges::stable_partition(states, slides);
  for (const Pair& pair : left)
    estimate.excluded.push_back(
        {pair.number, "the mass sticks: x/x_f = " + core::format_number(pair.x / value.x_f, 4)});
  const bool any = !left.empty();
  states.erase(left.begin(), left.end());
  std::ranges::sort(estimate.excluded, {}, &Exclusion::number);
  return any;
}

std::vector<Pair> exact_states(const std::vector<Pair>& states, const ParameterSet& value,
                               const KnownConstants& constants) {
  std::vector<Pair> exact;
  exact.reserve(states.size());
  analytic::DenHartog functions;
  double limit = 0.0;
  double omega = 0.0;
  for (const Pair& measured : states) {
    if (measured.omega != omega) {
      omega = measured.omega;
      functions = analytic::den_hartog(value.zeta, omega / constants.natural_frequency());
      limit = analytic::non_sticking_limit(functions);
    }
    const auto state = analytic::non_sticking_state(functions, limit, measured.Y, value.x_f);
    if (!state) continue;
    Pair pair = measured;
    pair.x = state->amplitude;
    if (!std::isnan(pair.phase)) pair.phase = state->phase;
    if (!std::isnan(pair.fundamental)) pair.fundamental = state->fundamental;
    if (!std::isnan(pair.mean_square_speed)) {
      // The work of the base in a period less that of friction is the work of the damper.
      const double work = pi * constants.stiffness * pair.Y * state->fundamental * std::sin(state->phase);
      pair.mean_square_speed = (work - 4.0 * value.F0 * pair.x) / value.c * pair.omega / core::two_pi;
    }
    exact.push_back(std::move(pair));
  }
  return exact;
}

void judge_own_reading(const std::vector<Pair>& states, const KnownConstants& constants,
                       const std::function<std::optional<ParameterSet>(const std::vector<Pair>&)>& read,
                       const std::string& because, Estimate& estimate, std::vector<std::string>& faults) {
  const ParameterSet value = estimate.value;
  if (!(value.zeta > 0.0) || !(value.x_f >= 0.0)) return;
  const std::vector<Pair> exact = exact_states(states, value, constants);
  const std::optional<ParameterSet> own = exact.size() < 2 ? std::nullopt : read(exact);
  if (!own) {
    estimate.warnings.push_back("how far the method misreads its own estimate " + because +
                                " cannot be determined: the exact law has no motion without a stop there");
    return;
  }
  if (exact.size() == states.size()) {
    allow_for_misreading(estimate, *own, [&](const ParameterSet& corrected) -> std::optional<ParameterSet> {
      const std::vector<Pair> there = exact_states(states, corrected, constants);
      return there.size() == states.size() ? read(there) : std::nullopt;
    });
  }
  double largest_input = 0.0;
  for (const Pair& pair : exact) largest_input = std::max(largest_input, pair.Y);
  const double c_error = own->c / value.c - 1.0;
  // A percentage of a friction below a thousandth of the input means nothing.
  const double F0_error = value.x_f > 1e-3 * largest_input ? own->F0 / value.F0 - 1.0 : 0.0;
  const double worst = std::max(std::abs(c_error), std::abs(F0_error));
  if (worst < 0.01) return;
  const std::string text = "the method is not exact: from exact data with this estimate it reads zeta wrong by " +
                           core::signed_percent(c_error, 3) + " and F0 by " + core::signed_percent(F0_error, 3) +
                           ", " + because;
  if (worst > 0.1)
    faults.push_back(text);
  else
    estimate.warnings.push_back(text + (estimate.interval95 ? "; the interval allows for it" : ""));
}

std::optional<ForceLine> force_line(std::vector<Datum> points, double share) {
  ForceLine result;
  result.points = std::move(points);
  result.share = share;
  result.moments = moments_of(result.points);
  constexpr double same = 1e-9;  // of a speed
  const double spread = std::sqrt(result.moments.S_YY);
  if (result.points.size() < 2 || !(spread > same * result.moments.mean_Y)) return std::nullopt;
  const std::optional<Line> line = line_of(result.moments, core::infinity);
  if (!line) return std::nullopt;
  result.line = *line;
  result.residuals.resize(static_cast<Eigen::Index>(result.points.size()));
  for (std::size_t i = 0; i < result.points.size(); ++i)
    result.residuals[static_cast<Eigen::Index>(i)] =
        result.points[i].x - line->intercept - line->slope * result.points[i].Y;
  return result;
}

void set_estimate(Estimate& estimate, const ForceLine& line, const KnownConstants& constants) {
  const ForceParameters force{constants.mass, line.c(), constants.stiffness, line.F0()};
  estimate.value = parameters(force);
  if (line.freedom() < 1.0) return;
  const double variance = line.residuals.squaredNorm() / line.freedom();
  const double of_c = variance / line.moments.S_YY;
  const double mean = line.moments.mean_Y;
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  covariance(1, 1) = of_c;
  covariance(3, 3) = (variance / line.moments.count + mean * mean * of_c) / (line.share * line.share);
  covariance(1, 3) = covariance(3, 1) = -mean * of_c / line.share;
  set_estimate(estimate, force, covariance, quantile95(line.freedom()));
}

}  // namespace dualdamp::identify
