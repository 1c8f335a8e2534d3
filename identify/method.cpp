#include "identify/method.hpp"

#include <algorithm>
#include <cmath>

namespace dualdamp::identify {

std::string_view describe(RecordKind kind) {
  switch (kind) {
    case RecordKind::pairs:
      return "x-Y pairs";
    case RecordKind::states:
      return "x-Y pairs with phases or frequencies";
    case RecordKind::decay:
      return "extremes of a free vibration";
    case RecordKind::history:
      return "time histories";
  }
  return {};
}

std::string lacks_pairs(const Record& record) {
  return record.pairs && !record.pairs->pairs.empty() ? "" : "the record holds no x-Y pairs";
}

std::string lacks_resonance_pairs(const Record& record) {
  if (std::string lack = lacks_pairs(record); !lack.empty()) return lack;
  constexpr double same = 1e-6;  // of a frequency: generators hold it to that
  const double first = record.pairs->pairs.front().omega;
  const auto differs = [first](const Pair& pair) {
    if (std::isnan(first) || std::isnan(pair.omega)) return std::isnan(first) != std::isnan(pair.omega);
    return std::abs(pair.omega - first) > same * first;
  };
  return std::ranges::any_of(record.pairs->pairs, differs) ? "the pairs were measured at several frequencies" : "";
}

std::string lacks_decay(const Record& record) {
  return record.decay && !record.decay->extremes.empty() ? "" : "the record holds no extremes of a free vibration";
}

}  // namespace dualdamp::identify
