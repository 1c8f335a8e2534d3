#pragma once
/// What the coordinate of a scenario's oscillator is, and what says so: the key `coordinate`, or else the first
/// quantity whose unit fits one kind of coordinate alone.

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

/// What `system.coordinate` says; nothing where it is not there, or says something else.
[[nodiscard]] std::optional<CoordinateSource> stated_coordinate(const Document& document);

/// What the units of quantities say, one after the other.
class ToldCoordinate {
 public:
  /// Whether the text of `node` is a quantity of `dimension` with the other coordinate and none with `assumed`.
  bool fits_other_only(const Document& document, const Node& node, const std::string& path,
                       const std::string& dimension, core::Coordinate assumed);

  /// By the first that told.
  [[nodiscard]] const std::optional<CoordinateSource>& first() const { return first_; }
  /// A later one told the other.
  [[nodiscard]] bool is_mixed() const { return is_mixed_; }

 private:
  std::optional<CoordinateSource> first_;
  bool is_mixed_ = false;
};

}  // namespace dualdamp::scenarios
