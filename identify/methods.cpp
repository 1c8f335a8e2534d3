#include "identify/methods.hpp"

#include <algorithm>

#include "identify/acceleration_velocity_displacement.hpp"
#include "identify/den_hartog_fit.hpp"
#include "identify/energy_balance.hpp"
#include "identify/extended_kalman.hpp"
#include "identify/free_decay.hpp"
#include "identify/friction_force.hpp"
#include "identify/harmonic_balance.hpp"
#include "identify/jacobsen_ayre.hpp"
#include "identify/law_selection.hpp"
#include "identify/output_error.hpp"
#include "identify/random_decrement.hpp"
#include "identify/receptance.hpp"
#include "identify/recursive_least_squares.hpp"
#include "identify/resonance_deming.hpp"
#include "identify/resonance_least_squares.hpp"
#include "identify/resonance_two_point.hpp"
#include "identify/resonance_within_sweep.hpp"
#include "identify/stochastic_averaging.hpp"

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

}  // namespace dualdamp::identify
