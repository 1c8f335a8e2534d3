#include "identify/methods.hpp"

#include <algorithm>

#include "identify/free_decay.hpp"
#include "identify/resonance_least_squares.hpp"
#include "identify/resonance_two_point.hpp"

namespace dualdamp::identify {

const std::vector<MethodEntry>& methods() {
  static const std::vector<MethodEntry> list = {
      {"free_decay", "damping ratio and friction force from the decrements of a free vibration",
       "linear spring, zeta < 1, the mass moves through every half swing; checked: extremes alternate, extremes "
       "after "
       "the stop are left out, half period against mass and stiffness, cubic term F-test",
       "X_(i+1) = R X_i - x_f (1 + R), R = exp(-pi zeta/sqrt(1 - zeta^2)); "
       "R = -(e_3 - e_1)/(e_2 - e_0) of signed extremes e about any offset",
       RecordKind::decay, free_decay},
      {"resonance_least_squares", "damping ratio and friction force from a straight line through amplitude pairs",
       "excitation at w = wn, zeta small, no sticking, errors in x alone; checked: sticking pairs are left out, "
       "quadratic term F-test, what the method would make of its own estimate by the exact law",
       "x = a + b Y, zeta = 1/(2 b), x_f = -a/G(zeta), G by Eq (4) at w = wn", RecordKind::pairs,
       resonance_least_squares},
      {"resonance_two_point", "damping ratio and friction force from two amplitude pairs",
       "excitation at w = wn, zeta small, no sticking; checked: sticking pairs are left out, what the method would "
       "make of its own estimate by the exact law",
       "zeta = (Y2 - Y1)/(2 (x2 - x1)), x_f = (x1 Y2 - x2 Y1)/(G(zeta) (Y1 - Y2)), G by Eq (4) at w = wn",
       RecordKind::pairs, resonance_two_point},
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
