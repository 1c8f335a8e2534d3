#pragma once
/// How long identification takes: processor time of one thread, median of several runs [s].

namespace dualdamp::bench::speed {

/// 1,000 replicates by sweeps of `resonance_least_squares`: ten sweeps of five noisy pairs.
[[nodiscard]] double seconds_for_bootstrap();

/// `output_error` with its intervals on ten seconds of noisy y and x at 1 kHz.
[[nodiscard]] double seconds_for_output_error();

/// `any_law` on eight noisy steady states with phases, on all cores.
[[nodiscard]] double seconds_for_any_law();

/// `law_selection` on fifty noisy pairs.
[[nodiscard]] double seconds_for_law_selection();

}  // namespace dualdamp::bench::speed
