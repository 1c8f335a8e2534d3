#pragma once
/// The steady states of a record, linearised: residuals of the drive that each of them needs, and how zeta, x_f and
/// the relaxed assumptions (`amplitude_terms.hpp`) change it.
///
/// Both x and Y may have errors. The rows of a state are those of its true amplitude, which is found with the
/// parameters, over the deviation that both errors give its drive.

#include <Eigen/Core>
#include <complex>
#include <set>
#include <vector>

#include "identify/ledger/amplitude_noise.hpp"
#include "identify/ledger/amplitude_step.hpp"
#include "identify/ledger/amplitude_terms.hpp"
#include "identify/ledger/joint_model.hpp"
#include "identify/ledger/stated_noise.hpp"

namespace dualdamp::identify {

/// Rows of one linearisation, each over its deviation; rows of phases follow those of amplitudes.
struct AmplitudeRows {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd base;           ///< columns of zeta and x_f
  Eigen::MatrixXd relaxed;        ///< columns of the relaxations
  std::vector<Reading> readings;  ///< lengths in units of the largest amplitude
  double log_variances = 0.0;     ///< half the log of the determinant of V
};

class AmplitudeStates {
 public:
  /// `known`: stated deviations of amplitudes, in the unit of the points.
  AmplitudeStates(std::vector<SteadyPoint> points, bool with_phases, const KnownDeviations& known);

  [[nodiscard]] const std::vector<SteadyPoint>& points() const { return points_; }
  [[nodiscard]] const std::vector<const AmplitudeTerm*>& terms() const { return terms_; }
  /// The true amplitude of a state at the last linearisation.
  [[nodiscard]] double true_x(std::size_t i) const { return true_x_[i]; }
  [[nodiscard]] bool with_phases() const { return with_phases_; }
  [[nodiscard]] const KnownDeviations& known() const { return known_; }
  [[nodiscard]] const Deviations& largest() const { return largest_; }
  [[nodiscard]] std::size_t frequencies() const { return frequencies_.size(); }
  [[nodiscard]] Eigen::Index smooth_columns() const {
    return identify::smooth_columns(frequencies() > 1, points_.size());
  }
  [[nodiscard]] int sweeps() const { return sweeps_; }
  [[nodiscard]] Eigen::Index amplitudes() const { return static_cast<Eigen::Index>(points_.size()); }
  [[nodiscard]] Eigen::Index phases() const { return with_phases_ ? phases_ : 0; }
  /// If only some states have phases, these may be too few for a smooth curve to leave noise. Then the noise is
  /// taken as large as that of the amplitudes, relative to the largest.
  [[nodiscard]] bool tells_phase_noise() const { return phases() == amplitudes() || phases() > smooth_columns(); }
  [[nodiscard]] std::vector<Relaxation> relaxations() const;
  /// Coefficients of all relaxations, each zero.
  [[nodiscard]] Eigen::VectorXd none_relaxed() const;

  /// Linearised at the parameters and at the true amplitudes of the last call; then updates these amplitudes.
  /// Columns of relaxations that are not wanted are zero.
  AmplitudeRows linearise(SteadyParameters at, const Deviations& deviations, const Taken& wanted);

 private:
  /// Y and phase of the drive that a motion needs.
  using Asked = Eigen::Vector2d;

  /// A state, and the drive that it needs.
  struct State {
    const SteadyPoint& point;
    double x = 0.0;
    std::complex<double> drive;
  };

  /// Number of sweeps whose friction force is set free: the first ones, if there are very many.
  [[nodiscard]] int contrasts() const;
  [[nodiscard]] bool has_trend() const { return sweeps_ > 2; }
  /// Friction displacement of a sweep less the mean over all sweeps, which is x_f.
  [[nodiscard]] double excess(int sweep, const SteadyParameters& at) const;
  [[nodiscard]] PlainFriction friction_of(int sweep, const SteadyParameters& at) const;
  /// The drive that a state needs, with every relaxation by its coefficient.
  [[nodiscard]] std::complex<double> drive(const SteadyPoint& point, const SteadyParameters& at, double x) const;
  /// Column of `parameter`, a number of `at`, which is moved and put back: the derivative of the needed drive.
  [[nodiscard]] Asked column(const State& state, const SteadyParameters& at, double step, double& parameter) const;
  /// Column of the coefficient of a relaxation. Those of terms add up: the derivative is that of one term.
  [[nodiscard]] Asked relaxed_column(const State& state, SteadyParameters& at, std::size_t number) const;
  /// `at` is as before, afterwards.
  void add_state(std::size_t i, SteadyParameters& at, const Deviations& deviations, Eigen::Index phase_row,
                 const Taken& wanted, AmplitudeRows& rows);

  std::vector<SteadyPoint> points_;
  std::vector<double> true_x_;
  KnownDeviations known_;
  Deviations largest_;
  std::set<long> frequencies_;
  std::vector<const AmplitudeTerm*> terms_;
  int sweeps_ = 0;
  Eigen::Index phases_ = 0;
  bool with_phases_ = false;
};

}  // namespace dualdamp::identify
