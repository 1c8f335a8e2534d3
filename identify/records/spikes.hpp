#pragma once
/// Spikes of one sample in histories, from a flipped bit or a broken contact.
///
/// In a signal with enough samples, the difference of a sample from the cubic through its four neighbours is small
/// noise. A spike differs by more than eight standard deviations, both of the whole signal and of its surroundings,
/// by more than 3 % of the range of its surroundings, and by clearly more than either neighbour; and the
/// signal returns beside it. Steps, peaks, corners and reversals of friction are therefore no spikes. Cost: 0.2 us
/// a sample.

#include <cstddef>
#include <string>
#include <vector>

#include "identify/record.hpp"

namespace dualdamp::identify {

struct Spike {
  std::size_t sample = 0;
  double deviations = 0.0;  ///< difference in standard deviations of the noise
  double smooth = 0.0;      ///< value of the cubic through the neighbours
};

/// In order of time.
[[nodiscard]] std::vector<Spike> spikes_of(const std::vector<double>& signal);

/// One sentence for each signal with spikes. `replace`: each spike is replaced by the value from its neighbours.
[[nodiscard]] std::vector<std::string> treat_spikes(std::vector<History>& histories, bool replace);

}  // namespace dualdamp::identify
