/// MATLAB files. An odd first byte: the rest is what the process that reads a file has sent over its pipe; damage
/// may have reached that process' memory. An even one: the rest is a file. matio reads it in a process of its own,
/// whose end in any way is a refusal; libFuzzer does not see what is covered there.

#include <cmath>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/diagnostics.hpp"
#include "identify/readers/formats/mat_content.hpp"
#include "identify/readers/record_reader.hpp"
#include "tests/fuzz/harness.hpp"

namespace {

using namespace dualdamp;
using fuzz::require;

void receive(std::string_view bytes) {
  const std::optional<identify::MatContent> content = identify::receive(bytes);
  if (!content) return;
  for (const identify::TestColumns& test : content->tests) {
    require(!test.columns.empty(), "a test has columns");
    for (const identify::DataColumn& column : test.columns)
      require(column.values.size() == test.columns.front().values.size(), "columns of a test are of one length");
  }
  std::string again;
  const identify::ByteSink sink = [&](std::span<const char> sent) { again.append(sent.data(), sent.size()); };
  identify::send(*content, sink);
  require(identify::receive(again).has_value(), "what is received can be sent on");
}

void read(std::string_view bytes) {
  const std::string path = fuzz::written("data.mat", bytes);
  const identify::MeasuredRecord read = identify::read_record(path);
  for (const identify::History& history : read.record.histories)
    require(std::isfinite(history.start) && history.sample_rate > 0.0 && std::isfinite(history.sample_rate),
            "times are finite");
}

}  // namespace

void dualdamp::fuzz::consume(std::string_view input) {
  if (input.empty()) return;
  const bool is_sent = static_cast<unsigned char>(input.front()) % 2 == 1;
  try {
    is_sent ? receive(input.substr(1)) : read(input.substr(1));
  } catch (const core::InputError& error) {
    require(!error.diagnostics().empty(), "a refusal says why");
  }
}
