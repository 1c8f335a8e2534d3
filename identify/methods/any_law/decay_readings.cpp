#include "identify/methods/any_law/decay_readings.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "identify/methods/decays/free_decay.hpp"
#include "sim/motion/free_decay.hpp"
#include "sim/validate.hpp"

namespace dualdamp::identify {

namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Tolerance of steps over the relative noise of the readings, and its bounds. Errors add up over the swings.
constexpr double step_error_over_noise = 1e-4;
constexpr double finest_step_error = 1e-8;
constexpr double coarsest_step_error = 1e-6;
/// Step of differences, relative to the unknown's unit.
constexpr double decay_difference_step = 2e-3;
constexpr double release_deviation = 1.0;
constexpr double offset_deviation = 0.2;

/// A decay is computed without neighbours.
struct NoOrbits final : NearbyOrbits {
  double accuracy = finest_step_error;
};

class DecayReadings final : public ReadingModel {
 public:
  DecayReadings(VectorXd extremes, const KnownConstants& constants, const Estimate& plain, double sigma_x)
      : constants_(constants), release_(extremes[0]) {
    readings_ = std::move(extremes);
    driven_ = false;
    numbers_ = plain.used;
    nuisances_ = {{"release", release_deviation}, {"offset", offset_deviation}};
    const double offset = plain.decay ? plain.decay->offset : 0.0;
    const double last = std::abs(readings_[readings_.size() - 1] - offset);
    reference_ = {.amplitude = 0.5 * (std::abs(release_ - offset) + last),
                  .frequency = constants.natural_frequency(),
                  .Y = std::abs(release_)};
    begin_with(plain.value, reference_.speed());
    start_[2] = -offset / release_;
    start_[3] = offset / release_;
    channels_.assign(static_cast<std::size_t>(readings_.size()), 0);
    known_deviations_ = {sigma_x};
    least_deviations_ = {least_relative_deviation * std::abs(release_)};
    find_smooth_curve(offset);
    data_ = std::to_string(readings_.size()) + " extremes of a free vibration";
  }

  /// Extremes that are planned.
  DecayReadings(const ReadingModel& record, double release, VectorXd extremes, const KnownConstants& constants,
                double deviation)
      : constants_(constants), release_(release) {
    readings_ = std::move(extremes);
    driven_ = false;
    nuisances_ = {{"release", release_deviation}, {"offset", offset_deviation}};
    reference_ = record.reference();
    F0_unit_ = record.F0_unit();
    c_unit_ = record.c_unit();
    start_ = VectorXd::Zero(unknowns());
    channels_.assign(static_cast<std::size_t>(readings_.size()), 0);
    known_deviations_ = {deviation};
    least_deviations_ = {least_relative_deviation * std::abs(release_)};
    find_smooth_curve(0.0);
  }

  [[nodiscard]] std::unique_ptr<NearbyOrbits> no_orbits(const std::vector<double>& deviations) const override {
    auto none = std::make_unique<NoOrbits>();
    none->accuracy =
        std::clamp(step_error_over_noise * relative_noise(deviations), finest_step_error, coarsest_step_error);
    return none;
  }

  [[nodiscard]] std::optional<VectorXd> residuals(const LawAt& law, const VectorXd& p,
                                                  NearbyOrbits& none) const override {
    const double accuracy = static_cast<const NoOrbits&>(none).accuracy;
    const sim::Model model = model_of(law, p, accuracy);
    if (!sim::validate(model).empty()) return std::nullopt;
    const sim::FreeDecay decay = sim::free_decay(model, static_cast<int>(readings_.size()));
    if (!decay.outcome.ok() || decay.extremes.empty()) return std::nullopt;
    VectorXd result(readings_.size());
    for (Index i = 0; i < result.size(); ++i) {
      // A mass that has come to rest stays where it is.
      const std::size_t peak = std::min(static_cast<std::size_t>(i), decay.extremes.size() - 1);
      result[i] = readings_[i] - decay.extremes[peak].x - p[3] * release_;
    }
    return result;
  }

  [[nodiscard]] std::optional<Eigen::MatrixXd> derivatives(const LawAt& law, const VectorXd& p,
                                                           const VectorXd& here,
                                                           NearbyOrbits& near) const override {
    Eigen::MatrixXd jacobian(here.size(), unknowns());
    for (Index j = 0; j < 3; ++j) {
      VectorXd moved = p;
      moved[j] += decay_difference_step;
      const std::optional<VectorXd> there = residuals(law, moved, near);
      if (!there) return std::nullopt;
      jacobian.col(j) = (here - *there) / decay_difference_step;
    }
    jacobian.col(3).setConstant(release_);
    return jacobian;
  }

 private:
  void find_smooth_curve(double offset) {
    smooth_curve_.resize(readings_.size(), 4);
    for (Index i = 0; i < readings_.size(); ++i) {
      const double swing = (readings_[i] - offset) / release_;
      const double side = i % 2 == 0 ? 1.0 : -1.0;
      smooth_curve_.row(i) << 1.0, side, swing, side * swing * swing;
    }
  }

  [[nodiscard]] sim::Model model_of(const LawAt& law, const VectorXd& p, double accuracy) const {
    departures::Truth truth;
    truth.model.oscillator.mass = constants_.mass;
    truth.model.oscillator.stiffness = constants_.stiffness;
    truth.model.oscillator.damping = p[1] * c_unit_;
    truth.model.initial.position = release_ * (1.0 + p[2]);
    truth.F0 = p[0] * F0_unit_;
    sim::Model model = law.model(truth, reference_);
    model.solver.tolerance = accuracy;
    return model;
  }

  KnownConstants constants_;
  double release_;  ///< the first extreme [m], signed
};

}  // namespace

std::variant<std::unique_ptr<const ReadingModel>, std::string> decay_readings(const Record& record,
                                                                              const KnownConstants& constants,
                                                                              double sigma_x) {
  const Estimate plain = free_decay(record, constants, {.sigma_x = sigma_x});
  if (!plain.outcome.ok()) return plain.outcome.reason;
  if (!is_friction(plain))
    return "Coulomb and viscous friction fit this decay only with a negative force or damping, from which no law can "
           "start";
  std::vector<double> used;
  for (const int number : plain.used) used.push_back(record.decay->extremes[static_cast<std::size_t>(number - 1)]);
  constexpr std::size_t fewest = 6;
  if (used.size() < fewest) return "fewer than six extremes can be used";
  return std::make_unique<const DecayReadings>(
      Eigen::Map<const VectorXd>(used.data(), static_cast<Index>(used.size())), constants, plain, sigma_x);
}

std::unique_ptr<const ReadingModel> planned_decay(const ReadingModel& record, double release, VectorXd extremes,
                                                  const KnownConstants& constants, double deviation) {
  return std::make_unique<const DecayReadings>(record, release, std::move(extremes), constants, deviation);
}

}  // namespace dualdamp::identify
