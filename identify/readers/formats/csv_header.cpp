#include "identify/readers/formats/csv_header.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <utility>

#include "core/units.hpp"
#include "identify/readers/formats/csv_numbers.hpp"

namespace dualdamp::identify {

namespace {

class HeaderReader {
 public:
  HeaderReader(const Layout& layout, const ReadOptions& options, Problems& problems,
               std::vector<std::string>& warnings)
      : layout_(layout),
        line_(layout.header),
        options_(options),
        problems_(problems),
        warnings_(warnings),
        factors_(options, problems, warnings) {}

  CsvHeader run() {
    if (layout_.header.number == 0 ? !read_first_row() : !read_headings()) return {};
    if (line_.number > 0 && is_row_of_numbers() && !names_any()) {
      refuse_row_of_numbers();
      return {};
    }
    fields_.resize(headings_.size());
    for (const auto& [name, called] : options_.columns)
      if (const KnownColumn* known = known_column(name)) rename(*known, called);
    for (std::size_t i = 0; i < headings_.size() && line_.number > 0; ++i)
      if (fields_[i].known == nullptr) take_by_name(headings_[i], fields_[i]);
    std::vector<std::string> ignored = all_ignored("column", unknown_, options_.words);
    warnings_.insert(warnings_.end(), ignored.begin(), ignored.end());
    report_missing();
    return {std::move(fields_), factors_.take_units(), std::move(ignored)};
  }

 private:
  [[nodiscard]] core::SourcePlace at(int column) const {
    return {options_.name, line_.number, column, excerpt(line_.text)};
  }

  void complain(int column, std::string message, std::string allowed = {}, std::string found = {},
                std::string suggestion = {}) {
    problems_.add({at(column), std::move(message), std::move(allowed), std::move(found), std::move(suggestion)});
  }

  bool read_headings() {
    Fields fields(line_.text, layout_.separator);
    while (fields.next()) {
      if (headings_.size() == most_columns) {
        complain(1, "the line has more than 1000 fields");
        return false;
      }
      headings_.push_back(parse_heading(fields.text, fields.column));
    }
    if (fields.is_unclosed) complain(1, "a quoted field does not end with its quote");
    if (!fields.is_unclosed && is_quoted_whole()) return false;
    if (!fields.is_unclosed && layout_.units) read_units();
    for (Heading& heading : headings_)
      if (is_time_of_labview(heading)) heading.unit = layout_.time_label;
    return !fields.is_unclosed;
  }

  /// Refuses rows that are one quoted field each. A spreadsheet writes them if it had read each row as one text.
  bool is_quoted_whole() {
    const bool whole = headings_.size() == 1 && trimmed(line_.text).starts_with('"') &&
                       headings_.front().text.find_first_of(",;\t") != std::string::npos;
    if (whole)
      complain(1, "the whole row is in quotes and is one field", "quotes around single fields, or none",
               excerpt(line_.text));
    return whole;
  }

  /// Without a header, the caller names columns by their numbers.
  bool read_first_row() {
    Lines lines = layout_.lines;
    if (lines.at_end()) {
      problems_.add({{options_.name, 0, 0, {}}, "the file holds no header", std::string(allowed_columns), {}, {}});
      return false;
    }
    const std::size_t count = std::min(fields_of(lines.next().text, layout_.separator).size(), most_columns);
    for (std::size_t i = 0; i < count; ++i) headings_.push_back({std::to_string(i + 1), std::to_string(i + 1), {}});
    if (!options_.columns.empty()) return true;
    problems_.add({{options_.name, 0, 0, {}},
                   "without a header the columns have no names",
                   "the numbers of the columns, such as " + options_.words(core::Setting::column, "t", "1") + ", " +
                       options_.words(core::Setting::column, "x", "2"),
                   std::to_string(count) + " columns",
                   {}});
    return false;
  }

  /// Whether a heading names a column by itself, or is a text by which the caller names one.
  [[nodiscard]] bool names_any() const {
    return std::ranges::any_of(headings_, [this](Heading heading) {
      if (is_like_number(heading.text)) return false;
      return named_column(heading) != nullptr || is_asked_for(heading, options_);
    });
  }

  /// Whether it holds numbers as a row of data does; `Channel 0: force` does not.
  [[nodiscard]] bool is_row_of_numbers() const {
    const auto numbers =
        std::ranges::count_if(headings_, [](const Heading& heading) { return is_like_number(heading.text); });
    return layout_.is_headless && (is_like_number(headings_.front().text) || 2 * numbers >= std::ssize(headings_));
  }

  /// As a header, the first row of the data would be lost.
  void refuse_row_of_numbers() {
    complain(1, "the first row holds numbers instead of the names of the columns",
             std::string(allowed_columns) + "; or " + options_.words(core::Setting::no_header) + " with " +
                 options_.words(core::Setting::column, "x", "2"),
             excerpt(line_.text));
  }

  /// Refuses a unit in the heading that differs from the one in the row of units.
  void refuse_other_unit(const Heading& heading, const std::string& below) {
    Heading named = heading;
    const KnownColumn* const known = named_column(named);
    if (known == nullptr || named.unit.empty() || below.empty()) return;
    const auto stated = core::unit_factor(named.unit, known->unit).value;
    const auto other = core::unit_factor(below, known->unit).value;
    if (!stated || !other || *stated == *other) return;
    complain(heading.column, "the unit of column " + std::string(known->name) + " is stated twice",
             "one unit, in the heading or in the row below it",
             "'" + excerpt(named.unit) + "' and, in line " + std::to_string(layout_.units->number) + ", '" +
                 excerpt(below) + "'");
  }

  /// Its unit is not in the row of units, whose first field says what the others are.
  static bool is_time_of_labview(const Heading& heading) { return heading.text == "X_Value"; }

  void read_units() {
    std::size_t i = 0;
    for (const std::string& field : fields_of(layout_.units->text, layout_.separator)) {
      if (i == headings_.size()) return;
      Heading& heading = headings_[i++];
      if (is_time_of_labview(heading)) continue;
      refuse_other_unit(heading, unit_in(field));
      if (!heading.brackets.empty()) below_[heading.column] = unit_in(field);
      if (!heading.unit.empty() || !heading.brackets.empty() || !heading.well_formed) continue;
      const KnownColumn* const before = named_column(heading);
      if (before == nullptr || heading.unit.empty()) heading.unit = unit_in(field);
    }
  }

  /// The index of a column that the caller states by its number; nothing if the text is no such number.
  [[nodiscard]] std::optional<std::size_t> number_in(const std::string& called) const {
    std::size_t number = 0;
    const auto [end, fault] = std::from_chars(called.data(), called.data() + called.size(), number);
    const bool is_whole = fault == std::errc{} && end == called.data() + called.size();
    return is_whole && number >= 1 && number <= headings_.size() ? std::optional(number - 1) : std::nullopt;
  }

  /// The heading that the caller names by its text, by its number, or by the name before its unit.
  [[nodiscard]] std::vector<std::size_t> find(const std::string& called, const KnownColumn& known) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < headings_.size(); ++i)
      if (is_called(headings_[i], called)) found.push_back(i);
    if (const auto place = number_in(called); found.empty() && place) found.push_back(*place);
    if (!found.empty()) return found;
    for (std::size_t i = 0; i < headings_.size(); ++i)
      if (is_called_without_unit(headings_[i], called, known)) found.push_back(i);
    return found;
  }

  [[nodiscard]] std::string names() const {
    std::string text;
    for (const Heading& heading : headings_) text += (text.empty() ? "" : ", ") + quoted(heading.text);
    return excerpt(text);
  }

  /// The column for which the caller states this heading.
  void rename(const KnownColumn& known, const std::string& called) {
    const std::vector<std::size_t> found = find(called, known);
    if (const auto place = number_in(called);
        place && found.size() == 1 && found.front() != *place && line_.number > 0) {
      complain(1, "'" + called + "' is the heading of a column and the number of another one",
               "headings that are names; then " + options_.words(core::Setting::column, known.name, "NAME"),
               "column " + std::to_string(found.front() + 1) + " with the heading '" + called + "'");
      return;
    }
    if (is_taken(known)) {
      problems_.add(
          {{options_.name, 0, 0, {}}, "column " + std::string(known.name) + " is asked for twice", {}, {}, {}});
      return;
    }
    if (found.size() == 1 && fields_[found.front()].known == nullptr) {
      take(headings_[found.front()], known, fields_[found.front()]);
      return;
    }
    const std::string subject = found.size() == 1 ? "column " + quoted(called) + " is asked for twice"
                                                  : "there are several columns " + quoted(called);
    complain(1,
             found.empty() ? "there is no column " + quoted(called) + " to be used as " + std::string(known.name)
                           : subject,
             found.size() > 1 ? "the number of the column, counted from 1" : "one of " + names());
  }

  void take_by_name(Heading& heading, CsvField& field) {
    const KnownColumn* known = named_column(heading);
    const bool is_left_alone = !options_.only.empty() && (known == nullptr || !is_wanted(options_, *known));
    static constexpr std::array<std::string_view, 6> remarks = {"",     "Comment", "Comments",
                                                                "Note", "Remark",  "comment"};
    if (known == nullptr || is_left_alone) {
      field.may_be_missing = std::ranges::find(remarks, heading.name) != remarks.end();
      if (heading.text.empty() || is_left_alone) return;
      unknown_.push_back(excerpt(heading.text));
    } else if (find_for(options_.columns, *known) != nullptr) {
      warnings_.push_back("column '" + excerpt(heading.text) + "' is ignored: another one is used in its place");
    } else if (!heading.well_formed) {
      const std::string fault =
          heading.brackets.empty()
              ? "the unit of column " + heading.name + " is not in square brackets"
              : "the heading of column " + heading.name + " has words behind its square brackets or other ones";
      complain(heading.column, fault,
               "'name' or 'name [unit]'; or, if it is the column that is meant, " +
                   options_.words(core::Setting::column, known->name, std::to_string(&field - fields_.data() + 1)),
               excerpt(heading.text));
      field.known = known;
    } else if (is_taken(*known)) {
      complain(heading.column, "column " + std::string(known->name) + " appears twice",
               "one column " + std::string(known->name) + "; " +
                   options_.words(core::Setting::column, known->name, "NUMBER") + " chooses one",
               excerpt(heading.text));
    } else {
      take(heading, *known, field);
    }
  }

  [[nodiscard]] bool is_taken(const KnownColumn& known) const {
    return std::ranges::any_of(fields_, [&](const CsvField& field) { return field.known == &known; });
  }

  /// Where several brackets state units, or none of them does.
  void settle_unit(Heading& heading, const KnownColumn& known) {
    const bool is_stated = find_for(options_.units, known) != nullptr;
    if (!heading.other_unit.empty() && !is_stated)
      complain(heading.column, "the heading of column " + std::string(known.name) + " states two units",
               "one unit, or " + options_.words(core::Setting::unit, known.name, heading.unit),
               "'" + excerpt(heading.other_unit) + "' and '" + excerpt(heading.unit) + "'");
    if (heading.brackets.empty() || is_unit_of(heading.unit, known)) return;
    const auto below = below_.find(heading.column);
    if (below != below_.end() && is_unit_of(below->second, known)) {
      heading.unit = below->second;
    } else if (is_stated && heading.unit.find(' ') != std::string::npos) {  // a remark, which contradicts no unit
      heading.unit.clear();
      heading.brackets.clear();
    }
  }

  void take(Heading& heading, const KnownColumn& known, CsvField& field) {
    field.known = &known;
    choose_unit(heading, known);
    settle_unit(heading, known);
    if (heading.unit.empty()) {  // x_mm or Weg_mm, if the caller names the column so
      Heading same = heading;
      if (named_column(same) == &known)
        heading.unit = same.unit;
      else
        split_unit(heading, known);
    }
    const bool holds_stamps =
        known.name == "t" && begins_with_stamp(static_cast<std::size_t>(&field - fields_.data()));
    if (holds_stamps && heading.unit.empty()) heading.unit = "s";
    core::Diagnostic where;
    where.place = at(heading.column);
    where.found = excerpt(heading.text);
    if (layout_.units && !heading.unit.empty() && heading.text.find(heading.unit) == std::string::npos) {
      where.place = {options_.name, layout_.units->number, 1, excerpt(layout_.units->text)};
      where.found = excerpt(heading.unit);
    }
    factors_.check_suffix(known, excerpt(heading.text), heading.unit,
                          std::ranges::any_of(headings_, is_output, &Heading::text), where);
    factors_.check_amplitude(known, heading.text, heading.unit, where);
    field.factor = factors_.factor_of(known, excerpt(heading.unit), where);
    if (holds_stamps && field.factor != 1.0)
      complain(heading.column, "column t holds time stamps, and a unit or a scale is stated for it",
               "none, or " + options_.words(core::Setting::unit, "t", "s"), excerpt(heading.text));
  }

  /// Whether the field of the first row is a time of day, which states hours, minutes and seconds itself.
  [[nodiscard]] bool begins_with_stamp(std::size_t index) const {
    const auto row = layout_.rows().next();
    const std::vector<std::string> fields =
        row ? fields_of(row->text, layout_.separator) : std::vector<std::string>();
    return index < fields.size() && fields[index].find(':') != std::string::npos &&
           read_clock(fields[index], options_.decimal).has_value();
  }

  void report_missing() {
    const bool any = std::ranges::any_of(fields_, [](const CsvField& field) {
      return field.known != nullptr && (field.known->is_signal || field.known->name == "Y");
    });
    const bool pairs_without_x = is_taken(*known_column("Y")) && !is_taken(*known_column("x"));
    if (!options_.only.empty()) return;                           // the caller reports missing columns
    if ((any && !pairs_without_x) || !problems_.empty()) return;  // the missing column may have a faulty heading
    const std::string other = ". Columns of other names: " + options_.words(core::Setting::column, "x", "NAME");
    if (is_transposed())
      complain(1, "rows and columns are exchanged: the names are in the first field of each row",
               "the names of the columns in one row and a row for each sample", excerpt(line_.text));
    else
      complain(1,
               "there is no column x; there are the columns " + names() +
                   (layout_.lines_left ? ", and no other header in the first " + std::to_string(most_header_lines) +
                                             " lines of the file"
                                       : std::string()),
               std::string(allowed_columns) + other, excerpt(line_.text), suggestion());
  }

  [[nodiscard]] bool is_transposed() const {
    if (headings_.size() < 2 || !layout_.is_headless) return false;
    Heading first = headings_.front();
    return named_column(first) != nullptr && std::all_of(headings_.begin() + 1, headings_.end(),
                                                         [](const Heading& h) { return is_like_number(h.text); });
  }

  /// A column with the other case of its one letter; else the only one with a unit of length, together with the
  /// only one with a unit of time.
  [[nodiscard]] std::string suggestion() const {
    for (const Heading& heading : headings_)
      if (heading.name == "X") return options_.words(core::Setting::column, "x", heading.text);
    const KnownColumn& x = *known_column("x");
    const KnownColumn& t = *known_column("t");
    const Heading* const moves = only_one_in(x);
    if (moves == nullptr || is_taken(*known_column("Y"))) return {};
    std::string text = options_.words(core::Setting::column, x.name, name_for(*moves, x));
    if (const Heading* const times = only_one_in(t); times != nullptr && !is_taken(t))
      text = options_.words(core::Setting::column, t.name, name_for(*times, t)) + " " + text;
    return text;
  }

  /// The heading, with its unit moved out of its name.
  [[nodiscard]] Heading in_parts(Heading heading, const KnownColumn& known) const {
    choose_unit(heading, known);
    if (heading.unit.empty()) split_unit(heading, known);
    if (const auto below = below_.find(heading.column); heading.unit.empty() && below != below_.end())
      heading.unit = below->second;
    return heading;
  }

  [[nodiscard]] std::string name_for(const Heading& heading, const KnownColumn& known) const {
    return in_parts(heading, known).name;
  }

  /// The only column of another name that states a unit of this one; nullptr: none, or several.
  [[nodiscard]] const Heading* only_one_in(const KnownColumn& known) const {
    const Heading* found = nullptr;
    for (std::size_t i = 0; i < headings_.size(); ++i) {
      if (fields_[i].known != nullptr || !is_unit_of(in_parts(headings_[i], known).unit, known)) continue;
      if (found != nullptr) return nullptr;
      found = &headings_[i];
    }
    return found;
  }

  const Layout& layout_;
  SourceLine line_;
  const ReadOptions& options_;
  Problems& problems_;
  std::vector<std::string>& warnings_;
  ColumnFactors factors_;
  std::vector<Heading> headings_;
  std::vector<CsvField> fields_;
  std::map<int, std::string> below_;  ///< unit in the row of units, by the column of a heading with brackets
  std::vector<std::string> unknown_;  ///< headings of no known column
};

}  // namespace

CsvHeader read_csv_header(const Layout& layout, const ReadOptions& options, Problems& problems,
                          std::vector<std::string>& warnings) {
  return HeaderReader(layout, options, problems, warnings).run();
}

}  // namespace dualdamp::identify
