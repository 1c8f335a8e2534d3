#include "scenarios/analyses/shared/structural_damping.hpp"

#include <algorithm>

namespace dualdamp::scenarios {

void check_structural_damping(const identify::Rig& rig, const std::vector<identify::FitParameter>& sought,
                              const identify::Experiments& experiments, const std::string& key,
                              std::vector<SetupFault>& faults) {
  using identify::Owner;
  const auto seeks = [&](Owner owner) {
    return std::ranges::find(sought, owner, &identify::FitParameter::owner) != sought.end();
  };
  const sim::Oscillator& o = rig.known.oscillator;
  if (o.loss_factor == 0.0 && !seeks(Owner::loss_factor)) return;
  for (const auto& experiment : experiments)
    if (experiment->kind != identify::ExperimentKind::steady_states)
      faults.push_back(
          {key, experiment->label +
                    ": 'loss_factor' does not work with this record: structural damping is not causal: it "
                    "has a steady vibration but no motion in time; fit it to amplitudes of steady states"});
  const bool is_damped = o.damping != 0.0 || seeks(Owner::damping) || seeks(Owner::damping_ratio);
  const bool moves_base = std::ranges::any_of(experiments, [](const auto& experiment) {
    return experiment->kind == identify::ExperimentKind::steady_states && !experiment->is_force_driven;
  });
  if (is_damped && moves_base && o.damper_to == sim::DamperTo::ground)
    faults.push_back(
        {key,
         "'loss_factor' acts between mass and base, and 'damping' between mass and ground: the system has "
         "one damper; state damper_to: base, or damping: 0"});
}

}  // namespace dualdamp::scenarios
