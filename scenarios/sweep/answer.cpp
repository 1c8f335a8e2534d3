#include "scenarios/sweep/answer.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <string_view>

#include "core/numbers.hpp"
#include "scenarios/format/json.hpp"
#include "scenarios/format/values.hpp"
#include "scenarios/results/table.hpp"

namespace dualdamp::scenarios {

namespace {

using core::ExitStatus;

/// The result of a run as one JSON value, which includes the rows of its tables.
Json whole_result(const RunResult& run) {
  Json result = Json::parse(run.result);
  for (const Table& table : run.tables) {
    if (table.key.empty() || !result.is_object() || !result.contains(table.key)) continue;
    Json rows = Json::array();
    for (std::size_t row = 0; row < table.size(); ++row) {
      Json item = Json::object();
      for (const Column& column : table.columns)
        if (const std::string cell = json_cell(column, row); !cell.empty()) item[column.name] = Json::parse(cell);
      rows.push_back(std::move(item));
    }
    result[table.key] = std::move(rows);
  }
  return result;
}

/// The text with # for each number, so that warnings of points that differ in numbers only become one.
std::string without_numbers(std::string_view text) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = is_digit(text[at]) ? at + core::read_number(text.substr(at)).length : at;
    result += end > at ? '#' : text[at];
    at = std::max(end, at + 1);
  }
  return result;
}

/// The value at a path; null if there is none.
const Json& value_at(const Json& json, const std::string& path) {
  static const Json nothing;
  const Json* value = find_value(json, path);
  return value == nullptr ? nothing : *value;
}

/// The path of the unit that may stand beside the value at `path`.
std::string path_of_unit(const std::string& path) { return path.substr(0, path.find_last_of('.') + 1) + "unit"; }

/// A column of JSON values, of which some may be missing.
class ColumnBuilder {
 public:
  ColumnBuilder(std::string name, std::string unit)
      : name_(std::move(name)), is_without_unit_(unit.empty()), unit_(unit == "1" ? "" : std::move(unit)) {}

  void add(const Json& value) {
    // Lists have separate tables.
    const bool is_value = !value.is_null() && !value.is_structured();
    is_empty_ = is_empty_ && !is_value;
    is_text_ = is_text_ || value.is_string();
    is_truth_ = is_truth_ || value.is_boolean();
    is_count_ = is_count_ && (!is_value || value.is_number_integer());
    numbers_.push_back(!is_value || value.is_string() ? none
                       : value.is_boolean()           ? (value.get<bool>() ? 1.0 : 0.0)
                                                      : value.get<double>());
    texts_.push_back(!is_value ? "" : value.is_string() ? value.get<std::string>() : value.dump());
  }

  /// The unit that stands beside the next value.
  void add_unit(const Json& unit) {
    if (is_without_unit_) row_units_.push_back(unit.is_string() ? unit.get<std::string>() : "");
  }

  [[nodiscard]] bool is_empty() const { return is_empty_; }
  [[nodiscard]] bool is_text() const { return is_text_; }

  Column take() {
    Column column{.name = std::move(name_), .unit = std::move(unit_)};
    if (is_text_) {
      column.kind = CellKind::text;
      column.texts = std::move(texts_);
    } else {
      column.kind = is_truth_ ? CellKind::truth : is_count_ ? CellKind::count : CellKind::number;
      column.numbers = std::move(numbers_);
      const bool has_units = std::ranges::any_of(row_units_, [](const auto& unit) { return !unit.empty(); });
      if (column.kind == CellKind::number && has_units) column.row_units = std::move(row_units_);
    }
    return column;
  }

 private:
  std::string name_;
  bool is_without_unit_;
  std::string unit_;
  std::vector<std::string> row_units_;
  std::vector<double> numbers_;
  std::vector<std::string> texts_;
  bool is_empty_ = true;
  bool is_text_ = false;
  bool is_truth_ = false;
  bool is_count_ = true;
};

class SweepAnswer {
 public:
  SweepAnswer(const std::vector<std::string>& lines, const std::vector<SweptColumn>& keys,
              const std::vector<ResultField>& fields, const std::vector<std::string_view>& main)
      : keys_(keys), fields_(fields), main_(main) {
    for (const std::string& line : lines) {
      Json point = Json::parse(line);
      point.erase("case");
      point.erase("check");
      points_.push_back(std::move(point));
    }
  }

  Answer take() {
    Answer answer;
    add_tables(answer);
    add_status(answer);
    add_warnings(answer);
    add_verification(answer);
    answer.result["sweep"] = std::move(points_);
    return answer;
  }

 private:
  [[nodiscard]] static ExitStatus status_of(const Json& point) {
    return static_cast<ExitStatus>(point.at("status").get<int>());
  }

  void add_status(Answer& answer) const {
    const auto count = [&](auto condition) {
      return static_cast<std::size_t>(std::ranges::count_if(points_, condition));
    };
    const auto is_failed = [](const Json& point) {
      return status_of(point) != ExitStatus::done && status_of(point) != ExitStatus::check_failed;
    };
    const std::size_t failed = count(is_failed);
    const auto first = std::ranges::find_if(points_, is_failed);
    if (failed > 0) {
      const auto number = static_cast<std::size_t>(first - points_.begin());
      answer.failure = (failed == points_.size() ? "all " : std::to_string(failed) + " of ") +
                       std::to_string(points_.size()) + " points failed; first " + describe_point(keys_, number) +
                       ": " + first->value("reason", "");
    }
    if (failed > 0)
      answer.status = failed == points_.size() ? ExitStatus::numerical_failure : ExitStatus::some_cases_failed;
    else if (count([](const Json& point) { return status_of(point) != ExitStatus::done; }) > 0)
      answer.status = ExitStatus::check_failed;
  }

  /// Each warning once.
  void add_warnings(Answer& answer) const {
    struct Group {
      std::string text;  ///< of the first point
      std::size_t first = 0;
      std::size_t points = 0;
      bool one_text = true;
    };
    std::vector<Group> groups;
    std::map<std::string, std::size_t> found;
    for (std::size_t i = 0; i < points_.size(); ++i)
      for (const Json& warning : points_.at(i).value("warnings", Json::array())) {
        const auto text = warning.get<std::string>();
        const auto place = found.emplace(without_numbers(text), groups.size());
        if (place.second) groups.push_back({.text = text, .first = i});
        Group& group = groups[place.first->second];
        ++group.points;
        group.one_text = group.one_text && text == group.text;
      }
    for (const Group& group : groups) {
      const std::string others = group.one_text ? " points; first " : " points, with numbers of their own; first ";
      const std::string count = group.points > 1 ? std::to_string(group.points) + others : "";
      answer.warnings.push_back(group.text + " (" + count + describe_point(keys_, group.first) + ")");
    }
  }

  /// The verification of the point that is nearest to its tolerance, with the counts of all points.
  void add_verification(Answer& answer) const {
    std::size_t verified = 0;
    std::size_t apart = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!points_.at(i).contains("verification")) continue;
      Verification one = verification_of(points_.at(i).at("verification"));
      ++verified;
      if (!one.agrees) ++apart;
      const std::string place = describe_point(keys_, i);
      one.engine += ", at " + place;
      if (!one.quantity.empty()) one.quantity = "sweep[" + std::to_string(i) + "].result." + one.quantity;
      if (!one.reason.empty()) one.reason = place + ": " + one.reason;
      answer.verification = answer.verification ? merged(*std::move(answer.verification), std::move(one)) : one;
    }
    if (verified == 0) return;
    const std::string of_all = " of " + std::to_string(verified) + (verified == 1 ? " point" : " points");
    answer.verification->engine += ", one" + of_all;
    if (apart > 0)
      answer.verification->reason =
          std::to_string(apart) + of_all + " without agreement; first " + answer.verification->reason;
  }

  [[nodiscard]] Column swept_column(const SweptColumn& key, const std::vector<std::size_t>& rows) const {
    return column(key.path, key.unit, rows, [&](std::size_t point) { return key.numbers[point]; });
  }

  /// Single values by field, those of short lists one by one.
  [[nodiscard]] std::vector<ColumnBuilder> columns_of(const ResultField& field) const {
    const std::size_t bracket = field.path.find("[]");
    std::vector<ColumnBuilder> columns;
    if (field.is_for_programs) return columns;
    if (bracket == std::string::npos) {
      ColumnBuilder column(field.path, field.unit);
      for (const Json& point : points_) {
        column.add(value_at(point.at("result"), field.path));
        column.add_unit(value_at(point.at("result"), path_of_unit(field.path)));
      }
      columns.push_back(std::move(column));
    } else if (bracket + 2 == field.path.size()) {
      constexpr std::size_t longest = 8;
      const std::string path = field.path.substr(0, bracket);
      std::size_t length = 0;
      for (const Json& point : points_) length = std::max(length, value_at(point.at("result"), path).size());
      for (std::size_t i = 0; length <= longest && i < length; ++i) {
        ColumnBuilder column(path + "[" + std::to_string(i) + "]", field.unit);
        for (const Json& point : points_) {
          const Json& list = value_at(point.at("result"), path);
          column.add(list.is_array() && i < list.size() ? list.at(i) : Json());
        }
        columns.push_back(std::move(column));
      }
    }
    return columns;
  }

  [[nodiscard]] static bool is_about_the_computation(const ResultField& field) {
    return field.path.starts_with("certificate.");
  }

  /// The numbers, those by which the analysis is drawn first, then the words.
  [[nodiscard]] std::vector<Column> scalar_columns() const {
    std::vector<ResultField> order;
    for (const std::string_view path : main_)
      if (const auto field = std::ranges::find(fields_, path, &ResultField::path); field != fields_.end())
        order.push_back(*field);
    for (const bool last : {false, true})
      for (const ResultField& field : fields_)
        if (std::ranges::find(main_, field.path) == main_.end() && is_about_the_computation(field) == last)
          order.push_back(field);
    std::vector<Column> numbers;
    std::vector<Column> words;
    for (const ResultField& field : order)
      for (ColumnBuilder& column : columns_of(field))
        if (!column.is_empty()) (column.is_text() ? words : numbers).push_back(column.take());
    std::ranges::move(words, std::back_inserter(numbers));
    return numbers;
  }

  void add_tables(Answer& answer) const {
    std::vector<std::size_t> all(points_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    Table table{.name = "sweep", .is_long = true};
    for (const SweptColumn& key : keys_) table.columns.push_back(swept_column(key, all));
    ColumnBuilder status("status", "");
    ColumnBuilder reason("reason", "");
    for (const Json& point : points_) {
      status.add(point.at("status"));
      reason.add(point.contains("reason") ? point.at("reason") : Json());
    }
    table.columns.push_back(status.take());
    std::ranges::move(scalar_columns(), std::back_inserter(table.columns));
    if (!reason.is_empty()) table.columns.push_back(reason.take());
    answer.tables.push_back(for_people(table));
    answer.tables.push_back(std::move(table));
    add_lists(answer);
  }

  /// Only as many columns as fit on a terminal.
  [[nodiscard]] Table for_people(const Table& table) const {
    constexpr std::size_t numbers = 4;
    Table shown = table;
    const bool has_reasons = table.columns.back().name == "reason";
    shown.is_long = shown.is_file = false;
    std::erase_if(shown.columns, [](const Column& column) { return column.name.starts_with("certificate."); });
    shown.columns.resize(std::min(shown.columns.size(), keys_.size() + 1 + numbers));
    if (has_reasons && shown.columns.back().name != "reason") shown.columns.push_back(table.columns.back());
    return shown;
  }

  /// The lists of all points, one below the other.
  void add_lists(Answer& answer) const {
    std::vector<std::string> lists;
    for (const ResultField& field : fields_) {
      const std::size_t bracket = field.path.find("[].");
      if (bracket == std::string::npos) continue;
      const std::string list = field.path.substr(0, bracket);
      if (std::ranges::find(lists, list) == lists.end()) lists.push_back(list);
    }
    for (const std::string& list : lists) {
      std::vector<std::size_t> rows;
      for (std::size_t i = 0; i < points_.size(); ++i)
        rows.insert(rows.end(), value_at(points_.at(i).at("result"), list).size(), i);
      if (!rows.empty()) answer.tables.push_back(list_table(list, rows));
    }
  }

  /// Paths inside an item, with units, in the order of the first item, which is that of the table of the analysis.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> columns_of_list(const std::string& list,
                                                                                 const Json& point) const {
    std::vector<std::string> keys;
    for (const auto& [key, value] : value_at(point.at("result"), list).at(0).items()) keys.push_back(key);
    std::vector<std::pair<std::string, std::string>> columns;
    for (const ResultField& field : fields_) {
      if (!field.path.starts_with(list + "[].")) continue;
      const std::string inner = field.path.substr(list.size() + 3);
      if (inner.find("[]") == std::string::npos) columns.emplace_back(inner, field.unit);
    }
    std::ranges::stable_sort(columns, {}, [&](const auto& column) {
      return std::ranges::find(keys, column.first.substr(0, column.first.find('.'))) - keys.begin();
    });
    return columns;
  }

  [[nodiscard]] Table list_table(const std::string& list, const std::vector<std::size_t>& rows) const {
    Table table{.name = "sweep_" + list, .is_long = true};
    Column number = column("point", "", rows, [](std::size_t point) { return static_cast<double>(point); });
    number.kind = CellKind::count;
    table.columns.push_back(std::move(number));
    for (const SweptColumn& key : keys_) table.columns.push_back(swept_column(key, rows));
    for (const auto& [inner, unit] : columns_of_list(list, points_.at(rows.front()))) {
      ColumnBuilder column(inner, unit);
      for (const Json& point : points_)
        if (const Json& items = value_at(point.at("result"), list); items.is_array())
          for (const Json& item : items) {
            column.add(value_at(item, inner));
            column.add_unit(value_at(item, path_of_unit(inner)));
          }
      if (!column.is_empty()) table.columns.push_back(column.take());
    }
    return table;
  }

  Json points_ = Json::array();
  const std::vector<SweptColumn>& keys_;
  const std::vector<ResultField>& fields_;
  const std::vector<std::string_view>& main_;
};

}  // namespace

std::string line_of(std::size_t number, const std::vector<SweptColumn>& keys, const RunResult& run) {
  Json line = {{"case", number}, {"values", Json::object()}};
  for (const SweptColumn& key : keys) line["values"][key.path] = key.si[number];
  line["status"] = static_cast<int>(run.status);
  line["result"] = whole_result(run);
  std::string reason = run.failure;
  if (reason.empty() && run.verification && !run.verification->agrees) reason = run.verification->reason;
  if (!reason.empty()) line["reason"] = std::move(reason);
  if (!run.warnings.empty()) line["warnings"] = run.warnings;
  if (run.verification) line["verification"] = json_of(*run.verification);
  return line.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Answer answer_of_sweep(const std::vector<std::string>& lines, const std::vector<SweptColumn>& keys,
                       const std::vector<ResultField>& fields, const std::vector<std::string_view>& main) {
  return SweepAnswer(lines, keys, fields, main).take();
}

std::vector<ResultField> fields_of_sweep(const std::vector<ResultField>& fields) {
  std::vector<ResultField> result = {{"sweep[].status", "", "exit status of a run of this point alone"},
                                     {"sweep[].reason", "", "without a result, or with a fault: the reason"}};
  for (ResultField field : fields) {
    field.path = "sweep[].result." + field.path;
    result.push_back(std::move(field));
  }
  return result;
}

std::string describe_point(const std::vector<SweptColumn>& keys, std::size_t number) {
  std::string text;
  for (const SweptColumn& key : keys)
    text += (text.empty() ? "" : ", ") + key.path + " = " + core::format_number(key.numbers[number]) +
            (key.unit.empty() ? "" : " " + key.unit);
  return text;
}

}  // namespace dualdamp::scenarios
