#pragma once
/// Makes the errors of readings independent where noise of the drive disturbs the motion: innovations of Kalman's
/// filter.
///
/// A disturbance s = (x, v) of a motion is carried from sample to sample and pushed by white noise n of the drive;
/// it is read with white noise w of the sensors:
///
///   s_(i+1) = A_i s_i + b_i n_i,   r_i = H s_i + w_i
///
/// A reading of a also sees the force of the same sample, (n - k x - c v)/m: n is a third part of s.
///
/// Each row of a regression with such errors is replaced by its difference from the prediction of the earlier rows,
/// over the deviation of that difference. Its errors are then exactly independent, of unit variance, whether or not
/// the motion is steady (kalman1960). Cost: 40 operations a row and column.

#include <Eigen/Core>
#include <vector>

#include "identify/models/force_parameters.hpp"
#include "identify/models/sampled_oscillator.hpp"

namespace dualdamp::identify {

/// Standard deviations of white noise.
struct ReadingNoise {
  double drive = 0.0;  ///< N
  double x = 0.0;      ///< m
  double v = 0.0;      ///< m/s; unused without readings of v
  double a = 0.0;      ///< m/s^2; unused without readings of a
};

/// Of each sensor in one test the residual, the base columns, the relaxations; no rows where it was not read.
struct SensorRows {
  Eigen::MatrixXd x, v, a;

  /// Adds the columns of `more` at the right.
  void append(const SensorRows& more);
};

/// Replaces the rows of every sensor by their innovations. Rows of a that are zero stay so. `steps`: the first
/// entry, which leads to the first sample, is not used.
void make_innovations(const std::vector<SampledOscillator::Step>& steps, const ReadingNoise& noise,
                      const ForceParameters& force, SensorRows& rows);

}  // namespace dualdamp::identify
