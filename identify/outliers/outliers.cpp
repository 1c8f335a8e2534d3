#include "identify/outliers/outliers.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "identify/ledger/joint_model.hpp"
#include "identify/outliers/readings.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/median.hpp"

namespace dualdamp::identify {

namespace {

constexpr double bound = 2.0;  ///< k
constexpr std::array<ReadingKind, 4> kinds = {ReadingKind::amplitude, ReadingKind::phase, ReadingKind::extreme,
                                              ReadingKind::time};

/// How far off a measured reading is, in deviations of its channel, positive above the fit.
struct Distance {
  Reading reading;
  double deviations = 0.0;
  double unit = 0.0;  ///< change of the reading for one deviation
};

/// Distances of the readings of `measured` from the fit to `moved`. Nothing where there is no fit.
std::optional<std::vector<Distance>> distances(Record& measured, Record& moved, const KnownConstants& constants) {
  const std::optional<JointModel> found = model_of_readings(moved, constants);
  if (!found) return std::nullopt;
  const JointModel& model = *found;
  const Eigen::VectorXd left = left_beside(model.base, model.residuals);
  std::vector<Distance> list;
  for (const ReadingKind kind : kinds) {
    const std::size_t first = list.size();
    std::vector<double> sizes;
    for (std::size_t i = 0; i < model.readings.size(); ++i) {
      const Reading& reading = model.readings[i];
      if (reading.kind != kind || reading.per_deviation == 0.0) continue;
      const double shift = value_of(moved, reading) - value_of(measured, reading);
      const double off = left[static_cast<Eigen::Index>(i)] - shift / reading.per_deviation;
      const double sign = reading.per_deviation < 0.0 ? -1.0 : 1.0;
      list.push_back({reading, sign * off, sign * reading.per_deviation});
      sizes.push_back(std::abs(off));
    }
    constexpr std::size_t fewest = 6;
    const double count = static_cast<double>(sizes.size());
    if (sizes.size() < fewest) {
      list.resize(first);
      continue;
    }
    constexpr double parameters = 2.0;
    const double deviation = median_deviation(std::move(sizes)) * std::sqrt(count / (count - parameters));
    for (std::size_t i = first; i < list.size(); ++i) {
      // Less than a millionth of a reading is rounding.
      const double least = 1e-6 * std::abs(value_of(measured, list[i].reading) / list[i].unit);
      const double scale = std::max(deviation, least);
      list[i].deviations /= scale;
      list[i].unit *= scale;
    }
  }
  return list;
}

/// Moves readings beyond the bound to it. Returns the largest move, in deviations.
double move(const std::vector<Distance>& list, Record& measured, Record& moved) {
  double most = 0.0;
  for (const Distance& distance : list) {
    double& value = value_of(moved, distance.reading);
    const double kept = std::clamp(distance.deviations, -bound, bound);
    const double wanted = value_of(measured, distance.reading) + (kept - distance.deviations) * distance.unit;
    most = std::max(most, std::abs((wanted - value) / distance.unit));
    value = wanted;
  }
  return most;
}

constexpr std::size_t few = 24;

std::size_t readings_of(const Record& record) {
  return record.pairs ? record.pairs->pairs.size() : record.decay->extremes.size();
}

/// A reading that is a gross error counts nothing: it gets the value that the others expect.
void leave_out(const std::optional<GrossError>& gross, Record& measured, BoundedInfluence& result) {
  if (!gross) return;
  result.gross = gross;
  result.outliers.push_back({name_of(gross->reading), gross->deviations, 0.0});
  value_of(measured, gross->reading) = gross->expected;
  value_of(result.record, gross->reading) = gross->expected;
  result.within = 1.0 - 1.0 / static_cast<double>(readings_of(measured));
}

/// The clearest gross error among the suspects of `record`, beside the other readings as they are in `bounded`.
std::optional<GrossError> gross_error_beside(const Record& record, const Record& bounded,
                                             const KnownConstants& constants,
                                             const std::vector<Reading>& suspects) {
  std::optional<GrossError> worst;
  for (const Reading& suspect : suspects) {
    Record one = bounded;
    Record read = record;
    value_of(one, suspect) = value_of(read, suspect);
    const std::optional<GrossError> found = gross_error(one, constants, {suspect});
    if (found && (!worst || std::abs(found->deviations) > std::abs(worst->deviations))) worst = found;
  }
  return worst;
}

}  // namespace

BoundedInfluence bounded_influence(const Record& record, const KnownConstants& constants) {
  BoundedInfluence result{record, {}, {}, 1.0};
  if (!record.histories.empty() || (!record.pairs && !record.decay)) return result;
  Record measured = record;
  // Among few readings the median does not find it.
  if (readings_of(record) <= few) leave_out(gross_error(record, constants), measured, result);
  std::optional<std::vector<Distance>> last;
  constexpr int iterations = 50;
  constexpr double still = 0.01;
  for (int i = 0; i < iterations; ++i) {
    std::optional<std::vector<Distance>> list = distances(measured, result.record, constants);
    if (!list) break;
    last = std::move(list);
    if (move(*last, measured, result.record) < still) break;
  }
  if (!last) {
    result.record = record;
    result.outliers.clear();
    return result;
  }
  double within = 0.0;
  std::vector<Reading> suspects;
  for (const Distance& distance : *last) {
    const double size = std::abs(distance.deviations);
    within += size <= bound ? 1.0 : 0.0;
    if (size <= 2.0 * bound) continue;
    result.outliers.push_back({name_of(distance.reading), distance.deviations, bound / size});
    suspects.push_back(distance.reading);
  }
  if (!suspects.empty() && !result.gross)
    result.gross = gross_error_beside(record, result.record, constants, suspects);
  if (!last->empty()) result.within *= within / static_cast<double>(last->size());
  return result;
}

void widen(Estimate& estimate, double within) {
  const double factor = 1.0 / within;
  for (const ReportedParameter& parameter : reported_parameters) {
    if (estimate.std) (*estimate.std).*parameter.value *= factor;
    if (!estimate.interval95) continue;
    auto& [low, high] = (*estimate.interval95).*parameter.interval;
    const double centre = std::clamp(estimate.value.*parameter.value, low, high);
    low = centre - (centre - low) * factor;
    high = centre + (high - centre) * factor;
  }
  if (estimate.covariance) *estimate.covariance *= factor * factor;
}

}  // namespace dualdamp::identify
