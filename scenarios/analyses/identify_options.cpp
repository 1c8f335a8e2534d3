#include "scenarios/analyses/identify_options.hpp"

#include <numbers>

#include "scenarios/format/values.hpp"

namespace dualdamp::scenarios {

std::vector<Field> method_option_fields() {
  return {
      boolean("approximate_G", "G from the approximation Eq (15) instead of Eq (4)").with_fallback(false),
      integers("pairs", "numbers of the two pairs that resonance_two_point uses; default: the outermost")
          .at_least(1)
          .items(2, 2),
      quantity("sigma_x", {"m"}, "known standard deviation of a measured output amplitude or extreme").at_least(0),
      quantity("sigma_Y", {"m"}, "known standard deviation of a measured input amplitude").at_least(0),
      boolean("zero_offset", "the extremes of a free vibration are known to be about zero").with_fallback(false),
      boolean("free_natural_frequency", "den_hartog_fit fits the natural frequency too").with_fallback(false),
      quantities("cutoffs", {"rad/s"},
                 "cut-off frequencies of the filter that histories are differentiated with; the first one counts, "
                 "the others show what the choice matters")
          .above(0)
          .items(1, 16),
      quantity("least_speed", {"m/s"}, "slower samples are left out where friction is regressed on speed")
          .at_least(0),
      integer("bootstrap", "replicates of a bootstrap by sweeps").at_least(0).at_most(1'000'000),
      boolean("profile", "profiles of the likelihood of zeta and F0").with_fallback(false),
      quantity("forgetting", {"1"}, "forgetting factor of recursive_least_squares; 1 forgets nothing")
          .above(0)
          .at_most(1),
      quantity("sign_width", {"m/s"}, "width of the smoothed sign of the velocity in extended_kalman").above(0)};
}

void check_method_options(CheckedFile& file, std::size_t pairs) {
  if (!file.has("analysis", "pairs")) return;
  const Json& chosen = file.values().at("analysis").at("pairs");
  if (chosen[0] == chosen[1]) file.complain("analysis.pairs", "'analysis.pairs' names one pair twice", "two pairs");
  for (std::size_t i = 0; i < 2 && pairs > 0; ++i)
    if (chosen[i].get<std::size_t>() > pairs)
      file.complain("analysis.pairs[" + std::to_string(i) + "]", "there is no such pair",
                    "1 to " + std::to_string(pairs), chosen[i].dump());
}

identify::MethodOptions method_options(const Json& section) {
  identify::MethodOptions options;
  options.approximate_G = section.at("approximate_G").get<bool>();
  options.zero_offset = section.at("zero_offset").get<bool>();
  options.sigma_x = number_or(section, "sigma_x", 0.0);
  options.sigma_Y = number_or(section, "sigma_Y", 0.0);
  options.profile = section.at("profile").get<bool>();
  options.free_natural_frequency = section.at("free_natural_frequency").get<bool>();
  options.least_speed = number_or(section, "least_speed", options.least_speed);
  options.forgetting = number_or(section, "forgetting", options.forgetting);
  options.sign_width = number_or(section, "sign_width", options.sign_width);
  if (section.contains("bootstrap")) options.bootstrap = section.at("bootstrap").get<int>();
  if (section.contains("cutoffs"))
    for (const Json& cutoff : section.at("cutoffs"))
      options.cutoffs.push_back(number(cutoff) / (2.0 * std::numbers::pi));
  if (section.contains("pairs")) {
    options.first_pair = section.at("pairs")[0].get<int>();
    options.second_pair = section.at("pairs")[1].get<int>();
  }
  return options;
}

}  // namespace dualdamp::scenarios
