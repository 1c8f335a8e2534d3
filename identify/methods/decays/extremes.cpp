#include "identify/methods/decays/extremes.hpp"

#include <algorithm>
#include <cmath>
#include "identify/conclusion.hpp"

namespace dualdamp::identify {

void cut(Extremes& extremes, std::size_t count, const std::string& reason, Estimate& estimate) {
  for (std::size_t i = count; i < extremes.values.size(); ++i)
    estimate.excluded.push_back({static_cast<int>(i) + 1, reason});
  extremes.values.resize(count);
}

std::optional<Extremes> take_extremes(const Record& record, const KnownConstants& constants, Estimate& estimate) {
  if (!record.decay) {
    refuse(estimate, "the record holds no extremes of a free vibration");
    return std::nullopt;
  }
  if (std::string fault = lacks_constants(constants); !fault.empty()) {
    refuse(estimate, std::move(fault));
    return std::nullopt;
  }
  Extremes extremes{record.decay->extremes, 1.0};
  double largest = 0.0;
  for (const double value : extremes.values) {
    if (!std::isfinite(value)) {
      refuse(estimate, "an extreme is not finite");
      return std::nullopt;
    }
    largest = std::max(largest, std::abs(value));
  }
  if (largest > 0.0) extremes.unit = std::ldexp(1.0, std::ilogb(largest));
  for (double& value : extremes.values) value /= extremes.unit;
  const std::vector<double>& e = extremes.values;
  for (std::size_t i = 1; i < e.size(); ++i) {
    const double swing = e[i] - e[i - 1];
    const bool turns = swing != 0.0 && (i == 1 || swing * (e[i - 1] - e[i - 2]) < 0.0);
    if (turns) continue;
    cut(extremes, i, "extreme " + std::to_string(i + 1) + " does not lie across from the one before it", estimate);
    break;
  }
  return extremes;
}

bool enough(const Extremes& extremes, std::size_t needed, Estimate& estimate) {
  if (extremes.values.size() >= needed) return true;
  std::string reason = std::string(needed == 3 ? "three" : "four") + " successive extremes are needed and " +
                       std::to_string(extremes.values.size()) + " can be used";
  if (!estimate.excluded.empty()) {
    reason += ": " + estimate.excluded.front().reason +
              " (signed turning points are asked for, peak and trough by turns, not peaks alone and not a history)";
  }
  refuse(estimate, std::move(reason));
  return false;
}

}  // namespace dualdamp::identify
