#pragma once
/// What a study of mechanisms found, and how it is told: as JSON, as tables, and in words.

#include <optional>
#include <string>
#include <vector>

#include "bench/mechanism_fit.hpp"
#include "bench/mechanisms.hpp"
#include "scenarios/format/json.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::bench {

/// What a free decay of the rig gives by the method, from its first and its last four extremes.
struct DecayReading {
  MeasuredDecay::Segment high, low;

  [[nodiscard]] double bend() const { return high.zeta / low.zeta - 1.0; }
};

/// One mechanism, answered.
struct Explanation {
  const Rig* mechanism = nullptr;
  std::size_t unknowns = 0;
  MechanismFit fit;
  double misfit = scenarios::none;   ///< largest of all numbers, relative
  double stretch = scenarios::none;  ///< largest ratio between a parameter and its plausible value, either way
  std::vector<std::string> aliases;
  std::optional<DecayReading> decay;
  Levels curve;
};

/// One mechanism at plausible values.
struct Effect {
  const PlausibleRig* rig = nullptr;
  std::optional<Response> response;
  std::optional<std::vector<PartReading>> readings;
};

/// All of them, the closest first.
struct StudyAnswer {
  Levels measured;  ///< that the estimates lead to
  std::vector<Explanation> explanations;
  std::vector<Effect> effects;
};

[[nodiscard]] scenarios::Json result_of(const StudyAnswer& answer, const MechanismStudy& study);

/// mechanisms, effects, levels, curves.
[[nodiscard]] std::vector<scenarios::Table> tables_of(const StudyAnswer& answer, const MechanismStudy& study);

}  // namespace dualdamp::bench
