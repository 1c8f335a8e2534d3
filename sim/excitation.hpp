#pragma once
/// The excitation of the oscillator: base motion y(t) or external force f(t).
///
/// harmonic:  A cos(w t + phi) + sum_j A_j cos(n_j (w t) + phi_j), plus a constant for a force
/// ramp:      y = V t, or f = R t
/// noise:     band-limited white: y or f is linear between nodes at n h, h = pi/w_b (1/(2 B) with the bandwidth B
///            in Hz). The value at node n is sqrt(D/h) times normal draw n of stream `noise_stream` of the seed.
///            The two-sided spectral density is D (sin(w h/2)/(w h/2))^4: D [m^2.s or N^2.s] at low frequencies,
///            0.3 dB less at w_b/5 and 7.8 dB less at w_b. (An analyser's one-sided density for each Hz is 2 D.)
/// chirp:     A cos(phi(t)), where the frequency phi'(t) goes from w_0 to w_1 within T, linearly or exponentially.
///            Computed by cubics between nodes with the exact value and slope; error 1e-9 A, of the rate 2e-7 A
///            phi'. After T it keeps its last value.
/// samples:   a polynomial between given nodes (`sim/sampled_signal.hpp`)

#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

namespace dualdamp::sim {

/// One further harmonic of a distorted drive: amplitude cos(order w t + phase).
struct Harmonic {
  int order = 1;           ///< multiple of the fundamental frequency, >= 2
  double amplitude = 0.0;  ///< m (base) or N (force)
  double phase = 0.0;      ///< rad
};

struct Noise {
  double intensity = 0.0;  ///< D [m^2.s] (base) or [N^2.s] (force), >= 0
  double bandwidth = 0.0;  ///< w_b [rad/s], > 0
  std::uint64_t seed = 0;

  /// Time between nodes [s].
  [[nodiscard]] double spacing() const { return std::numbers::pi / bandwidth; }
};

enum class ChirpLaw {
  linear,       ///< phi' = w_0 + (w_1 - w_0) t/T
  exponential,  ///< phi' = w_0 (w_1/w_0)^(t/T)
};

struct Chirp {
  double from = 0.0;      ///< w_0 [rad/s], > 0
  double to = 0.0;        ///< w_1 [rad/s], > 0
  double duration = 0.0;  ///< T [s], > 0
  ChirpLaw law = ChirpLaw::linear;
};

class SampledSignal;

/// A stream of random numbers that laws with the same seed do not use.
inline constexpr std::uint32_t noise_stream = 2;

enum class ExcitationType {
  none,
  base_harmonic,
  force_harmonic,
  base_ramp,
  force_ramp,
  base_noise,
  force_noise,
  base_chirp,
  force_chirp,
  base_samples,
  force_samples,
};

struct Excitation {
  ExcitationType type = ExcitationType::none;
  double amplitude = 0.0;  ///< m (base) or N (force), >= 0; of a harmonic excitation or a chirp
  double frequency = 0.0;  ///< w [rad/s], > 0 for a harmonic excitation
  double phase = 0.0;      ///< phi [rad], at t = 0
  double offset = 0.0;     ///< constant force [N], force_harmonic only
  double slope = 0.0;      ///< V [m/s] of base_ramp or R [N/s] of force_ramp
  std::vector<Harmonic> harmonics{};
  Noise noise{};                                   ///< of base_noise and force_noise
  Chirp chirp{};                                   ///< of base_chirp and force_chirp
  std::shared_ptr<const SampledSignal> samples{};  ///< of base_samples and force_samples; m or N

  [[nodiscard]] bool moves_base() const {
    return type == ExcitationType::base_harmonic || type == ExcitationType::base_ramp ||
           type == ExcitationType::base_noise || type == ExcitationType::base_chirp ||
           type == ExcitationType::base_samples;
  }
  /// Of the amplitude, for a displacement; `Model::unit` names it for an angle.
  [[nodiscard]] const char* unit() const { return moves_base() ? "m" : "N"; }
  [[nodiscard]] bool is_ramp() const {
    return type == ExcitationType::base_ramp || type == ExcitationType::force_ramp;
  }
  [[nodiscard]] bool is_noise() const {
    return type == ExcitationType::base_noise || type == ExcitationType::force_noise;
  }
  [[nodiscard]] bool is_chirp() const {
    return type == ExcitationType::base_chirp || type == ExcitationType::force_chirp;
  }
  [[nodiscard]] bool is_sampled() const {
    return type == ExcitationType::base_samples || type == ExcitationType::force_samples;
  }
  [[nodiscard]] bool is_harmonic() const {
    return type == ExcitationType::base_harmonic || type == ExcitationType::force_harmonic;
  }
};

/// Largest number of further harmonics of an excitation.
inline constexpr int max_harmonics = 8;

}  // namespace dualdamp::sim
