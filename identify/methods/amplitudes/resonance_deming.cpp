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

}  // namespace dualdamp::identify
