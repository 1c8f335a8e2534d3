#include "identify/ledger/stated_noise.hpp"

#include <algorithm>

#include "core/numbers.hpp"

namespace dualdamp::identify {

void set_noise(Eigen::Index amplitudes, Eigen::Index phases, Eigen::Index smooth_columns, JointModel& model) {
  const auto of_amplitudes = static_cast<double>(amplitudes - smooth_columns);
  const auto of_phases = static_cast<double>(phases - smooth_columns);
  model.spent = phases > 0 ? 1.0 : 0.0;
  model.scale_freedom = of_amplitudes;
  if (model.is_stated) model.scale_freedom = phases > 0 ? std::max(1.0, of_phases) : known_freedom;
  if (model.is_stated || of_amplitudes > 0.0)
    model.known_noise.push_back({amplitudes, model.is_stated ? known_freedom : of_amplitudes});
  if (of_phases > 0.0) model.known_noise.push_back({phases, of_phases});
}

bool is_stated(const KnownDeviations& known) { return known.sigma_x > 0.0 || known.sigma_Y > 0.0; }

ScatterBesideStated readings_scatter(double ratio, double freedom) {
  return freedom >= 1.0 ? scatter_beside_stated(ratio, stated_noise_p_value(ratio * ratio, freedom))
                        : ScatterBesideStated::as_stated;
}

void note_contradiction(ScatterBesideStated scatter, double ratio, const std::string& readings, JointModel& model) {
  if (scatter == ScatterBesideStated::as_stated) return;
  const std::string size = "the " + readings + " scatter " + core::format_number(ratio, 2) +
                           " times as much as the stated deviations say: the stated noise is too ";
  model.warnings.push_back(scatter == ScatterBesideStated::less
                               ? size + "large, and the intervals of joint_fit are as wide as it makes them"
                               : size + "small, and joint_fit takes the noise from the readings");
}

}  // namespace dualdamp::identify
