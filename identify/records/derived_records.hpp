#pragma once
/// Records that are derived from histories: x-Y pairs from driven steady states, extremes from free vibrations.
///
/// A steady state is read by sine fits (identify/records/sine_fit.hpp). Y and the phase lag come from the
/// fundamental of y. x is half of peak to trough of the fitted waveform of x, with up to nine harmonics. The mean
/// square speed comes from v if it was measured, else from that waveform. A transient at the beginning is found by
/// fits to pieces of whole periods, and is skipped; at most 2 of 10,000 steady histories are taken for transients.
/// The harmonics beyond the ninth are 2e-3 of x for a Coulomb response at the limit of sticking, and fall as 1/x^2.
///
/// An extreme of a free vibration is the value of a local fit where its slope is zero. The acceleration jumps there
/// by twice the friction over the mass, so the fit has one polynomial on each side. It needs 16 samples a period.
///
/// Errors: none thrown. If a history gives no record, a warning says why. Cost: linear, about 1 us a sample.

#include <cstddef>
#include <string>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

struct DerivedPairs {
  PairRecord record;  ///< empty if no history is a driven steady state
  std::vector<std::string> warnings;
  std::vector<std::string> lacking;  ///< why a history gives no pair, one for each history; empty: it gives one,
                                     ///< or lacks x or y
};

/// One pair for each history with x and y at a steady state. `frequency`: of the drive [rad/s], replaced by that of
/// y where the two differ by more than the error of a fit; `unknown`: fitted to y of each history. In a label such
/// as `up/3`, the part before the `/` is the sweep of the pair.
[[nodiscard]] DerivedPairs pairs_of(const std::vector<History>& histories, double frequency = unknown);

struct DerivedDecay {
  DecayRecord record;                   ///< empty if the history is no free decay
  std::vector<double> standard_errors;  ///< of the extremes [m], from the noise of x
  std::vector<std::string> warnings;    ///< what was left out before the release and in the noise at the end
  std::size_t first = 0, last = 0;      ///< samples [first, last) of the free motion
  std::string fault;                    ///< why there are no extremes
  /// The fault is that x has few extremes, or few samples between them: a simulated motion may still fit it.
  bool is_coarse = false;
  bool is_driven = false;    ///< the fault is that something drives the motion
  bool rests = false;        ///< the samples from `last` on are of the mass at rest
  std::size_t held = 0;      ///< first samples that are equal within the noise
  double half_period = 0.0;  ///< samples of a half swing; 0: x does not turn back
};

/// Turning points of x, from the release until the mass comes to rest, the swings grow again in noise, or the
/// record ends.
[[nodiscard]] DerivedDecay decay_of(const History& history);

/// Leaves out the samples before the free motion, where the mass is held or a blow pushes it, and the samples from
/// `last` on. Returns a warning; empty if there are none.
[[nodiscard]] std::string keep_free_motion(History& history, std::size_t first, std::size_t last);

/// The mean of several decays of the same oscillator: the means of their first, second, ... extremes. The sign of
/// each decay is chosen so that its first swing goes down. With one decay ratio and one x_f, the law of extremes is
/// linear in the release and the offset, so the mean obeys it too. Decays with less than half of the extremes of
/// the longest one are left out.
[[nodiscard]] DecayRecord mean_decay(const std::vector<DecayRecord>& decays);

/// The warning about a mean decay of `decays` free vibrations.
[[nodiscard]] std::string mean_decay_warning(std::size_t decays, std::size_t extremes);

/// If a record holds only histories, adds what can be derived from them: pairs if they are driven, else a decay if
/// all are free vibrations (the mean of several). The histories of free vibrations are then cut: they begin at
/// their release, and end where something else pushes the mass or soon after the mass has come to rest. A zero of x
/// that is far off is subtracted (identify/records/sensor_zero.hpp). Returns warnings.
[[nodiscard]] std::vector<std::string> complete(Record& record, double frequency = unknown,
                                                double stiffness = unknown);

}  // namespace dualdamp::identify
