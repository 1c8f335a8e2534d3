#pragma once
/// What a MATLAB file holds, and its way over the pipe from the process that reads the file
/// (identify/readers/isolated.hpp).
///
/// What comes is not trusted: damage may have reached the sender's memory. Every length is held against the bytes
/// there are, every column against the known ones and against the length of its neighbours.

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
  std::optional<std::vector<LabelRun>> row_labels;  ///< instead of the labels of the tests
  std::vector<std::string> warnings;
  ColumnUnits units;
};

void send(const MatContent& content, const ByteSink& sink);
void send(const std::vector<core::Diagnostic>& problems, const ByteSink& sink);

/// Throws `core::InputError` with the problems where these were sent. Nothing when the bytes are neither.
[[nodiscard]] std::optional<MatContent> receive(std::string_view bytes);

}  // namespace dualdamp::identify
