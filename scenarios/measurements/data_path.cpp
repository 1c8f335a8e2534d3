#include "scenarios/measurements/data_path.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "core/input_file.hpp"

namespace dualdamp::scenarios {

namespace fs = std::filesystem;

std::optional<std::string> path_of_data(CheckedFile& file, const std::string& key, const std::string& name) {
  const fs::path path(name);
  const std::string allowed = "a relative path inside the scenario's directory";
  const std::string subject = "'" + key + "'";
  const Place place = file.place_of(key);
  if (file.data_place().anywhere || file.data_place().texts.contains(name)) return name;
  if (name.empty() || path.is_absolute() || std::ranges::find(path, fs::path("..")) != path.end()) {
    file.complain(place, subject + " must stay inside the scenario's directory", allowed, name);
    return std::nullopt;
  }
  std::error_code error;
  const std::string& directory = file.data_place().directory;
  const fs::path root = fs::canonical(directory.empty() ? "." : directory, error);
  const fs::path target = fs::canonical(root / path, error);
  if (error && !core::is_fault_of_name(error.value())) throw std::system_error(error, name + ": cannot be opened");
  if (error) {
    file.complain(place, subject + ": " + name + " cannot be opened: " + error.message(), allowed);
    return std::nullopt;
  }
  if (std::mismatch(root.begin(), root.end(), target.begin(), target.end()).first != root.end()) {
    file.complain(place, subject + " leads out of the scenario's directory through a link", allowed,
                  target.string());
    return std::nullopt;
  }
  if (!fs::is_regular_file(target, error)) {
    file.complain(place, subject + ": " + name + " is not a file", allowed);
    return std::nullopt;
  }
  return target.string();
}

}  // namespace dualdamp::scenarios
