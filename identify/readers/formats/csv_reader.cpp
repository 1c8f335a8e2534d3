#include "identify/readers/formats/csv_reader.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "identify/readers/formats/csv_header.hpp"
#include "identify/readers/formats/csv_layout.hpp"
#include "identify/readers/formats/csv_numbers.hpp"

namespace dualdamp::identify {

namespace {

constexpr std::size_t most_rows = 20'000'000;

/// A field of every row, and the target of its numbers.
struct Target {
  CsvField field;
  std::vector<double>* values = nullptr;  ///< nullptr: a label, or an ignored field
};

class Parser {
 public:
  Parser(std::string_view text, const ReadOptions& options, Problems& problems, std::vector<std::string>& warnings)
      : options_(options),
        layout_(layout_of(text, options)),
        rows_(layout_.rows()),
        problems_(problems),
        warnings_(warnings) {}

  DataTable run() {
    table_.file = options_.name;
    check_names(options_, problems_);
    problems_.throw_if_any();
    if (layout_.lines_above > 0)
      warnings_.push_back(std::to_string(layout_.lines_above) + " line" + (layout_.lines_above == 1 ? "" : "s") +
                          " above the header, line " + std::to_string(layout_.header.number) + ", " +
                          (layout_.lines_above == 1 ? "is" : "are") + " not read");
    auto [fields, units, ignored] = read_csv_header(layout_, options_, problems_, warnings_);
    table_.units = std::move(units);
    table_.ignored = std::move(ignored);
    problems_.throw_if_any();
    table_.columns.reserve(known_columns.size());  // targets point into it
    for (const CsvField& field : fields) {
      targets_.push_back({field});
      if (field.known == nullptr || field.known->unit.empty()) continue;
      table_.columns.push_back({field.known, {}});
      targets_.back().values = &table_.columns.back().values;
    }
    read_rows();
    problems_.throw_if_any();
    refuse_without_numbers();
    table_.time_digits = std::max(time_digits_, 1);
    if (time_decimals_) table_.time_quantum = std::pow(10.0, -*time_decimals_) * time_factor_;
    table_.show = [rows = layout_.rows(), file = options_.name, separator = layout_.separator, targets = targets_](
                      std::size_t row, const KnownColumn& known) {
      return show(rows, file, separator, targets, row, known);
    };
    return std::move(table_);
  }

 private:
  [[nodiscard]] std::string decimal_comma() const { return options_.words(core::Setting::decimal, {}, ","); }

  [[nodiscard]] core::SourcePlace at(const SourceLine& line, int column) const {
    return {options_.name, line.number, column, excerpt(line.text)};
  }

  static core::Diagnostic show(Rows rows, const std::string& file, char separator,
                               const std::vector<Target>& targets, std::size_t row, const KnownColumn& known) {
    SourceLine line;
    for (std::size_t i = 0; i <= row; ++i) line = rows.next().value_or(line);
    core::Diagnostic result;
    result.place = {file, line.number, 1, excerpt(line.text)};
    Fields fields(line.text, separator);
    for (const Target& target : targets) {
      if (!fields.next()) break;
      if (target.field.known != &known) continue;
      result.place.column = fields.column;
      result.found = quoted(fields.text);
    }
    return result;
  }

  void read_rows() {
    if (targets_.empty()) return;
    const std::size_t rows = rows_.count();
    if (rows > most_rows) core::refuse({.file = options_.name}, "the file has more than 20 million rows");
    for (DataColumn& column : table_.columns) column.values.reserve(rows);
    bool any = false;
    while (const auto line = rows_.next()) {
      if (rows_.restarted() && any) table_.restarts.push_back(table_.rows());
      read_row(*line);
      any = true;
    }
    if (!any)
      problems_.add({at(layout_.header, 0),
                     "there is a header and no data below it",
                     "a row of numbers for each reading",
                     {},
                     {}});
    if (const std::size_t empty = rows_.empty_rows(); empty > 0)
      warnings_.push_back(std::to_string(empty) + " row" + (empty == 1 ? "" : "s") +
                          " of empty fields between the others " + (empty == 1 ? "is" : "are") + " left out");
  }

  void read_row(const SourceLine& line) {
    const std::size_t row = table_.rows();
    if (!has_all_fields(line)) {
      // The row keeps its place, so that later messages name the right line.
      for (DataColumn& column : table_.columns) column.values.push_back(std::nan(""));
      return;
    }
    Fields fields(line.text, layout_.separator);
    for (const Target& target : targets_) {
      if (!fields.next()) break;
      if (target.values != nullptr)
        target.values->push_back(number(line, fields, target.field));
      else if (target.field.known != nullptr)
        take_label(fields.text, row);
    }
  }

  bool has_all_fields(const SourceLine& line) {
    std::size_t count = 0;
    if (layout_.separator != ' ' && line.text.find('"') == std::string_view::npos) {
      count = static_cast<std::size_t>(std::count(line.text.begin(), line.text.end(), layout_.separator)) + 1;
    } else {
      Fields fields(line.text, layout_.separator);
      while (fields.next()) ++count;
      if (fields.is_unclosed) {
        problems_.add({at(line, fields.column), "a quoted field does not end with its quote", {}, {}, {}});
        return false;
      }
    }
    if (count == targets_.size() || is_same_but_for_the_end(line, count)) return true;
    const std::string problem = "the row does not have as many fields as the header";
    if (problems_.repeats(problem, line.number)) return false;
    const bool split_numbers = layout_.separator == ',' && count == 2 * targets_.size();
    problems_.add({at(line, 1),
                   problem,
                   std::to_string(targets_.size()) + " fields" +
                       (count == 1 && line.text.find_first_of(";\t, ") != std::string_view::npos
                            ? ", separated as those of the header"
                            : "") +
                       (split_numbers ? ", numbers with a decimal point, not with a comma; for decimal commas "
                                        "quotes around the numbers, or semicolons between them, and " +
                                            decimal_comma()
                                      : std::string()),
                   std::to_string(count) + " fields",
                   {}});
    return false;
  }

  /// Whether a row differs from the header only at its end: empty fields too many, or remarks that are missing.
  [[nodiscard]] bool is_same_but_for_the_end(const SourceLine& line, std::size_t count) const {
    for (std::size_t i = count; i < targets_.size(); ++i)
      if (!targets_[i].field.may_be_missing) return false;
    if (count <= targets_.size()) return true;
    const std::vector<std::string> fields = fields_of(line.text, layout_.separator);
    return std::all_of(fields.begin() + static_cast<std::ptrdiff_t>(targets_.size()), fields.end(),
                       [](const std::string& field) { return field.empty(); });
  }

  void take_label(std::string_view label, std::size_t row) {
    if (table_.sweeps.empty() || table_.sweeps.back().label != label)
      table_.sweeps.push_back({std::string(label), row});
  }

  /// A column without any number is a fault of the program that wrote it, not a record without phases.
  void refuse_without_numbers() const {
    for (const DataColumn& column : table_.columns)
      if (std::ranges::all_of(column.values, [](double value) { return std::isnan(value); }))
        unmeasured_.throw_if_any();
  }

  /// The number of a field in SI. NaN if it was not measured, and after a problem; the record is not used then.
  double number(const SourceLine& line, const Fields& field, const CsvField& target) {
    const bool is_time = target.known->name == "t";
    if (is_time && field.text.find(':') != std::string_view::npos)
      if (const auto time = stamp(field.text)) return *time;
    FieldNumber number = read_field(field.text, options_.decimal);
    if (number.value && !std::isfinite(*number.value * target.factor)) {
      number = {std::nullopt, "is not a finite number", "a number of double precision"};
    }
    if (!number.value) {
      const std::string kind = std::string(number.fault).append(number.allowed);
      Problems& problems = target.known->may_lack && is_unmeasured(field.text) ? unmeasured_ : problems_;
      if (!problems.repeats(kind, line.number))
        problems.add({at(line, field.column),
                      "the field of column " + std::string(target.known->name) + " " + std::string(number.fault),
                      std::string(number.allowed) +
                          (number.has_comma ? "; for decimal commas " + decimal_comma() : std::string()),
                      field.text.empty() ? "an empty field" : quoted(field.text),
                      {}},
                     kind);
      return std::nan("");
    }
    if (is_time) note_rounding(field.text, target.factor);
    return *number.value * target.factor;
  }

  /// Seconds since the first time stamp. Without a date, a day is added after midnight.
  std::optional<double> stamp(std::string_view text) {
    constexpr double day = 86400.0;
    const auto clock = read_clock(text, options_.decimal);
    if (!clock) return std::nullopt;
    if (!first_stamp_) first_stamp_ = last_stamp_ = *clock;
    const bool is_midnight = clock->days == 0 && clock->seconds < last_stamp_.seconds - 0.5 * day;
    if (is_midnight) nights_ += 1;
    last_stamp_ = *clock;
    const std::string_view seconds = text.substr(text.rfind(':') + 1);
    time_decimals_ = std::max(time_decimals_.value_or(0), digits_of(seconds, options_.decimal).decimals);
    time_digits_ = std::numeric_limits<double>::max_digits10;  // leading digits are hours and days
    return (clock->days - first_stamp_->days + nights_) * day + clock->seconds - first_stamp_->seconds;
  }

  void note_rounding(std::string_view text, double factor) {
    const Digits digits = digits_of(text, options_.decimal);
    time_digits_ = std::max(time_digits_, digits.significant);
    time_decimals_ = std::max(time_decimals_.value_or(digits.decimals), digits.decimals);
    time_factor_ = std::abs(factor);
  }

  const ReadOptions& options_;
  Layout layout_;
  Rows rows_;
  Problems& problems_;
  Problems unmeasured_;  ///< what the fields of columns that may lack are otherwise
  std::vector<std::string>& warnings_;
  std::vector<Target> targets_;
  DataTable table_;
  std::optional<Clock> first_stamp_;
  Clock last_stamp_;
  int nights_ = 0;
  int time_digits_ = 0;
  std::optional<int> time_decimals_;
  double time_factor_ = 1.0;
};

}  // namespace

DataTable parse_csv(std::string_view text, const ReadOptions& options, Problems& problems,
                    std::vector<std::string>& warnings) {
  constexpr std::size_t longest_head = 4096;
  if (text.starts_with("LabVIEW Measurement") &&
      text.substr(0, longest_head).find("X_Columns\tNo") != std::string_view::npos)
    core::refuse({.file = options.name}, "the LabVIEW file holds no times: X_Columns is No",
                 "a measurement file with one X column (X_Columns One)");
  return Parser(text, options, problems, warnings).run();
}

}  // namespace dualdamp::identify
