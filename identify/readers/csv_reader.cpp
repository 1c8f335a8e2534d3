#include "identify/readers/csv_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "core/units.hpp"
#include "identify/readers/csv_text.hpp"
#include "identify/readers/text.hpp"

namespace dualdamp::identify {

namespace {

constexpr std::size_t most_columns = 1000;
constexpr std::size_t most_rows = 20'000'000;
constexpr std::size_t longest_excerpt = 200;  ///< bytes of the file quoted in one message

/// The beginning of `text` that fits into a message, cut between characters.
std::string excerpt(std::string_view text) {
  if (text.size() <= longest_excerpt) return std::string(text);
  std::size_t end = longest_excerpt;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // inside a character
  return std::string(text.substr(0, end));
}

std::string quoted(std::string_view text) { return "'" + excerpt(text) + "'"; }

/// What a field of every row is for.
struct Target {
  const KnownColumn* known = nullptr;  ///< nullptr: ignored
  double factor = 1.0;
  std::vector<double>* values = nullptr;  ///< nullptr: a label
};

class Parser {
 public:
  Parser(std::string_view text, std::string file, const ReadOptions& options, Problems& problems,
         std::vector<std::string>& warnings)
      : lines_(text), file_(std::move(file)), options_(options), problems_(problems), warnings_(warnings) {}

  DataTable run() {
    table_.file = file_;
    check_names(options_.units, "unit", file_, problems_);
    check_names(options_.columns, "column", file_, problems_);
    read_header();
    problems_.throw_if_any();
    first_row_ = lines_;
    read_rows();
    table_.time_digits = std::max(time_digits_, 1);
    if (time_decimals_) table_.time_quantum = std::pow(10.0, -*time_decimals_) * time_factor_;
    table_.show = [rows = first_row_, file = file_, separator = separator_, targets = targets_](
                      std::size_t row, const KnownColumn& known) {
      return show(rows, file, separator, targets, row, known);
    };
    return std::move(table_);
  }

 private:
  [[nodiscard]] core::SourcePlace at(const SourceLine& line, int column) const {
    return {file_, line.number, column, excerpt(line.text)};
  }

  static core::Diagnostic show(Lines lines, const std::string& file, char separator,
                               const std::vector<Target>& targets, std::size_t row, const KnownColumn& known) {
    SourceLine line = lines.next();
    for (; row > 0; --row) line = lines.next();
    core::Diagnostic result;
    result.place = {file, line.number, 1, excerpt(line.text)};
    Fields fields(line.text, separator);
    for (const Target& target : targets) {
      if (!fields.next()) break;
      if (target.known != &known) continue;
      result.place.column = fields.column;
      result.found = quoted(fields.text);
    }
    return result;
  }

  void read_header() {
    SourceLine line = first_line();
    if (line.number == 0) {
      problems_.add({{file_, 0, 0, {}}, "the file holds no header", std::string(allowed_columns), {}, {}});
      return;
    }
    lines_.drop_empty_rows(separator_);
    Fields fields(line.text, separator_);
    std::vector<Heading> headings;
    while (fields.next()) {
      if (headings.size() == most_columns) {
        problems_.add({at(line, 1), "the line has more than 1000 fields", {}, {}, {}});
        return;
      }
      headings.push_back(parse_heading(fields.text, fields.column));
    }
    if (fields.is_unclosed) {
      problems_.add({at(line, 1), "a quoted field does not end with its quote", {}, {}, {}});
      return;
    }
    choose_columns(line, headings);
    if (lines_.at_end()) problems_.add({at(line, 0), "there is a header and no data below it", {}, {}, {}});
  }

  /// The header; number 0 when there is none. Excel's own first line `sep=;` names the separator.
  SourceLine first_line() {
    while (!lines_.at_end()) {
      const SourceLine line = lines_.next();
      if (line.number == 1 && line.text.size() == 5 && line.text.starts_with("sep=")) {
        separator_ = line.text.back();
        continue;
      }
      if (trimmed(line.text).empty() || line.text[0] == '#') continue;
      if (separator_ == 0) separator_ = separator_of(line.text);
      return line;
    }
    return {};
  }

  void choose_columns(const SourceLine& line, const std::vector<Heading>& headings) {
    targets_.resize(headings.size());
    table_.columns.reserve(known_columns.size());  // targets point into it
    for (const auto& [name, called] : options_.columns)
      if (const KnownColumn* known = known_column(name)) rename(line, headings, *known, called);
    for (std::size_t i = 0; i < headings.size(); ++i)
      if (targets_[i].known == nullptr) take_by_name(line, headings[i], targets_[i]);
    const bool any = std::any_of(targets_.begin(), targets_.end(), [](const Target& target) {
      return target.known != nullptr && (target.known->is_signal || target.known->name == "Y");
    });
    const bool pairs_without_x = is_taken(*known_column("Y")) && !is_taken(*known_column("x"));
    if (!any || pairs_without_x) report_missing(line, headings);
  }

  void report_missing(const SourceLine& line, const std::vector<Heading>& headings) {
    double number = 0.0;
    const bool numbers = std::any_of(headings.begin(), headings.end(), [&number](const Heading& heading) {
      const auto end = heading.text.data() + heading.text.size();
      return !heading.text.empty() && std::from_chars(heading.text.data(), end, number).ptr == end;
    });
    problems_.add({at(line, 1),
                   numbers ? "there is no column x: the first row holds numbers instead of the names of the columns"
                           : "there is no column x",
                   std::string(allowed_columns),
                   excerpt(line.text),
                   {}});
  }

  /// The column that the caller knows by what the file calls it.
  void rename(const SourceLine& line, const std::vector<Heading>& headings, const KnownColumn& known,
              const std::string& called) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < headings.size(); ++i)
      if (headings[i].text == called || headings[i].name == called) found.push_back(i);
    std::size_t number = 0;
    const auto [end, fault] = std::from_chars(called.data(), called.data() + called.size(), number);
    if (found.empty() && fault == std::errc{} && end == called.data() + called.size() && number >= 1 &&
        number <= headings.size())
      found.push_back(number - 1);
    if (is_taken(known)) {
      problems_.add({{file_, 0, 0, {}}, "column " + std::string(known.name) + " is asked for twice", {}, {}, {}});
      return;
    }
    if (found.size() == 1 && targets_[found.front()].known == nullptr) {
      take(line, headings[found.front()], known, targets_[found.front()]);
      return;
    }
    std::string names;
    for (const Heading& heading : headings) names += (names.empty() ? "" : ", ") + quoted(heading.text);
    problems_.add({at(line, 1),
                   found.empty()
                       ? "there is no column " + quoted(called) + " to be used as " + std::string(known.name)
                   : found.size() == 1 ? "column " + quoted(called) + " is asked for twice"
                                       : "there are several columns " + quoted(called),
                   excerpt(names),
                   {},
                   {}});
  }

  void take_by_name(const SourceLine& line, const Heading& heading, Target& target) {
    const KnownColumn* known = known_column(heading.name);
    if (known == nullptr) {
      warnings_.push_back("column '" + excerpt(heading.text) + "' is not known and is ignored");
    } else if (options_.columns.contains(std::string(known->name)) ||
               options_.columns.contains(std::string(known->alias))) {
      warnings_.push_back("column '" + excerpt(heading.text) + "' is ignored: another one is used in its place");
    } else if (!heading.well_formed) {
      problems_.add({at(line, heading.column),
                     "the unit of column " + heading.name + " is not in square brackets",
                     "'name' or 'name [unit]'",
                     excerpt(heading.text),
                     {}});
      target.known = known;
    } else if (is_taken(*known)) {
      problems_.add({at(line, heading.column),
                     "column " + std::string(known->name) + " stands there twice",
                     {},
                     excerpt(heading.text),
                     {}});
    } else {
      take(line, heading, *known, target);
    }
  }

  [[nodiscard]] bool is_taken(const KnownColumn& known) const {
    return std::any_of(targets_.begin(), targets_.end(),
                       [&](const Target& target) { return target.known == &known; });
  }

  void take(const SourceLine& line, const Heading& heading, const KnownColumn& known, Target& target) {
    target.known = &known;
    target.factor = factor_of(line, heading, known);
    if (known.unit.empty()) return;
    table_.columns.push_back({&known, {}});
    target.values = &table_.columns.back().values;
  }

  double factor_of(const SourceLine& line, const Heading& heading, const KnownColumn& known) {
    const std::string name(known.name);
    std::string unit = heading.unit;
    if (const std::string* given = find_unit(options_.units, known)) {
      if (!unit.empty() && unit != *given)
        warnings_.push_back("column " + name + " is read in " + *given + ", not in " + excerpt(unit) +
                            " as the file states");
      unit = *given;
    }
    const bool needs_unit = known.unit == "rad/s" || known.unit == "rad";
    if (unit.empty() && !needs_unit) return 1.0;
    const core::SourcePlace place = at(line, heading.column);
    if (known.unit.empty()) {
      problems_.add({place,
                     "column " + heading.name + " is a label and has no unit",
                     heading.name,
                     excerpt(heading.text),
                     {}});
      return 1.0;
    }
    core::QuantityText factor = core::unit_factor(unit, known.unit);
    if (unit.empty() && known.unit == "rad")
      factor = {std::nullopt, "an angle needs its unit, because degrees and radians differ", "deg"};
    if (factor.value) return *factor.value;
    problems_.add({place, "the unit of column " + name + ": " + factor.fault, core::describe_dimension(known.unit),
                   excerpt(heading.text), factor.suggestion});
    return 1.0;
  }

  void read_rows() {
    const std::size_t rows = lines_.count();
    if (rows > most_rows) refuse_file(file_, "the file has more than 20 million rows");
    for (DataColumn& column : table_.columns) column.values.reserve(rows);
    while (!lines_.at_end()) read_row(lines_.next());
  }

  void read_row(const SourceLine& line) {
    const std::size_t row = table_.rows();
    if (!has_all_fields(line)) {
      // The row keeps its place, so that later messages name the right line.
      for (DataColumn& column : table_.columns) column.values.push_back(std::nan(""));
      return;
    }
    Fields fields(line.text, separator_);
    for (const Target& target : targets_) {
      fields.next();
      if (target.values != nullptr)
        target.values->push_back(number(line, fields, target));
      else if (target.known != nullptr)
        take_label(fields.text, row);
    }
  }

  bool has_all_fields(const SourceLine& line) {
    std::size_t count = 0;
    if (line.text.find('"') == std::string_view::npos) {
      count = static_cast<std::size_t>(std::count(line.text.begin(), line.text.end(), separator_)) + 1;
    } else {
      Fields fields(line.text, separator_);
      while (fields.next()) ++count;
      if (fields.is_unclosed) {
        problems_.add({at(line, fields.column), "a quoted field does not end with its quote", {}, {}, {}});
        return false;
      }
    }
    if (count == targets_.size()) return true;
    const bool split_numbers = separator_ == ',' && count == 2 * targets_.size();
    problems_.add({at(line, 1),
                   "the row does not have as many fields as the header",
                   std::to_string(targets_.size()) + " fields" +
                       (split_numbers ? ", numbers with a decimal point, not with a comma" : ""),
                   std::to_string(count) + " fields",
                   {}});
    return false;
  }

  void take_label(std::string_view label, std::size_t row) {
    if (table_.sweeps.empty() || table_.sweeps.back().label != label)
      table_.sweeps.push_back({std::string(label), row});
  }

  /// The number of a field in SI; NaN after a problem, which keeps the record from being used.
  double number(const SourceLine& line, const Fields& field, const Target& target) {
    std::string_view text = field.text;
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    double value = 0.0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault == std::errc::invalid_argument || end != text.data() + text.size()) {
      const bool comma = field.text.find(',') != std::string_view::npos;
      problems_.add({at(line, field.column),
                     "the field of column " + std::string(target.known->name) + " is not a number",
                     comma ? "a decimal number with a point, not with a comma" : "a decimal number",
                     field.text.empty() ? "an empty field" : quoted(field.text),
                     {}});
      return std::nan("");
    }
    value *= target.factor;
    if (fault == std::errc::result_out_of_range || !std::isfinite(value)) {
      problems_.add({at(line, field.column),
                     "the field of column " + std::string(target.known->name) + " is not a finite number",
                     "a number of double precision",
                     quoted(field.text),
                     {}});
      return std::nan("");
    }
    if (target.known->name == "t") note_rounding(text, target.factor);
    return value;
  }

  void note_rounding(std::string_view text, double factor) {
    const Digits digits = digits_of(text);
    time_digits_ = std::max(time_digits_, digits.significant);
    time_decimals_ = std::max(time_decimals_.value_or(digits.decimals), digits.decimals);
    time_factor_ = factor;
  }

  Lines lines_;
  Lines first_row_{{}};
  std::string file_;
  const ReadOptions& options_;
  Problems& problems_;
  std::vector<std::string>& warnings_;
  char separator_ = 0;
  std::vector<Target> targets_;
  DataTable table_;
  int time_digits_ = 0;
  std::optional<int> time_decimals_;
  double time_factor_ = 1.0;
};

}  // namespace

DataTable parse_csv(std::string_view text, const std::string& file, const ReadOptions& options, Problems& problems,
                    std::vector<std::string>& warnings) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  refuse_binary(text, file);
  return Parser(text, file, options, problems, warnings).run();
}

}  // namespace dualdamp::identify
