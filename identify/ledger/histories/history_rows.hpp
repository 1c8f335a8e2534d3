#pragma once
/// Rows of the joint model that the sensors of histories give.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/constants.hpp"
#include "identify/ledger/histories/history_terms.hpp"
#include "identify/ledger/histories/innovations.hpp"
#include "identify/record.hpp"
#include "identify/statistics/autoregression.hpp"

namespace dualdamp::identify {

/// Rows of one sensor over all tests: the residual first, then the base columns, then the relaxations, then other
/// columns that are treated alike.
struct Channel {
  Eigen::MatrixXd rows;
  std::vector<Eigen::Index> blocks;
  int most_lags = 0;                     ///< over which its errors may be correlated
  std::vector<Eigen::VectorXd> at_rest;  ///< readings with the same errors and nothing else but a mean

  void add(const Eigen::MatrixXd& more);
};

/// Rows with independent errors of unit variance.
struct WhiteRows {
  Eigen::MatrixXd rows;
  double log_variances = 0.0;  ///< sum of the logs of the variances that the errors had
  Autoregression errors = {};
  double scatter = 1.0;             ///< standard deviation that the errors had
  double freedom = core::infinity;  ///< degrees of freedom behind what is known of errors that last
};

/// The rows with independent errors. The errors are those of `known`, else what the first `columns` columns leave
/// of the residual. `is_unit`: the rows are stated to have unit variance, and only how their errors last from row
/// to row is taken from the residual.
[[nodiscard]] WhiteRows made_white(const Channel& channel, Eigen::Index columns,
                                   const Autoregression* known = nullptr, bool is_unit = false);

/// Errors of a sensor. It reads gain (u + square u^2 + cube u^3) + zero + drift s of u = x(t - delay), where s is
/// the share of the record that is over. With a corner frequency, a high-pass of the first order reads x, as that
/// of an AC coupling does.
struct SensorErrors {
  double gain = 1.0;
  double delay = 0.0;   ///< s
  double corner = 0.0;  ///< rad/s
  double zero = 0.0;
  double drift = 0.0;  ///< of the zero, from the beginning to the end
  double square = 0.0;
  double cube = 0.0;

  [[nodiscard]] Eigen::ArrayXd reading(const Eigen::ArrayXd& u) const {
    return u * (1.0 + u * (square + cube * u));
  }
  [[nodiscard]] Eigen::ArrayXd slope(const Eigen::ArrayXd& u) const {  ///< of the reading over u
    return 1.0 + u * (2.0 * square + 3.0 * cube * u);
  }
};

/// What a sensor reads, and its first two derivatives over time.
struct SensorMotion {
  Eigen::VectorXd value, slope, curvature;
  double rate = 1.0;  ///< samples in a unit of time
};

/// Columns as they were a delay before [s]: between samples cubic by their slopes, d/dt, and so before the first.
[[nodiscard]] Eigen::MatrixXd delayed(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& slopes, double rate,
                                      double delay);

/// Columns r behind a high-pass of the first order, r' = x' - corner r, which begins with their first values.
[[nodiscard]] Eigen::MatrixXd high_passed(const Eigen::MatrixXd& columns, double rate, double corner);

/// d/d corner of a signal behind a high-pass.
[[nodiscard]] Eigen::VectorXd by_corner(const Eigen::VectorXd& passed, double rate, double corner);

/// Columns as a sensor with a delay and a corner frequency reads them, at a gain of one.
[[nodiscard]] Eigen::MatrixXd as_read(const Eigen::MatrixXd& columns, const Eigen::MatrixXd& slopes,
                                      const SensorErrors& errors, double rate);

/// Share of a record that is over at each sample, from 0 to 1. A zero that drifts is right at the beginning.
[[nodiscard]] Eigen::VectorXd course_of(Eigen::Index samples);

/// The residual of a reading, then the columns, derivatives of the motion. `slopes`: d/dt of the columns.
[[nodiscard]] Eigen::MatrixXd reading_rows(const std::vector<double>& measured, const SensorMotion& motion,
                                           const SensorErrors& errors, const Eigen::MatrixXd& columns,
                                           const Eigen::MatrixXd& slopes);

/// The parts one below the other; all have the same number of columns.
[[nodiscard]] Eigen::MatrixXd stacked(const std::vector<Eigen::MatrixXd>& parts);

/// The history with noise added to y and force, as strong as the noise that they have.
[[nodiscard]] History with_noisier_drive(History history);

/// Means of `width` rows each; what is left over at the end is dropped.
[[nodiscard]] Eigen::MatrixXd averaged(const Eigen::MatrixXd& rows, Eigen::Index width);

/// d/dt of every column by central differences over three samples, for the course of v through a reversal.
[[nodiscard]] Eigen::MatrixXd differentiated(const Eigen::MatrixXd& columns, double rate);

/// d/dt of every column over five samples, where the columns are smooth. Differences over three samples of a motion
/// of frequency w miss a share (w/rate)^2/6: at 30 samples in a period 0.7 %, which readings of a show.
[[nodiscard]] Eigen::MatrixXd finely_differentiated(const Eigen::MatrixXd& columns, double rate);

/// Sets to zero the rows within two samples of a reversal or of an end of the history.
void leave_out_reversals(const Eigen::VectorXd& v, Eigen::MatrixXd& rows);

/// Number of rows of a history that are used: all of a driven one; of a free vibration those before its amplitude
/// has fallen to 3 x_f. After that, the number of swings and the place where the mass comes to rest jump with the
/// parameters.
[[nodiscard]] Eigen::Index moving_rows(const History& history, const Eigen::VectorXd& x, double x_f);

/// Standard deviation of the noise of a signal, its rounding to the steps of a converter included.
[[nodiscard]] double sensor_noise_of(const std::vector<double>& signal);

/// Noise of the drive k y + f, and of readings. `sigma_x`: stated for x; 0: none.
[[nodiscard]] ReadingNoise noise_levels(const History& history, double k, const MotionScale& scale,
                                        double sigma_x = 0.0);

/// With negative damping the noise of the drive grows in the motion: within one of the histories by the factor e or
/// more. The residuals then do not show the noise level.
[[nodiscard]] bool noise_grows(const ForceParameters& force, const Record& record);

/// Why the motion of the histories cannot be simulated; empty when it can.
[[nodiscard]] std::string fault_of_histories(const Record& record);

}  // namespace dualdamp::identify
