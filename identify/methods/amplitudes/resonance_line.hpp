#pragma once
/// What the resonance methods share: pairs, the line through them, the friction behind the line, the gate that
/// keeps sticking pairs out, and the diagnostics.
///
///   x = a + b Y,   zeta = 1/(2 b),   x_f = -a/G(zeta)                                 Eqs (9)-(15)
///
/// which neglects H and takes q = 2 zeta and G at w = wn, all of them what holds at resonance. (G at the true
/// frequency of a detuned test would not match the q that is taken: at zeta = 0.12 and 2 % detuning x_f would be
/// off by 5 % instead of 0.7 %.) Lengths inside are in units of `ResonanceData::unit`, a power of two near the
/// largest output, so that no scale of the record matters. Source: liang2004identifying.

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
  double r = 1.0;     ///< w/wn of the first pair; of all of them where one frequency is asked for
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

/// The same for pairs at one frequency near resonance. Refused beyond that: another record, a frequency far from
/// resonance, fewer than two pairs with positive finite amplitudes.
[[nodiscard]] std::optional<ResonanceData> prepare(const Record& record, const KnownConstants& constants,
                                                   const ResonanceOptions& options, Estimate& estimate);

/// Nothing for a line that does not rise, or for numbers beyond double precision.
[[nodiscard]] std::optional<LineFriction> friction_of(const Line& line, const ResonanceG& G);

/// The line a method draws through the pairs from index `first` on; nothing when it cannot.
using LineFrom = std::function<std::optional<Line>(std::size_t first)>;

/// Leaves out the pairs that stick at the estimate, until the estimate of those left finds none: the test is
/// x > S(zeta, r) x_f (sim/analytic/den_hartog.hpp), and since it asks for x alone, what is left out is always the
/// lower end of `data.pairs`. A pair once out stays out, so the search ends. Returns the index of the first pair
/// left. Pairs left out are added to `estimate.excluded`.
[[nodiscard]] std::size_t first_sliding_pair(const ResonanceData& data, const LineFrom& line_from,
                                             Estimate& estimate);

/// Why no line goes through these pairs: fewer than two, equal inputs, equal outputs; empty when one does. `total`
/// counts the pairs of the record, `excluded` says where the others went.
[[nodiscard]] std::string fault_of(const std::vector<Datum>& pairs, std::size_t total,
                                   const std::vector<Exclusion>& excluded);

/// The pairs with the outputs that the exact Eq (3) gives at the estimate; empty when it has no such motion for one
/// of them.
[[nodiscard]] std::vector<Datum> exact_pairs(const ResonanceData& data, const std::vector<Datum>& used,
                                             const LineFriction& friction);

/// How far the method would misread its own estimate: `exact` outputs for the same inputs give a line, and that
/// another estimate. Above 1 % of either parameter it is a warning, above 10 % a fault. That covers the detuning, a
/// damping ratio that is not small, and the approximation of G in one figure.
void judge_method(const ResonanceData& data, const std::vector<Datum>& exact, const LineFriction& friction,
                  const std::function<std::optional<Line>(const std::vector<Datum>&)>& line_through,
                  Estimate& estimate, std::vector<std::string>& faults);

/// Numbers of the pairs, ascending.
[[nodiscard]] std::vector<int> numbers_of(const std::vector<Datum>& pairs);

/// "w/wn = 1.002" for messages.
[[nodiscard]] std::string frequency_text(const ResonanceData& data);

}  // namespace dualdamp::identify
