#include "identify/methods.hpp"

#include <algorithm>

// The methods, one line each, sorted by name. The source of each method defines its entry, NAME_method.
#define DUALDAMP_METHODS(METHOD)             \
  METHOD(acceleration_velocity_displacement) \
  METHOD(any_law)                            \
  METHOD(den_hartog_fit)                     \
  METHOD(energy_balance)                     \
  METHOD(extended_kalman)                    \
  METHOD(free_decay)                         \
  METHOD(friction_force)                     \
  METHOD(harmonic_balance)                   \
  METHOD(jacobsen_ayre)                      \
  METHOD(law_selection)                      \
  METHOD(output_error)                       \
  METHOD(random_decrement)                   \
  METHOD(receptance)                         \
  METHOD(recursive_least_squares)            \
  METHOD(resonance_deming)                   \
  METHOD(resonance_least_squares)            \
  METHOD(resonance_two_point)                \
  METHOD(resonance_within_sweep)             \
  METHOD(stochastic_averaging)

namespace dualdamp::identify {

#define DUALDAMP_DECLARE(name) extern const MethodEntry name##_method;
DUALDAMP_METHODS(DUALDAMP_DECLARE)
#undef DUALDAMP_DECLARE

const std::vector<MethodEntry>& methods() {
#define DUALDAMP_ENTRY(name) name##_method,
  static const std::vector<MethodEntry> list = {DUALDAMP_METHODS(DUALDAMP_ENTRY)};
#undef DUALDAMP_ENTRY
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
