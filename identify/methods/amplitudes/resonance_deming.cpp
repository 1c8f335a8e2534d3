#include "identify/methods/amplitudes/resonance_deming.hpp"

#include "identify/methods/amplitudes/line_estimate.hpp"

namespace dualdamp::identify {

Estimate resonance_deming(const Record& record, const KnownConstants& constants, const LineOptions& options) {
  const auto lambda = [&options](const Moments& moments) {
    const bool known = options.sigma_x > 0.0 || options.sigma_Y > 0.0;
    const double ratio = known ? options.sigma_x / options.sigma_Y : moments.mean_x / moments.mean_Y;
    return ratio * ratio;
  };
  return estimate_by_line({resonance_deming_method.name, lambda}, record, constants, options);
}

constinit const MethodEntry resonance_deming_method{
    .name = "resonance_deming",
    .summary = "damping ratio and friction force from a straight line, with errors in both amplitudes",
    .assumes =
        "excitation at w = wn, zeta small, no sticking, a known ratio of the errors of x and Y (by default errors by "
        "the same fraction); checked: sticking pairs are left out, quadratic friction F-test, what the method would "
        "make of its own estimate by the exact law",
    .equation = "x = a + b Y by Deming's line, zeta = 1/(2 b), x_f = -a/G(zeta), G by Eq (4) at w = wn",
    .sources = "liang2004identifying, deming1943, fuller1987",
    .needs = RecordKind::pairs,
    .lacks = lacks_resonance_pairs,
    .call = call_of<resonance_deming>,
    .rests_on = AssumptionSet::all_but(),
};

}  // namespace dualdamp::identify
