#pragma once
/// Prediction: a record of the same rig, simulated with the parameters of a fit to other records.
///
/// What the record has of its own, its first state, is fitted to it; the rig is not. Attainable is what the same
/// rig reaches when it is fitted to the record itself. A rig is wrong where no one set of its numbers suits both
/// records
/// (`compromise.hpp`, a chance below 0.001) and the prediction misses by a tenth more than the attainable error, or
/// where even its own fit leaves what is not noise.
///
/// Bands: the residual of a sampled signal in octaves, by Haar's wavelets: sums and differences of neighbours,
/// whose squares add up to those of the residual.

#include <string>
#include <vector>

#include "identify/fit/compromise.hpp"
#include "identify/fit/fit.hpp"

namespace dualdamp::identify {

struct PredictionBand {
  double from = 0.0;   ///< Hz
  double to = 0.0;     ///< Hz
  double error = 0.0;  ///< rms of the residual over the rms of the whole signal
  double noise_units = unknown;
};

struct Prediction {
  core::Outcome outcome;
  double error = unknown;        ///< rms of the residuals over the rms of the signal, all signals together
  double noise_units = unknown;  ///< rms of the residuals over the noise
  double attainable = unknown;   ///< `error` of the rig fitted to this record
  double attainable_noise_units = unknown;
  double uncertainty = unknown;  ///< what the parameters' uncertainty adds to `error`, by itself
  /// One rig against two: the fitted numbers and those of this record alone (`compromise.hpp`).
  Compromise compromise;
  bool is_wrong = false;
  std::string text;
  std::vector<PredictionBand> bands;  ///< of the first sampled signal
  Fit fit;                            ///< with the rig held
};

/// `parameters`: those that were fitted, with their fitted values in `rig`; `covariance` of them.
[[nodiscard]] Prediction predict_records(const Rig& rig, const std::vector<FitParameter>& parameters,
                                         const Eigen::MatrixXd& covariance, const Experiments& experiments,
                                         const FitOptions& options = {});

}  // namespace dualdamp::identify
