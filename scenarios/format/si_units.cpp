#include "scenarios/format/si_units.hpp"

#include <algorithm>
#include <utility>

#include "core/coordinate.hpp"

namespace dualdamp::scenarios {

namespace {

class UnitsOfNumbers {
 public:
  explicit UnitsOfNumbers(core::Coordinate coordinate) : coordinate_(coordinate) {}

  void section(const Json& values, const Section& section, const std::string& path) {
    for (const Field& field : section.fields)
      if (const auto value = values.find(field.name); value != values.end())
        note(*value, field, path.empty() ? field.name : path + "." + field.name);
  }

  [[nodiscard]] std::map<std::string, std::string> take() { return std::move(units_); }

 private:
  void note(const Json& value, const Field& field, const std::string& path) {
    if (field.kind == Kind::choice) return maps(value, *field.choice, path);
    if (field.units.empty()) return;
    if (value.is_object()) return section(value, grid_section(field), path);
    const bool is_of_drive = std::ranges::find(field.units, drive_) != field.units.end();
    const std::string unit = core::unit_for(coordinate_, is_of_drive ? drive_ : field.units.front());
    if (!value.is_string()) units_.emplace(path, unit);
  }

  void maps(const Json& value, const Choice& choice, const std::string& path) {
    for (std::size_t i = 0; value.is_array() && i < value.size(); ++i)
      maps(value[i], choice, path + "[" + std::to_string(i) + "]");
    if (!value.is_object()) return;
    if (choice.key.empty()) return section(value, choice.variants.front().section, path);
    const auto name = value.find(choice.key);
    const Variant* variant =
        name == value.end() || !name->is_string() ? nullptr : choice.find(name->get<std::string>());
    if (variant == nullptr) return;
    if (!variant->amplitude_unit.empty()) drive_ = variant->amplitude_unit;
    section(value, variant->section, path);
  }

  core::Coordinate coordinate_;
  std::string drive_ = "m";  ///< of its amplitude
  std::map<std::string, std::string> units_;
};

}  // namespace

std::map<std::string, std::string> si_units(const Json& scenario, const Section& format) {
  const bool is_angle = scenario.value("system", Json::object()).value("coordinate", "") == "angle";
  UnitsOfNumbers units(is_angle ? core::Coordinate::angle : core::Coordinate::displacement);
  if (scenario.is_object()) units.section(scenario, format, "");
  return units.take();
}

}  // namespace dualdamp::scenarios
