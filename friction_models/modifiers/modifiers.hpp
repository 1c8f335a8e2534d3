#pragma once
/// Modifiers change the force limits of a law (`modified.hpp` has the equation). The entry of a law names the
/// modifiers that it supports; they are parameters of the law. The factors act first, then the slope.
///
///   drift           limits multiplied by max(0, 1 + drift t)
///   position_slope  limits plus position_slope |x|, at least 0
///   load_gradient   limits multiplied by max(0, 1 + load_gradient x): the load of the contact varies with position
///   load_modulation limits multiplied by 1 + ratio cos(order w t + phase): the load follows a harmonic excitation
///                   of frequency w; the law then runs on the smooth engine
///   fluctuation     limits multiplied by max(0, 1 + ratio n), n a stationary Ornstein-Uhlenbeck process of
///                   variance 1 over time, correlation exp(-|t|/correlation_time), or over position, correlation
///                   exp(-|x|/correlation_length), held on a grid
///   warming         limits multiplied by exp(-P/power), P the power that the law turns to heat, averaged with a
///                   weight that falls as exp(-t/time_constant) into the past; the law then runs on the smooth
///                   engine

#include <string_view>
#include <vector>

#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

/// The largest phase of a load or a drive that is taken, either way [rad]. Beyond it an angle is known to less than
/// 1e-10 rad; at 1e16 rad nothing is left of it.
inline constexpr double largest_phase = 1e6;

/// The parameters of all modifiers, each optional; an absent modifier has no effect.
[[nodiscard]] const std::vector<Parameter>& modifier_parameters();

/// The names of all modifiers; of all but one.
[[nodiscard]] std::vector<std::string_view> all_modifiers();
[[nodiscard]] std::vector<std::string_view> all_modifiers_but(std::string_view name);

/// A law's own parameters, then the modifiers named.
[[nodiscard]] std::vector<Parameter> with_modifiers(std::vector<Parameter> own,
                                                    const std::vector<std::string_view>& modifiers);

}  // namespace dualdamp::friction
