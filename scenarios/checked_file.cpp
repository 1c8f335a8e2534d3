#include "scenarios/checked_file.hpp"
#include "scenarios/formulas.hpp"

#include <algorithm>
#include <utility>

namespace dualdamp::scenarios {

CheckedFile::CheckedFile(const Document& document, Reading& reading)
    : document_(document), reading_(reading), analysis_(text_at("analysis", "type")), needs_(find_needs()) {}

const Needs* CheckedFile::find_needs() const {
  std::string measurement;
  if (analysis_ == "identify") {
    if (stands_in_file("analysis", "data"))
      measurement = "data";
    else if (has("analysis", "measurement"))
      measurement = reading_.values.at("analysis").at("measurement").at("type").get<std::string>();
  }
  const auto row = std::ranges::find_if(scenarios::needs(), [&](const Needs& candidate) {
    return candidate.analysis == analysis_ && candidate.measurement == measurement;
  });
  return row == scenarios::needs().end() ? nullptr : &*row;
}

std::string CheckedFile::subject() const {
  std::string name = "analysis '" + analysis_ + "'";
  if (needs_->measurement.empty()) return name;
  return name +
         (needs_->measurement == "data" ? " with data" : " with a measurement '" + needs_->measurement + "'");
}

void CheckedFile::complain(Place place, std::string message, std::string allowed, std::string found,
                           std::string suggestion) {
  reading_.complain(document_, place, std::move(message), std::move(allowed), std::move(found),
                    std::move(suggestion));
}

void CheckedFile::complain(const std::string& path, std::string message, std::string allowed, std::string found,
                           std::string suggestion) {
  complain(place_of(path), std::move(message), std::move(allowed), std::move(found), std::move(suggestion));
}

void CheckedFile::take_over(const std::vector<core::Diagnostic>& problems) {
  reading_.problems.insert(reading_.problems.end(), problems.begin(), problems.end());
}

Place CheckedFile::place_of(std::string path) const {
  while (true) {
    const auto found = reading_.places.find(path);
    if (found != reading_.places.end()) return found->second;
    const std::size_t cut = path.find_last_of(".[");
    if (cut == std::string::npos) return document_.root().place;
    path.resize(cut);
  }
}

const Node* CheckedFile::node(std::string_view section) const {
  const Entry* found = entry(section);
  return found == nullptr ? nullptr : &found->value;
}

bool CheckedFile::stands_in_file(std::string_view section, std::string_view key) const {
  const Node* parent = node(section);
  return parent != nullptr && parent->find(key) != nullptr;
}

bool CheckedFile::has(const std::string& section, const std::string& key) const {
  return reading_.values.contains(section) && reading_.values.at(section).is_object() &&
         reading_.values.at(section).contains(key);
}

std::string CheckedFile::text_at(const std::string& section, const std::string& key) const {
  return has(section, key) ? reading_.values.at(section).at(key).get<std::string>() : std::string();
}

std::optional<double> CheckedFile::number_at(const std::string& section, const std::string& key) const {
  if (!has(section, key)) return std::nullopt;
  return number(reading_.values.at(section).at(key));
}

const Json* CheckedFile::measurement() const {
  return has("analysis", "measurement") ? &reading_.values.at("analysis").at("measurement") : nullptr;
}

std::optional<std::size_t> CheckedFile::points() const {
  std::optional<std::size_t> count;
  for (const char* key : {"amplitudes", "frequencies"}) {
    if (has("analysis", key))
      count = count.value_or(1) * grid_size(reading_.values.at("analysis").at(key));
    else if (stands_in_file("analysis", key))
      return std::nullopt;
  }
  return count;
}

std::size_t grid_size(const Json& grid) {
  return grid.is_array() ? grid.size() : grid.at("count").get<std::size_t>();
}

void put_in_order(Json& values, const Section& section) {
  Json sorted = Json::object();
  for (const auto& [key, value] : values.items())
    if (section.find(key) == nullptr) sorted[key] = value;  // the key that tells which section it is
  for (const Field& field : section.fields)
    if (values.contains(field.name)) sorted[field.name] = values.at(field.name);
  values = std::move(sorted);
}

}  // namespace dualdamp::scenarios
