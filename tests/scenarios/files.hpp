#pragma once
/// The files of the tree that tests read.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "bench/analyses.hpp"
#include "scenarios/scenario.hpp"
#include "tests/support/source_tree.hpp"

namespace dualdamp::testing {

inline const std::filesystem::path root = in_tree("");

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The .yaml files of a folder below the root, sorted.
inline std::vector<std::filesystem::path> yaml_files(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(root / folder))
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

/// A file that may ask for any analysis.
inline scenarios::Scenario load(const std::filesystem::path& path) {
  return scenarios::load_scenario(path.string(), {.analyses = bench::analyses()});
}

/// The question of a scenario as its own type.
template <typename Question>
const Question& question_of(const scenarios::Scenario& scenario) {
  return dynamic_cast<const Question&>(*scenario.question);
}

}  // namespace dualdamp::testing
