#include "identify/methods/amplitudes/resonance_two_point.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/numbers.hpp"
#include "identify/conclusion.hpp"
#include "identify/methods/amplitudes/resonance_line.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/statistics.hpp"

namespace dualdamp::identify {

namespace {

std::optional<Line> line_through(const std::vector<Datum>& two) {
  const double dY = two[1].Y - two[0].Y;
  if (dY == 0.0) return std::nullopt;
  const double slope = (two[1].x - two[0].x) / dY;
  return Line{slope, (two[0].x * two[1].Y - two[1].x * two[0].Y) / dY};
}

/// For every first index: the pairs of smallest and largest input from there on (of equal inputs the lower number).
class Outermost {
 public:
  explicit Outermost(const std::vector<Datum>& pairs)
      : pairs_(pairs), least_(pairs.size()), greatest_(pairs.size()) {
    for (std::size_t i = pairs.size(); i-- > 0;) {
      least_[i] = greatest_[i] = i;
      if (i + 1 == pairs.size()) continue;
      const auto before = [&](std::size_t a, std::size_t b, double sign) {
        const double difference = sign * (pairs_[a].Y - pairs_[b].Y);
        return difference < 0.0 || (difference == 0.0 && pairs_[a].number < pairs_[b].number);
      };
      if (before(least_[i + 1], i, 1.0)) least_[i] = least_[i + 1];
      if (before(greatest_[i + 1], i, -1.0)) greatest_[i] = greatest_[i + 1];
    }
  }

  [[nodiscard]] std::vector<Datum> from(std::size_t first) const {
    return {pairs_[least_[first]], pairs_[greatest_[first]]};
  }

 private:
  const std::vector<Datum>& pairs_;
  std::vector<std::size_t> least_;
  std::vector<std::size_t> greatest_;
};

/// The named pairs in the order of naming; empty after `estimate` has been refused.
std::vector<Datum> named_pairs(const ResonanceData& data, const TwoPointOptions& options, Estimate& estimate) {
  if (options.pairs.size() != 2 || options.pairs[0] == options.pairs[1]) {
    refuse(estimate, options.pairs.size() == 2 ? "the two named pairs are the same" : "two pairs must be named");
    return {};
  }
  std::vector<Datum> named;
  for (const int number : options.pairs) {
    const auto found = std::find_if(data.pairs.begin(), data.pairs.end(),
                                    [number](const Datum& datum) { return datum.number == number; });
    if (found == data.pairs.end()) {
      refuse(estimate, "pair " + std::to_string(number) + " was named and is not among the pairs that can be used");
      return {};
    }
    named.push_back(*found);
  }
  return named;
}

/// Two pairs always lie on a straight line; the other sliding pairs may not.
void judge_others(const std::vector<Datum>& sliding, const std::vector<Datum>& two, const Line& line,
                  Estimate& estimate, std::vector<std::string>& faults) {
  const auto off = [&line](const Datum& datum) {
    return std::abs(datum.x - (line.intercept + line.slope * datum.Y));
  };
  const auto farthest = std::max_element(sliding.begin(), sliding.end(),
                                         [&off](const Datum& a, const Datum& b) { return off(a) < off(b); });
  const double fraction = off(*farthest) / std::abs(two[1].x - two[0].x);
  if (fraction < 0.05) return;
  std::vector<std::string>& list = fraction < 0.1 ? estimate.warnings : faults;
  list.push_back("pair " + std::to_string(farthest->number) + " lies off the line through the two by " +
                 core::percent(fraction, 3) + " of their distance in x");
}

/// The two pairs to use, none of which sticks at their own estimate; empty after `estimate` has been refused.
/// `sliding` receives all pairs that do not stick.
std::vector<Datum> choose(const ResonanceData& data, const TwoPointOptions& options, std::vector<Datum>& sliding,
                          Estimate& estimate) {
  const auto total = data.pairs.size() + estimate.excluded.size();
  const bool by_name = !options.pairs.empty();
  std::vector<Datum> two;
  std::size_t first = 0;
  if (by_name) {
    two = named_pairs(data, options, estimate);
    if (two.empty()) return {};
    if (std::string fault = fault_of(two, total, estimate.excluded); !fault.empty()) {
      refuse(estimate, std::move(fault));
      return {};
    }
    first = first_sliding_pair(data, [&two](std::size_t) { return line_through(two); }, estimate);
  } else {
    const Outermost outermost(data.pairs);
    first = first_sliding_pair(data, [&](std::size_t i) { return line_through(outermost.from(i)); }, estimate);
    if (data.pairs.size() - first >= 2) two = outermost.from(first);
  }
  sliding.assign(data.pairs.begin() + static_cast<std::ptrdiff_t>(first), data.pairs.end());
  std::string fault = fault_of(sliding, total, estimate.excluded);
  for (const Datum& datum : two) {
    const bool excluded = std::none_of(sliding.begin(), sliding.end(),
                                       [&datum](const Datum& other) { return other.number == datum.number; });
    if (fault.empty() && excluded) fault = "pair " + std::to_string(datum.number) + " was named and sticks";
  }
  if (fault.empty()) return two;
  refuse(estimate, std::move(fault));
  return {};
}

void add_uncertainty(const ResonanceData& data, const TwoPointSensitivity& s, const TwoPointOptions& options,
                     Estimate& estimate) {
  if (!(options.sigma_x > 0.0) && !(options.sigma_Y > 0.0)) return;
  Eigen::Matrix<double, 2, 4> jacobian;
  jacobian << s.of_zeta.x1 / data.unit, s.of_zeta.x2 / data.unit, s.of_zeta.Y1 / data.unit,
      s.of_zeta.Y2 / data.unit, s.of_x_f.x1, s.of_x_f.x2, s.of_x_f.Y1, s.of_x_f.Y2;
  const Eigen::Vector4d deviation(options.sigma_x, options.sigma_x, options.sigma_Y, options.sigma_Y);
  const Eigen::Matrix<double, 2, 4> scaled = jacobian * deviation.asDiagonal();
  const Eigen::Matrix2d covariance = scaled * scaled.transpose();
  set_uncertainty(estimate, covariance, normal95(), data.constants);
}

}  // namespace

Estimate resonance_two_point(const Record& record, const KnownConstants& constants,
                             const TwoPointOptions& options) {
  Estimate estimate;
  estimate.method = resonance_two_point_method.name;
  const std::optional<ResonanceData> data = prepare(record, constants, options, estimate);
  if (!data) return estimate;
  std::vector<Datum> sliding;
  const std::vector<Datum> two = choose(*data, options, sliding, estimate);
  if (two.empty()) return estimate;
  const std::optional<Line> line = line_through(two);
  const std::optional<LineFriction> friction = line ? friction_of(*line, data->G) : std::nullopt;
  if (!friction) {
    refuse(estimate, "the output amplitude does not grow with the input amplitude");
    return estimate;
  }
  estimate.value = parameters(friction->zeta, friction->x_f * data->unit, constants);
  estimate.used = numbers_of(two);
  estimate.line = LineFit{line->slope, line->intercept * data->unit, 0.0, friction->G, {}};
  const TwoPointSensitivity s = two_point_sensitivity({two[0].Y, two[0].x}, {two[1].Y, two[1].x}, data->G);
  add_uncertainty(*data, s, options, estimate);

  std::vector<std::string> faults;
  judge_signs(estimate, std::max(two[0].Y, two[1].Y) * data->unit, faults);
  judge_others(sliding, two, *line, estimate, faults);
  judge_method(*data, exact_pairs(*data, two, *friction), *friction, line_through, estimate, faults);
  conclude(estimate, faults,
           "rests on pairs " + std::to_string(two[0].number) + " and " + std::to_string(two[1].number) + " at " +
               frequency_text(*data));
  return estimate;
}

constinit const MethodEntry resonance_two_point_method{
    .name = "resonance_two_point",
    .summary = "damping ratio and friction force from two amplitude pairs",
    .assumes =
        "excitation at w = wn, zeta small, no sticking; checked: sticking pairs are left out, what the method would "
        "make of its own estimate by the exact law",
    .equation = "zeta = (Y2 - Y1)/(2 (x2 - x1)), x_f = (x1 Y2 - x2 Y1)/(G(zeta) (Y1 - Y2)), G by Eq (4) at w = wn",
    .sources = "liang2004identifying",
    .needs = RecordKind::pairs,
    .lacks = lacks_resonance_pairs,
    .call = call_of<resonance_two_point>,
    .rests_on = AssumptionSet::all_but(),
};

}  // namespace dualdamp::identify
