#pragma once
/// Reads a document by the tables of `keys.hpp`: every key known, every value of the right kind, dimension and
/// range.
///
/// What comes out is the resolved scenario: SI numbers, defaults filled in, keys in the order of the tables. It is
/// itself a valid scenario; frequencies keep their unit (`"10 rad/s"`) because the format refuses them without.
///
/// `system.coordinate` tells the dimensions of all quantities. Without that key the first quantity does whose unit
/// fits one kind of coordinate alone; a quantity of the other kind is then refused.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/diagnostics.hpp"
#include "scenarios/format/coordinate_source.hpp"
#include "scenarios/format/keys.hpp"
#include "scenarios/format/tree.hpp"

namespace dualdamp::scenarios {

/// A list of 300,000 wrong items needs no 300,000 messages.
inline constexpr std::size_t max_reported = 200;

struct Reading {
  Json values;                                       ///< what could be read; faulty values are left out
  std::map<std::string, Place> places;               ///< of each value by path: "system.friction[0].static"
  std::map<std::string, std::string> written_units;  ///< of quantities, by path; columns of data: `data.x`
  std::vector<core::Diagnostic> problems;
  /// By the key `coordinate`, or by the units; nothing where all numbers are bare.
  std::optional<CoordinateSource> coordinate;

  /// Notes a problem, up to `max_reported` of them.
  void complain(const Document& document, Place place, std::string message, std::string allowed = {},
                std::string found = {}, std::string suggestion = {});
};

[[nodiscard]] Reading read(const Document& document, const Section& format);

}  // namespace dualdamp::scenarios
