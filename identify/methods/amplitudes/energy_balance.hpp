#pragma once
/// Energy balance: viscous and Coulomb friction from the work of the base in one period.
///
///   pi k Y X_1 sin(phi) = F0 path + c integral v^2 dt,   path = integral |dx| = 4 x
///
/// with X_1 and phi the amplitude and lag of the fundamental of x, and x half of peak to trough. It is exact for
/// Coulomb and viscous friction at any frequency and for any waveform of x, with stops or without, if x has two
/// turning points in a period. It needs neither resonance nor small damping nor the mass, and the spring need not
/// be linear. Divided by the path, the states lie on a straight line of force over speed, which is fitted by least
/// squares over levels and frequencies.
///
/// If the record has no two states with phases, histories of y and x are read. Each period gives one balance: the
/// work less the change of the stored energy. This needs the mass and allows any motion and any drive. Periods of
/// low motion are left out: their path is that of noise, and the filter rounds the stops of the mass.
///
/// If the mean square speed of a state was not measured, that of the fundamental is used, w^2 X_1^2/2; if X_1 was
/// not measured, x is used. This biases c and F0 by one to two percent in opposite directions. The method computes
/// the bias from exact states at its own estimate. A phase error e changes the work by the fraction cot(phi) e,
/// which is 0 at resonance. Uncertainty: from the scatter about the line with n - 2 degrees of freedom.
/// Diagnostics: an F test of a quadratic term of the speed. Source: tomlinson1979, liang2006balancing. Errors:
/// `outcome`. Cost: about 5 us for 50 states.

#include <functional>
#include <vector>

#include "identify/method.hpp"

namespace dualdamp::identify {

/// The energy balance of one steady state: over a period, or over any time without change of stored energy.
struct EnergyTerms {
  double work = 0.0;          ///< done on the oscillator by base and force [J]
  double path = 0.0;          ///< integral |dx| [m]
  double speed_square = 0.0;  ///< integral v^2 dt [m^2/s]
  int number = 0;             ///< of the state in the record
};

/// The balance of one period, from the measured quantities of a steady state; `pair.omega` and `pair.phase` are
/// known.
[[nodiscard]] EnergyTerms energy_of(const Pair& pair, double stiffness);

/// The balances for the exact motion at an estimate.
using OwnAccounts = std::function<std::vector<EnergyTerms>(const ParameterSet&)>;

/// The line through these balances, with its uncertainty and its test, in `estimate`; false after the estimate has
/// been refused. Reasons not to use it are appended to `faults`. `own`, for approximate balances: those of the
/// exact motion at the estimate; their departure from a line does not count against the law.
bool balance(const std::vector<EnergyTerms>& accounts, const KnownConstants& constants, Estimate& estimate,
             std::vector<std::string>& faults, const OwnAccounts& own = {});

[[nodiscard]] Estimate energy_balance(const Record& record, const KnownConstants& constants,
                                      const FilterOptions& options = {});

extern const MethodEntry energy_balance_method;

}  // namespace dualdamp::identify
