#pragma once
/// The result of a study of mechanisms, as JSON and as tables.

#include <optional>
#include <string>
#include <vector>

#include "bench/mechanisms.hpp"
#include "bench/mechanisms/fit.hpp"
#include "scenarios/format/json.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::bench {

/// The estimates of `free_decay` for a decay of the rig, from its first four and from its last four extremes.
struct DecayReading {
  MeasuredDecay::Segment high, low;

  [[nodiscard]] double bend() const { return high.zeta / low.zeta - 1.0; }
};

/// One mechanism, fitted to the estimates.
struct Explanation {
  const Departure* mechanism = nullptr;
  std::size_t unknowns = 0;
  MechanismFit fit;
  double misfit = scenarios::none;   ///< largest relative deviation of a number
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

/// All mechanisms, the closest first.
struct StudyAnswer {
  Levels measured;  ///< reconstructed from the estimates
  std::vector<Explanation> explanations;
  std::vector<Effect> effects;
};

[[nodiscard]] scenarios::Json result_of(const StudyAnswer& answer, const MechanismStudy& study);

/// The tables mechanisms, effects, levels and curves.
[[nodiscard]] std::vector<scenarios::Table> tables_of(const StudyAnswer& answer, const MechanismStudy& study);

}  // namespace dualdamp::bench
