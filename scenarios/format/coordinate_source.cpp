#include "scenarios/format/coordinate_source.hpp"

#include "core/uncertain_quantity.hpp"

namespace dualdamp::scenarios {

using core::Coordinate;

std::string CoordinateSource::reason() const {
  return std::string("the coordinate is ") + (coordinate == Coordinate::angle ? "an angle" : "a displacement") +
         ": " + words;
}

std::optional<CoordinateSource> stated_coordinate(const Document& document) {
  const Entry* system = document.root().find("system");
  const Entry* entry = system == nullptr ? nullptr : system->value.find("coordinate");
  if (entry == nullptr) return std::nullopt;
  for (const Coordinate coordinate : {Coordinate::displacement, Coordinate::angle})
    if (entry->value.text == core::name_of(coordinate))
      return CoordinateSource{coordinate, "'system.coordinate' says so"};
  return std::nullopt;
}

bool ToldCoordinate::fits_other_only(const Document& document, const Node& node, const std::string& path,
                                     const std::string& dimension, Coordinate assumed) {
  if (core::unit_for(Coordinate::angle, dimension) == dimension) return false;
  const auto fits = [&](Coordinate coordinate) {
    return core::parse_uncertain_quantity(node.text, dimension, coordinate).value.has_value();
  };
  const Coordinate other = assumed == Coordinate::angle ? Coordinate::displacement : Coordinate::angle;
  const bool fits_assumed = fits(assumed);
  const bool fits_other = fits(other);
  if (fits_assumed == fits_other) return false;
  const Coordinate told = fits_assumed ? assumed : other;
  if (!first_) {
    const core::SourcePlace place = document.locate(node.place);
    const std::string where = node.place.source == 0 ? "in line " + std::to_string(place.line) : "of " + place.file;
    first_ = {told, "'" + path + "' " + where + " is " + shortened(node.text)};
  }
  is_mixed_ = is_mixed_ || first_->coordinate != told;
  return fits_other;
}

}  // namespace dualdamp::scenarios
