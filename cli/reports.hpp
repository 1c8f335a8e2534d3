#pragma once
/// What the program has to say about each scenario, and in which order.

#include <cstddef>
#include <iosfwd>
#include <mutex>
#include <string>
#include <vector>

#include "core/diagnostics.hpp"
#include "scenarios/results/files.hpp"

namespace dualdamp::cli {

/// What one scenario has to say, kept until it is its turn.
struct Report {
  core::ExitStatus status = core::ExitStatus::done;
  std::string text;        ///< for stdout
  scenarios::Writer json;  ///< instead, when JSON is wanted
  std::string messages;    ///< for stderr
  std::string errors;      ///< for stderr, also when quiet
};

struct Style {
  bool json = false;
  bool quiet = false;
};

void print(const Report& report, const Style& style);

/// Prints reports in the order of the files, each as soon as those before it are there.
class InOrder {
 public:
  /// `silent`: nothing between them; of several processes that share the work only the first says anything.
  InOrder(std::size_t count, Style style, bool silent = false);

  void put(std::size_t index, Report report);
  /// One document; a list of them for several files.
  void write_json(std::ostream& out) const;
  [[nodiscard]] core::ExitStatus worst() const;

 private:
  std::mutex mutex_;
  std::vector<Report> reports_;
  std::vector<bool> ready_;
  std::size_t next_ = 0;
  Style style_;
  bool silent_;
};

}  // namespace dualdamp::cli
