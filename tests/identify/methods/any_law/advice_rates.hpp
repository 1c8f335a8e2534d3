#pragma once
/// The value of the advice of `design` on a random rig: a record of eight levels is continued by eight more states,
/// either those advised or eight equally spaced levels again.

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "identify/methods/any_law/library.hpp"
#include "tests/identify/methods/any_law/law_laboratory.hpp"

namespace dualdamp::identify::testing {

struct Followed {
  std::string advice;
  /// Widths of the hull after the advice over those before, of zeta and of F0: as expected over laws, as promised
  /// if the law is that of the rig, and as found.
  Interval expected{}, promised{}, found{};
  /// Width of the hull after equally spaced levels over that after the advice, of zeta and of F0.
  Interval narrower{};
  /// Whether plain friction is rejected: after equally spaced levels, after the advice.
  std::array<bool, 2> rejected{};
  /// Whether the hulls after the advice hold zeta and F0.
  std::array<bool, 2> held{};
};

/// `kind`: amplitudes alone or with phases. Nothing if one of the records has no answer.
[[nodiscard]] std::optional<Followed> followed_advice(const LawRig& rig,
                                                      const identify::departures::Departure& departure,
                                                      double severity, std::uint64_t seed,
                                                      const LawIntervalOptions& options = {},
                                                      LawRecord kind = LawRecord::amplitudes);

}  // namespace dualdamp::identify::testing
