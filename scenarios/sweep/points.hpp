#pragma once
/// The points of a sweep: their documents and scenarios.

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "scenarios/format/swept_keys.hpp"
#include "scenarios/format/tree.hpp"
#include "scenarios/scenario.hpp"
#include "scenarios/scenario_format.hpp"
#include "scenarios/scenario_reading.hpp"
#include "scenarios/sweep/answer.hpp"

namespace dualdamp::scenarios {

/// The document without its sections `sweep` and `expect`, and what differs.
class SweepPoints {
 public:
  SweepPoints(Document base, SweptKeys swept, std::string name, LoadOptions options)
      : base_(std::move(base)),
        swept_(std::move(swept)),
        name_(std::move(name)),
        options_(std::move(options)),
        format_(scenario_format(options_.analyses)) {}

  [[nodiscard]] std::size_t size() const {
    std::size_t count = 1;
    for (const SweptKey& key : swept_.keys) count *= key.values.size();
    return count;
  }
  [[nodiscard]] const SweptKeys& swept() const { return swept_; }
  [[nodiscard]] const Document& base() const { return base_; }
  [[nodiscard]] const Section& format() const { return format_; }
  [[nodiscard]] const std::string& name() const { return name_; }

  /// Index of the value of a key at a point; the last key varies fastest.
  [[nodiscard]] std::size_t index(std::size_t point, std::size_t key) const {
    for (std::size_t i = swept_.keys.size(); --i > key;) point /= swept_.keys[i].values.size();
    return point % swept_.keys[key].values.size();
  }

  [[nodiscard]] Document document(std::size_t point) const {
    Document document = base_;
    for (std::size_t i = 0; i < swept_.keys.size(); ++i) {
      const SweptKey& key = swept_.keys[i];
      document.put(key.path, key.place, key.values[index(point, i)]);
    }
    return document;
  }

  [[nodiscard]] Scenario scenario(const Document& document, Reading reading) const {
    return scenario_of(document, std::move(reading), name_, options_);
  }
  [[nodiscard]] Scenario scenario(std::size_t point) const {
    const Document document = this->document(point);
    return scenario(document, read(document, format_));
  }

  [[nodiscard]] std::vector<SweptColumn> columns() const {
    std::vector<SweptColumn> columns;
    for (std::size_t i = 0; i < swept_.keys.size(); ++i) {
      const SweptKey& key = swept_.keys[i];
      SweptColumn& column = columns.emplace_back(SweptColumn{key.path, key.unit, {}, {}});
      for (std::size_t point = 0; point < size(); ++point) column.numbers.push_back(key.number(index(point, i)));
    }
    return columns;
  }

 private:
  Document base_;
  SweptKeys swept_;
  std::string name_;
  LoadOptions options_;
  Section format_;
};

}  // namespace dualdamp::scenarios
