#pragma once
/// The ways in which the joint model of histories is relaxed: constants, forces, friction of single histories, and
/// what is free in a sensor; and what a sensor reads with them.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "identify/ledger/histories/history_rows.hpp"
#include "identify/ledger/histories/history_terms.hpp"
#include "identify/ledger/joint_model.hpp"
#include "identify/methods/histories/forward_fit.hpp"
#include "identify/models/sampled_oscillator.hpp"

namespace dualdamp::identify {

enum class MotionSensor { x, v, a };

/// A zero that is always free: of a sensor of v or of a, in one history, on which no force depends; of x, in all
/// histories.
struct FreeZero {
  std::size_t history = 0;
  MotionSensor sensor = MotionSensor::v;
  double unit = 1.0;  ///< m/s or m/s^2; m of x
  double near = 0.0;  ///< a value near it, in this unit

  [[nodiscard]] bool is_of(std::size_t test, MotionSensor other) const {
    return sensor == other && (sensor == MotionSensor::x || history == test);
  }
};

[[nodiscard]] std::vector<FreeZero> free_zeros(const std::vector<ForwardTest>& tests, const MotionScale& scale);

/// What a relaxation sets free.
struct FreedPart {
  enum class Kind {
    constant,
    force,
    contact,  ///< tested by the force of `term`; taken into the model, it yields before it slides
    friction_of_history,
    gain,
    delay,
    corner,
    square,  ///< of the motion over its length, in the readings
    cube,
    zero,
    zero_drift
  } kind = Kind::constant;
  SampledOscillator::By by = SampledOscillator::By::mass;  ///< of a constant
  const HistoryTerm* term = nullptr;                       ///< of a force, or of a contact
  std::size_t history = 0;
  MotionSensor sensor = MotionSensor::x;
};

/// Share of the free friction force of one history in every history, so that F0 stays the mean over all.
[[nodiscard]] double share_of(const FreedPart& part, std::size_t test, std::size_t tests);

/// All relaxations that the histories may show, each with the part that it sets free.
struct HistoryRelaxations {
  std::vector<Relaxation> relaxations;
  std::vector<FreedPart> parts;  ///< of each relaxation
};

/// Gain and delay of x are free only beside another signal: x alone, with its initial state free, tells neither.
[[nodiscard]] HistoryRelaxations history_relaxations(const std::vector<ForwardTest>& tests,
                                                     const KnownConstants& constants);

/// Where the model is linearised: the parameters of the fit, the free zeros, and a coefficient for each
/// relaxation.
struct Place {
  Eigen::VectorXd p;
  Eigen::VectorXd zeros;
  Eigen::VectorXd g;
};

/// Rows of the readings of one test, with the columns of what is free in their sensor. All are references: they
/// outlive this.
struct HistoryReader {
  const std::vector<FreedPart>& parts;
  const std::vector<FreeZero>& zeros;
  const ForwardLayout& layout;
  double length;  ///< of the motion [m]
  const Place& at;
  const std::vector<std::size_t>& wanted;  ///< relaxations that have a column
  std::size_t test;

  /// The columns are those of the motion: parameters, zeros, relaxations. `slopes`: d/dt of them.
  [[nodiscard]] Eigen::MatrixXd operator()(MotionSensor sensor, const std::vector<double>& measured,
                                           const SensorMotion& motion, const Eigen::MatrixXd& columns,
                                           const Eigen::MatrixXd& slopes) const;
};

}  // namespace dualdamp::identify
