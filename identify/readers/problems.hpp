#pragma once
/// The problems of a data file, with their places. The same fault in many rows is one problem.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.hpp"

namespace dualdamp::identify {

/// What is said of a time that is not after the one above it.
inline constexpr std::string_view no_increase = "the time does not increase";
inline constexpr std::string_view no_increase_twice = "the time does not increase: it appears twice";

/// Collects problems. Throws `core::InputError` as soon as there are more kinds of problems than anyone would read.
///
/// Problems with the same message become one problem at the first of their places. Its message states how many
/// others there are, and the lines of some of them.
class Problems {
 public:
  static constexpr std::size_t most_lines = 5;  ///< named in one message

  void add(core::Diagnostic diagnostic);
  /// Problems of one `kind` become one problem, even if their messages differ (in the name of a column).
  void add(core::Diagnostic diagnostic, const std::string& kind);
  /// Counts one more problem of a known `kind`, for which no message is made; false if the kind is new.
  [[nodiscard]] bool repeats(std::string_view kind, int line);
  /// A problem of several rows: the first one, and `others` more rows; `lines` has the lines of some of these.
  void add(core::Diagnostic diagnostic, std::size_t others, std::vector<int> lines);
  /// Throws `core::InputError` with all problems, in the order of their places.
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

}  // namespace dualdamp::identify
