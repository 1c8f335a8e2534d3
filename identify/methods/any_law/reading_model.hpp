#pragma once
/// The forward model behind the ranges over laws: what a record's readings would be under any friction law.
///
/// The law is a departure of `identify/departures/` at a severity s, or Coulomb + viscous friction. Unknowns are
/// numbers of order one: F0 and c over their values where the search begins, and the nuisances.

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/constants.hpp"
#include "identify/departures/departures.hpp"
#include "identify/equal_work.hpp"
#include "identify/estimate.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

/// A law at a severity; without a departure it is Coulomb + viscous friction.
struct LawAt {
  const departures::Departure* departure = nullptr;
  double severity = 0.0;

  /// A rig under this law. `reference`: the motion that severities refer to.
  [[nodiscard]] sim::Model model(const departures::Truth& truth,
                                 const departures::ReferenceMotion& reference) const {
    return departure == nullptr ? departures::undisturbed(truth)
                                : departures::departed(*departure, truth, reference, severity);
  }
};

/// An unknown beside F0 and c that is free in every fit.
struct Nuisance {
  std::string name;
  double deviation = 0.0;  ///< standard deviation of its prior, about zero; 0: none, the record decides
};

/// Orbits of the last prediction. Orbits of a similar prediction are found quickly next to them. Where a search has
/// a limit of work, it keeps to it.
struct NearbyOrbits {
  virtual ~NearbyOrbits() = default;

  /// Searches for events and their panels (core::SearchCount) of all predictions so far: the same on every machine.
  long work = 0;
  /// Beyond this work there are no predictions.
  long most_work = std::numeric_limits<long>::max();
  [[nodiscard]] bool is_exhausted() const { return work > most_work; }
};

/// Whether the search can begin at this plain friction: neither F0 nor c is negative by more than its error, and
/// not both are zero.
[[nodiscard]] inline bool is_friction(const Estimate& plain) {
  const auto may_be = [&](double ParameterSet::* value, Interval ParameterIntervals::* interval) {
    return plain.value.*value > 0.0 || (plain.interval95 && ((*plain.interval95).*interval)[1] > 0.0);
  };
  return may_be(&ParameterSet::F0, &ParameterIntervals::F0) && may_be(&ParameterSet::c, &ParameterIntervals::c) &&
         std::max(plain.value.F0, plain.value.c) > 0.0;
}

class ReadingModel {
 public:
  virtual ~ReadingModel() = default;

  /// Unknowns: F0, c, then the nuisances.
  [[nodiscard]] const std::vector<Nuisance>& nuisances() const { return nuisances_; }
  [[nodiscard]] Eigen::Index unknowns() const { return 2 + static_cast<Eigen::Index>(nuisances_.size()); }
  [[nodiscard]] const Eigen::VectorXd& start() const { return start_; }
  /// F0 [N] and c [N.s/m] per unit of the first two unknowns.
  [[nodiscard]] double F0_unit() const { return F0_unit_; }
  [[nodiscard]] double c_unit() const { return c_unit_; }

  /// The motion that severities refer to.
  [[nodiscard]] const departures::ReferenceMotion& reference() const { return reference_; }

  [[nodiscard]] const Eigen::VectorXd& readings() const { return readings_; }
  /// The channel of each reading. Readings of one channel have the same standard deviation.
  [[nodiscard]] const std::vector<int>& channels() const { return channels_; }
  /// Known standard deviation of each channel; 0: to be estimated from the record.
  [[nodiscard]] const std::vector<double>& known_deviations() const { return known_deviations_; }
  /// Columns that span the effect of a smooth departure on the readings. What they leave of the readings is noise.
  [[nodiscard]] const Eigen::MatrixXd& smooth_curve() const { return smooth_curve_; }
  /// Least deviation that is used; a smaller estimate is raised to it.
  [[nodiscard]] double least_deviation(int channel) const {
    return least_deviations_[static_cast<std::size_t>(channel)];
  }
  /// The smallest of the channels' deviations, relative to the size of what the channel reads.
  [[nodiscard]] double relative_noise(const std::vector<double>& deviations) const {
    double least = core::infinity;
    for (std::size_t i = 0; i < deviations.size(); ++i)
      if (least_deviations_[i] > 0.0) least = std::min(least, deviations[i] / least_deviations_[i]);
    return least_relative_deviation * least;
  }
  /// Whether a base drives the mass. Otherwise departures of the drive are left out.
  [[nodiscard]] bool is_driven() const { return driven_; }
  /// Most work (`NearbyOrbits::work`) of the search for one law.
  [[nodiscard]] long most_work() const { return most_work_; }
  [[nodiscard]] const std::vector<int>& numbers() const { return numbers_; }  ///< of the data used
  [[nodiscard]] const std::string& data() const { return data_; }             ///< "8 steady states with phases"

  /// No orbits yet, for the first prediction. `deviations`: of each channel; predictions are accurate beside them.
  [[nodiscard]] virtual std::unique_ptr<NearbyOrbits> no_orbits(const std::vector<double>& deviations) const = 0;
  /// Readings less their predictions. Nothing if the law has no such motion there, or `near` is exhausted.
  [[nodiscard]] virtual std::optional<Eigen::VectorXd> residuals(const LawAt& law, const Eigen::VectorXd& unknowns,
                                                                 NearbyOrbits& near) const = 0;
  /// Derivatives of the predictions by the unknowns. `residuals`: the last ones, at these `unknowns`.
  [[nodiscard]] virtual std::optional<Eigen::MatrixXd> derivatives(const LawAt& law,
                                                                   const Eigen::VectorXd& unknowns,
                                                                   const Eigen::VectorXd& residuals,
                                                                   NearbyOrbits& near) const = 0;

 protected:
  /// Sets the units of F0 and c, and where the search begins: at plain friction, in a motion of peak speed `speed`.
  /// If one of the two is next to nothing, its unit is a share of the other's force and the search begins with a
  /// little of it.
  void begin_with(const ParameterSet& plain, double speed) {
    constexpr double least_unit = 0.05;
    constexpr double little = 0.1;
    const double forces = std::max(plain.F0, 0.0) + coulomb_per_viscous * std::max(plain.c, 0.0) * speed;
    F0_unit_ = std::max(plain.F0, least_unit * forces);
    c_unit_ = std::max(plain.c, least_unit * forces / (coulomb_per_viscous * speed));
    start_ = Eigen::VectorXd::Zero(unknowns());
    start_[0] = std::max(plain.F0 / F0_unit_, little);
    start_[1] = std::max(plain.c / c_unit_, little);
  }

  /// Least deviation of a reading over the size of its channel; least deviation of a phase [rad].
  static constexpr double least_relative_deviation = 1e-4;

  std::vector<Nuisance> nuisances_;
  Eigen::VectorXd start_;
  double F0_unit_ = 0.0;
  double c_unit_ = 0.0;
  departures::ReferenceMotion reference_;
  Eigen::VectorXd readings_;
  std::vector<int> channels_;
  std::vector<double> known_deviations_;
  std::vector<double> least_deviations_;
  Eigen::MatrixXd smooth_curve_;
  bool driven_ = true;
  long most_work_ = std::numeric_limits<long>::max();
  std::vector<int> numbers_;
  std::string data_;
};

}  // namespace dualdamp::identify
