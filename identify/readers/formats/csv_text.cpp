#include "identify/readers/formats/csv_text.hpp"

namespace dualdamp::identify {

char separator_of(std::string_view header) {
  for (const char candidate : {'\t', ';', ','}) {
    bool inside = false;
    for (const char c : header) {
      if (c == '"') inside = !inside;
      if (c == candidate && !inside) return candidate;
    }
  }
  const std::string_view words = trimmed(header);
  return words.find(' ') == std::string_view::npos || words.starts_with('"') ? ',' : ' ';
}

/// If blanks are the separator, a unit in brackets still belongs to the name before it: `x [mm]`.
std::size_t Fields::end_of_field() const {
  std::size_t end = std::min(line_.find_first_of(ends_, at_), line_.size());
  if (separator_ != ' ' || end == line_.size()) return end;
  const std::size_t next = line_.find_first_not_of(" \t", end);
  if (next == std::string_view::npos || (line_[next] != '[' && line_[next] != '(')) return end;
  const std::size_t close = line_.find_first_of("])", next);
  return close == std::string_view::npos ? end : std::min(line_.find_first_of(ends_, close), line_.size());
}

void Fields::read_quoted() {
  unquoted_.clear();
  bool closed = false;
  for (++at_; at_ < line_.size() && !closed; ++at_) {
    const bool doubled = line_[at_] == '"' && at_ + 1 < line_.size() && line_[at_ + 1] == '"';
    closed = line_[at_] == '"' && !doubled;
    if (!closed) unquoted_ += line_[at_];
    if (doubled) ++at_;
  }
  const std::size_t end = std::min(line_.find_first_of(ends_, at_), line_.size());
  is_unclosed = is_unclosed || !closed || !trimmed(line_.substr(at_, end - at_)).empty();
  text = trimmed(unquoted_);
  at_ = end;
}

std::vector<std::string> fields_of(std::string_view line, char separator) {
  std::vector<std::string> result;
  Fields fields(line, separator);
  while (result.size() <= most_columns && fields.next()) result.emplace_back(fields.text);
  return result;
}

}  // namespace dualdamp::identify
