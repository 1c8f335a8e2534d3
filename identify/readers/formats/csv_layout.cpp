#include "identify/readers/formats/csv_layout.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/units.hpp"
#include "identify/readers/formats/csv_numbers.hpp"

namespace dualdamp::identify {

namespace {

/// Largest number of lines between a header and its rows: units, descriptions.
constexpr std::size_t most_between = 3;

constexpr std::array<char, 4> separators = {'\t', ';', ',', ' '};

bool is_comment(std::string_view line) {
  const std::string_view text = trimmed(line);
  return text.starts_with('#') || text.starts_with('%') || text.starts_with("//");
}

bool is_empty_row(std::string_view line, char separator) {
  const std::array<char, 3> blanks = {' ', '\t', separator};
  return line.find_first_not_of(std::string_view(blanks.data(), blanks.size())) == std::string_view::npos;
}

using Words = std::vector<std::string>;

bool holds_numbers(const Words& fields) { return std::ranges::any_of(fields, is_like_number); }

/// Number of fields, without the empty ones that come from separators at the end of the line.
std::size_t count_of(const Words& fields) {
  std::size_t count = fields.size();
  while (count > 1 && fields[count - 1].empty()) --count;
  return count;
}

class Search {
 public:
  Search(std::string_view text, const ReadOptions& options) : options_(options), start_(text) { collect(); }

  Layout run() {
    Layout layout = found();
    if (!layout.units && labels_.number > 0) layout.units = labels_;
    layout.time_label = time_label(layout.separator);
    return layout;
  }

 private:
  Layout found() {
    if (lines_.empty()) return with_separator({});
    if (options_.no_header) return headless();
    for (const bool named : {true, false})
      for (std::size_t i = 0; i < lines_.size(); ++i)
        for (const char separator : candidates(lines_[i].line.text))
          if (const auto row = first_row(i, separator, named))
            return below(header_of(*row, i, separator, named), separator, *row);
    if (auto layout = header_in_comment()) return *layout;
    return first_line();
  }

  struct Candidate {
    SourceLine line;
    Lines before;        ///< positioned at this line
    SourceLine comment;  ///< the last comment above it
  };

  void collect() {
    Lines lines = start_;
    SourceLine comment;
    SourceLine line;
    while (!lines.at_end() && line.number < most_header_lines) {
      const Lines before = lines;
      line = lines.next();
      if (line.number == 1 && line.text.size() == 5 && line.text.starts_with("sep=")) {
        stated_separator_ = line.text.back();  // `sep=;`, as Excel writes it
      } else if (trimmed(line.text).starts_with("***End_of_Header***")) {
        keep_labels();
        lines_.clear();  // end of the LabVIEW header: the lines above are no table
      } else if (is_comment(line.text)) {
        comment = line;
      } else if (!trimmed(line.text).empty()) {
        lines_.push_back({line, before, comment});
      }
    }
    lines_left_ = !lines.at_end();
  }

  /// LabVIEW labels the units of its columns above the table, field by field; those of times all alike.
  void keep_labels() {
    for (const auto& [line, before, comment] : lines_) {
      if (line.text.starts_with("Y_Unit_Label")) labels_ = line;
      if (line.text.starts_with("X_Unit_Label")) time_labels_ = line;
    }
  }

  [[nodiscard]] std::string time_label(char separator) const {
    const Words fields = fields_of(time_labels_.text, separator);
    return fields.size() < 2 ? std::string() : unit_in(fields[1]);
  }

  [[nodiscard]] std::vector<char> candidates(std::string_view header) const {
    if (stated_separator_ != 0) return {stated_separator_};
    std::vector<char> result;
    for (const char separator : separators)
      if (header.find(separator) != std::string_view::npos) result.push_back(separator);
    if (result.empty()) result.push_back(options_.decimal == ',' ? ';' : ',');
    return result;
  }

  [[nodiscard]] Layout with_separator(Layout layout) const {
    if (stated_separator_ != 0) layout.separator = stated_separator_;
    return layout;
  }

  /// Whether a heading names a column of numbers, by itself or by a statement of the caller.
  [[nodiscard]] bool names_column(const std::string& field) const {
    Heading heading = parse_heading(field, 0);
    if (is_asked_for(heading, options_)) return true;
    const KnownColumn* known = named_column(heading);
    return known != nullptr && !known->unit.empty();
  }

  /// Whether the caller states this column, counted from 0, by its number.
  [[nodiscard]] bool is_numbered(std::size_t column) const {
    return std::ranges::any_of(options_.columns,
                               [&](const auto& entry) { return entry.second == std::to_string(column + 1); });
  }

  /// The first row below line `i`, if line `i` can be its header: the header has no numbers, the row has as many
  /// fields, and the fields below known headings (`named`), or all fields, or one that the caller states by its
  /// number, are numbers.
  [[nodiscard]] std::optional<std::size_t> first_row(std::size_t i, char separator, bool named) const {
    const Words headings = fields_of(lines_[i].line.text, separator);
    if (holds_numbers(headings)) return std::nullopt;
    std::size_t row = i + 1;
    while (row < lines_.size() && row <= i + most_between &&
           !holds_numbers(fields_of(lines_[row].line.text, separator)))
      ++row;
    if (row == lines_.size() || row > i + most_between + 1) return std::nullopt;
    const Words fields = fields_of(lines_[row].line.text, separator);
    if (!holds_numbers(fields) || !fits(headings, fields, separator)) return std::nullopt;
    bool any = false;
    bool all = true;
    for (std::size_t k = 0; k < std::min(fields.size(), headings.size()); ++k) {
      if (!fields[k].empty()) all = all && is_like_number(fields[k]);
      if (named ? names_column(headings[k]) : is_numbered(k)) any = any || is_like_number(fields[k]);
    }
    return any || (!named && all) ? std::optional(row) : std::nullopt;
  }

  /// Of several possible headers of a row, the nearest one that names a column: a line above it that does so may be
  /// a description. Where none names one, the first of those with the most fields: a spreadsheet fills a title with
  /// separators.
  [[nodiscard]] std::size_t header_of(std::size_t row, std::size_t i, char separator, bool named) const {
    const auto count = [&](std::size_t k) { return count_of(fields_of(lines_[k].line.text, separator)); };
    std::size_t found = i;
    for (std::size_t k = i + 1; k < row; ++k)
      if (first_row(k, separator, named) == row && (named || count(k) > count(found))) found = k;
    return found;
  }

  /// As many fields as the header. With decimal commas there are more; the reader reports these.
  [[nodiscard]] static bool fits(const Words& headings, const Words& fields, char separator) {
    if (headings.size() == 1 && separator == ' ') return false;
    const std::size_t wanted = count_of(headings);
    const std::size_t found = count_of(fields);
    return found == wanted || fields.size() == headings.size() || (separator == ',' && found == 2 * wanted) ||
           (found < wanted && wanted <= fields.size());
  }

  [[nodiscard]] Layout below(std::size_t i, char separator, std::size_t row) const {
    Layout layout{.separator = separator, .header = lines_[i].line, .lines = lines_[row].before, .lines_above = i};
    const Words headings = fields_of(layout.header.text, separator);
    for (std::size_t k = i + 1; k < row; ++k) {
      layout.below_header.push_back(lines_[k].line.text);
      if (!layout.units && (row == i + 2 || holds_units(headings, lines_[k].line.text, separator)))
        layout.units = lines_[k].line;
    }
    return layout;
  }

  [[nodiscard]] static bool holds_units(const Words& headings, std::string_view line, char separator) {
    const Words fields = fields_of(line, separator);
    for (std::size_t k = 0; k < std::min(fields.size(), headings.size()); ++k) {
      Heading heading = parse_heading(headings[k], 0);
      const KnownColumn* known = named_column(heading);
      const std::string unit = unit_in(fields[k]);
      if (known != nullptr && !known->unit.empty() && !unit.empty() &&
          (core::unit_factor(unit, known->unit).value || core::coordinate_told_by(unit, known->unit)))
        return true;
    }
    return false;
  }

  /// A header in a comment, `# t x`, above rows of numbers, as numpy writes it.
  [[nodiscard]] std::optional<Layout> header_in_comment() const {
    const Candidate& first = lines_.front();
    if (first.comment.number == 0) return std::nullopt;
    SourceLine header = first.comment;
    const std::size_t mark = header.text.find_first_not_of("#%/ \t");
    if (mark == std::string_view::npos) return std::nullopt;
    header.text.remove_prefix(mark);
    for (const char separator : candidates(first.line.text)) {
      const Words fields = fields_of(first.line.text, separator);
      const Words headings = fields_of(header.text, separator);
      const bool named = std::ranges::any_of(headings, [this](const std::string& h) { return names_column(h); });
      if (named && headings.size() == fields.size() && holds_numbers(fields) && !holds_numbers(headings))
        return Layout{.separator = separator, .header = header, .lines = first.before};
    }
    return std::nullopt;
  }

  /// The first line as header, although the line below does not fit. The reader reports the fault.
  [[nodiscard]] Layout first_line() const {
    std::size_t i = 0;
    const auto names = [this](const Candidate& candidate) {
      const Words fields = fields_of(candidate.line.text, separator_of(candidate.line.text));
      return !holds_numbers(fields) &&
             std::ranges::any_of(fields, [this](const std::string& field) { return names_column(field); });
    };
    if (const auto named = std::ranges::find_if(lines_, names); named != lines_.end())
      i = static_cast<std::size_t>(named - lines_.begin());
    const SourceLine& line = lines_[i].line;
    Layout layout{
        .separator = separator_of(line.text), .header = line, .lines = lines_[i].before, .lines_above = i};
    layout.is_headless = holds_numbers(fields_of(line.text, layout.separator));
    layout.lines_left = lines_left_;
    (void)layout.lines.next();
    return with_separator(std::move(layout));
  }

  [[nodiscard]] Layout headless() const {
    const std::string_view line = lines_.front().line.text;
    Layout layout{.separator = separator_of(line), .lines = lines_.front().before, .is_headless = true};
    // With decimal commas, a comma is no separator.
    if (options_.decimal == ',' && layout.separator == ',')
      layout.separator = trimmed(line).find(' ') != std::string_view::npos ? ' ' : ';';
    return with_separator(std::move(layout));
  }

  const ReadOptions& options_;
  Lines start_;
  std::vector<Candidate> lines_;
  SourceLine labels_, time_labels_;  ///< of units, in a LabVIEW header; number 0: none
  char stated_separator_ = 0;
  bool lines_left_ = false;
};

}  // namespace

std::optional<SourceLine> Rows::next() {
  restarted_ = false;
  std::size_t empty = 0;  // not counted at the end of the file, where spreadsheets leave such rows
  while (!lines_.at_end()) {
    const SourceLine line = lines_.next();
    if (!header_.empty() && line.text == header_) {
      restarted_ = true;
    } else if (std::ranges::find(below_header_, line.text) != below_header_.end() || is_comment(line.text) ||
               trimmed(line.text).empty()) {
      continue;
    } else if (is_empty_row(line.text, separator_)) {
      ++empty;
    } else {
      empty_rows_ += empty;
      return line;
    }
  }
  return std::nullopt;
}

Layout layout_of(std::string_view text, const ReadOptions& options) { return Search(text, options).run(); }

bool is_called_without_unit(Heading heading, std::string_view called, const KnownColumn& known) {
  choose_unit(heading, known);
  split_unit(heading, known);
  return heading.name == called;
}

bool is_asked_for(const Heading& heading, const ReadOptions& options) {
  return std::ranges::any_of(options.columns, [&](const auto& entry) {
    const KnownColumn* const known = known_column(entry.first);
    return is_called(heading, entry.second) ||
           (known != nullptr && is_called_without_unit(heading, entry.second, *known));
  });
}

std::string unit_in(std::string_view field) {
  std::string_view unit = trimmed(field);
  if (unit.size() >= 2 && (unit.front() == '[' || unit.front() == '(')) unit = unit.substr(1, unit.size() - 2);
  unit = trimmed(unit);
  return unit == "-" ? std::string() : std::string(unit);
}

}  // namespace dualdamp::identify
