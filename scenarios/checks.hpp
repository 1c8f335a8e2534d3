#pragma once
/// Checks that no table of keys can express: whether the sections of a scenario fit together. Words and keys that
/// stand for other values (`natural`, a damping ratio, the default of `methods`) are replaced by these values, and
/// measured data are read.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "identify/readers/record_reader.hpp"
#include "scenarios/analysis.hpp"
#include "scenarios/format/reader.hpp"
#include "sim/sampled_signal.hpp"

namespace dualdamp::scenarios {

struct Checked {
  const Analysis* analysis = nullptr;            ///< nullptr when the file is too faulty for it
  std::optional<identify::MeasuredRecord> data;  ///< of `analysis.data`, if it is there
  std::size_t result_rows = 0;                   ///< number of items of the result's lists, as far as it is known
  std::vector<DataFile> files;                   ///< of an analysis that takes several
  std::optional<identify::MeasuredSignal> compared;
  std::shared_ptr<const sim::SampledSignal> drive;
  double drive_start = 0.0;
  std::vector<std::string> sha256;  ///< of the files read
  std::vector<std::string> warnings;
};

/// Adds problems to `reading`, which was read by `format`, and completes its values.
[[nodiscard]] Checked check(const Document& document, Reading& reading, const Section& format,
                            const AnalysisList& analyses, const DataPlace& data_place);

}  // namespace dualdamp::scenarios
