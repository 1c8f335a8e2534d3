#pragma once
/// How modifiers change the force limits of a law (`modified.hpp` has the equation): the force limits at an
/// instant, the guards and times at which their course changes, and the course after each change. This file is
/// independent of the law.

#include <cstdint>
#include <limits>
#include <vector>

#include "friction_models/law.hpp"
#include "friction_models/modifiers/fluctuation.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

struct ModifierSettings {
  double drift = 0.0;  ///< 1/s
  double slope = 0.0;  ///< N/m
  double ratio = 0.0;  ///< standard deviation of the fluctuation relative to the force limit
  double correlation_time = std::numeric_limits<double>::infinity();    ///< s
  double correlation_length = std::numeric_limits<double>::infinity();  ///< m
  std::uint64_t seed = 0;
  double load_gradient = 0.0;                                      ///< 1/m
  double modulation = 0.0;                                         ///< share of the load that follows the drive
  double modulation_order = 1.0;                                   ///< multiple of the drive's frequency
  double modulation_phase = 0.0;                                   ///< rad
  double warming_power = std::numeric_limits<double>::infinity();  ///< W
  double warming_time = std::numeric_limits<double>::infinity();   ///< s

  ModifierSettings() = default;
  /// From the parameters of a law; without effect if no modifier is among them.
  explicit ModifierSettings(const ParameterValues& values);

  [[nodiscard]] bool warms() const { return warming_power < std::numeric_limits<double>::infinity(); }
  [[nodiscard]] bool fluctuates() const { return ratio != 0.0; }
  [[nodiscard]] bool fluctuates_over_position() const {
    return correlation_length < std::numeric_limits<double>::infinity();
  }
  [[nodiscard]] bool modulates() const { return modulation != 0.0; }
  /// Between events the force limits are affine functions of time and position.
  [[nodiscard]] bool are_affine() const {
    return !warms() && !modulates() && (drift == 0.0 || load_gradient == 0.0);
  }
  [[nodiscard]] bool do_nothing() const {
    return drift == 0.0 && slope == 0.0 && load_gradient == 0.0 && !fluctuates() && !modulates() && !warms();
  }
};

/// The rate of a limit that varies [1/s]: never exactly zero. Which guards a law has depends on whether its limit
/// varies, and must not depend on whether its rate is zero at an instant, which rounding may decide.
[[nodiscard]] constexpr double varying_rate(double rate) {
  constexpr double least = 1e-200;
  return rate == 0.0 ? least : rate;
}

class ForceLimits {
 public:
  /// `nominal`: the force limits [N] of a law that supports `position_slope`, in any order.
  ForceLimits(const ModifierSettings& settings, std::vector<double> nominal);

  [[nodiscard]] const ModifierSettings& settings() const { return settings_; }

  [[nodiscard]] ModifierCourse start(const Instant& now) const;
  /// `now` with the modification of the force limits. `power`: mean of the power that the law turned to heat [W].
  [[nodiscard]] Instant at(const ModifierCourse& course, double power, const Instant& now) const;
  /// All force limits are zero: there is no contact until one comes back.
  [[nodiscard]] bool are_gone(const ModifierCourse& course) const;

  /// The next time at which the course changes, whatever the motion does [s].
  [[nodiscard]] double next_change(const ModifierCourse& course) const;
  /// The course after that change, due at this time.
  [[nodiscard]] ModifierCourse after_change(const ModifierCourse& course, double due) const;

  /// > 0 while the course stays: the load, minus it once it is gone; x within its cell; x on its side; and of force
  /// limits that fall with |x| the smallest one that is not yet zero, and minus the largest one that is zero.
  [[nodiscard]] std::vector<Affine> guards(const ModifierCourse& course, double power, const Instant& now) const;
  /// What ends at a guard, by its index.
  enum class Ending { load, cell, side, force_limit };
  [[nodiscard]] Ending ending(int guard) const;
  /// The course after that guard.
  [[nodiscard]] ModifierCourse after_guard(const ModifierCourse& course, int guard) const;

  /// The number of force limits that are zero after a step of all of them.
  [[nodiscard]] int vanished(const ModifierCourse& course, double power, const Instant& now) const;
  /// The factor of the fluctuation, >= 0.
  [[nodiscard]] double fluctuation(const ModifierCourse& course) const;

 private:
  [[nodiscard]] double drift_end(const ModifierCourse& course) const;
  [[nodiscard]] double cell_end(const ModifierCourse& course) const;
  [[nodiscard]] double cell_width() const;
  /// `now` as if no force limit had fallen to zero.
  [[nodiscard]] Instant before_vanishing(ModifierCourse course, double power, const Instant& now) const;
  /// The load relative to that at x = 0 without modulation, where it is not gone.
  [[nodiscard]] double load(double x) const { return 1.0 + settings_.load_gradient * x; }
  [[nodiscard]] int load_guards() const { return settings_.load_gradient != 0.0 ? 1 : 0; }
  [[nodiscard]] int guards_before_side() const {
    return load_guards() + (settings_.fluctuates_over_position() ? 2 : 0);
  }

  ModifierSettings settings_;
  std::vector<double> nominal_;  ///< ascending, each once [N]
  Fluctuation fluctuation_;
};

}  // namespace dualdamp::friction
