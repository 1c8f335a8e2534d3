#include "scenarios/format/common_keys.hpp"

#include <utility>

#include "scenarios/format/limits.hpp"

namespace dualdamp::scenarios {

namespace {

constexpr auto max_items = static_cast<std::size_t>(max_points);

}  // namespace

Field amplitudes() {
  return grid("amplitudes", {"m", "N"}, "excitation amplitudes; each replaces that of the excitation")
      .required()
      .at_least(0)
      .items(1, max_items);
}

Field frequencies() {
  return grid("frequencies", {"rad/s"}, "forcing frequencies; each replaces that of the excitation")
      .required()
      .above(0)
      .items(1, max_items);
}

Field peaks() {
  return integer("peaks", "number of extremes wanted, the initial one included")
      .required()
      .at_least(1)
      .at_most(max_points);
}

Field seed() {
  return integer("seed", "seed of the random numbers")
      .with_fallback(0)
      .at_least(0)
      .at_most(friction::seed_range.high);
}

Field range(std::string name, const std::vector<std::string>& units, std::string meaning) {
  return section(std::move(name),
                 {{quantity("from", units, "value at the first point").required().above(0),
                   quantity("to", units, "the continuation ends where the branch leaves the range")
                       .required()
                       .above(0)}},
                 std::move(meaning))
      .required();
}

std::vector<Field> signal_file(const std::string& column, const std::string& si) {
  return {text("file", "data file (CSV, MATLAB, universal file) in the scenario's directory or below").required(),
          text("column", "name or number of the signal's column in the file; default: " + column),
          text("unit", "unit of the column if the file states none, of the same kind as " + si),
          text("time_column", "name or number of the column of times in the file; default: t"),
          text("time_unit", "unit of the times if the file states none, such as ms; default: s"),
          text("scale", "factor of the numbers, such as the sensitivity of a sensor: 2.5 " + si + "/V"),
          words("decimal", {".", ","}, "decimal mark of a CSV file"),
          boolean("no_header", "the CSV file has no header: its columns are named by their numbers"),
          quantity("sample_rate", {"1/s"}, "sample rate of a file that has no times").above(0)};
}

Field optional(Field field) {
  field.is_required = false;
  return field;
}

}  // namespace dualdamp::scenarios
