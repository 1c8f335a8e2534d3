#include "identify/methods/amplitudes/resonance_least_squares.hpp"

#include <limits>

#include "identify/methods/amplitudes/line_estimate.hpp"

namespace dualdamp::identify {

Estimate resonance_least_squares(const Record& record, const KnownConstants& constants,
                                 const LineOptions& options) {
  const auto errors_in_x_alone = [](const Moments&) { return std::numeric_limits<double>::infinity(); };
  return estimate_by_line({resonance_least_squares_method.name, errors_in_x_alone}, record, constants, options);
}

}  // namespace dualdamp::identify
