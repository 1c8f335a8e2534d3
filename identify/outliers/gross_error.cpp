#include "identify/outliers/gross_error.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <boost/math/statistics/univariate_statistics.hpp>
#include <cmath>
#include <cstddef>

#include "core/numbers.hpp"
#include "identify/outliers/readings.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/distributions.hpp"

namespace dualdamp::identify {

namespace {

using Eigen::Index;

constexpr double gross = 0.3;
constexpr double rare = 1e-3;  ///< chance of a gross error in a record that has none

bool can_be_wrong(const Reading& reading) {
  return reading.per_deviation != 0.0 &&
         (reading.kind == ReadingKind::amplitude || reading.kind == ReadingKind::extreme);
}

bool same(const Reading& a, const Reading& b) { return a.kind == b.kind && a.number == b.number; }

/// One reading against the others, at a value that it may have had.
struct Standing {
  Reading reading;
  double left = 0.0;       ///< what the model leaves of it, over its deviation
  double share = 0.0;      ///< 1 - leverage
  double deviation = 0.0;  ///< rms of what the model leaves of the others of its kind
  double freedom = 0.0;    ///< of that deviation
};

std::optional<Standing> standing_of(const JointModel& model, const Reading& wanted) {
  const auto at = std::ranges::find_if(model.readings, [&](const Reading& r) { return same(r, wanted); });
  if (at == model.readings.end() || !can_be_wrong(*at)) return std::nullopt;
  const Index row = at - model.readings.begin();
  const Eigen::VectorXd left = left_beside(model.base, model.residuals);
  Standing standing{.reading = *at, .left = left[row]};
  standing.share = 1.0 - orthonormal_basis(model.base).row(row).squaredNorm();
  double squares = 0.0;
  double count = 0.0;
  for (Index i = 0; i < left.size(); ++i) {
    const Reading& other = model.readings[static_cast<std::size_t>(i)];
    if (i == row || other.kind != wanted.kind || other.per_deviation == 0.0) continue;
    squares += left[i] * left[i];
    count += 1.0;
  }
  standing.freedom = count - static_cast<double>(model.base.cols());
  standing.deviation = std::sqrt(squares / standing.freedom);
  constexpr double least_share = 1e-9;
  if (!(standing.freedom >= 1.0 && standing.share > least_share)) return std::nullopt;
  return standing;
}

/// A value from which the search begins: that of the reading beside it.
double value_beside(const Record& record, const Reading& reading) {
  if (reading.kind == ReadingKind::extreme) {
    const std::vector<double>& extremes = record.decay->extremes;
    const auto at = static_cast<std::size_t>(reading.number - 1);
    return -(at > 0 ? extremes[at - 1] : extremes[at + 1]);
  }
  std::vector<double> others;
  for (const Pair& pair : record.pairs->pairs)
    if (pair.number != reading.number) others.push_back(pair.x);
  return boost::math::statistics::median(others);
}

/// The reading with the value that the others expect. Nothing if they determine none.
std::optional<GrossError> against_others(const Record& record, const KnownConstants& constants,
                                         const Reading& reading) {
  Record moved = record;
  double& value = value_of(moved, reading);
  GrossError error{.reading = reading, .value = value};
  value = value_beside(record, reading);
  constexpr int iterations = 20;
  constexpr double still = 1e-3;
  for (int i = 0; i < iterations; ++i) {
    const std::optional<JointModel> model = model_of_readings(moved, constants);
    const std::optional<Standing> standing = model ? standing_of(*model, reading) : std::nullopt;
    if (!standing) return std::nullopt;
    const double step = -standing->left / standing->share * standing->reading.per_deviation;
    if (!std::isfinite(step)) return std::nullopt;
    if (std::abs(step) <= still * std::abs(value)) {
      const double unit = standing->deviation / std::sqrt(standing->share) * standing->reading.per_deviation;
      error.expected = value;
      error.deviations = (error.value - value) / std::abs(unit);
      const double p = f_test_p_value(error.deviations * error.deviations, 1.0, standing->freedom);
      const auto tried = static_cast<double>(model->readings.size());
      return p * tried < rare ? std::optional(error) : std::nullopt;
    }
    value += step;
    // x of a steady state is positive, and an extreme keeps its side.
    if (value * error.value <= 0.0) value = 0.1 * (value - step);
  }
  return std::nullopt;
}

double median_size(const Record& record, ReadingKind kind) {
  std::vector<double> sizes;
  if (kind == ReadingKind::extreme) {
    for (const double extreme : record.decay->extremes) sizes.push_back(std::abs(extreme));
  } else {
    for (const Pair& pair : record.pairs->pairs) sizes.push_back(pair.x);
  }
  return boost::math::statistics::median(sizes);
}

bool is_gross(const GrossError& error, const Record& record) {
  const double off = std::abs(error.value - error.expected);
  return off > gross * std::abs(error.expected) && off > gross * median_size(record, error.reading.kind);
}

std::vector<Reading> all_readings(const Record& record) {
  std::vector<Reading> readings;
  if (record.pairs)
    for (const Pair& pair : record.pairs->pairs) readings.push_back({ReadingKind::amplitude, pair.number, 1.0});
  else
    for (std::size_t i = 0; i < record.decay->extremes.size(); ++i)
      readings.push_back({ReadingKind::extreme, static_cast<int>(i) + 1, 1.0});
  return readings;
}

}  // namespace

std::optional<GrossError> gross_error(const Record& record, const KnownConstants& constants,
                                      const std::vector<Reading>& suspects) {
  std::optional<GrossError> worst;
  const std::vector<Reading> all = all_readings(record);
  constexpr std::size_t fewest = 4;  // two parameters, the reading itself, and one to judge it by
  if (all.size() < fewest) return worst;
  for (const Reading& reading : suspects.empty() ? all : suspects) {
    if (!can_be_wrong(reading)) continue;
    const std::optional<GrossError> found = against_others(record, constants, reading);
    if (!found || !is_gross(*found, record)) continue;
    if (!worst || std::abs(found->deviations) > std::abs(worst->deviations)) worst = found;
  }
  return worst;
}

std::string text_of(const GrossError& error) {
  return name_of(error.reading) + " is " + core::format_number(error.value / error.expected, 2) +
         " times what all other readings expect" +
         (error.reading.kind == ReadingKind::amplitude ? " at its Y" : "");
}

}  // namespace dualdamp::identify
