#pragma once
/// The equation of motion as a first-order system X' = f(X, t) with a frozen branch.
///
///   X = (x, v, states of the first law, of the second, ...)        x [m], v [m/s]
///   x' = v
///   v' = (k (y - x) + k3 (y - x)^3 + c (y' - v, or -v) + f(t) - F) / m
///   states' = the rates that the laws state
///
/// While the mass sticks x' = v' = 0. The direction of slip and the modes of the laws are those given to freeze(),
/// for every X: so the field is analytic beyond the event that ends the interval. Time is counted from the start of
/// the forcing period. The spring of a pendulum: sim/oscillator.hpp.
///
/// The Jacobian of the known part is exact. That of the laws comes from differences, relative error about 1e-8:
/// enough for Newton iterations and Floquet multipliers, and the same for every law (decision 017). If a law
/// changes over speeds far below the motion's, the differences are taken over such speeds. `close_jacobian` does
/// so for states: where a longer difference gives another slope it takes shorter ones.

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "sim/engine/drive.hpp"
#include "sim/engine/interval.hpp"
#include "sim/engine/velocity_history.hpp"
#include "sim/model.hpp"
#include "sim/steppers/stepper.hpp"

namespace dualdamp::sim {

class Flow final : public VectorField {
 public:
  /// `drive`: set to the start of a period, or in the present piece; it is not moved. `past`: the past velocity,
  /// for laws with a delay.
  Flow(const Model& model, const Drive& drive, const VelocityHistory& past);

  /// Fixes modes and direction. `offset`: absolute time at which the local time is 0 [s].
  void freeze(const std::vector<friction::Memory>& memories, friction::Direction direction, double offset);
  /// Sets the sizes of x [m] and v [m/s]; increments of differences are small parts of them.
  void set_scales(double x, double v);

  [[nodiscard]] friction::Direction direction() const { return direction_; }
  /// The absolute time at the local time t [s].
  [[nodiscard]] double time(double t) const { return offset_ + t; }

  [[nodiscard]] std::size_t size() const override { return size_; }
  void evaluate(std::span<const double> X, double t, std::span<double> rates) const override;
  void jacobian(std::span<const double> X, double t, std::span<double> columns) const override;
  void linearize(std::span<const double> X, double t, std::span<double> rates,
                 std::span<double> columns) const override;
  void close_jacobian(std::span<const double> X, double t, std::span<double> columns) const override;

  /// Number of evaluations of laws so far.
  [[nodiscard]] long responses() const { return responses_; }

  /// Size of every component: those of set_scales(), and those that the laws state for their states.
  [[nodiscard]] std::span<const double> scales() const { return scales_; }

  /// From the mass and the memories to X, and back to the memories; modes do not change.
  void gather(double x, double v, const std::vector<friction::Memory>& memories, std::vector<double>& X) const;
  void scatter(std::span<const double> X, std::vector<friction::Memory>& memories) const;

  /// While the mass sticks: the pull and its limit [N] (sim/engine/sticking_gate.hpp).
  [[nodiscard]] double pull(std::span<const double> X, double t) const;
  [[nodiscard]] double limit(std::span<const double> X, double t) const;
  /// Appends the guards of law i to `values`.
  void guards(std::size_t i, std::span<const double> X, double t, std::vector<double>& values) const;
  /// All quantities of the motion at the local time t; the time of the sample is absolute.
  [[nodiscard]] Sample sample(std::span<const double> X, double t) const;

 private:
  [[nodiscard]] friction::Instant instant(std::span<const double> X, double t) const;
  [[nodiscard]] friction::Instant instant(std::size_t i, std::span<const double> X, double t) const;
  void remember(std::size_t i, friction::Instant& now, double t) const;
  const friction::Memory& memory(std::size_t i, std::span<const double> X) const;
  template <class Force>
  double resolved_force(std::size_t i, const friction::Instant& now, const Force& law) const;
  double respond(std::size_t i, std::span<const double> X, const friction::Instant& now,
                 std::span<double> rates) const;
  [[nodiscard]] double resisting(std::span<const double> X, double t) const;
  [[nodiscard]] const Drive::Value& drive(double t) const;
  [[nodiscard]] double driving(double x, double v, const Drive::Value& drive) const;
  struct Slope {
    double value = 0.0;     ///< N per unit of the column
    bool resolved = false;  ///< beyond rounding
  };
  /// What is differentiated, by what, and where.
  struct Derivative {
    std::size_t law = 0;
    std::size_t column = 0;  ///< the component of X that is displaced
    std::span<const double> X;
    double t = 0.0;      ///< local time [s]
    double force = 0.0;  ///< of the law at X [N]
  };
  [[nodiscard]] Slope difference(const Derivative& d, double step) const;
  [[nodiscard]] double closer(const Derivative& d, double step, double slope) const;
  void slopes(const Derivative& d, double step, std::vector<double>& of_rates_and_force) const;
  void differentiate_law(const Derivative& d, bool closely, std::span<double> columns) const;
  void move(std::span<const double> X, double t, double force, std::span<double> rates) const;
  void differentiate(std::span<const double> X, double t, bool closely, std::span<double> rates,
                     std::span<double> columns) const;

  Model model_;
  const Drive& drive_;
  const VelocityHistory& past_;
  friction::Direction direction_ = friction::Direction::none;
  double offset_ = 0.0;
  bool is_delayed_ = false;  ///< some law has a delay
  bool is_harmonic_ = false;
  long past_frame_ = 0;  ///< frame of time of `past_` in which the flow counts
  std::size_t size_ = 2;
  std::vector<std::size_t> first_;  ///< of each law: index of its first state in X
  std::vector<std::size_t> count_;  ///< of each law
  std::vector<double> own_scales_;  ///< 0 for positions
  std::vector<double> scales_;
  mutable long responses_ = 0;
  // Scratch: the memories as they are kept, with the states of X in place of their own.
  mutable std::vector<friction::Memory> memories_;
  mutable std::vector<double> displaced_;
  mutable std::vector<double> base_rates_;
  mutable std::vector<double> displaced_rates_;
  mutable std::vector<double> last_slopes_;
  mutable std::vector<double> shorter_slopes_;
  mutable std::vector<double> closest_slopes_;
  mutable std::vector<double> apart_;
  /// The drive at recent times: iterations and displaced steps need it at the stages of a step again and again.
  struct KnownDrive {
    double t = std::numeric_limits<double>::quiet_NaN();
    long piece = 0;
    Drive::Value value{};
  };
  mutable std::array<KnownDrive, 64> known_drives_;  ///< the index is a hash of the time's bits
};

}  // namespace dualdamp::sim
