#include "identify/readers/formats/universal_file_reader.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

#include "core/diagnostics.hpp"
#include "core/units.hpp"
#include "identify/readers/column_factors.hpp"
#include "identify/readers/formats/universal_file.hpp"
#include "identify/readers/text.hpp"

namespace dualdamp::identify {

namespace {

using universal_file::Function;

/// Decides the signal and the unit of each data set.
class Mapping {
 public:
  Mapping(const ReadOptions& options, Problems& problems, std::vector<std::string>& warnings)
      : file_(options.name),
        options_(options),
        problems_(problems),
        warnings_(warnings),
        factors_(options, problems, warnings) {}

  DataTable run(const std::vector<Function>& functions) {
    check_names(options_, problems_);
    problems_.throw_if_any();
    std::vector<TestColumns> tests;
    for (std::size_t i = 0; i < functions.size(); ++i) {
      const KnownColumn* known = signal_of(functions, i);
      if (known != nullptr) add(tests, functions[i], *known);
    }
    problems_.throw_if_any();
    if (tests.empty()) {
      std::vector<std::string> names;
      for (const Function& f : functions) names.push_back("'" + name_of(f) + "'");
      core::refuse({.file = file_}, "no data set of the file is a signal that could be used", allowed(),
                   "the data sets " + excerpt(core::joined(names, " and ")));
    }
    for (std::size_t i = 0; tests.size() > 1 && i < tests.size(); ++i) tests[i].label = std::to_string(i + 1);
    DataTable table = join(file_, tests);
    table.units = factors_.take_units();
    if (std::ranges::any_of(functions, [](const Function& f) { return !f.is_even; }))
      table.time_digits = 6;  // E13.5
    return table;
  }

 private:
  [[nodiscard]] std::string allowed() const {
    return "a response name, axis label or ID line x, y, v, a or force; or " +
           options_.words(core::Setting::column, "x", "NAME");
  }

  void refuse_set(const Function& f, std::string message, std::string wanted) {
    problems_.add({{file_, f.line, 0, {}}, std::move(message), std::move(wanted), {}, {}});
  }

  /// The names of a data set, for the caller's options and for messages.
  static std::string name_of(const Function& f) {
    return !f.entity.empty() ? f.entity : !f.ordinate.label.empty() ? f.ordinate.label : f.title;
  }

  static std::string called(const Function& f) { return "'" + name_of(f) + "' (node, direction " + f.place + ")"; }

  [[nodiscard]] const KnownColumn* signal_of(const std::vector<Function>& functions, std::size_t index) {
    const Function& f = functions[index];
    const std::array<std::string, 3> names = {f.entity, f.ordinate.label, f.title};
    for (const auto& [column, called] : options_.columns)
      if (called == std::to_string(index + 1) || std::ranges::find(names, called) != names.end())
        return known_column(column);
    for (const std::string& name : names)
      if (const KnownColumn* known = known_column(name);
          known != nullptr && known->is_signal && !is_chosen(*known) && is_wanted(options_, *known))
        return known;
    return by_quantity(functions, f);
  }

  [[nodiscard]] bool is_chosen(const KnownColumn& known) const {
    return options_.columns.contains(std::string(known.name)) ||
           options_.columns.contains(std::string(known.alias));
  }

  const KnownColumn* by_quantity(const std::vector<Function>& functions, const Function& f) {
    constexpr std::array<std::pair<int, std::string_view>, 5> table = {
        {{8, "x"}, {11, "v"}, {12, "a"}, {9, "force"}, {13, "force"}}};
    const auto* const row = std::ranges::find(table, f.ordinate.quantity, &std::pair<int, std::string_view>::first);
    const KnownColumn* known = row == table.end() ? nullptr : known_column(row->second);
    if (known == nullptr || is_chosen(*known) || !is_wanted(options_, *known)) {
      if (options_.only.empty())
        warnings_.push_back("data set '" + name_of(f) + "' at line " + std::to_string(f.line) +
                            " is not a requested signal and is ignored");
      return nullptr;
    }
    // The file does not state whether a displacement is that of the base or of the mass.
    for (const Function& other : functions) {
      if (other.ordinate.quantity != f.ordinate.quantity || called(other) == called(f)) continue;
      refuse_set(f,
                 called(f) + " and " + called(other) +
                     " are of the same kind, and nothing shows which of them is " + std::string(known->name),
                 allowed());
      return nullptr;
    }
    return known;
  }

  void add(std::vector<TestColumns>& tests, const Function& f, const KnownColumn& known) {
    const auto holds = [&known](const TestColumns& test) {
      return std::ranges::any_of(test.columns, [&](const DataColumn& column) { return column.known == &known; });
    };
    const double unit = time_factor(f);
    std::vector<double> times;
    for (const double t : f.times) times.push_back(t * unit);
    for (std::size_t i = 0; f.is_even && i < f.count; ++i)
      times.push_back((f.start + static_cast<double>(i) * f.step) * unit);
    if (tests.empty() || holds(tests.back())) {
      tests.emplace_back();
      tests.back().columns.push_back({known_column("t"), std::move(times)});
    } else if (tests.back().columns.front().values != times) {
      refuse_set(f, "data set '" + name_of(f) + "' is not sampled at the times of those before it",
                 "signals of one test with the same number of values, start and step");
      return;
    }
    std::vector<double> values = f.values;
    const double factor = factor_of(f, known);
    for (double& value : values) value *= factor;
    tests.back().columns.push_back({&known, std::move(values)});
  }

  /// From the times of a data set to seconds. An axis label that is no unit of time means seconds.
  double time_factor(const Function& f) {
    const KnownColumn& known = *known_column("t");
    const bool is_time =
        !f.abscissa.unit.empty() && core::unit_factor(f.abscissa.unit, known.unit).value.has_value();
    const bool is_given = find_for(options_.units, known) != nullptr || find_for(options_.scales, known) != nullptr;
    if (!is_time && !is_given) return 1.0;
    const auto [place, is_new] = time_factors_.try_emplace(is_time ? f.abscissa.unit : "", 1.0);
    if (is_new) {
      core::Diagnostic where;
      where.place = {file_, f.line, 0, {}};
      place->second = factors_.factor_of(known, place->first, where);
    }
    return place->second;
  }

  double factor_of(const Function& f, const KnownColumn& known) {
    core::Diagnostic where;
    where.place = {file_, f.line, 0, {}};
    where.found = "data set '" + name_of(f) + "'" + (f.ordinate.unit.empty() ? "" : " in " + f.ordinate.unit);
    // Without a unit of the axis, the units are those of data set 164.
    const bool in_units_of_file = f.ordinate.unit.empty() && find_for(options_.units, known) == nullptr &&
                                  find_for(options_.scales, known) == nullptr;
    return in_units_of_file && f.divisor ? 1.0 / *f.divisor : factors_.factor_of(known, f.ordinate.unit, where);
  }

  std::string file_;
  const ReadOptions& options_;
  Problems& problems_;
  std::vector<std::string>& warnings_;
  ColumnFactors factors_;
  std::map<std::string, double> time_factors_;  ///< by the unit of the axis; each is asked once
};

}  // namespace

bool is_universal_file(std::string_view text) {
  return universal_file::begins_data_set(text) || universal_file::lines_above_data_set(text).has_value();
}

DataTable parse_universal_file(std::string_view text, const ReadOptions& options, Problems& problems,
                               std::vector<std::string>& warnings) {
  const std::size_t above =
      universal_file::begins_data_set(text) ? 0 : universal_file::lines_above_data_set(text).value_or(0);
  if (above > 0)
    warnings.push_back(std::to_string(above) + (above == 1 ? " line" : " lines") +
                       " above the first data set of the universal file " + (above == 1 ? "is" : "are") +
                       " not read");
  const std::vector<Function> functions = universal_file::time_responses(text, options.name, warnings);
  if (functions.empty())
    core::refuse({.file = options.name}, "the universal file holds no time response",
                 "data sets 58 of function type 1");
  return Mapping(options, problems, warnings).run(functions);
}

}  // namespace dualdamp::identify
