#include "identify/records/faults/sign_faults.hpp"

#include <optional>

#include "core/numbers.hpp"
#include "identify/records/faults/drive_work.hpp"
#include "identify/records/faults/phase_checks.hpp"

namespace dualdamp::identify {

std::vector<core::Diagnostic> gross_faults_under_force(const PairRecord& pairs, const KnownConstants& constants,
                                                       const std::string& file, const core::SettingWords& words) {
  const std::optional<PhaseFault> fault = force_phase_fault(pairs.pairs, constants, words);
  if (!fault) return {};
  return {{{file, 0, 0, {}}, fault->message, fault->allowed, {}, {}}};
}

std::vector<core::Diagnostic> gross_faults_of_loops(const Record& record, const KnownConstants& constants,
                                                    const std::string& file, const core::SettingWords& words) {
  std::vector<core::Diagnostic> faults;
  for (const History& history : record.histories)
    if (const std::optional<double> losses = impossible_losses(history))
      faults.push_back({{file, 0, 0, {}},
                        (history.sweep.empty() ? "" : "sweep " + history.sweep + ": ") +
                            "over closed loops the force takes " + core::format_number(-*losses, 3) + " " +
                            constants.unit("J") +
                            " out of the motion, and friction cannot give energy: the force or the motion has the "
                            "wrong sign",
                        "the force that moves the mass, positive in the direction of the motion: " +
                            words(core::Setting::scale, "force", "-1"),
                        {},
                        {}});
  return faults;
}

}  // namespace dualdamp::identify
