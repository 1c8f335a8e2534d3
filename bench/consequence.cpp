#include "bench/consequence.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "identify/statistics/least_squares.hpp"

namespace dualdamp::bench {

namespace {

using Readings = std::vector<double>;

/// The sensors without noise and resolution.
identify::Sensors quiet(identify::Sensors sensors) {
  for (identify::Sensor* sensor : {&sensors.y, &sensors.x, &sensors.v, &sensors.a, &sensors.force})
    sensor->noise = sensor->resolution = 0.0;
  return sensors;
}

/// Standard deviation of one reading.
double deviation(const identify::Sensor& sensor) {
  return std::hypot(sensor.noise, sensor.resolution / std::sqrt(12.0));
}

/// Whether the samples of x, v and a are readings: those with noise, of which resolution is a part; without any, x.
std::array<bool, 3> sampled_channels(const identify::Sensors& sensors) {
  const std::array<bool, 3> noisy = {deviation(sensors.x) > 0.0, deviation(sensors.v) > 0.0,
                                     deviation(sensors.a) > 0.0};
  return noisy[0] || noisy[1] || noisy[2] ? noisy : std::array{true, false, false};
}

/// Extremes of a decay that has come to rest: the remaining ones are the position where the mass sticks. So motions
/// with different numbers of swings can be compared, and the readings change continuously as a swing vanishes.
Readings with_rest(Readings extremes, int peaks) {
  if (!extremes.empty())
    extremes.resize(std::max(extremes.size(), static_cast<std::size_t>(peaks)), extremes.back());
  return extremes;
}

/// Appends numbers in the order of `readings_of` and `deviations_of`.
void append(Readings& list, const Readings& more) { list.insert(list.end(), more.begin(), more.end()); }

/// The readings, in a fixed order.
Readings readings_of(const Motions& motions, const identify::Sensors& sensors) {
  std::vector<std::string> unused;
  const identify::Record record = motions.reading(quiet(sensors), 0, unused);
  Readings list;
  if (!record.histories.empty()) {
    const auto [has_x, has_v, has_a] = sampled_channels(sensors);
    for (const identify::History& history : record.histories) {
      if (has_x) append(list, history.x);
      if (has_v) append(list, history.v);
      if (has_a) append(list, history.a);
    }
  } else if (record.pairs) {
    for (const identify::Pair& pair : record.pairs->pairs) {
      list.push_back(pair.x);
      // A mass that never moves has no phase, and a deviation of its phase without bound.
      list.push_back(std::isnan(pair.phase) ? 0.0 : pair.phase);
    }
  }
  if (record.decay) append(list, with_rest(record.decay->extremes, motions.peaks));
  return list;
}

/// Standard deviations of these readings; `slopes`: dx/dY of each pair.
Readings deviations_of(const Motions& motions, const identify::Sensors& sensors, const Readings& slopes) {
  Readings list;
  const double x = deviation(sensors.x);
  const double y = deviation(sensors.y);
  const auto [has_x, has_v, has_a] = sampled_channels(sensors);
  for (const identify::History& history : motions.curve.exact.histories) {
    if (has_x) list.insert(list.end(), history.x.size(), x);
    if (has_v) list.insert(list.end(), history.v.size(), deviation(sensors.v));
    if (has_a) list.insert(list.end(), history.a.size(), deviation(sensors.a));
  }
  if (motions.curve.exact.histories.empty() && motions.curve.exact.pairs) {
    const double periods = sensors.average_cycles;
    for (std::size_t i = 0; i < motions.curve.exact.pairs->pairs.size(); ++i) {
      const identify::Pair& pair = motions.curve.exact.pairs->pairs[i];
      const double slope = i < slopes.size() ? slopes[i] : 0.0;
      list.push_back(std::hypot(x, slope * y) / std::sqrt(2.0 * periods));
      list.push_back(std::hypot(x / pair.x, y / pair.Y) / std::sqrt(periods));
    }
  }
  if (motions.decay)
    list.insert(list.end(), with_rest(motions.decay->exact.decay->extremes, motions.peaks).size(), x);
  return list;
}

Readings slopes_of(const MotionMaker& maker, const sim::Model& model, const identify::Sensors& sensors) {
  constexpr double step = 1e-3;
  const Motions here = maker.motions(model, sensors);
  const Motions there = maker.motions(model, sensors, 0.0, 1.0 + step);
  Readings slopes;
  if (!here.curve.exact.pairs || !there.curve.exact.pairs) return slopes;
  const auto& [low, high] = std::pair(here.curve.exact.pairs->pairs, there.curve.exact.pairs->pairs);
  for (std::size_t i = 0; i < std::min(low.size(), high.size()); ++i)
    slopes.push_back((high[i].x - low[i].x) / (step * low[i].Y));
  return slopes;
}

constexpr double step_of_slopes = 1e-3;  // of ln c and ln F0

/// The truth with c and F0 times exp(p).
Truth changed(Truth truth, const Eigen::Vector2d& p) {
  truth.model.oscillator.damping *= std::exp(p[0]);
  truth.F0 *= std::exp(p[1]);
  return truth;
}

/// Readings over their deviations; nothing where not all of them can be measured.
std::optional<Eigen::VectorXd> scaled(const Motions& motions, const identify::Sensors& sensors,
                                      const Readings& deviations) {
  const Readings readings = readings_of(motions, sensors);
  if (readings.size() != deviations.size() || readings.empty()) return std::nullopt;
  Eigen::VectorXd result(static_cast<Eigen::Index>(readings.size()));
  for (std::size_t i = 0; i < readings.size(); ++i)
    result[static_cast<Eigen::Index>(i)] = readings[i] / deviations[i];
  return result;
}

/// The readings of Coulomb + viscous friction, as a function of ln(c/c0) and ln(F0/F00).
class MatchedResponse {
 public:
  MatchedResponse(const MotionMaker& maker, Truth truth, const identify::Sensors& sensors,
                  const Readings& deviations)
      : maker_(maker), truth_(std::move(truth)), sensors_(sensors), deviations_(deviations) {}

  [[nodiscard]] std::optional<Eigen::VectorXd> operator()(const Eigen::Vector2d& p) const {
    return scaled(maker_.motions(undisturbed(changed(truth_, p)), sensors_), sensors_, deviations_);
  }

  [[nodiscard]] std::optional<Eigen::MatrixX2d> slopes(const Eigen::Vector2d& p, Eigen::Index size) const {
    Eigen::MatrixX2d result(size, 2);
    for (Eigen::Index j = 0; j < 2; ++j) {
      Eigen::Vector2d step = Eigen::Vector2d::Zero();
      step[j] = step_of_slopes;
      const std::optional<Eigen::VectorXd> above = (*this)(p + step);
      const std::optional<Eigen::VectorXd> below = (*this)(p - step);
      if (!above || !below) return std::nullopt;
      result.col(j) = (*above - *below) / (2.0 * step_of_slopes);
    }
    return result;
  }

 private:
  const MotionMaker& maker_;
  Truth truth_;
  const identify::Sensors& sensors_;
  const Readings& deviations_;
};

struct Nearest {
  Eigen::Vector2d p;
  double distance = 0.0;
};

/// Levenberg and Marquardt's method from the departure's own c and F0; nothing where it does not end.
std::optional<Nearest> nearest(const MatchedResponse& response, const Eigen::VectorXd& data) {
  identify::LeastSquaresProblem problem;
  problem.residuals = data.size();
  problem.start = Eigen::Vector2d::Zero();
  constexpr double farthest = 10.0;  // a force of exp(-10) times the true one is none
  problem.low = Eigen::Vector2d::Constant(-farthest);
  problem.high = Eigen::Vector2d::Constant(farthest);
  problem.tolerance = 1e-9;
  problem.most_iterations = 100;
  problem.evaluate = [&](const Eigen::VectorXd& p, Eigen::VectorXd& misses, Eigen::MatrixXd* jacobian) {
    const std::optional<Eigen::VectorXd> here = response(p);
    if (!here) return false;
    misses = *here - data;
    if (jacobian == nullptr) return true;
    const std::optional<Eigen::MatrixX2d> slopes = response.slopes(p, data.size());
    if (slopes) *jacobian = *slopes;
    return slopes.has_value();
  };
  const identify::LeastSquaresFit found = identify::fit(problem);
  if (!found.outcome.ok()) return std::nullopt;
  return Nearest{found.parameters, std::sqrt(found.sum_of_squares)};
}

/// Relative standard deviations of (c, F0); `here`: readings of the departure.
std::optional<Eigen::Vector2d> cramer_rao(const Eigen::VectorXd& here, const DepartedMotions& motions,
                                          const identify::Sensors& sensors, const Readings& deviations) {
  Eigen::MatrixX2d slopes(here.size(), 2);
  for (Eigen::Index j = 0; j < 2; ++j) {
    const std::optional<Eigen::VectorXd> there =
        scaled(motions.beside.at(static_cast<std::size_t>(j)), sensors, deviations);
    if (!there) return std::nullopt;
    slopes.col(j) = (*there - here) / step_of_slopes;
  }
  const Eigen::Matrix2d information = slopes.transpose() * slopes;
  if (!(information.determinant() > 0.0)) return std::nullopt;
  return information.inverse().diagonal().cwiseSqrt();
}

/// The model that a departure makes of a truth.
sim::Model model_of(const DepartedRig& departed, const Truth& truth) {
  return departed.departure.model(truth, departed.reference, departed.severity);
}

/// Distribution function of the normal distribution.
double probability_below(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

}  // namespace

double Consequence::harm() const {
  if (std::isnan(harm_zeta)) return std::abs(harm_F0);
  return std::isnan(harm_F0) ? std::abs(harm_zeta) : std::max(std::abs(harm_zeta), std::abs(harm_F0));
}

DepartedMotions departed_motions(const MotionMaker& maker, const DepartedRig& departed, const Truth& truth,
                                 const Laboratory& laboratory) {
  const auto motions = [&](double c, double F0) {
    return maker.motions(model_of(departed, changed(truth, {c, F0})), laboratory.sensors,
                         laboratory.friction_growth);
  };
  return {motions(0.0, 0.0),
          {motions(step_of_slopes, 0.0), motions(0.0, step_of_slopes)},
          maker.unmeasured(model_of(departed, truth))};
}

Consequence consequence_of(const MotionMaker& maker, const DepartedRig& departed, const TrueRig& rig,
                           const DepartedMotions& motions, const Laboratory& laboratory,
                           const identify::Sensors& nominal) {
  Consequence result;
  Truth believed = rig.truth;
  believed.model.oscillator.mass = laboratory.constants.mass;
  believed.model.oscillator.stiffness = laboratory.constants.stiffness;
  const Readings slopes = slopes_of(maker, undisturbed(rig.truth), nominal);
  Readings deviations = deviations_of(motions.here, nominal, slopes);
  const bool has_noise = !deviations.empty() && std::ranges::all_of(deviations, [](double s) { return s > 0.0; });
  if (!has_noise) std::ranges::fill(deviations, 1.0);
  const MatchedResponse simple(maker, believed, nominal, deviations);
  const std::optional<Eigen::VectorXd> data = scaled(motions.here, laboratory.sensors, deviations);
  if (!data) return result;
  const double stretch = std::sqrt(rig.truth.model.oscillator.mass * rig.truth.model.oscillator.stiffness /
                                   (laboratory.constants.mass * laboratory.constants.stiffness));
  if (departed.departure.is_truth()) {
    result = {.distance = 0.0, .harm_zeta = 0.0, .harm_F0 = 0.0};
  } else if (const std::optional<Nearest> found = nearest(simple, *data)) {
    // zeta of the nearest motion refers to the constants that the laboratory believes in.
    if (departed.departure.has_zeta()) result.harm_zeta = std::exp(found->p[0]) * stretch - 1.0;
    if (departed.departure.has_F0()) result.harm_F0 = std::exp(found->p[1]) - 1.0;
    result.distance = found->distance;
  }
  if (!has_noise) result.distance = not_stated;
  constexpr double one_sided = 1.6448536269514722;
  if (!std::isnan(result.distance)) result.attainable_power = probability_below(result.distance - one_sided);
  if (!has_noise) return result;
  if (const std::optional<Eigen::Vector2d> bound = cramer_rao(*data, motions, laboratory.sensors, deviations)) {
    if (departed.departure.has_zeta()) result.cramer_rao_zeta = (*bound)[0];
    if (departed.departure.has_F0()) result.cramer_rao_F0 = (*bound)[1];
  }
  return result;
}

}  // namespace dualdamp::bench
