#include "identify/csv_reader.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/units.hpp"

namespace dualdamp::identify {

namespace {

constexpr std::size_t largest_file = std::size_t{256} << 20;
constexpr std::size_t most_problems = 20;
constexpr std::size_t most_lines = 10'000'000;
constexpr std::size_t most_columns = 1000;
constexpr std::size_t longest_excerpt = 200;  ///< bytes of the file quoted in one message

/// A column a record may have.
struct KnownColumn {
  std::string_view name;
  std::string_view alias;
  std::string_view unit;  ///< SI; empty for a label
};

constexpr std::array<KnownColumn, 8> known_columns = {{{"t", "time", "s"},
                                                       {"Y", "", "m"},
                                                       {"x", "position", "m"},
                                                       {"y", "", "m"},
                                                       {"v", "", "m/s"},
                                                       {"a", "", "m/s^2"},
                                                       {"force", "", "N"},
                                                       {"sweep", "", ""}}};

constexpr std::string_view allowed_columns = "Y and x (with or without sweep), or x alone (with or without t)";

const KnownColumn* known_column(std::string_view name) {
  const auto found = std::find_if(known_columns.begin(), known_columns.end(), [name](const KnownColumn& known) {
    return name == known.name || (!known.alias.empty() && name == known.alias);
  });
  return found == known_columns.end() ? nullptr : &*found;
}

/// The beginning of `text` that fits into a message, cut between characters.
std::string excerpt(std::string_view text) {
  if (text.size() <= longest_excerpt) return std::string(text);
  std::size_t end = longest_excerpt;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // inside a character
  return std::string(text.substr(0, end));
}

std::string quoted(std::string_view text) { return "'" + excerpt(text) + "'"; }

/// Collects problems and ends the reading when there are too many to be read by anyone.
class Problems {
 public:
  void add(core::Diagnostic diagnostic) {
    diagnostics_.push_back(std::move(diagnostic));
    if (diagnostics_.size() < most_problems) return;
    core::Diagnostic end;
    end.place.file = diagnostics_.back().place.file;
    end.message = "too many problems; those after the first " + std::to_string(most_problems) + " are not listed";
    diagnostics_.push_back(std::move(end));
    throw core::InputError(diagnostics_);
  }

  void throw_if_any() const {
    if (!diagnostics_.empty()) throw core::InputError(diagnostics_);
  }

 private:
  std::vector<core::Diagnostic> diagnostics_;
};

[[noreturn]] void refuse_file(const std::string& path, std::string message) {
  core::Diagnostic problem;
  problem.place.file = path;
  problem.message = std::move(message);
  throw core::InputError(std::move(problem));
}

struct SourceLine {
  std::string_view text;  ///< without its line end
  int number = 0;
};

/// One field of a line; `column` counts from 1 where its content begins.
struct Field {
  std::string text;
  int column = 1;
};

/// A named file and the line at hand, for messages.
class Places {
 public:
  explicit Places(std::string file) : file_(std::move(file)) {}

  [[nodiscard]] core::SourcePlace at(const SourceLine& line, int column) const {
    return {file_, line.number, column, excerpt(line.text)};
  }
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  std::string file_;
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Length of the UTF-8 character at the start of `text`; 0 when there is none.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (byte(i) < 0x80 || byte(i) > 0xBF) return 0;
  // Overlong forms, surrogates and code points beyond the last one.
  if (lead == 0xE0 && byte(1) < 0xA0) return 0;
  if (lead == 0xED && byte(1) > 0x9F) return 0;
  if (lead == 0xF0 && byte(1) < 0x90) return 0;
  if (lead == 0xF4 && byte(1) > 0x8F) return 0;
  return length;
}

/// Text means UTF-8 without control characters: anything else would end up in messages and in JSON.
void refuse_binary(std::string_view text, const std::string& name) {
  int line = 1;
  std::size_t line_start = 0;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    const bool control = (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7F;
    const std::size_t length = control ? 0 : utf8_length(text.substr(i));
    if (length == 0) {
      core::Diagnostic problem;
      problem.place = {name, line, static_cast<int>(std::min<std::size_t>(i - line_start, 1'000'000)) + 1, {}};
      problem.message = control ? "the file is not text: it holds a control character" : "the text is not UTF-8";
      problem.allowed = "a text file in UTF-8";
      throw core::InputError(std::move(problem));
    }
    if (c == '\n') {
      ++line;
      line_start = i + 1;
    }
    i += length;
  }
}

std::vector<SourceLine> split_lines(std::string_view text, const std::string& name) {
  std::vector<SourceLine> lines;
  int number = 1;
  for (std::size_t start = 0; start < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    std::string_view line = text.substr(start, end - start);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    lines.push_back({line, number});
    start = end + 1;
    if (lines.size() > most_lines) refuse_file(name, "the file has more than ten million lines");
  }
  while (!lines.empty() && trimmed(lines.back().text).empty()) lines.pop_back();
  return lines;
}

/// The separator that stands in the header: a tab, else a semicolon, else a comma.
char separator_of(std::string_view header) {
  for (const char candidate : {'\t', ';'}) {
    bool quoted = false;
    for (const char c : header) {
      if (c == '"') quoted = !quoted;
      if (c == candidate && !quoted) return candidate;
    }
  }
  return ',';
}

/// Fields of a line; a field in double quotes may hold the separator, and a quote as two quotes.
std::optional<std::vector<Field>> split_fields(const SourceLine& line, char separator, const Places& places,
                                               Problems& problems) {
  std::vector<Field> fields;
  const std::string_view text = line.text;
  std::size_t at = 0;
  while (true) {
    while (at < text.size() && (text[at] == ' ' || (text[at] == '\t' && separator != '\t'))) ++at;
    Field field;
    field.column = static_cast<int>(at) + 1;
    if (at < text.size() && text[at] == '"') {
      bool closed = false;
      for (++at; at < text.size() && !closed; ++at) {
        const bool doubled = text[at] == '"' && at + 1 < text.size() && text[at + 1] == '"';
        closed = text[at] == '"' && !doubled;
        if (!closed) field.text += text[at];
        if (doubled) ++at;
      }
      const std::size_t end = std::min(text.find(separator, at), text.size());
      if (!closed || !trimmed(text.substr(at, end - at)).empty()) {
        problems.add({places.at(line, field.column), "a quoted field does not end with its quote", {}, {}, {}});
        return std::nullopt;
      }
      at = end;
    } else {
      const std::size_t end = std::min(text.find(separator, at), text.size());
      field.text = std::string(trimmed(text.substr(at, end - at)));
      at = end;
    }
    fields.push_back(std::move(field));
    if (at >= text.size()) return fields;
    if (fields.size() == most_columns) {
      problems.add({places.at(line, 1), "the line has more than 1000 fields", {}, {}, {}});
      return std::nullopt;
    }
    ++at;
  }
}

/// A column of the file: which known column it is and the factor to SI.
struct Column {
  const KnownColumn* known = nullptr;
  double factor = 1.0;
};

/// "x [mm]" taken apart.
struct Heading {
  std::string name;
  std::string unit;
  bool well_formed = true;
};

Heading parse_heading(std::string_view text) {
  const std::size_t open = text.find('[');
  if (open == std::string_view::npos)
    return {std::string(trimmed(text)), {}, text.find(']') == std::string_view::npos};
  const std::string_view rest = text.substr(open + 1);
  const std::size_t close = rest.find(']');
  return {std::string(trimmed(text.substr(0, open))),
          close == std::string_view::npos ? std::string{} : std::string(trimmed(rest.substr(0, close))),
          close != std::string_view::npos && close + 1 == rest.size()};
}

class Table {
 public:
  Table(std::string_view text, const std::string& name) : places_(name) {
    refuse_binary(text, name);
    lines_ = split_lines(text, name);
    read_header();
    problems_.throw_if_any();
  }

  [[nodiscard]] bool has(std::string_view name) const { return index_of(name).has_value(); }

  CsvRecord read() {
    CsvRecord result;
    result.warnings = std::move(warnings_);
    if (has("Y")) {
      warn_unused({"Y", "x", "sweep"}, result.warnings);
      result.record.pairs = read_pairs();
    } else {
      warn_unused({"x", "t"}, result.warnings);
      result.record.decay = read_decay();
    }
    problems_.throw_if_any();
    return result;
  }

 private:
  void read_header() {
    while (header_ < lines_.size() && (trimmed(lines_[header_].text).empty() || lines_[header_].text[0] == '#'))
      ++header_;
    if (header_ >= lines_.size()) {
      problems_.add({{places_.file(), 0, 0, {}}, "the file holds no header", std::string(allowed_columns), {}, {}});
      return;
    }
    const SourceLine& line = lines_[header_];
    separator_ = separator_of(line.text);
    const auto fields = split_fields(line, separator_, places_, problems_);
    if (!fields) return;
    for (const Field& field : *fields) columns_.push_back(read_heading(line, field));
    if (!has("x")) {
      problems_.add(
          {places_.at(line, 1), "there is no column x", std::string(allowed_columns), excerpt(line.text), {}});
    }
    if (header_ + 1 == lines_.size())
      problems_.add({places_.at(line, 0), "there is a header and no data below it", {}, {}, {}});
  }

  Column read_heading(const SourceLine& line, const Field& field) {
    const Heading heading = parse_heading(field.text);
    const KnownColumn* known = known_column(heading.name);
    if (!known) {
      warnings_.push_back("column '" + excerpt(field.text) + "' is not known and is ignored");
      return {};
    }
    const core::SourcePlace place = places_.at(line, field.column);
    if (!heading.well_formed) {
      problems_.add({place,
                     "the unit of column " + heading.name + " is not in square brackets",
                     "'name' or 'name [unit]'",
                     excerpt(field.text),
                     {}});
    } else if (index_of(known->name)) {
      problems_.add(
          {place, "column " + std::string(known->name) + " stands there twice", {}, excerpt(field.text), {}});
    } else {
      return {known, factor_of(*known, heading, field, place)};
    }
    return {known, 1.0};
  }

  double factor_of(const KnownColumn& known, const Heading& heading, const Field& field,
                   const core::SourcePlace& place) {
    if (heading.unit.empty()) return 1.0;
    if (known.unit.empty()) {
      problems_.add(
          {place, "column " + heading.name + " is a label and has no unit", heading.name, excerpt(field.text), {}});
      return 1.0;
    }
    const core::QuantityText factor = core::unit_factor(heading.unit, known.unit);
    if (factor.value) return *factor.value;
    problems_.add({place, "the unit of column " + heading.name + ": " + factor.fault,
                   core::describe_dimension(known.unit), excerpt(field.text), factor.suggestion});
    return 1.0;
  }

  [[nodiscard]] std::optional<std::size_t> index_of(std::string_view name) const {
    for (std::size_t i = 0; i < columns_.size(); ++i)
      if (columns_[i].known && columns_[i].known->name == name) return i;
    return std::nullopt;
  }

  void warn_unused(std::initializer_list<std::string_view> used, std::vector<std::string>& warnings) const {
    for (const Column& column : columns_) {
      if (!column.known || std::find(used.begin(), used.end(), column.known->name) != used.end()) continue;
      warnings.push_back("column " + std::string(column.known->name) + " is not used");
    }
  }

  /// Calls `take(line, fields)` for every row with as many fields as the header.
  template <typename Take>
  void for_each_row(Take take) {
    for (std::size_t i = header_ + 1; i < lines_.size(); ++i) {
      const SourceLine& line = lines_[i];
      const auto fields = split_fields(line, separator_, places_, problems_);
      if (!fields) continue;
      if (fields->size() != columns_.size()) {
        problems_.add({places_.at(line, 1),
                       "the row does not have as many fields as the header",
                       std::to_string(columns_.size()) + " fields",
                       std::to_string(fields->size()) + " fields",
                       {}});
        continue;
      }
      take(line, *fields);
    }
  }

  /// The number of a field in SI; NaN after a problem, which keeps the record from being used.
  double number(const SourceLine& line, const Field& field, std::size_t column) {
    const double problem = std::nan("");
    std::string_view text = field.text;
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    double value = 0.0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    const std::string name(columns_[column].known->name);
    const bool comma = field.text.find(',') != std::string::npos;
    if (fault == std::errc::invalid_argument || end != text.data() + text.size()) {
      problems_.add({places_.at(line, field.column),
                     "the field of column " + name + " is not a number",
                     comma ? "a decimal number with a point" : "a decimal number",
                     field.text.empty() ? "an empty field" : quoted(field.text),
                     {}});
      return problem;
    }
    value *= columns_[column].factor;
    if (fault == std::errc::result_out_of_range || !std::isfinite(value)) {
      problems_.add({places_.at(line, field.column),
                     "the field of column " + name + " is not a finite number",
                     "a number of double precision",
                     quoted(field.text),
                     {}});
      return problem;
    }
    return value;
  }

  double positive_amplitude(const SourceLine& line, const Field& field, std::size_t column) {
    const double value = number(line, field, column);
    if (value < 0.0) {
      problems_.add({places_.at(line, field.column),
                     "the amplitude of column " + std::string(columns_[column].known->name) + " is negative",
                     "a number not below zero",
                     quoted(field.text),
                     {}});
    }
    return value;
  }

  PairRecord read_pairs() {
    const std::size_t Y = *index_of("Y");
    const std::size_t x = *index_of("x");
    const std::optional<std::size_t> sweep = index_of("sweep");
    PairRecord record;
    for_each_row([&](const SourceLine& line, const std::vector<Field>& fields) {
      Pair pair;
      pair.Y = positive_amplitude(line, fields[Y], Y);
      pair.x = positive_amplitude(line, fields[x], x);
      if (sweep) pair.sweep = fields[*sweep].text;
      pair.number = static_cast<int>(record.pairs.size()) + 1;
      record.pairs.push_back(std::move(pair));
    });
    return record;
  }

  DecayRecord read_decay() {
    const std::size_t x = *index_of("x");
    const std::optional<std::size_t> t = index_of("t");
    DecayRecord record;
    for_each_row([&](const SourceLine& line, const std::vector<Field>& fields) {
      record.extremes.push_back(number(line, fields[x], x));
      if (!t) return;
      const double time = number(line, fields[*t], *t);
      if (!record.times.empty() && time <= record.times.back()) {
        problems_.add({places_.at(line, fields[*t].column),
                       "the time does not increase",
                       "a time after the row above",
                       "'" + fields[*t].text + "'",
                       {}});
      }
      record.times.push_back(time);
    });
    return record;
  }

  Places places_;
  Problems problems_;
  std::vector<SourceLine> lines_;
  std::size_t header_ = 0;  ///< index of the header line
  char separator_ = ',';
  std::vector<Column> columns_;
  std::vector<std::string> warnings_;
};

/// Reads at most `largest_file` bytes, from pipes as well as from files.
std::string load(const std::string& path) {
  const auto close = [](std::FILE* file) { std::fclose(file); };
  const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "rb"), close);
  if (!file) refuse_file(path, "the file cannot be opened: " + std::generic_category().message(errno));
  std::string text;
  std::array<char, 1 << 16> buffer{};
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file.get())) {
    text.append(buffer.data(), count);
    if (text.size() > largest_file) refuse_file(path, "the file is larger than 256 MiB");
  }
  if (std::ferror(file.get()) != 0)
    refuse_file(path, "the file cannot be read: " + std::generic_category().message(errno));
  return text;
}

}  // namespace

CsvRecord parse_csv(std::string_view text, const std::string& name) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.substr(0, byte_order_mark.size()) == byte_order_mark) text.remove_prefix(byte_order_mark.size());
  return Table(text, name).read();
}

CsvRecord read_csv(const std::string& path) { return parse_csv(load(path), path); }

}  // namespace dualdamp::identify
