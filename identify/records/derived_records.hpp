#pragma once
/// What histories hold beside their samples: x-Y pairs of driven steady states, extremes of a free vibration.
///
/// A steady state is read by sine fits (identify/records/sine_fit.hpp): Y and the phase from the fundamental of y,
/// x as half of peak to trough of the fitted waveform of x with up to nine harmonics, the mean square speed from v
/// where it was measured and else from that waveform. A transient at the beginning is found by fits to pieces of
/// whole periods and skipped; noise is taken for one in 2 of 10,000 histories at most. What nine harmonics leave
/// out of a Coulomb response is 2e-3 of x at the limit of sticking and falls as 1/x^2.
///
/// An extreme of a free vibration is the value that a local fit takes where its slope is zero. The acceleration
/// jumps there, by twice the friction over the mass, so that the fit has a polynomial of its own on each side.
///
/// Errors: none thrown; a history that gives nothing says why among the warnings. Cost: linear, about 1 us a
/// sample.

#include <cstddef>
#include <string>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

struct DerivedPairs {
  PairRecord record;  ///< empty where no history is a driven steady state
  std::vector<std::string> warnings;
};

/// One pair for each history with x and y at a steady state. `frequency` [rad/s] of the drive; unknown: fitted to
/// y, history by history. The part of a history's label before a `/` is the sweep of its pair: `up/3`.
[[nodiscard]] DerivedPairs pairs_of(const std::vector<History>& histories, double frequency = unknown);

struct DerivedDecay {
  DecayRecord record;                   ///< empty where the history is no free decay
  std::vector<double> standard_errors;  ///< of the extremes [m], from the noise of x
  std::vector<std::string> warnings;    ///< what was left out before the release and in the noise at the end
  std::size_t first = 0, last = 0;      ///< samples [first, last) of the free motion
};

/// Turning points of x, from the first after its release to where the mass comes to rest, where the swings grow
/// again in noise, or where the record ends.
[[nodiscard]] DerivedDecay decay_of(const History& history);

/// One decay for several of the same oscillator: the means of their first, second, ... extremes, each decay turned
/// so that its first swing goes down. With one decay ratio and one x_f the law of extremes is linear in the release
/// and the offset, so that the mean obeys it too. Decays with less than half of the extremes of the longest are
/// left out.
[[nodiscard]] DecayRecord mean_decay(const std::vector<DecayRecord>& decays);

/// What to tell of it.
[[nodiscard]] std::string mean_decay_warning(std::size_t decays, std::size_t extremes);

/// Adds to a record that holds nothing but histories what can be derived from them: pairs where they are driven, a
/// decay where there is a single one without drive. The histories of free vibrations then begin at their release,
/// and end where something else pushes the mass, or soon after the mass has come to rest. A zero of x that is far
/// off is subtracted (identify/records/sensor_zero.hpp). Returns warnings.
[[nodiscard]] std::vector<std::string> complete(Record& record, double frequency = unknown,
                                                double stiffness = unknown);

}  // namespace dualdamp::identify
