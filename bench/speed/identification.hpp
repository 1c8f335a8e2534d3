#pragma once
/// Times of identification: processor time of one thread unless stated otherwise, median of several runs [s].

namespace dualdamp::bench::speed {

/// 1,000 replicates by sweeps of `resonance_least_squares`: ten sweeps of five noisy pairs.
[[nodiscard]] double seconds_for_bootstrap();

/// `output_error` with its intervals on ten seconds of noisy y and x at 1 kHz.
[[nodiscard]] double seconds_for_output_error();

/// `any_law` on noisy records, on all cores.
enum class AnyLawRecord {
  states,    ///< eight levels at resonance with phases
  response,  ///< 21 frequencies with phases
  decay,     ///< 24 extremes of a free vibration
  history,   ///< 12 s of a free vibration at 2 kHz
};
[[nodiscard]] double seconds_for_any_law(AnyLawRecord record);

/// The design of the next measurements after eight amplitudes at resonance, on all cores.
[[nodiscard]] double seconds_for_design();

/// The ledger of assumptions of 12 s of y, x, v and a at 2 kHz.
[[nodiscard]] double seconds_for_ledger();

/// Peak memory of this program so far [MB].
[[nodiscard]] double peak_megabytes();

/// `law_selection` on fifty noisy pairs.
[[nodiscard]] double seconds_for_law_selection();

}  // namespace dualdamp::bench::speed
