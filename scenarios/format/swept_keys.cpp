#include "scenarios/format/swept_keys.hpp"

#include <algorithm>
#include <utility>

#include "core/numbers.hpp"
#include "scenarios/format/keys.hpp"
#include "scenarios/format/limits.hpp"
#include "scenarios/format/reader.hpp"
#include "scenarios/format/values.hpp"

namespace dualdamp::scenarios {

namespace {

constexpr std::string_view forms =
    "a list of numbers with their units, such as [1 N, 2 N], or {from: 1 N, to: 5 N, count: 9}";

Section range_section() {
  return {{text("from", "first value").required(), text("to", "last value").required(),
           integer("count", "number of values, both ends included").required().at_least(2).at_most(max_swept),
           words("spacing", {"linear", "log"}, "equal steps, or equal ratios").with_fallback("linear")}};
}

class SweepReader {
 public:
  SweepReader(const Document& document, std::vector<core::Diagnostic>& problems)
      : document_(document), problems_(problems) {}

  SweptKeys read(const Entry& entry) {
    SweptKeys result{entry.place, {}};
    if (entry.value.kind == Node::Kind::null) return result;
    if (entry.value.kind != Node::Kind::map || entry.value.entries.empty() || entry.value.entries.size() > 2) {
      complain(entry.value.place, "'sweep' needs one or two keys",
               "a map of paths and their values: " + std::string(forms),
               entry.value.kind == Node::Kind::map ? std::to_string(entry.value.entries.size()) : "");
      return result;
    }
    for (const Entry& key : entry.value.entries) {
      if (key.value.kind == Node::Kind::null) continue;
      result.keys.push_back({key.key, key.place, {}, {}});
      read(key.value, result.keys.back());
    }
    if (result.keys.size() == 2 && result.keys.front().path == result.keys.back().path)
      complain(result.keys.back().place, "'" + result.keys.back().path + "' is swept twice");
    return result;
  }

 private:
  void complain(Place place, std::string message, std::string allowed = {}, std::string found = {}) {
    problems_.push_back({document_.locate(place), std::move(message), std::move(allowed), std::move(found), {}});
  }

  void read(const Node& node, SweptKey& key) {
    if (node.kind == Node::Kind::sequence)
      read_list(node, key);
    else if (node.kind == Node::Kind::map)
      read_range(node, key);
    else
      complain(node.place, "'sweep." + key.path + "' has one value only", std::string(forms), shortened(node.text));
  }

  /// All values must be numbers in one unit, so that a table can show them in it.
  bool is_number(const Node& node, SweptKey& key, bool is_first) {
    const std::string where = "'sweep." + key.path + "'";
    if (node.kind == Node::Kind::null) return false;
    if (node.kind != Node::Kind::scalar || core::read_number(node.text).length == 0) {
      complain(node.place, where + " takes numbers only", std::string(forms),
               node.kind == Node::Kind::scalar ? shortened(node.text) : "");
      return false;
    }
    if (const core::NumberText number = core::read_number(node.text); !number.value) {
      complain(node.place, where + ": the number '" + shortened(node.text) + "' " + number.fault,
               std::string(forms));
      return false;
    }
    const std::string unit = written_unit(node.text);
    const std::string_view behind = std::string_view(node.text).substr(core::read_number(node.text).length);
    if (behind.find('+') != std::string_view::npos || behind.find("±") != std::string_view::npos) {
      complain(node.place, where + " takes no uncertainty", std::string(forms), shortened(node.text));
      return false;
    }
    if (is_first) key.unit = unit;
    if (unit == key.unit) return true;
    complain(node.place, where + " has values in different units",
             key.unit.empty() ? "all without unit" : "all in " + key.unit, shortened(node.text));
    return false;
  }

  void read_list(const Node& node, SweptKey& key) {
    if (node.items.empty() || static_cast<double>(node.items.size()) > max_swept)
      return complain(node.place, "'sweep." + key.path + "' has the wrong number of values",
                      "1 to " + core::format_number(max_swept, 6), std::to_string(node.items.size()));
    for (const Node& item : node.items)
      if (is_number(item, key, key.values.empty())) key.values.push_back(item);
  }

  void read_range(const Node& node, SweptKey& key) {
    const Document part = document_.part(node);
    Reading reading = scenarios::read(part, range_section());
    problems_.insert(problems_.end(), reading.problems.begin(), reading.problems.end());
    if (!reading.problems.empty() || !reading.values.contains("from") || !reading.values.contains("to") ||
        !reading.values.contains("count"))
      return;
    const Node& from = node.find("from")->value;
    const Node& to = node.find("to")->value;
    const bool are_numbers = is_number(from, key, true) && is_number(to, key, false);
    if (!are_numbers) return;
    key.values = {from, to};
    const bool is_log = reading.values.at("spacing") == "log";
    for (const Node& end : key.values)
      if (is_log && *core::read_number(end.text).value <= 0.0)
        return complain(end.place, "equal ratios do not reach zero", "> 0", shortened(end.text));
    add_steps(node, reading.values, key);
  }

  /// The values between the ends.
  static void add_steps(const Node& node, Json range, SweptKey& key) {
    range["from"] = key.number(0);
    range["to"] = key.number(1);
    const std::vector<double> numbers = grid_values(range);
    Node step = key.values.front();
    step.place = node.place;
    std::vector<Node> values = {key.values.front()};
    for (std::size_t i = 1; i + 1 < numbers.size(); ++i) {
      step.text = core::format_number(numbers[i]) + (key.unit.empty() ? "" : " " + key.unit);
      values.push_back(step);
    }
    values.push_back(key.values.back());
    key.values = std::move(values);
  }

  const Document& document_;
  std::vector<core::Diagnostic>& problems_;
};

}  // namespace

double SweptKey::number(std::size_t i) const { return core::read_number(values[i].text).value.value(); }

std::optional<SweptKeys> take_swept_keys(Document& document, std::vector<core::Diagnostic>& problems) {
  const std::optional<Entry> entry = document.take("sweep");
  if (!entry) return std::nullopt;
  return SweepReader(document, problems).read(*entry);
}

}  // namespace dualdamp::scenarios
