#pragma once
/// Checks that a motion integrated in time, and its samples, are within what a file may ask for.

#include <optional>
#include <string>

#include "scenarios/format/checked_file.hpp"

namespace dualdamp::scenarios {

/// The samples of such a motion.
struct Sampling {
  std::string path;            ///< of the key for their rate, for messages
  std::optional<double> rate;  ///< 1/s; nothing: none are taken
  double tests = 1.0;          ///< motions that are sampled
};

/// Checks a motion integrated in time, which the `section` at `path` describes.
void check_work(CheckedFile& file, const Json& section, const std::string& path, const Sampling& sampling);

/// Checks the rows of all histories together; `path`: of the key for messages.
void check_rows(CheckedFile& file, const std::string& path, double rows);

}  // namespace dualdamp::scenarios
