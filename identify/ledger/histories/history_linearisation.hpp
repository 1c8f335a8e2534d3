#pragma once
/// The simulated motion of the histories of a record, and what their sensors read of it, linear about one place.

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <optional>
#include <vector>

#include "identify/ledger/histories/history_relaxations.hpp"
#include "identify/ledger/histories/history_rows.hpp"
#include "identify/ledger/histories/innovations.hpp"
#include "identify/methods/histories/forward_fit.hpp"

namespace dualdamp::identify {

/// Whether the rows of a channel are made white. Only the joint model needs that.
enum class Whitening { off, on };

/// The rows of all channels at one place.
struct LinearisedHistories {
  Eigen::VectorXd residuals;
  Eigen::MatrixXd base;
  Eigen::MatrixXd relaxed;
  Eigen::MatrixXd shaken;           ///< all of these with more noise in the drive; empty: not wanted, or no noise
  double log_variances = 0.0;       ///< of the errors of the rows, summed
  double squares = 0.0;             ///< of the innovations of x
  double variance = 1.0;            ///< of one residual
  double freedom = core::infinity;  ///< degrees of freedom behind what is known of errors that last
  std::vector<Autoregression> errors;  ///< of the channels that were read
};

/// Begins at the fit of the histories with the constants as stated. In reading order:
///  1. `at`: the rows of all channels at one place, whitened;
///  2. `add_test`: of one test, the simulated motion and its derivatives, and the innovations of its rows;
///  3. `rows_of`, `arranged`: what each sensor reads of that motion, a column for each parameter and relaxation.
class HistoryLinearisation {
 public:
  /// `record` and `constants` outlive this. `exclusions`: histories left out are added. Use nothing but `fit` where
  /// the fit has a problem.
  HistoryLinearisation(const Record& record, const KnownConstants& constants, double sigma_x, Estimate& exclusions);

  [[nodiscard]] ForwardFit& fit() { return fit_; }
  [[nodiscard]] const HistoryRelaxations& list() const { return list_; }
  [[nodiscard]] const Place& start() const { return start_; }  ///< where the fit is, with nothing relaxed

  /// Rows of every channel, with columns of the relaxations wanted. They are whitened by `errors`, else by their
  /// own residuals, and then have `shaken`. Nothing where the motion grows beyond all numbers.
  [[nodiscard]] std::optional<LinearisedHistories> at(const Place& place, const Taken& wanted, Whitening whitening,
                                                      const std::vector<Autoregression>& errors = {});

  /// The place after a step of the base parameters and of the relaxations taken. The step of the first parameter is
  /// taken in zeta, so that a step of the mass does not change zeta.
  [[nodiscard]] Place stepped(Place at, const Eigen::VectorXd& step, const Taken& taken) const;

  [[nodiscard]] ForceParameters force_at(const Place& at) const;

  /// Always free: parameters of the fit, then the free zeros.
  [[nodiscard]] Eigen::Index count_of_base() const { return fit_.layout().count() + start_.zeros.size(); }

  /// Whether it is that of a contact that yields, by g times the length of the motion.
  [[nodiscard]] bool is_contact(std::size_t number) const {
    return list_.parts[number].kind == FreedPart::Kind::contact;
  }

  /// Whether a relaxation sets a constant free.
  [[nodiscard]] bool is_constant(std::size_t number) const {
    return list_.parts[number].kind == FreedPart::Kind::constant;
  }

  [[nodiscard]] double unit_force() const { return unit_force_; }  ///< of the terms [N]
  /// The damping of a force at the motion's size that grows with its speed [N.s/m].
  [[nodiscard]] double unit_damping() const { return unit_force_ / scale_.speed; }

  /// Whether the mean zero of x is always free, as the zero of each history less this mean always is. At first it
  /// is not.
  void free_zero_of_x(bool is_free);

  void forget_stated();  ///< the noise of x is that of its samples
  [[nodiscard]] bool is_stated() const { return sigma_x_ > 0.0; }
  [[nodiscard]] double scatter() const { return scatter_; }  ///< of the samples of x over that stated

 private:
  struct Motion {
    Eigen::VectorXd x, v;
    SampledOscillator::Derivatives derivatives{.with_steps = true};
  };

  /// The readings of each sensor.
  struct Channels {
    Channel x{.most_lags = 4};
    // Innovations are nearly white: the noise levels are estimates.
    Channel v{.most_lags = 4};
    Channel a{.most_lags = 4};
  };

  [[nodiscard]] LinearisedHistories whitened(Channels& channels, std::size_t wanted, Whitening whitening,
                                             const std::vector<Autoregression>& errors, bool shake);
  bool add_test(std::size_t t, const Place& at, const Taken& wanted, bool shake, Channels& channels);
  [[nodiscard]] SampledOscillator::Parameters parameters_of(std::size_t t, const Place& at,
                                                            const Taken& wanted) const;
  [[nodiscard]] bool is_force(std::size_t number, const Place& at) const;
  [[nodiscard]] bool yields(std::size_t number, const Place& at) const;
  [[nodiscard]] std::vector<SampledOscillator::Force> forces_of(const Place& at, const Taken& wanted) const;
  /// By what the motion of a test is differentiated: base parameters, then constants, then a contact that yields.
  [[nodiscard]] std::vector<SampledOscillator::By> columns_of(std::size_t t, const Place& at,
                                                              const Taken& wanted) const;
  [[nodiscard]] SensorRows rows_of(std::size_t t, const Place& at, const Taken& wanted, const Motion& motion);
  /// Base columns, then those of the relaxations wanted, from the derivatives of one test; zero for those of
  /// sensors. Columns of mass and stiffness are at constant zeta.
  [[nodiscard]] Eigen::MatrixXd arranged(std::size_t t, const Place& at, const Taken& wanted,
                                         const Eigen::MatrixXd& derivatives);

  const Record& record_;
  const KnownConstants& constants_;
  double sigma_x_;        ///< stated; 0: none
  double scatter_ = 1.0;  ///< of the rows of x where the model was linearised last
  ForwardFit fit_;
  Place start_;
  MotionScale scale_;
  double natural_ = 1.0;     ///< rad/s
  double unit_force_ = 1.0;  ///< N
  HistoryRelaxations list_;
  std::vector<FreeZero> zeros_;
  std::vector<ReadingNoise> noise_;
  std::map<std::size_t, SampledOscillator> shaken_;  ///< of the tests with noise in their drive
  std::vector<Eigen::Index> moving_;
};

}  // namespace dualdamp::identify
