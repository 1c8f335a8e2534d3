#include "identify/records/derived_records.hpp"

#include <utility>

namespace dualdamp::identify {

std::vector<std::string> complete(Record& record, double frequency) {
  if (record.pairs || record.decay || record.histories.empty()) return {};
  DerivedPairs driven = pairs_of(record.histories, frequency);
  if (!driven.record.pairs.empty()) {
    record.pairs = std::move(driven.record);
    return std::move(driven.warnings);
  }
  const History& only = record.histories.front();
  if (record.histories.size() == 1 && !only.x.empty() && only.force.empty() && only.y.empty()) {
    DerivedDecay decay = decay_of(only);
    if (!decay.record.extremes.empty()) record.decay = std::move(decay.record);
  }
  return {};
}

}  // namespace dualdamp::identify
