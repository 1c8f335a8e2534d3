#pragma once
/// A stress test as files for programs outside: the data of a laboratory, without laws and truth.
///
/// `cases/NNNNNN.csv`: the record of a case in the format of docs/data-files.md, x-Y pairs or histories;
/// `cases/NNNNNN-decay.csv` beside it where the stress test has decays, `cases/NNNNNN-random.csv` where it has
/// responses to a random drive. `constants.csv`: for each case the mass, the stiffness and the frequency that the
/// laboratory believes in, and the standard deviations of an amplitude by the noise of its sensors. The numbers are
/// those of the key (`key.hpp`), in random order.
///
/// Errors: `scenarios::OutputError`.

#include <string>
#include <vector>

#include "bench/contest/key.hpp"
#include "bench/stress_test.hpp"

namespace dualdamp::bench {

struct Exported {
  std::size_t cases = 0;
  std::vector<std::string> messages;  ///< which files of others were renamed
};

/// Writes all records on all threads (`options.threads`), `constants.csv` and `key.json`; all files appear at the
/// end. Files of an earlier export are then removed if `options.found` says so; else they are an error. Other files
/// whose names are needed, or that would be read as records, are renamed.
Exported export_cases(const StressTest& question, const scenarios::RunContext& context,
                      const std::string& directory);

/// The key of a stress test, as `export_cases` makes it.
[[nodiscard]] Key key_of(const StressTest& question, const scenarios::RunContext& context);

}  // namespace dualdamp::bench
