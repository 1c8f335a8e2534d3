#pragma once
/// Diagnostics: what is wrong with an input, where, what was allowed, what was found.
///
/// Input faults are thrown as one `InputError` with every problem found, so that a user can correct a file in one
/// pass. Numerical outcomes are not exceptions: see `core/outcome.hpp`.

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace dualdamp::core {

/// Exit status of the program.
enum class ExitStatus {
  done = 0,
  check_failed = 1,
  usage = 2,
  invalid_input = 3,
  numerical_failure = 4,
  some_cases_failed = 5,
  internal_bug = 70,
  interrupted = 130,
};

/// A place in a text file. Lines and columns count from 1; 0 means unknown.
struct SourcePlace {
  std::string file;
  int line = 0;
  int column = 0;
  std::string text;  ///< the source line itself, without its line end
};

/// One problem. Empty fields are left out of the printed message.
struct Diagnostic {
  SourcePlace place;
  std::string message;     ///< what is wrong, a sentence without final stop
  std::string allowed;     ///< what would have been accepted
  std::string found;       ///< the text found there
  std::string suggestion;  ///< "did you mean" candidate
};

/// Several lines of text: `file:line:column: error: message`, the source line, a caret, then what was allowed,
/// what was found and the suggestion.
[[nodiscard]] std::string format(const Diagnostic& diagnostic);

/// Words of a message: "a, b, c"; with `last` = " and ": "a, b and c".
[[nodiscard]] std::string joined(const std::vector<std::string>& words, std::string_view last = ", ");
[[nodiscard]] std::string joined(std::span<const std::string_view> words, std::string_view last = ", ");

/// Thrown by the readers of scenario files, data files and the command line, with all problems found.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Diagnostic> diagnostics);
  explicit InputError(Diagnostic diagnostic);

  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

/// Throws an `InputError` with this one problem.
[[noreturn]] void refuse(SourcePlace place, std::string message, std::string allowed = {}, std::string found = {});

}  // namespace dualdamp::core
