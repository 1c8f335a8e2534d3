#pragma once
/// Words of a heading or a unit that say which amplitude of an oscillation its numbers are: `x_rms`, `Y p-p`,
/// `mm pp`, `Vrms`, `mm peak`.
///
/// Y, x and fundamental are half of peak to trough. Numbers of another kind are off by a known factor, which only
/// the force tells: zeta stays right if both amplitudes are off.
///
/// Errors: none. Cost: linear in the text.

#include <optional>
#include <string>
#include <string_view>

namespace dualdamp::identify {

struct AmplitudeWords {
  std::string_view name;          ///< "an rms value", "peak to peak"
  std::string_view to_amplitude;  ///< the factor to half of peak to trough: "1.41421" (of a sine), "0.5"
};

/// What a heading says, if it says rms or peak to peak.
[[nodiscard]] std::optional<AmplitudeWords> amplitude_words(std::string_view text);

/// A unit without such words behind it, or words for the peak: "mm" of "mm rms", "mm_pp", "mm peak", "mmpp".
[[nodiscard]] std::string without_amplitude_words(std::string_view unit);

}  // namespace dualdamp::identify
