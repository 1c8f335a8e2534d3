/// Data files as text, CSV and universal files: the first byte chooses the options.

#include <array>
#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.hpp"
#include "identify/readers/record_reader.hpp"
#include "tests/fuzz/harness.hpp"

namespace {

using namespace dualdamp;
using fuzz::require;

void require_finite(const std::vector<double>& values) {
  for (const double value : values) require(std::isfinite(value), "a value of a record is finite");
}

void require_finite(const identify::Record& record) {
  if (record.pairs)
    for (const identify::Pair& pair : record.pairs->pairs) require_finite({pair.Y, pair.x});
  if (record.decay) {
    require_finite(record.decay->extremes);
    require_finite(record.decay->times);
  }
  for (const identify::History& history : record.histories) {
    require_finite({history.start, history.sample_rate});
    require(history.sample_rate > 0.0, "a sample rate is positive");
    for (const auto* signal : {&history.y, &history.x, &history.v, &history.a, &history.force})
      require_finite(*signal);
  }
}

identify::ReadOptions options_of(unsigned choice) {
  identify::ReadOptions options{.name = "data"};
  if ((choice & 1U) != 0) options.decimal = ',';
  if ((choice & 2U) != 0) options.no_header = true;
  if ((choice & 4U) != 0) options.columns = {{"t", "1"}, {"x", "2"}};
  if ((choice & 8U) != 0) options.units = {{"x", "mm"}, {"Y", "mm"}, {"t", "ms"}};
  if ((choice & 16U) != 0) options.scales = {{"x", "2.5 mm/V"}};
  if ((choice & 32U) != 0) options.coordinate = core::Coordinate::angle;
  return options;
}

}  // namespace

void dualdamp::fuzz::consume(std::string_view input) {
  if (input.empty()) return;
  const auto choice = static_cast<unsigned char>(input.front());
  input.remove_prefix(1);
  const identify::ReadOptions options = options_of(choice);
  try {
    if ((choice & 64U) != 0) {
      const identify::MeasuredSignal signal = identify::parse_signal(input, "x", options);
      require_finite(signal.times);
      require_finite(signal.values);
    } else {
      require_finite(identify::parse_record(input, options).record);
    }
  } catch (const core::InputError& error) {
    require(!error.diagnostics().empty(), "a refusal says why");
    for (const core::Diagnostic& problem : error.diagnostics())
      require(!core::format(problem).empty() && !problem.message.empty(), "a problem has a message");
  }
}
