#pragma once
/// Reads a document by the tables of `keys.hpp` and checks that every key is known and every value has the right
/// kind, dimension and range.
///
/// The result is the resolved scenario: SI numbers, defaults filled in, keys in the order of the tables. It is
/// itself a valid scenario. Frequencies keep their unit (`"10 rad/s"`), because the format refuses a frequency
/// without a unit.
///
/// `system.coordinate` determines the dimensions of all quantities. Without this key the first quantity whose unit
/// is possible for one kind of coordinate only determines them. A quantity of the other kind is then refused.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnostics.hpp"
#include "scenarios/format/coordinate_source.hpp"
#include "scenarios/format/keys.hpp"
#include "scenarios/format/tree.hpp"

namespace dualdamp::scenarios {

/// So that a list of 300,000 wrong items does not give 300,000 messages.
inline constexpr std::size_t max_reported = 200;

struct Reading {
  Json values;                                       ///< what could be read; faulty values are left out
  std::map<std::string, Place> places;               ///< of each value by path: "system.friction[0].static"
  std::map<std::string, std::string> written_units;  ///< of quantities, by path; columns of data: `data.x`
  std::vector<core::Diagnostic> problems;
  /// From the key `coordinate`, or from the units; nothing if no number has a unit.
  std::optional<CoordinateSource> coordinate;

  /// Adds a problem, up to `max_reported` problems.
  void complain(const Document& document, Place place, std::string message, std::string allowed = {},
                std::string found = {}, std::string suggestion = {});
};

[[nodiscard]] Reading read(const Document& document, const Section& format);

}  // namespace dualdamp::scenarios
