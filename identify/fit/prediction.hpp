#pragma once
/// Prediction of a record with the parameters of a fit to other records of the same rig.
///
/// The parameters of the record itself, such as its first state, are fitted to it; the rig is held fixed. The zero
/// of a sensor is one of them if it was sought in the fit or is off (`record_zeros.hpp`); the text then says so.
/// The attainable error is that of the same laws when they are fitted to this record. The rig is called wrong
/// * if one set of parameters does not agree with both records (`compromise.hpp`, a chance below 0.001) and the
///   error of the prediction exceeds the attainable error by more than a tenth; or
/// * if even the attainable fit leaves residuals that are not noise.
///
/// Bands: the residual of a sampled signal in octaves, by Haar wavelets: sums and differences of neighbours, whose
/// squares add up to those of the residual.

#include <functional>
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
  /// Part of `error` from the uncertainty of the parameters; `unknown` if the record shows what the fit does not
  /// determine.
  double uncertainty = unknown;
  /// Test whether one rig made both records (`compromise.hpp`).
  Compromise compromise;
  bool is_wrong = false;
  std::string text;
  std::vector<PredictionBand> bands;  ///< of the first sampled signal
  std::vector<std::string> warnings;  ///< stated noises that even the same laws, fitted to the record, contradict
  Fit fit;                            ///< of the record's own parameters, with the rig held fixed
};

/// Why records are not to be judged, from the fit of their own parameters; empty: they are.
using Refusal = std::function<std::string(const Fit& held)>;

/// `parameters`: those that were fitted, with the zeros that were sought in their records; `rig` has their fitted
/// values. `known`: uncertainty of `parameters`. `refuses` is asked before the rig is fitted to the records, which
/// takes most of the time.
[[nodiscard]] Prediction predict_records(const Rig& rig, const std::vector<FitParameter>& parameters,
                                         const SharedUncertainty& known, const Experiments& experiments,
                                         const FitOptions& options = {}, const Refusal& refuses = {});

}  // namespace dualdamp::identify
