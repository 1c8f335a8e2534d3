#pragma once
/// What drives the oscillator: base motion y(t) or external force f(t).
///
/// harmonic:  A cos(w t + phi) + sum_j A_j cos(n_j (w t) + phi_j), plus a constant for a force
/// ramp:      y = V t, or f = R t

#include <vector>

namespace dualdamp::sim {

/// One further harmonic of a distorted drive: amplitude cos(order w t + phase).
struct Harmonic {
  int order = 1;           ///< multiple of the fundamental frequency, >= 2
  double amplitude = 0.0;  ///< m (base) or N (force)
  double phase = 0.0;      ///< rad
};

enum class ExcitationType { none, base_harmonic, force_harmonic, base_ramp, force_ramp };

struct Excitation {
  ExcitationType type = ExcitationType::none;
  double amplitude = 0.0;  ///< m (base) or N (force), >= 0
  double frequency = 0.0;  ///< w [rad/s], > 0 for a harmonic excitation
  double phase = 0.0;      ///< phi [rad]
  double offset = 0.0;     ///< constant force [N], force_harmonic only
  double slope = 0.0;      ///< V [m/s] of base_ramp or R [N/s] of force_ramp
  std::vector<Harmonic> harmonics{};

  [[nodiscard]] bool is_harmonic() const {
    return type == ExcitationType::base_harmonic || type == ExcitationType::force_harmonic;
  }
};

/// Further harmonics an excitation may carry.
inline constexpr int max_harmonics = 8;

}  // namespace dualdamp::sim
