#pragma once
/// Files that a test writes in the way of the program.

#include <string>
#include <vector>

#include "scenarios/results/staged_files.hpp"

namespace dualdamp::testing {

/// Writes all files, or none.
inline void write_files(const std::string& directory, const std::vector<scenarios::OutputFile>& files) {
  scenarios::StagedFiles staged(directory);
  for (const scenarios::OutputFile& file : files) staged.write(file);
  staged.publish();
}

}  // namespace dualdamp::testing
