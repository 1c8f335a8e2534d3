#include "core/diagnostics.hpp"

#include <utility>

namespace dualdamp::core {

namespace {

std::string location(const SourcePlace& place) {
  std::string text = place.file;
  if (place.line > 0) {
    text += ':' + std::to_string(place.line);
    if (place.column > 0) text += ':' + std::to_string(place.column);
  }
  return text.empty() ? text : text + ": ";
}

/// The source line and a caret below the column; tabs are kept so that the caret stays aligned.
std::string excerpt(const SourcePlace& place) {
  std::string caret;
  for (int column = 1; column < place.column; ++column) {
    const auto index = static_cast<std::size_t>(column - 1);
    caret += index < place.text.size() && place.text[index] == '\t' ? '\t' : ' ';
  }
  return "\n  | " + place.text + "\n  | " + caret + '^';
}

std::string join(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) {
    if (!text.empty()) text += '\n';
    text += format(diagnostic);
  }
  return text;
}

}  // namespace

std::string format(const Diagnostic& diagnostic) {
  std::string text = location(diagnostic.place) + "error: " + diagnostic.message;
  if (!diagnostic.place.text.empty() && diagnostic.place.column > 0) text += excerpt(diagnostic.place);
  if (!diagnostic.allowed.empty()) text += "\n  allowed: " + diagnostic.allowed;
  if (!diagnostic.found.empty()) text += "\n  found: " + diagnostic.found;
  if (!diagnostic.suggestion.empty()) text += "\n  did you mean '" + diagnostic.suggestion + "'?";
  return text;
}

std::string joined(const std::vector<std::string>& words, std::string_view last) {
  return joined(std::vector<std::string_view>(words.begin(), words.end()), last);
}

std::string joined(std::span<const std::string_view> words, std::string_view last) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 < words.size() ? ", " : last;
    text += words[i];
  }
  return text;
}

InputError::InputError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(join(diagnostics)), diagnostics_(std::move(diagnostics)) {}

InputError::InputError(Diagnostic diagnostic) : InputError(std::vector<Diagnostic>{std::move(diagnostic)}) {}

void refuse(SourcePlace place, std::string message, std::string allowed, std::string found) {
  throw InputError(Diagnostic{std::move(place), std::move(message), std::move(allowed), std::move(found), {}});
}

}  // namespace dualdamp::core
