#pragma once
/// The output of the program about each scenario, in the order of the files.

#include <cstddef>
#include <iosfwd>
#include <mutex>
#include <string>
#include <vector>

#include "core/diagnostics.hpp"
#include "scenarios/results/files.hpp"

namespace dualdamp::cli {

/// The output about one scenario, kept until those of earlier files are printed.
struct CommandOutput {
  core::ExitStatus status = core::ExitStatus::done;
  std::string text;        ///< for stdout
  scenarios::Writer json;  ///< for stdout in place of `text`, if JSON is asked for
  std::string messages;    ///< for stderr
  std::string errors;      ///< for stderr, also with `quiet`
};

struct Style {
  bool json = false;
  bool quiet = false;
};

void print(const CommandOutput& output, const Style& style);

/// Prints outputs in the order of the files, each one as soon as those before it are printed, with an empty line
/// between their texts.
class InOrder {
 public:
  InOrder(std::size_t count, Style style);

  void put(std::size_t index, CommandOutput output);
  /// Writes one JSON document, or a list of documents for several files.
  void write_json(std::ostream& out) const;
  [[nodiscard]] core::ExitStatus worst() const;

 private:
  std::mutex mutex_;
  std::vector<CommandOutput> outputs_;
  std::vector<bool> ready_;
  std::size_t next_ = 0;
  Style style_;
  bool has_printed_ = false;  ///< a text
};

}  // namespace dualdamp::cli
