#pragma once
/// The problems of a data file: what is wrong at which line, the same fault of many rows once.

#include <cstddef>
#include <string>
#include <vector>

#include "core/diagnostics.hpp"

namespace dualdamp::identify {

/// Collects problems and ends the reading when there are too many kinds of them to be read by anyone.
///
/// Problems with the same message are one problem: it stands at the first of their places, and the message counts
/// the others and names the lines of some.
class Problems {
 public:
  static constexpr std::size_t most_lines = 5;  ///< of the same problem that are named

  void add(core::Diagnostic diagnostic);
  /// Problems of one `kind` are one, though their messages name other columns.
  void add(core::Diagnostic diagnostic, const std::string& kind);
  /// A problem of several rows: at its place, `others` more, some of which are in `lines`.
  void add(core::Diagnostic diagnostic, std::size_t others, std::vector<int> lines);
  /// In the order of their places.
  void throw_if_any() const;
  [[nodiscard]] bool empty() const { return groups_.empty(); }

 private:
  struct Group {
    std::string kind;
    core::Diagnostic first;
    int last_line = 0;
    std::size_t others = 0;
    std::vector<int> lines;  ///< of some of the others
  };
  [[nodiscard]] std::vector<core::Diagnostic> diagnostics() const;

  std::vector<Group> groups_;
};

[[noreturn]] void refuse_file(const std::string& file, std::string message, std::string allowed = {},
                              std::string found = {});

}  // namespace dualdamp::identify
