#pragma once
/// Energy balance: viscous and Coulomb friction from the work that the base does in a period.
///
///   pi k Y X_1 sin(phi) = F0 path + c integral v^2 dt,   path = integral |dx| = 4 x
///
/// with X_1 and phi the amplitude and lag of the fundamental of x, and x half of peak to trough. It is exact for
/// Coulomb and viscous friction at any frequency, whatever the waveform of x, with stops or without, as long as the
/// mass turns twice in a period; it needs neither resonance nor small damping nor the mass, and springs that are
/// not linear do not matter. Each state is divided by its path, which leaves a straight line of force over speed,
/// fitted by least squares over levels and frequencies.
///
/// Histories of y and x are read where the record has no two states with phases: each period is an account, with
/// the work less the change of the stored energy, which needs the mass and allows any motion and any drive.
///
/// Where the mean square speed of a state was not measured that of the fundamental is taken, w^2 X_1^2/2, and where
/// X_1 was not, x. That biases c and F0 by one to two percent in opposite directions; by how much, the method tells
/// by reading exact states at its own estimate. A phase error e changes the work by cot(phi) e: nothing at
/// resonance. Uncertainty: from the scatter about the line with n - 2 degrees of freedom. Diagnostics: an F test of
/// a quadratic term of the speed. Source: tomlinson1979, liang2006balancing. Errors: `outcome`. Cost: about 5 us
/// for 50 states.

#include <functional>
#include <vector>

#include "identify/method.hpp"

namespace dualdamp::identify {

/// The account of one steady state or one record of it: over a period, or any time without change of stored energy.
struct EnergyTerms {
  double work = 0.0;          ///< done on the oscillator by base and force [J]
  double path = 0.0;          ///< integral |dx| [m]
  double speed_square = 0.0;  ///< integral v^2 dt [m^2/s]
  int number = 0;             ///< of the state in the record
};

/// Of one period, from what was measured of a steady state; `pair.omega` and `pair.phase` are known.
[[nodiscard]] EnergyTerms energy_of(const Pair& pair, double stiffness);

/// What the accounts would be if the motion were the exact one of an estimate.
using OwnAccounts = std::function<std::vector<EnergyTerms>(const ParameterSet&)>;

/// The line through accounts of any origin, with its uncertainty and its test, in `estimate`; false after it has
/// been refused. Reasons not to use it are appended to `faults`. `own`, where accounts are approximate: what they
/// would be at the estimate; its departure from a line is not held against the law.
bool balance(const std::vector<EnergyTerms>& accounts, const KnownConstants& constants, Estimate& estimate,
             std::vector<std::string>& faults, const OwnAccounts& own = {});

[[nodiscard]] Estimate energy_balance(const Record& record, const KnownConstants& constants,
                                      const FilterOptions& options = {});

/// Two pairs with phases, or histories, are asked for.
[[nodiscard]] std::string lacks_energy(const Record& record);

extern const MethodEntry energy_balance_method;

}  // namespace dualdamp::identify
