#include "scenarios/format/checked_file.hpp"

#include <algorithm>
#include <utility>

#include "core/units.hpp"

namespace dualdamp::scenarios {

CheckedFile::CheckedFile(const Document& document, Reading& reading, const Section& format,
                         const std::vector<Needs>& needs, DataPlace data_place)
    : document_(document),
      reading_(reading),
      format_(format),
      analysis_(text_at("analysis", "type")),
      needs_(find_needs(needs)),
      data_place_(std::move(data_place)) {}

const Needs* CheckedFile::find_needs(const std::vector<Needs>& rows) const {
  std::string source;
  if (rows.size() > 1) {
    if (stands_in_file("analysis", "data"))
      source = "data";
    else if (has("analysis", "measurement"))
      source = measurement()->at("type").get<std::string>();
  }
  const auto row = std::ranges::find(rows, source, &Needs::source);
  return row == rows.end() ? nullptr : &*row;
}

std::string CheckedFile::subject() const {
  std::string name = "analysis '" + analysis_ + "'";
  if (needs_->source.empty()) return name;
  return name + (needs_->source == "data" ? " with data" : " with a measurement '" + needs_->source + "'");
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

void CheckedFile::withdraw(const std::string& path) {
  std::erase_if(reading_.problems, [start = "'" + path](const core::Diagnostic& problem) {
    return problem.message.starts_with(start);
  });
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
  const Json& value = reading_.values.at(section).at(key);
  return value.is_string() ? core::parse_quantity(value.get<std::string>(), "rad/s").value
                           : std::optional(value.get<double>());
}

const Json* CheckedFile::measurement() const {
  return has("analysis", "measurement") ? &reading_.values.at("analysis").at("measurement") : nullptr;
}

const Section& CheckedFile::keys_of(std::string_view section) const {
  return format_.find(section)->choice->variants.front().section;
}

void CheckedFile::note_units(const identify::ColumnUnits& units) {
  for (const auto& [column, unit] : units.stated) reading_.written_units.emplace("data." + column, unit);
}

void CheckedFile::fill_in(const std::string& key, Json value) {
  Json& analysis = reading_.values["analysis"];
  analysis[key] = std::move(value);
  put_in_order(analysis, format_.find("analysis")->choice->find(analysis_)->section);
}

void put_in_order(Json& values, const Section& section) {
  Json sorted = Json::object();
  for (const auto& [key, value] : values.items())
    if (section.find(key) == nullptr) sorted[key] = value;  // the key that selects the section
  for (const Field& field : section.fields)
    if (values.contains(field.name)) sorted[field.name] = values.at(field.name);
  values = std::move(sorted);
}

}  // namespace dualdamp::scenarios
