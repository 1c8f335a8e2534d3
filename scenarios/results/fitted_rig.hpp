#pragma once
/// A fitted rig as the text of a scenario that computes the curves of the fit.

#include <string>

#include "identify/fit/fit.hpp"
#include "scenarios/format/json.hpp"

namespace dualdamp::scenarios {

/// Parts of the text beside the fitted numbers.
struct RigText {
  std::string title;
  Json excitation;  ///< as the reader returned it; null: none
};

/// `system` with the values of the rig; a rig from a loop, without mass or spring, gets 1 kg and 1 N/m.
[[nodiscard]] Json system_json(const identify::Rig& rig);

/// A scenario that computes experiment `index` of the fit: YAML.
[[nodiscard]] std::string scenario_text(const identify::Fit& fit, const identify::Experiments& experiments,
                                        std::size_t index, const RigText& text);

}  // namespace dualdamp::scenarios
