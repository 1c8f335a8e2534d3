#pragma once
/// Errors of a reading that a disturbed system makes, made independent: the innovations of Kalman's filter.
///
/// A disturbance s = (x, v) of a motion is carried from sample to sample, and pushed by white noise of the drive;
/// it is read with white noise of the sensors:
///
///   s_(i+1) = A_i s_i + b_i n_i,   r_i = H s_i + w_i
///
/// The rows of a regression with such errors, each less what the earlier ones foretell and over its deviation, have
/// independent errors of unit variance, exactly, whether or not the motion is steady (kalman1960). Cost: 30
/// operations a row and column.

#include <Eigen/Core>
#include <vector>

#include "identify/models/sampled_oscillator.hpp"

namespace dualdamp::identify {

/// Standard deviations of white noise.
struct ReadingNoise {
  double drive = 0.0;  ///< N
  double x = 0.0;      ///< m
  double v = 0.0;      ///< m/s; unused without readings of v
};

/// Replaces the rows of x, and those of v where there are any (else it has no rows), by their innovations. `steps`:
/// the first entry is what led to the first sample, which is not used.
void make_innovations(const std::vector<SampledOscillator::Step>& steps, const ReadingNoise& noise,
                      Eigen::MatrixXd& x, Eigen::MatrixXd& v);

}  // namespace dualdamp::identify
