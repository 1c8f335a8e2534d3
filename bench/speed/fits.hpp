#pragma once
/// How long fits, predictions and sweeps take: processor time of all threads [s].

namespace dualdamp::bench::speed {

/// Coulomb friction and damping, with their intervals, from ten seconds of noisy x at 1 kHz.
[[nodiscard]] double seconds_for_coulomb_fit();

/// The same with the five numbers of `lugre`, of which nothing is stated.
[[nodiscard]] double seconds_for_lugre_fit();

/// Another such record predicted with fitted numbers, and what the law can attain there.
[[nodiscard]] double seconds_for_prediction();

/// Steady states of the standard case over 100 friction forces and 100 amplitudes, each point a run of its own.
[[nodiscard]] double seconds_for_sweep();

}  // namespace dualdamp::bench::speed
