#include "identify/methods/amplitudes/resonance_least_squares.hpp"

#include "core/constants.hpp"
#include "identify/methods/amplitudes/line_estimate.hpp"

namespace dualdamp::identify {

Estimate resonance_least_squares(const Record& record, const KnownConstants& constants,
                                 const LineOptions& options) {
  const auto errors_in_x_alone = [](const Moments&) { return core::infinity; };
  return estimate_by_line({resonance_least_squares_method.name, errors_in_x_alone}, record, constants, options);
}

constinit const MethodEntry resonance_least_squares_method{
    .name = "resonance_least_squares",
    .summary = "damping ratio and friction force from a straight line through amplitude pairs",
    .assumes =
        "excitation at w = wn, zeta small, no sticking, errors in x alone; checked: sticking pairs are left out, "
        "quadratic friction F-test, what the method would make of its own estimate by the exact law",
    .equation = "x = a + b Y, zeta = 1/(2 b), x_f = -a/G(zeta), G by Eq (4) at w = wn",
    .sources = "liang2004identifying",
    .needs = RecordKind::pairs,
    .lacks = lacks_resonance_pairs,
    .call = call_of<resonance_least_squares>,
    .rests_on = AssumptionSet::all_but(),
};

}  // namespace dualdamp::identify
