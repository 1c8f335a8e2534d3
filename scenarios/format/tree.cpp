#include "scenarios/format/tree.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>
#include <utility>

#include "core/utf8.hpp"
#include "scenarios/format/limits.hpp"
#include "scenarios/format/text_checks.hpp"

namespace dualdamp::scenarios {

using core::Diagnostic;
using core::InputError;

std::string shortened(std::string_view text) { return core::shortened(text, 60); }

Node map_of(const std::string& key, const Node& value) {
  Node map;
  map.kind = Node::Kind::map;
  map.place = value.place;
  map.entries.push_back({key, value.place, value});
  return map;
}

Node list_of_names(const Node& node) {
  if (node.kind != Node::Kind::scalar) return node;
  Node list;
  list.kind = Node::Kind::sequence;
  list.place = node.place;
  list.key_place = node.key_place;
  std::istringstream in(node.text);
  for (std::string name; std::getline(in, name, ',');) {
    const std::size_t first = name.find_first_not_of(" \t");
    if (first == std::string::npos) continue;
    Node item;
    item.kind = Node::Kind::scalar;
    item.place = node.place;
    item.text = name.substr(first, name.find_last_not_of(" \t") - first + 1);
    list.items.push_back(std::move(item));
  }
  return list;
}

const Entry* Node::find(std::string_view key) const {
  const auto found = std::ranges::find(entries, key, &Entry::key);
  return found == entries.end() ? nullptr : &*found;
}

namespace {

std::vector<std::size_t> starts_of_lines(std::string_view text) {
  std::vector<std::size_t> starts = {0};
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') starts.push_back(i + 1);
  return starts;
}

/// One step of the path of an override: a key or a list index.
struct Step {
  std::string key;
  std::optional<std::size_t> index;
  std::size_t offset = 0;
};

/// Steps of `a.b[0].c`; nothing when the path is malformed.
std::optional<std::vector<Step>> split_path(std::string_view path) {
  std::vector<Step> steps;
  std::size_t at = 0;
  while (at < path.size()) {
    Step step;
    step.offset = at;
    if (path[at] == '[') {
      const std::size_t end = path.find(']', at);
      if (steps.empty() || end == std::string_view::npos) return std::nullopt;
      std::size_t index = 0;
      const std::from_chars_result result = std::from_chars(path.data() + at + 1, path.data() + end, index);
      if (result.ec != std::errc() || result.ptr != path.data() + end) return std::nullopt;
      step.index = index;
      at = end + 1;
    } else {
      const std::size_t end = std::min(path.find_first_of(".[", at), path.size());
      if (end == at) return std::nullopt;
      step.key = std::string(path.substr(at, end - at));
      at = end;
    }
    steps.push_back(std::move(step));
    if (at < path.size() && path[at] == '.') {
      ++at;
      if (at == path.size() || path[at] == '[') return std::nullopt;
    } else if (at < path.size() && path[at] != '[') {
      return std::nullopt;
    }
  }
  if (steps.empty()) return std::nullopt;
  return steps;
}

/// The node at these steps; nullptr where there is none.
const Node* find(const Node& root, const std::vector<Step>& steps) {
  const Node* node = &root;
  for (const Step& step : steps) {
    if (step.index) {
      node = node->kind == Node::Kind::sequence && *step.index < node->items.size() ? &node->items[*step.index]
                                                                                    : nullptr;
    } else {
      const Entry* entry = node->find(step.key);
      node = entry == nullptr ? nullptr : &entry->value;
    }
    if (node == nullptr) break;
  }
  return node;
}

/// The last of the texts that state this value or a part of it; 0: only the file does.
int last_source(const Node& node) {
  int last = node.place.source;
  for (const Node& item : node.items) last = std::max(last, last_source(item));
  for (const Entry& entry : node.entries) last = std::max(last, last_source(entry.value));
  return last;
}

}  // namespace

Document::Document(std::string name, const std::string& text, core::SettingWords words) : words_(words) {
  sources_.push_back({std::move(name), normalised(text), {}});
  sources_.front().line_starts = starts_of_lines(sources_.front().text);
  const std::string& content = sources_.front().text;
  if (content.size() > max_bytes)
    throw InputError(
        Diagnostic{{sources_.front().name, 0, 0, {}}, "the file is too large", "at most 1 MiB", {}, {}});
  root_ = parse(0, 0);
  if (root_.kind == Node::Kind::map) return;
  // A text without a key that yaml-cpp reads, such as the rows of a data file, leaves problems.
  const bool empty = root_.kind == Node::Kind::null && problems_.empty();
  const std::string schema = "a file that begins with 'schema: " + std::string(schema_name) + "'";
  throw InputError(Diagnostic{locate(root_.kind == Node::Kind::null ? Place{0, 1, 1} : root_.place),
                              empty ? "the file is empty" : "a scenario is a map of keys and values",
                              empty ? schema : schema + "; data files are read by identify, fit and predict",
                              {},
                              {}});
}

Place Document::place_at(int source, std::size_t offset) const {
  const Source& text = sources_[static_cast<std::size_t>(source)];
  const auto after = std::ranges::upper_bound(text.line_starts, offset);
  const std::size_t start = *(after - 1);
  const std::size_t before = core::count_characters(std::string_view(text.text).substr(start, offset - start));
  return {source, static_cast<int>(after - text.line_starts.begin()), static_cast<int>(before) + 1};
}

core::SourcePlace Document::locate(Place place) const {
  const Source& source = sources_[static_cast<std::size_t>(place.source)];
  core::SourcePlace result{source.name, place.line, place.column, {}};
  if (place.line < 1) return result;
  const std::size_t start = source.line_starts[static_cast<std::size_t>(place.line) - 1];
  const std::size_t end = std::min(source.text.find('\n', start), source.text.size());
  // A caret far to the right on a very long line does not help.
  constexpr std::size_t max_line = 240;
  if (end - start <= max_line) result.text = source.text.substr(start, end - start);
  return result;
}

std::optional<std::string> Document::assigned(std::string_view path) const {
  const auto steps = split_path(path);
  const Node* node = steps ? find(root_, *steps) : nullptr;
  const int last = node == nullptr ? 0 : last_source(*node);
  const Source& source = sources_[static_cast<std::size_t>(last)];
  if (last == 0) return std::nullopt;
  return source.name + ": " + shortened(source.text);
}

void Document::set(std::string_view assignment, std::string origin) {
  const int source = static_cast<int>(sources_.size());
  sources_.push_back({std::move(origin), std::string(assignment), {}});
  sources_.back().line_starts = starts_of_lines(assignment);
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos || !split_path(assignment.substr(0, equals)))
    throw InputError(
        Diagnostic{locate(place_at(source, 0)),
                   "this does not name a value",
                   "PATH=VALUE, such as system.friction.kinetic=3 N or excitation.harmonics[0].order=3",
                   {},
                   {}});
  const std::size_t before = problems_.size();
  Node value = parse(source, equals + 1);
  if (value.kind == Node::Kind::null && problems_.size() > before) throw InputError(problems_.back());
  if (value.kind == Node::Kind::null)
    throw InputError(
        Diagnostic{locate(place_at(source, equals)), "a value is missing after '='", "PATH=VALUE", {}, {}});
  const std::string_view path = assignment.substr(0, equals);
  if (auto earlier = assigned(path))
    throw InputError(Diagnostic{locate(place_at(source, 0)),
                                "'" + shortened(path) + "' is stated twice",
                                "one option for each value",
                                std::move(*earlier),
                                {}});
  put(path, std::move(value), [this, source](std::size_t offset) { return place_at(source, offset); });
  chosen_.emplace_back(path);
}

bool Document::is_chosen(std::string_view path) const { return std::ranges::find(chosen_, path) != chosen_.end(); }

void Document::put(std::string_view path, Place place, Node value) {
  put(path, std::move(value), [place](std::size_t) { return place; });
  chosen_.emplace_back(path);
}

void Document::put(std::string_view path, Node value, const std::function<Place(std::size_t)>& place_of) {
  const auto refuse = [&](std::size_t offset, std::string message, std::string allowed) {
    throw InputError(Diagnostic{locate(place_of(offset)), std::move(message), std::move(allowed), {}, {}});
  };
  const auto steps = split_path(path);
  if (!steps)
    refuse(0, "'" + shortened(path) + "' does not name a value",
           "a path such as system.friction.kinetic or excitation.harmonics[0].order");
  if (steps->size() > static_cast<std::size_t>(max_depth))
    refuse((*steps)[static_cast<std::size_t>(max_depth)].offset,
           "this is nested deeper than " + std::to_string(max_depth) + " levels", {});
  Node* node = &root_;
  for (const Step& step : *steps) {
    if (step.index) {
      if (node->kind != Node::Kind::sequence || *step.index >= node->items.size())
        refuse(
            step.offset, "there is no such list item",
            node->kind == Node::Kind::sequence ? "an index below " + std::to_string(node->items.size()) : "a key");
      node = &node->items[*step.index];
      continue;
    }
    const Place place = place_of(step.offset);
    if (node->kind == Node::Kind::null) {
      node->kind = Node::Kind::map;
      node->place = place;
    }
    if (node->kind != Node::Kind::map)
      refuse(step.offset, "'" + shortened(step.key) + "' is inside a value that has no keys", {});
    auto entry = std::ranges::find(node->entries, step.key, &Entry::key);
    const bool is_new = entry == node->entries.end();
    if (is_new) entry = node->entries.insert(entry, Entry{step.key, place, Node{}});
    // A section of the file keeps its place.
    if (is_new || &step == &steps->back()) entry->place = entry->value.key_place = place;
    node = &entry->value;
  }
  value.key_place = node->key_place;
  *node = std::move(value);
}

std::optional<Entry> Document::take(std::string_view path) {
  const std::size_t dot = path.find('.');
  std::vector<Entry>* entries = &root_.entries;
  if (dot != std::string_view::npos) {
    const auto section = std::ranges::find(*entries, path.substr(0, dot), &Entry::key);
    if (section == entries->end()) return std::nullopt;
    entries = &section->value.entries;
    path.remove_prefix(dot + 1);
  }
  const auto found = std::ranges::find(*entries, path, &Entry::key);
  if (found == entries->end()) return std::nullopt;
  Entry entry = std::move(*found);
  entries->erase(found);
  return entry;
}

Document Document::part(Node root) const {
  Document document = *this;
  document.root_ = std::move(root);
  document.problems_.clear();
  return document;
}

}  // namespace dualdamp::scenarios
