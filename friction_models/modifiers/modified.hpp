#pragma once
/// A law under modifiers. Every force limit of the law, nominally L, becomes
///
///   max(0, max(0, 1 + drift t) max(0, 1 + ratio n) exp(-p/power) N L + position_slope |x|) if N > 0, else 0  [N]
///   N = max(0, 1 + load_gradient x) (1 + modulation cos(order w t + phase))
///
/// The factors act first, then the slope. N is the load of the contact; where it is lost there is no friction,
/// whatever the slope. w is the frequency of a harmonic excitation. n is the process of `fluctuation.hpp`, either
/// over time, stationary from the start, or over position, with the middle of cell 0 at x = 0. p [W] is a state:
/// time_constant p' = P - p, where P is the power that the law turns to heat, and p = 0 at the start.
///
/// The law inside reads its force limits from `Instant::modification`. Between the events below they are affine in
/// t and x, so an affine law stays affine, unless it warms, its load is modulated, or its load varies with x while
/// its limits drift. The wrapper adds events to those of the law:
///   times    the end of each cell; the end of a falling drift at t = -1/drift.
///   guards   where the load is lost or comes back; the ends of cells over position; x = 0, where the slope changes
///            its sign; a force limit that becomes zero, or comes back.
/// Before force limits rise by a step the law gets `Trigger::limit_change` under the old limits. While all force
/// limits are zero the law has no force but the one that no limit bounds. The states of a law either stand still
/// then, so that a spring comes back unstretched, or go on moving without force (`WithoutLimits`).
///
/// Cost: a few operations a call; with warming also a copy of what the law remembers.

#include <concepts>
#include <functional>
#include <utility>
#include <vector>

#include "friction_models/instant.hpp"
#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

/// A law while all its force limits are zero.
struct WithoutLimits {
  /// States that do not need the contact, such as a late velocity, go on moving; rates and guards stay those of the
  /// law. Otherwise the states stand still: deflections and ages of a contact that is not there.
  bool states_move = false;
  /// The force that no limit bounds is stiffness x + damping v. Not for affine laws.
  double stiffness = 0.0;  ///< N/m
  double damping = 0.0;    ///< N.s/m

  [[nodiscard]] double force(const Instant& now) const { return stiffness * now.x + damping * now.v; }  ///< N
  [[nodiscard]] double heat(const Instant& now) const { return damping * now.v * now.v; }               ///< W
};

/// Has springs whose energy can turn to heat in an instant: at a change of mode, or when its force limits vanish.
/// Returns this energy [J]; force times velocity is the dissipation plus its growth.
template <class L>
concept StoringLaw = DissipatingLaw<L> && requires(const L& law, const Memory& memory, const Instant& now) {
  { law.stored_energy(memory, now) } -> std::same_as<double>;
};
using StoredEnergy = std::function<double(const Memory& memory, const Instant& now)>;  ///< J; empty: always 0

/// `law` under the modifiers among `values`; `law` itself if no modifier has an effect. `limits`: the nominal force
/// limits of a law that supports `position_slope` [N].
[[nodiscard]] Law modified(const Law& law, const ParameterValues& values, std::vector<double> limits = {},
                           const WithoutLimits& without = {}, StoredEnergy stored_energy = {});

template <FrictionLaw L>
  requires(!std::same_as<L, Law>)
[[nodiscard]] Law modified(const L& law, const ParameterValues& values, std::vector<double> limits = {},
                           const WithoutLimits& without = {}) {
  StoredEnergy stored_energy;
  if constexpr (StoringLaw<L>)
    stored_energy = [law](const Memory& memory, const Instant& now) { return law.stored_energy(memory, now); };
  return modified(Law(law), values, std::move(limits), without, std::move(stored_energy));
}

}  // namespace dualdamp::friction
