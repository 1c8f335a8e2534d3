#pragma once
/// Makes the errors of readings independent where noise of the drive disturbs the motion: innovations of Kalman's
/// filter.
///
/// A disturbance s = (x, v) of a motion is carried from sample to sample and pushed by white noise n of the drive;
/// it is read with white noise w of the sensors:
///
///   s_(i+1) = A_i s_i + b_i n_i,   r_i = H s_i + w_i
///
/// Each row of a regression with such errors is replaced by its difference from the prediction of the earlier rows,
/// over the deviation of that difference. Its errors are then exactly independent, of unit variance, whether or not
/// the motion is steady (kalman1960). Cost: 30 operations a row and column.

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

/// Replaces the rows of x, and those of v if it has any, by their innovations. `steps`: the first entry, which
/// leads to the first sample, is not used.
void make_innovations(const std::vector<SampledOscillator::Step>& steps, const ReadingNoise& noise,
                      Eigen::MatrixXd& x, Eigen::MatrixXd& v);

}  // namespace dualdamp::identify
