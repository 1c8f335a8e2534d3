#include "identify/records/faults/frequency_unit.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "identify/records/faults/phase_checks.hpp"

namespace dualdamp::identify {

namespace {

/// The pairs with every frequency multiplied.
std::vector<Pair> at_other_frequencies(std::vector<Pair> pairs, const KnownConstants& constants, double factor) {
  for (Pair& pair : pairs) pair.omega = factor * frequency_of(pair, constants);
  return pairs;
}

/// (k - m w^2)/k.
double share_of_spring(const Pair& pair, const KnownConstants& constants) {
  const double omega = frequency_of(pair, constants);
  return 1.0 - constants.mass * omega * omega / constants.stiffness;
}

/// Whether x is larger than `factor` times what the base can give, with an allowance for an error of m w^2/k.
bool is_beyond(const Pair& pair, double share, double factor) {
  constexpr double of_constants = 0.1;
  return (share - of_constants) * pair.x > factor * pair.Y;
}

}  // namespace

std::vector<std::string> other_units_of_frequency(const std::vector<Pair>& pairs, const KnownConstants& constants) {
  constexpr double rpm = core::two_pi / 60.0;
  std::vector<std::string> units;
  for (const auto& [factor, unit] : {std::pair{core::two_pi, "Hz, not rad/s"},
                                     {1.0 / core::two_pi, "rad/s, not Hz"},
                                     {rpm, "rpm, not rad/s"},
                                     {rpm / core::two_pi, "rpm, not Hz"}})
    if (balance_of(at_other_frequencies(pairs, constants, factor), constants).too_much == 0)
      units.emplace_back(unit);
  return units;
}

bool are_in_hertz(const std::vector<Pair>& pairs, const KnownConstants& constants) {
  constexpr double impossible = 1.5;
  constexpr double possible = 1.2;
  const auto beyond = std::ranges::count_if(
      pairs, [&](const Pair& pair) { return is_beyond(pair, share_of_spring(pair, constants), impossible); });
  if (beyond < 2 || 4 * beyond < std::ssize(pairs)) return false;
  const std::vector<Pair> read = at_other_frequencies(pairs, constants, core::two_pi);
  const bool all_fit = std::ranges::all_of(read, [&](const Pair& pair) {
    return !is_beyond(pair, std::abs(share_of_spring(pair, constants)), possible);
  });
  return all_fit && (balance_of(read, constants).phases == 0 || phases_fit(read, constants));
}

}  // namespace dualdamp::identify
