#include "identify/records/derived_records.hpp"

#include <algorithm>
#include <utility>

namespace dualdamp::identify {

std::vector<std::string> complete(Record& record, double frequency) {
  if (record.pairs || record.decay || record.histories.empty()) return {};
  DerivedPairs driven = pairs_of(record.histories, frequency);
  if (!driven.record.pairs.empty()) {
    record.pairs = std::move(driven.record);
    return std::move(driven.warnings);
  }
  const auto is_free = [](const History& history) {
    return !history.x.empty() && history.force.empty() && history.y.empty();
  };
  if (!std::ranges::all_of(record.histories, is_free)) return {};
  std::vector<DecayRecord> decays;
  std::vector<std::string> warnings;
  for (const History& history : record.histories) {
    DerivedDecay decay = decay_of(history);
    if (!decay.record.extremes.empty()) decays.push_back(std::move(decay.record));
    const std::string test = history.sweep.empty() ? "" : "test '" + history.sweep + "': ";
    for (const std::string& warning : decay.warnings) warnings.push_back(test + warning);
  }
  if (!decays.empty()) record.decay = mean_decay(decays);
  if (decays.size() > 1) warnings.push_back(mean_decay_warning(decays.size(), record.decay->extremes.size()));
  return warnings;
}

std::string mean_decay_warning(std::size_t decays, std::size_t extremes) {
  return "the extremes are means over " + std::to_string(decays) + " free vibrations, " + std::to_string(extremes) +
         " of each";
}

DecayRecord mean_decay(const std::vector<DecayRecord>& decays) {
  const auto length = [](const DecayRecord& decay) { return decay.extremes.size(); };
  const std::size_t longest = std::ranges::max(decays, {}, length).extremes.size();
  std::vector<const DecayRecord*> used;
  for (const DecayRecord& decay : decays)
    if (2 * length(decay) >= longest) used.push_back(&decay);
  std::size_t count = longest;
  for (const DecayRecord* decay : used) count = std::min(count, length(*decay));
  DecayRecord mean;
  mean.extremes.resize(count);
  const bool timed = std::ranges::all_of(used, [](const DecayRecord* decay) { return !decay->times.empty(); });
  if (timed) mean.times.resize(count);
  const auto n = static_cast<double>(used.size());
  for (const DecayRecord* decay : used) {
    const bool falls = count < 2 || decay->extremes[1] < decay->extremes[0];
    for (std::size_t i = 0; i < count; ++i) {
      mean.extremes[i] += (falls || used.size() == 1 ? 1.0 : -1.0) * decay->extremes[i] / n;
      // Each began at a time of its own; the first names it.
      if (timed) mean.times[i] += (decay->times[i] - decay->times[0]) / n;
    }
  }
  for (double& time : mean.times) time += used.front()->times[0];
  return mean;
}

}  // namespace dualdamp::identify
