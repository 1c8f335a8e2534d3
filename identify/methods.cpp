#include "identify/methods.hpp"

#include <algorithm>

#include "identify/methods/amplitudes/den_hartog_fit.hpp"
#include "identify/methods/amplitudes/energy_balance.hpp"
#include "identify/methods/amplitudes/harmonic_balance.hpp"
#include "identify/methods/amplitudes/law_selection.hpp"
#include "identify/methods/amplitudes/receptance.hpp"
#include "identify/methods/amplitudes/resonance_deming.hpp"
#include "identify/methods/amplitudes/resonance_least_squares.hpp"
#include "identify/methods/amplitudes/resonance_two_point.hpp"
#include "identify/methods/amplitudes/resonance_within_sweep.hpp"
#include "identify/methods/decays/free_decay.hpp"
#include "identify/methods/decays/jacobsen_ayre.hpp"
#include "identify/methods/histories/acceleration_velocity_displacement.hpp"
#include "identify/methods/histories/extended_kalman.hpp"
#include "identify/methods/histories/friction_force.hpp"
#include "identify/methods/histories/output_error.hpp"
#include "identify/methods/histories/random_decrement.hpp"
#include "identify/methods/histories/recursive_least_squares.hpp"
#include "identify/methods/histories/stochastic_averaging.hpp"

namespace dualdamp::identify {

const std::vector<MethodEntry>& methods() {
  static const std::vector<MethodEntry> list = {
      acceleration_velocity_displacement_method,
      den_hartog_fit_method,
      energy_balance_method,
      extended_kalman_method,
      free_decay_method,
      friction_force_method,
      harmonic_balance_method,
      jacobsen_ayre_method,
      law_selection_method,
      output_error_method,
      random_decrement_method,
      receptance_method,
      recursive_least_squares_method,
      resonance_deming_method,
      resonance_least_squares_method,
      resonance_two_point_method,
      resonance_within_sweep_method,
      stochastic_averaging_method,
  };
  return list;
}

const MethodEntry* find_method(std::string_view name) {
  const auto& list = methods();
  const auto found =
      std::find_if(list.begin(), list.end(), [name](const MethodEntry& m) { return m.name == name; });
  return found == list.end() ? nullptr : &*found;
}

const std::vector<const Option*>& options() {
  static const std::vector<const Option*> list = [] {
    std::vector<const Option*> all;
    for (const MethodEntry& method : methods())
      for (const Option* option : method.options())
        if (std::ranges::find(all, option) == all.end()) all.push_back(option);
    std::ranges::sort(all, {}, &Option::name);
    return all;
  }();
  return list;
}

}  // namespace dualdamp::identify
