#include "identify/readers/formats/mat_content.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

namespace dualdamp::identify {

namespace {

constexpr std::uint64_t content_mark = 1;
constexpr std::uint64_t problems_mark = 2;

/// Numbers are sent as they are in memory, since sender and receiver are the same program.
class Sender {
 public:
  explicit Sender(const ByteSink& sink) : sink_(sink) {}

  void put(std::uint64_t number) const {
    sink_(
        {reinterpret_cast<const char*>(&number), sizeof number});  // NOLINT(*-reinterpret-cast): bytes of a number
  }
  void put(const std::string& text) const {
    put(text.size());
    sink_(text);
  }
  void put(const std::vector<double>& values) const {
    put(values.size());
    // NOLINTNEXTLINE(*-reinterpret-cast): bytes of numbers
    sink_({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)});
  }
  template <typename Item, typename Put>
  void put(const std::vector<Item>& items, Put put_item) const {
    put(items.size());
    for (const Item& item : items) put_item(item);
  }

 private:
  const ByteSink& sink_;
};

/// Thrown for invalid bytes. It is caught in this file.
struct Nonsense {};

class Receiver {
 public:
  explicit Receiver(std::string_view bytes) : bytes_(bytes) {}

  std::uint64_t number() {
    std::uint64_t value = 0;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  std::string text() { return std::string(take(number())); }
  std::vector<double> values() {
    const std::uint64_t count = number();
    if (count > bytes_.size() / sizeof(double)) throw Nonsense{};
    if (count == 0) return {};  // memcpy takes no null pointer, even for zero bytes
    std::vector<double> values(count);
    std::memcpy(values.data(), take(count * sizeof(double)).data(), count * sizeof(double));
    return values;
  }
  template <typename Get>
  auto items(Get get) {
    std::vector<decltype(get())> items;
    for (std::uint64_t count = number(); count > 0; --count) items.push_back(get());
    return items;
  }
  void expect_end() const {
    if (!bytes_.empty()) throw Nonsense{};
  }

 private:
  std::string_view take(std::uint64_t size) {
    if (size > bytes_.size()) throw Nonsense{};
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }

  std::string_view bytes_;
};

DataColumn column(Receiver& from) {
  const std::uint64_t index = from.number();
  if (index >= known_columns.size()) throw Nonsense{};
  return {&known_columns[index], from.values()};
}

TestColumns test(Receiver& from) {
  TestColumns test{from.text(), from.items([&from] { return column(from); })};
  const auto differs = [&test](const DataColumn& column) {
    return column.values.empty() || column.values.size() != test.columns.front().values.size();
  };
  if (test.columns.empty() || std::ranges::any_of(test.columns, differs)) throw Nonsense{};
  for (std::size_t i = 1; i < test.columns.size(); ++i)
    if (std::ranges::count(test.columns, test.columns[i].known, &DataColumn::known) > 1) throw Nonsense{};
  return test;
}

/// Whether the labels begin at row 0, are in order, and lie within the only test.
std::vector<LabelRun> row_labels(Receiver& from, const std::vector<TestColumns>& tests) {
  std::vector<LabelRun> runs = from.items([&from] {
    std::string label = from.text();
    return LabelRun{std::move(label), from.number()};
  });
  const bool ascends = std::ranges::adjacent_find(runs, [](const LabelRun& a, const LabelRun& b) {
                         return a.first_row >= b.first_row;
                       }) == runs.end();
  std::size_t rows = 0;
  for (const TestColumns& test : tests) rows += test.columns.front().values.size();
  if (runs.empty() || runs.front().first_row != 0 || !ascends || runs.back().first_row >= rows) throw Nonsense{};
  return runs;
}

MatContent content(Receiver& from) {
  MatContent content;
  content.tests = from.items([&from] { return test(from); });
  if (content.tests.empty()) throw Nonsense{};
  if (from.number() != 0) content.row_labels = row_labels(from, content.tests);
  content.warnings = from.items([&from] { return from.text(); });
  content.ignored = from.items([&from] { return from.text(); });
  content.units.assumed = from.items([&from] { return from.text(); });
  for (std::uint64_t count = from.number(); count > 0; --count) {
    std::string column = from.text();
    if (known_column(column) == nullptr) throw Nonsense{};
    content.units.stated[std::move(column)] = from.text();
  }
  from.expect_end();
  return content;
}

std::vector<core::Diagnostic> problems(Receiver& from) {
  auto problems = from.items([&from] {
    core::Diagnostic problem;
    for (std::string* field : {&problem.place.file, &problem.place.text, &problem.message, &problem.allowed,
                               &problem.found, &problem.suggestion})
      *field = from.text();
    return problem;
  });
  from.expect_end();
  if (problems.empty()) throw Nonsense{};
  return problems;
}

}  // namespace

void send(const MatContent& content, const ByteSink& sink) {
  const Sender to(sink);
  to.put(content_mark);
  to.put(content.tests, [&to](const TestColumns& test) {
    to.put(test.label);
    to.put(test.columns, [&to](const DataColumn& column) {
      to.put(static_cast<std::uint64_t>(column.known - known_columns.data()));
      to.put(column.values);
    });
  });
  to.put(std::uint64_t{content.row_labels.has_value()});
  if (content.row_labels)
    to.put(*content.row_labels, [&to](const LabelRun& run) {
      to.put(run.label);
      to.put(std::uint64_t{run.first_row});
    });
  for (const auto* texts : {&content.warnings, &content.ignored, &content.units.assumed})
    to.put(*texts, [&to](const std::string& text) { to.put(text); });
  to.put(std::uint64_t{content.units.stated.size()});
  for (const auto& [column, unit] : content.units.stated) {
    to.put(column);
    to.put(unit);
  }
}

void send(const std::vector<core::Diagnostic>& problems, const ByteSink& sink) {
  const Sender to(sink);
  to.put(problems_mark);
  to.put(problems, [&to](const core::Diagnostic& problem) {  // binary files have no lines and columns
    for (const std::string* field : {&problem.place.file, &problem.place.text, &problem.message, &problem.allowed,
                                     &problem.found, &problem.suggestion})
      to.put(*field);
  });
}

std::optional<MatContent> receive(std::string_view bytes) {
  std::vector<core::Diagnostic> sent;
  try {
    Receiver from(bytes);
    const std::uint64_t mark = from.number();
    if (mark == content_mark) return content(from);
    if (mark != problems_mark) return std::nullopt;
    sent = problems(from);
  } catch (const Nonsense&) {
    return std::nullopt;
  }
  throw core::InputError(std::move(sent));
}

}  // namespace dualdamp::identify
