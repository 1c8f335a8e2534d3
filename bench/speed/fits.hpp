#pragma once
/// Times of fits, predictions and sweeps: processor time of all threads [s].

namespace dualdamp::bench::speed {

/// Coulomb friction and damping, with their intervals, from ten seconds of noisy x at 1 kHz.
[[nodiscard]] double seconds_for_coulomb_fit();

/// The fit of `lugre` with its five parameters, all free.
[[nodiscard]] double seconds_for_lugre_fit();

/// The fit of `dahl`, both parameters and damping, to sixteen amplitudes with phases.
[[nodiscard]] double seconds_for_dahl_fit();

/// The prediction of another such record with fitted parameters, and the best error that the law can attain there.
[[nodiscard]] double seconds_for_prediction();

/// Steady states of the standard case over 100 friction forces and 100 amplitudes, each point a run of its own.
[[nodiscard]] double seconds_for_sweep();

}  // namespace dualdamp::bench::speed
