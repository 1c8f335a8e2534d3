#pragma once
/// The coordinate of a scenario's oscillator, and where it is stated: in the key `coordinate`, or otherwise by the
/// first quantity whose unit is possible for one kind of coordinate only.

#include <optional>
#include <string>

#include "core/coordinate.hpp"
#include "scenarios/format/tree.hpp"

namespace dualdamp::scenarios {

struct CoordinateSource {
  core::Coordinate coordinate = core::Coordinate::displacement;
  std::string words;  ///< "'system.mass' in line 4 is 0.3 kg.m^2"

  /// "the coordinate is an angle: 'system.mass' in line 4 is 0.3 kg.m^2"
  [[nodiscard]] std::string reason() const;
};

/// The value of `system.coordinate`; nothing if it is missing or is not a coordinate.
[[nodiscard]] std::optional<CoordinateSource> stated_coordinate(const Document& document);

/// Finds the coordinate from the units of quantities, one after the other.
class ToldCoordinate {
 public:
  /// Whether the text of `node` is a quantity of `dimension` with the other coordinate and none with `assumed`.
  bool fits_other_only(const Document& document, const Node& node, const std::string& path,
                       const std::string& dimension, core::Coordinate assumed);

  /// The coordinate by the first quantity that determines it.
  [[nodiscard]] const std::optional<CoordinateSource>& first() const { return first_; }
  /// Whether a later quantity contradicts it.
  [[nodiscard]] bool is_mixed() const { return is_mixed_; }

 private:
  std::optional<CoordinateSource> first_;
  bool is_mixed_ = false;
};

}  // namespace dualdamp::scenarios
