#pragma once
/// A periodic signal in noise: amplitude, phase and harmonics by linear least squares.
///
///   s(t) = offset + sum_k A_k cos(k w t + phi_k),   k = 1 ... K,   t from the first sample
///
/// The record need not hold a whole number of periods. The frequency is known, or refined from a first guess by
/// Gauss-Newton steps with the other parameters eliminated; over the whole record the guess must be right to about
/// half a period. Standard errors assume uncorrelated residuals; `correlation` shows whether they are. For K = 1
/// and many periods they are those of the closed form, std(A) = sigma sqrt(2/n), std(phi) = std(A)/A, std(w) =
/// sigma/A sqrt(24/n^3)/T, T the time between samples.
///
/// Source: ieee1057, the sine fits of three and four parameters, here with harmonics. Errors: `outcome` is
/// not_identifiable for fewer samples than parameters, less than one period, K w beyond half the sample rate, or a
/// constant signal whose frequency is to be refined. Cost: about 10 ns a sample and harmonic.

#include <span>
#include <vector>

#include "core/outcome.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

struct Harmonic {
  double amplitude = 0.0;  ///< A_k, unit of the signal, >= 0
  double phase = 0.0;      ///< phi_k [rad], in (-pi, pi]
  double amplitude_std = 0.0;
};

struct SineFit {
  core::Outcome outcome;
  double omega = 0.0;      ///< rad/s
  double omega_std = 0.0;  ///< 0 if the frequency was known
  double offset = 0.0;
  std::vector<Harmonic> harmonics;  ///< K of them, the fundamental first
  double noise = 0.0;               ///< standard deviation of the residuals
  double correlation = 0.0;         ///< of residuals one sample apart
};

struct SineFitOptions {
  int harmonics = 1;
  bool refine = false;  ///< `omega` is a guess
};

/// `omega` [rad/s] > 0, `sample_rate` [Hz] > 0.
[[nodiscard]] SineFit fit_sine(std::span<const double> signal, double sample_rate, double omega,
                               const SineFitOptions& options = {});

/// Frequency [rad/s] from the crossings of the mean, with a dead band against noise; `unknown` for less than two
/// periods.
[[nodiscard]] double guess_frequency(std::span<const double> signal, double sample_rate);

/// Half of peak to trough of the fitted waveform.
[[nodiscard]] double half_peak_to_peak(const SineFit& fit);

/// Mean of the squared derivative of the fitted waveform: sum (k w A_k)^2/2.
[[nodiscard]] double mean_square_derivative(const SineFit& fit);

}  // namespace dualdamp::identify
