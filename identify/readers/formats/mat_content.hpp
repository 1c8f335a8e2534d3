#pragma once
/// The content of a MATLAB file, and its transfer over the pipe from the process that reads the file
/// (identify/readers/isolated.hpp).
///
/// The receiver does not trust the bytes, because a damaged file may have damaged the sender's memory. It checks
/// every length against the number of bytes, and every column against the known names and the length of the others.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.hpp"
#include "identify/readers/data_table.hpp"
#include "identify/readers/isolated.hpp"

namespace dualdamp::identify {

struct MatContent {
  std::vector<TestColumns> tests;
  std::optional<std::vector<LabelRun>> row_labels;  ///< replace the labels of the tests
  std::vector<std::string> warnings;
  std::vector<std::string> ignored = {};  ///< those about unknown variables and fields
  ColumnUnits units;
};

void send(const MatContent& content, const ByteSink& sink);
void send(const std::vector<core::Diagnostic>& problems, const ByteSink& sink);

/// Throws `core::InputError` if problems were sent. Nothing if the bytes are neither a content nor problems.
[[nodiscard]] std::optional<MatContent> receive(std::string_view bytes);

}  // namespace dualdamp::identify
