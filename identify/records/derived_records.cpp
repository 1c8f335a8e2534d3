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
  if (record.histories.size() == 1) {
    DerivedDecay decay = decay_of(record.histories.front());
    if (!decay.record.extremes.empty()) record.decay = std::move(decay.record);
    return std::move(decay.warnings);
  }
  return {
      "the file holds " + std::to_string(record.histories.size()) +
      " free vibrations: methods that read histories use them together; methods that read extremes take one, from "
      "a file of its own"};
}

}  // namespace dualdamp::identify
