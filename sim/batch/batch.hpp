#pragma once
/// Many independent oscillators at once, for curves, maps and campaigns.
///
/// Oscillator: mass, stiffness, damping 0 <= zeta < 1, one Coulomb law (static >= kinetic), one harmonic drive:
///
///     m x'' + c x' + k x + kinetic sgn x' = drive amplitude cos(w t)
///
/// A pack has 8, 4, 2 or 1 oscillators, as many as the processor allows. Packs compute the motion in closed form
/// from reversal to reversal, with the certificate of `core/crossing/first_crossing.hpp`. The exact engine computes
/// what packs cannot certify (sticking, grazing, a static limit met within 1e-9, critical damping, undamped
/// resonance), one oscillator at a time, in the same call. Steady states of a batch of either kind:
/// `sim/orbits/batch_steady_states.hpp`.
///
/// Results are the same to the last bit for every width and number of threads: each lane depends only on its own
/// numbers, and exp, sin, cos and atan2 are SLEEF's reproducible variants (shibata2020). They agree with the exact
/// engine to rounding, not to the bit.
///
/// Cost on one core with AVX-512: about 0.08 us for a forcing period, 0.1 us for a steady state; tens of us for an
/// oscillator that the exact engine computes.

#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/crossing/search_result.hpp"
#include "sim/engine/state.hpp"
#include "sim/excitation.hpp"
#include "sim/model.hpp"
#include "sim/oscillator.hpp"

namespace dualdamp::sim {

/// One entry for each oscillator; all of the same length. Units as in Oscillator, friction::Coulomb and Excitation.
struct OscillatorBatch {
  ExcitationType type = ExcitationType::base_harmonic;  ///< or force_harmonic
  DamperTo damper_to = DamperTo::ground;
  std::vector<double> mass;
  std::vector<double> damping;
  std::vector<double> stiffness;
  std::vector<double> kinetic;
  std::vector<double> static_level;
  std::vector<double> amplitude;
  std::vector<double> frequency;

  [[nodiscard]] std::size_t size() const { return mass.size(); }
};

/// `size` copies of `model`, or nothing if the model is not of the class above: one harmonic, no constant force,
/// and laws without memory that together are one Coulomb law. The phase of the drive and the initial state are left
/// out.
[[nodiscard]] std::optional<OscillatorBatch> batch_of(const Model& model, std::size_t size);

struct BatchOptions {
  int width = 0;    ///< one of batch_widths(); 0: the largest
  int threads = 0;  ///< at most; 0: all cores
};

/// The widths that this processor has, ascending.
[[nodiscard]] std::vector<int> batch_widths();

/// A symmetric periodic orbit without sticking that attracts every motion.
struct SlidingOrbit {
  double peak = 0.0;                         ///< max x, -min x [m]
  double lag = 0.0;                          ///< of x's fundamental behind the drive [rad], in [0, 2 pi)
  double radius = 0.0;                       ///< largest modulus of a Floquet multiplier of the full period
  std::complex<double> drive_at_peak = 1.0;  ///< e^{i angle of the drive} when x is largest
  core::SearchCount certificate;             ///< of the half periods on the way to the orbit and on it
};

/// Relative closure of a SlidingOrbit.
inline constexpr double sliding_closure = 1e-14;

/// The orbits that packs find, on this thread and without the exact engine: each by Newton's method on the
/// half-period map and certified by that map (`sim/batch/find_orbits.hpp`). `width` as in BatchOptions.
[[nodiscard]] std::vector<std::optional<SlidingOrbit>> sliding_orbits(const OscillatorBatch& batch, int width = 0);

/// The orbit of one model; nothing if batch_of() gives nothing or no orbit is found.
[[nodiscard]] std::optional<SlidingOrbit> sliding_orbit(const Model& model);

/// The state of the orbit of this model at t = 0; nothing if its velocity is zero there.
[[nodiscard]] std::optional<State> start_of(const SlidingOrbit& orbit, const Model& model);

/// States of motions: the caller fills in the start, pass_periods() replaces it by the end.
struct BatchMotions {
  std::vector<double> position;     ///< m; given: at t = 0
  std::vector<double> velocity;     ///< m/s; given: at t = 0
  std::vector<double> amplitude{};  ///< half the distance between the last two reversals [m]
  std::vector<long> reversals{};
  std::vector<unsigned char> engine{};  ///< 1: computed by the exact engine, 0: in a pack
};

/// Continues each motion from t = 0 over whole forcing periods.
void pass_periods(const OscillatorBatch& batch, int periods, BatchMotions& motions,
                  const BatchOptions& options = {});

}  // namespace dualdamp::sim
