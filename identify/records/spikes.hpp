#pragma once
/// Spikes of one sample in histories: a bit that flipped, a contact that broke.
///
/// What a sample differs from the cubic through its four neighbours is small noise in a signal that is sampled well
/// enough to be used at all. A spike differs by more than eight deviations, those of the whole signal and of its
/// surroundings both, by 3 % of the range of its surroundings, and clearly more than either neighbour, so that no
/// step, no peak and no reversal of friction is one.
/// Cost: 0.2 us a sample.

#include <cstddef>
#include <string>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

struct Spike {
  std::size_t sample = 0;
  double deviations = 0.0;  ///< how far off, in standard deviations of the noise
  double smooth = 0.0;      ///< what the neighbours say
};

/// In order of time.
[[nodiscard]] std::vector<Spike> spikes_of(const std::vector<double>& signal);

/// One sentence for each signal that holds spikes. With `replace` each is replaced by what its neighbours say.
[[nodiscard]] std::vector<std::string> treat_spikes(std::vector<History>& histories, bool replace);

}  // namespace dualdamp::identify
