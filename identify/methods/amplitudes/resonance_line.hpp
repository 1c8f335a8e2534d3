#pragma once
/// Common parts of the resonance methods: pairs, the line through them, the friction that follows from the line,
/// the search that leaves out sticking pairs, and the diagnostics.
///
///   x = a + b Y,   zeta = 1/(2 b),   x_f = -a/G(zeta)                                 Eqs (9)-(15)
///
/// which neglects H and uses q = 2 zeta and G at w = wn, as at resonance. (G at the true frequency of a detuned
/// test would not match this q: at zeta = 0.12 and 2 % detuning the error of x_f would be 5 % instead of 0.7 %.)
/// Lengths inside are in units of `ResonanceData::unit`, a power of two near the largest output, so that results do
/// not depend on the scale of the record. Source: liang2004identifying.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "identify/estimate.hpp"
#include "identify/method.hpp"
#include "identify/methods/amplitudes/error_propagation.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

struct Datum {
  double Y = 0.0;
  double x = 0.0;
  int number = 0;  ///< of the pair in the record
  int sweep = 0;   ///< index of its sweep, in order of appearance
  double r = 1.0;  ///< w/wn
};

/// The record made ready: pairs with positive finite amplitudes in order of x, and the frequency.
struct ResonanceData {
  std::vector<Datum> pairs;
  double unit = 1.0;  ///< m
  double r = 1.0;     ///< w/wn of the first pair; of all of them if one frequency is required
  ResonanceG G;       ///< at w = wn
  KnownConstants constants;
  std::vector<std::string> sweeps;  ///< labels
};

struct Line {
  double slope = 0.0;
  double intercept = 0.0;
};

struct LineFriction {
  double zeta = 0.0;
  double x_f = 0.0;
  double G = 0.0;
};

/// The usable pairs, at any frequencies. Nothing after `estimate` has been refused: no pairs, unusable constants,
/// an unknown frequency.
[[nodiscard]] std::optional<ResonanceData> take_pairs(const Record& record, const KnownConstants& constants,
                                                      Estimate& estimate);

/// The usable pairs of a record at one frequency near resonance. Refused too: another record, a frequency far from
/// resonance, fewer than two pairs with positive finite amplitudes.
[[nodiscard]] std::optional<ResonanceData> prepare(const Record& record, const KnownConstants& constants,
                                                   const ResonanceOptions& options, Estimate& estimate);

/// Nothing for a line that does not rise, or for numbers beyond double precision.
[[nodiscard]] std::optional<LineFriction> friction_of(const Line& line, const ResonanceG& G);

/// The line that a method fits to the pairs from index `first` on; nothing when it cannot.
using LineFrom = std::function<std::optional<Line>(std::size_t first)>;

/// Leaves out the pairs that stick at the estimate, until no pair sticks at the estimate from the remaining ones.
/// The test is x > S(zeta, r) x_f (sim/analytic/den_hartog.hpp). It depends on x alone, so the pairs left out are
/// always the lower end of `data.pairs`. A pair that was left out does not return, so the search ends. Returns the
/// index of the first pair left. Pairs left out are added to `estimate.excluded`.
[[nodiscard]] std::size_t first_sliding_pair(const ResonanceData& data, const LineFrom& line_from,
                                             Estimate& estimate);

/// Why no line goes through these pairs: fewer than two, one level of the input, equal outputs; empty when one
/// does. `total` counts the pairs of the record, `excluded` says where the others went.
[[nodiscard]] std::string fault_of(const std::vector<Datum>& pairs, std::size_t total,
                                   const std::vector<Exclusion>& excluded);

/// The pairs with the outputs that the exact Eq (3) gives at the estimate; empty when it has no such motion for one
/// of them.
[[nodiscard]] std::vector<Datum> exact_pairs(const ResonanceData& data, const std::vector<Datum>& used,
                                             const LineFriction& friction);

/// Error of the method at its own estimate: the line through the `exact` outputs for the same inputs gives another
/// estimate. A difference above 1 % of either parameter is a warning, above 10 % a fault. The difference contains
/// the effects of detuning, of a damping ratio that is not small, and of the approximation of G.
void judge_method(const ResonanceData& data, const std::vector<Datum>& exact, const LineFriction& friction,
                  const std::function<std::optional<Line>(const std::vector<Datum>&)>& line_through,
                  Estimate& estimate, std::vector<std::string>& faults);

/// Numbers of the pairs, ascending.
[[nodiscard]] std::vector<int> numbers_of(const std::vector<Datum>& pairs);

/// "w/wn = 1.002" for messages.
[[nodiscard]] std::string frequency_text(const ResonanceData& data);

}  // namespace dualdamp::identify
