#pragma once
/// Do steady states need more force than their drive gives?
///
///   (k - m w^2) X + Re F = k Y cos(phase),   X: amplitude of x, F: first harmonic of friction
///
/// Friction takes work by Im F, and a contact that yields before it slides adds a spring, Re F >= 0. So below
/// resonance no such friction leaves |k - m w^2| X above k Y, and above resonance only a contact that yields does.
/// Readings that are above it contradict mass, stiffness or frequency, however few they are: no fit is needed.
///
/// A reading is above if it is so by more than 10 %, which covers noise and the harmonics of x, and by more than
/// errors of 2.6 times the stated uncertainties do. More than half of the states decide.

#include "identify/ledger/ledger.hpp"

namespace dualdamp::identify {

/// Charges the constants with such readings of x-Y pairs in a ledger that charges nothing else; no estimate that
/// rests on them is left. Does nothing beside histories, which are tested as they are.
void charge_force_balance(const Record& record, const KnownConstants& constants,
                          const ConstantUncertainties& uncertainties, Ledger& ledger);

}  // namespace dualdamp::identify
