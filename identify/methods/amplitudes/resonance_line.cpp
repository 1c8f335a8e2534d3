#include "identify/methods/amplitudes/resonance_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/methods/amplitudes/input_levels.hpp"
#include "identify/statistics/statistics.hpp"
#include "sim/analytic/den_hartog.hpp"

namespace dualdamp::identify {

namespace analytic = sim::analytic;

namespace {

/// Amplitudes closer than this fraction are equal: their difference is rounding.
constexpr double equal_fraction = 64.0 * std::numeric_limits<double>::epsilon();

/// Frequencies outside this range of w/wn are far from resonance.
constexpr double least_ratio = 0.5;
constexpr double greatest_ratio = 2.0;

std::string exclusion_reason(const Pair& pair) {
  if (!std::isfinite(pair.Y) || !std::isfinite(pair.x)) return "an amplitude is not finite";
  if (pair.Y < 0.0 || pair.x < 0.0) return "an amplitude is negative";
  if (pair.Y == 0.0) return "the input amplitude is zero";
  if (pair.x == 0.0) return "the output amplitude is zero: the mass sticks";
  return {};
}

/// Each root is taken separately, because k/m may leave the range of double precision.
double frequency_ratio(double frequency, const KnownConstants& constants) {
  return frequency * std::sqrt(constants.mass) / std::sqrt(constants.stiffness);
}

/// Index of the label; most pairs have the label of the pair before them.
int sweep_index(const std::string& label, std::vector<std::string>& labels) {
  if (labels.empty() || labels.back() != label) {
    const auto found = std::ranges::find(labels, label);
    if (found != labels.end()) return static_cast<int>(found - labels.begin());
    labels.push_back(label);
  }
  return static_cast<int>(labels.size()) - 1;
}

template <typename Value>
bool nearly_equal(const std::vector<Datum>& pairs, Value value) {
  const auto [least, greatest] = std::minmax_element(
      pairs.begin(), pairs.end(), [value](const Datum& a, const Datum& b) { return value(a) < value(b); });
  return value(*greatest) - value(*least) <= equal_fraction * value(*greatest);
}

}  // namespace

std::optional<ResonanceData> take_pairs(const Record& record, const KnownConstants& constants, Estimate& estimate) {
  const auto refused = [&estimate](std::string reason) {
    if (!reason.empty()) refuse(estimate, std::move(reason));
    return !estimate.outcome.ok();
  };
  if (refused(lacks_pairs(record)) || refused(lacks_constants(constants))) return std::nullopt;
  ResonanceData data;
  data.constants = constants;
  double largest = 0.0;
  for (std::size_t i = 0; i < record.pairs->pairs.size(); ++i) {
    const Pair& pair = record.pairs->pairs[i];
    const double r = frequency_ratio(frequency_of(pair, constants), constants);
    if (std::isnan(r)) {
      refuse(estimate, "the method needs the forcing frequency");
      return std::nullopt;
    }
    if (i == 0) data.r = r;
    const int number = pair.number > 0 ? pair.number : static_cast<int>(i) + 1;
    if (std::string reason = exclusion_reason(pair); !reason.empty()) {
      estimate.excluded.push_back({number, std::move(reason)});
      continue;
    }
    data.pairs.push_back({pair.Y, pair.x, number, sweep_index(pair.sweep, data.sweeps), r});
    largest = std::max(largest, pair.x);
  }
  data.unit = largest > 0.0 ? std::ldexp(1.0, std::ilogb(largest)) : 1.0;
  for (Datum& datum : data.pairs) {
    datum.Y /= data.unit;
    datum.x /= data.unit;
  }
  std::ranges::sort(data.pairs, {}, [](const Datum& datum) { return std::pair(datum.x, datum.number); });
  return data;
}

std::optional<ResonanceData> prepare(const Record& record, const KnownConstants& constants,
                                     const ResonanceOptions& options, Estimate& estimate) {
  if (std::string lack = lacks_resonance_pairs(record); !lack.empty()) {
    refuse(estimate, std::move(lack));
    return std::nullopt;
  }
  std::optional<ResonanceData> data = take_pairs(record, constants, estimate);
  if (!data) return std::nullopt;
  if (!(data->r >= least_ratio && data->r <= greatest_ratio)) {
    refuse(estimate, "the method needs excitation near resonance, and w/wn is " + core::format_number(data->r, 4));
    return std::nullopt;
  }
  data->G.approximate = options.approximate_G;
  if (std::string fault = fault_of(data->pairs, record.pairs->pairs.size(), estimate.excluded); !fault.empty()) {
    refuse(estimate, std::move(fault));
    return std::nullopt;
  }
  return data;
}

std::optional<LineFriction> friction_of(const Line& line, const ResonanceG& G) {
  if (!(line.slope > 0.0)) return std::nullopt;
  LineFriction friction;
  friction.zeta = 0.5 / line.slope;
  if (!(friction.zeta > 0.0) || !std::isfinite(friction.zeta)) return std::nullopt;
  friction.G = G.value(friction.zeta);
  friction.x_f = -line.intercept / friction.G;
  if (!std::isfinite(friction.G) || !std::isfinite(friction.x_f)) return std::nullopt;
  return friction;
}

std::size_t first_sliding_pair(const ResonanceData& data, const LineFrom& line_from, Estimate& estimate) {
  std::size_t first = 0;
  while (data.pairs.size() - first >= 2) {
    const std::optional<Line> line = line_from(first);
    const std::optional<LineFriction> friction = line ? friction_of(*line, data.G) : std::nullopt;
    if (!friction || !(friction->x_f > 0.0)) break;
    const double limit = analytic::non_sticking_limit(analytic::den_hartog(friction->zeta, data.r));
    const std::size_t before = first;
    for (; first < data.pairs.size() && !(data.pairs[first].x > limit * friction->x_f); ++first) {
      estimate.excluded.push_back(
          {data.pairs[first].number,
           "the mass sticks: x/x_f = " + core::format_number(data.pairs[first].x / friction->x_f, 4) +
               " is not above " + core::format_number(limit, 4) +
               " (at zeta = " + core::format_number(friction->zeta, 4) + ", x_f = " +
               core::format_number(friction->x_f * data.unit, 4) + " " + data.constants.unit("m") + ")"});
    }
    if (first == before) break;
  }
  std::sort(estimate.excluded.begin(), estimate.excluded.end(),
            [](const Exclusion& a, const Exclusion& b) { return a.number < b.number; });
  return first;
}

std::string fault_of(const std::vector<Datum>& pairs, std::size_t total, const std::vector<Exclusion>& excluded) {
  if (pairs.size() < 2) {
    std::string fault = "two pairs are needed, and of " + std::to_string(total) + " in the record " +
                        std::to_string(pairs.size()) + (pairs.size() == 1 ? " is" : " are") + " left";
    if (!excluded.empty())
      fault += "; pair " + std::to_string(excluded.front().number) + ": " + excluded.front().reason;
    return fault;
  }
  if (std::string fault = lacks_levels(pairs); !fault.empty()) return fault;
  if (nearly_equal(pairs, [](const Datum& d) { return d.x; })) return "the output amplitudes are all equal";
  return {};
}

std::vector<Datum> exact_pairs(const ResonanceData& data, const std::vector<Datum>& used,
                               const LineFriction& friction) {
  const analytic::DenHartog functions = analytic::den_hartog(friction.zeta, data.r);
  std::vector<Datum> exact;
  exact.reserve(used.size());
  for (const Datum& datum : used) {
    const std::optional<double> x = analytic::amplitude(functions, datum.Y, std::max(friction.x_f, 0.0));
    if (!x) return {};
    exact.push_back({datum.Y, *x, datum.number, datum.sweep});
  }
  return exact;
}

void judge_method(const ResonanceData& data, const std::vector<Datum>& exact, const LineFriction& friction,
                  const std::function<std::optional<Line>(const std::vector<Datum>&)>& line_through,
                  Estimate& estimate, std::vector<std::string>& faults) {
  const std::optional<Line> line = exact.empty() ? std::nullopt : line_through(exact);
  const std::optional<LineFriction> misread = line ? friction_of(*line, data.G) : std::nullopt;
  if (!misread) {
    faults.push_back("the exact law has no such motion at the estimate and " + frequency_text(data));
    return;
  }
  const auto estimate_of = [&](const LineFriction& read) {
    return parameters(read.zeta, read.x_f * data.unit, data.constants);
  };
  allow_for_misreading(estimate, estimate_of(*misread),
                       [&](const ParameterSet& corrected) -> std::optional<ParameterSet> {
                         LineFriction there = friction;
                         there.zeta = corrected.zeta;
                         there.x_f = corrected.x_f / data.unit;
                         const std::vector<Datum> pairs = exact_pairs(data, exact, there);
                         const std::optional<Line> line_there = pairs.empty() ? std::nullopt : line_through(pairs);
                         const auto read = line_there ? friction_of(*line_there, data.G) : std::nullopt;
                         return read ? std::optional(estimate_of(*read)) : std::nullopt;
                       });
  const double x_f = std::max(friction.x_f, 0.0);
  double largest_input = 0.0;
  for (const Datum& datum : exact) largest_input = std::max(largest_input, datum.Y);
  const double zeta_error = misread->zeta / friction.zeta - 1.0;
  // A percentage of a friction below a thousandth of the input means nothing.
  const double x_f_error = x_f > 1e-3 * largest_input ? misread->x_f / x_f - 1.0 : 0.0;
  const double worst = std::max(std::abs(zeta_error), std::abs(x_f_error));
  if (worst < 0.01) return;
  const std::string text = "at " + frequency_text(data) +
                           " the method is not exact: from exact data with this estimate it reads zeta wrong by " +
                           core::signed_percent(zeta_error, 3) + " and F0 by " +
                           core::signed_percent(x_f_error, 3) + ", because it neglects H and takes q for 2 zeta" +
                           (data.G.approximate ? " and G from Eq (15)" : "");
  if (worst > 0.1) {
    faults.push_back(text);
  } else {
    estimate.warnings.push_back(text + (estimate.interval95 ? "; the interval allows for it" : ""));
  }
}

std::vector<int> numbers_of(const std::vector<Datum>& pairs) {
  std::vector<int> numbers;
  numbers.reserve(pairs.size());
  for (const Datum& datum : pairs) numbers.push_back(datum.number);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

std::string frequency_text(const ResonanceData& data) { return "w/wn = " + core::format_number(data.r, 4); }

}  // namespace dualdamp::identify
