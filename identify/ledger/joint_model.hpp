#pragma once
/// One model of a whole record, linearised at its best fit. The ledger's tests are built from it.
///
///   r = B d + C g + e,   e of unit variance, independent
///
/// r: residuals of the fit, each over its standard deviation. B: a column for each parameter that is always free
/// (zeta and F0 first). C: a column for each relaxation, one way in which an assumption may fail.

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "core/constants.hpp"
#include "identify/assumption.hpp"
#include "identify/estimate.hpp"
#include "identify/record.hpp"
#include "identify/uncertainty/uncertain_constants.hpp"

namespace dualdamp::identify {

/// What of a rig a relaxation sets free: the mass or the stiffness by the frequency or the period, the gain of a
/// sensor, its delay. All others add an effect.
enum class Freed { effect, mass, stiffness, gain, delay };

struct Relaxation {
  Assumption assumption = Assumption::constants;
  std::string test;  ///< "natural frequency free", ...: what is set free
  int sign = 0;      ///< of the coefficient in such a departure; 0: either
  Freed freed = Freed::effect;
  /// A drift of friction or damping in free vibrations from about one amplitude: it falls with time, so that
  /// friction over speed, of whatever form, has the same effect.
  bool is_like_speed = false;
  /// A fit with it begins far from the plain fit, where the linear model may not see that it explains the record.
  bool is_far = false;
  /// A positive coefficient makes a law of friction of it, with a Coulomb force and a viscous damping of its own.
  bool is_law = false;
  /// The uncertainty of the number that it sets free, if an estimate of the model is to know it; nullptr: none.
  double ConstantUncertainties::* stated = nullptr;
  double stated_unit = 1.0;  ///< coefficient of a relative error of one of this number
  /// The constant force that a coefficient of one stands for, by a zero of x or by friction that differs between
  /// the directions [N]; 0: another effect.
  double constant_force = 0.0;
};

/// What was read.
enum class ReadingKind { amplitude, phase, extreme, time };

/// The reading behind a row.
struct Reading {
  ReadingKind kind = ReadingKind::amplitude;
  int number = 0;              ///< of the pair or of the extreme, from 1
  double per_deviation = 0.0;  ///< change of the reading that raises the row's residual by one; 0: no reading
};

/// Noise of some rows that is known without the model, and that residuals of unit variance have.
struct KnownNoise {
  Eigen::Index rows = 0;
  double freedom = 0.0;  ///< degrees of freedom behind it
};

/// Relaxations that are free beside the base parameters, by their numbers in the model.
using Taken = std::vector<std::size_t>;

struct JointModel {
  std::string data;           ///< "24 steady states"
  bool of_histories = false;  ///< the motion itself is simulated
  std::string unlike_zeros;   ///< that the zero of x differs from history to history; empty: not beyond chance
  Eigen::VectorXd residuals;
  std::vector<Reading> readings;  ///< of each row; empty where rows are means of many
  Eigen::MatrixXd base;
  std::vector<Relaxation> relaxations;
  Eigen::MatrixXd relaxed;            ///< a column for each relaxation
  Eigen::VectorXd coefficients = {};  ///< of the relaxations where the model is linearised; empty: all zero
  /// Residuals, base and relaxed side by side, computed with as much noise again in the drive; empty: noise is in r
  /// alone. The columns are derivatives of the motion under the measured drive, so they contain its noise as r
  /// does.
  Eigen::MatrixXd shaken = {};
  /// Friction force of one part of the record (a sweep, a history) less the mean F0, for a unit of each relaxation
  /// [N]; empty: no relaxation sets one free.
  Eigen::VectorXd F0_parts = {};
  Eigen::VectorXd zeta_parts = {};  ///< the same for the damping ratio
  /// Relaxations without a column: they change the record in the second order only, or are forms of friction that
  /// others stand for. They are not tested, but are fitted when a departure of friction is to be explained.
  std::vector<std::size_t> hidden = {};
  /// Of each channel, whose rows follow one another; empty: the noise is what the model leaves.
  std::vector<KnownNoise> known_noise = {};
  /// Degrees of freedom that the estimated deviations of channels take, beside those of the columns.
  double spent = 0.0;
  /// The deviation of the readings that decide about friction is stated: their rows have unit variance.
  bool is_stated = false;
  double deviance = unknown;   ///< twice the negative log-likelihood, to compare fits of the record; NaN: not known
  double scale_freedom = 0.0;  ///< degrees of freedom behind the deviation that decides about friction
  /// All rows depend on that deviation, or on that power of errors that last; else some have one of their own.
  bool has_one_scale = false;
  /// Of a channel that is estimated beside one that is stated and decides about friction.
  double other_freedom = core::infinity;
  ParameterSet value;        ///< of the fit
  bool is_possible = true;   ///< friction takes work in either direction, and sensors are nearly linear
  KnownConstants constants;  ///< as stated, or as fitted
  /// The model fitted again with these relaxations free, and linearised there; empty: no such fit is needed.
  std::function<JointModel(const Taken& taken)> refit;
  std::vector<std::string> warnings;  ///< about the readings and what is stated of them, each a sentence
  std::vector<std::string>
      left_out;  ///< parts of the record that are outside the tests' conditions, each a sentence
};

/// The columns of the base parameters and of the relaxations taken, these last.
[[nodiscard]] Eigen::MatrixXd free_columns(const Eigen::MatrixXd& base, const Eigen::MatrixXd& relaxed,
                                           const Taken& taken);

}  // namespace dualdamp::identify
