#pragma once
/// A fitted rig as text: for predictions, and as scenarios that compute the curves of the fit.

#include <string>
#include <vector>

#include "identify/fit/fit.hpp"
#include "scenarios/format/json.hpp"
#include "scenarios/results/answer.hpp"

namespace dualdamp::scenarios {

/// Parts of the text beside the fitted numbers.
struct RigText {
  std::string title;
  Json excitation;  ///< as the reader returned it; null: none
};

/// Title, system and drive of the rig: YAML, to which a prediction adds its analysis. Constants that the fit lacked
/// are left out.
[[nodiscard]] std::string rig_text(const identify::Fit& fit, const RigText& text);

/// A scenario that computes experiment `index` of the fit: YAML. A rig from a loop, without mass or spring, gets 1
/// kg and 1 N/m.
[[nodiscard]] std::string scenario_text(const identify::Fit& fit, const identify::Experiments& experiments,
                                        std::size_t index, const RigText& text);

/// Adds these scenarios as files to an answer: fitted.yaml, or fitted_0.yaml and so on if there are several. A
/// drive by samples is the table drive.csv, or drive_0.csv and so on, beside it, so that the directory needs no
/// other file. `texts`: of each experiment.
void add_scenario_files(const identify::Fit& fit, const identify::Experiments& experiments,
                        const std::vector<RigText>& texts, Answer& answer);

}  // namespace dualdamp::scenarios
