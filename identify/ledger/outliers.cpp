#include "identify/ledger/outliers.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <variant>

#include "identify/ledger/amplitude_model.hpp"
#include "identify/ledger/decay_model.hpp"
#include "identify/ledger/joint_model.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/median.hpp"

namespace dualdamp::identify {

namespace {

constexpr double bound = 2.0;  ///< k
constexpr std::array<ReadingKind, 4> kinds = {ReadingKind::amplitude, ReadingKind::phase, ReadingKind::extreme,
                                              ReadingKind::time};

std::variant<JointModel, std::string> readings_model(const Record& record, const KnownConstants& constants) {
  if (record.pairs) return amplitude_model(record, constants);
  return decay_model(record, constants);
}

Pair& pair_of(Record& record, int number) { return *std::ranges::find(record.pairs->pairs, number, &Pair::number); }

/// The place of a reading in a record.
double& value_of(Record& record, const Reading& reading) {
  switch (reading.kind) {
    case ReadingKind::amplitude:
      return pair_of(record, reading.number).x;
    case ReadingKind::phase:
      return pair_of(record, reading.number).phase;
    case ReadingKind::extreme:
      return record.decay->extremes[static_cast<std::size_t>(reading.number - 1)];
    case ReadingKind::time:
      break;
  }
  return record.decay->times[static_cast<std::size_t>(reading.number - 1)];
}

std::string name_of(const Reading& reading) {
  const std::string number = std::to_string(reading.number);
  switch (reading.kind) {
    case ReadingKind::amplitude:
      return "x of pair " + number;
    case ReadingKind::phase:
      return "the phase of pair " + number;
    case ReadingKind::extreme:
      return "extreme " + number;
    case ReadingKind::time:
      break;
  }
  return "the time of extreme " + number;
}

/// How far off a measured reading is, in deviations of its channel, positive above the fit.
struct Distance {
  Reading reading;
  double deviations = 0.0;
  double unit = 0.0;  ///< change of the reading for one deviation
};

/// Distances of the readings of `measured` from the fit to `moved`. Nothing where there is no fit.
std::optional<std::vector<Distance>> distances(Record& measured, Record& moved, const KnownConstants& constants) {
  const auto found = readings_model(moved, constants);
  if (std::holds_alternative<std::string>(found)) return std::nullopt;
  const auto& model = std::get<JointModel>(found);
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

}  // namespace

BoundedInfluence bounded_influence(const Record& record, const KnownConstants& constants) {
  BoundedInfluence result{record, {}, 1.0};
  if (!record.histories.empty() || (!record.pairs && !record.decay)) return result;
  Record measured = record;
  std::optional<std::vector<Distance>> last;
  constexpr int iterations = 50;
  constexpr double still = 0.01;
  for (int i = 0; i < iterations; ++i) {
    std::optional<std::vector<Distance>> list = distances(measured, result.record, constants);
    if (!list) break;
    last = std::move(list);
    if (move(*last, measured, result.record) < still) break;
  }
  if (!last) return {record, {}, 1.0};
  double within = 0.0;
  for (const Distance& distance : *last) {
    const double size = std::abs(distance.deviations);
    within += size <= bound ? 1.0 : 0.0;
    if (size > 2.0 * bound)
      result.outliers.push_back({name_of(distance.reading), distance.deviations, bound / size});
  }
  if (!last->empty()) result.within = within / static_cast<double>(last->size());
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
