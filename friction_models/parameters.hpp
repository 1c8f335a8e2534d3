#pragma once
/// Parameters of a law, stated once in a table. The scenario reader, the schema, `dualdamp laws`, the range checks
/// and the documentation use this table.
///
///     {.name = "elements", .kind = ParameterKind::list, .fields = {stiffness, limit}, .meaning = "..."},
///     {.name = "count", .kind = ParameterKind::count, .instead_of = "elements", .range = {.low = 1.0}, ...},

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/coordinate.hpp"

namespace dualdamp::friction {

/// Values by name, SI. Access to a value that is missing or of another kind is a bug and throws `std::logic_error`
/// or `std::bad_variant_access`.
class ParameterValues {
 public:
  /// A whole number is a double without fraction, exact below 2^53; a record is a list of one.
  using Value = std::variant<double, bool, std::string, std::vector<ParameterValues>>;
  using Map = std::map<std::string, Value, std::less<>>;

  ParameterValues() = default;
  ParameterValues(std::initializer_list<Map::value_type> values);

  [[nodiscard]] bool has(std::string_view name) const { return find(name) != nullptr; }
  [[nodiscard]] double number(std::string_view name) const;
  [[nodiscard]] std::size_t count(std::string_view name) const;
  [[nodiscard]] std::uint64_t seed(std::string_view name) const;
  [[nodiscard]] const std::string& choice(std::string_view name) const;
  [[nodiscard]] bool flag(std::string_view name) const;
  [[nodiscard]] const ParameterValues& record(std::string_view name) const;
  [[nodiscard]] const std::vector<ParameterValues>& list(std::string_view name) const;

  /// nullptr when there is no such value.
  [[nodiscard]] const Value* find(std::string_view name) const;
  [[nodiscard]] Value* find(std::string_view name);
  [[nodiscard]] const Map& values() const { return values_; }

  void set(std::string_view name, Value value);
  void erase(std::string_view name);

  /// Sets what the law's x is. It affects only the units in messages.
  void measure(core::Coordinate coordinate) { coordinate_ = coordinate; }
  [[nodiscard]] core::Coordinate coordinate() const { return coordinate_; }
  /// "N.m" for "N" where x is an angle.
  [[nodiscard]] std::string unit(std::string_view unit) const { return core::unit_for(coordinate_, unit); }

 private:
  [[nodiscard]] const Value& at(std::string_view name) const;

  Map values_;
  core::Coordinate coordinate_ = core::Coordinate::displacement;
};

/// The range of values that a parameter may have; ends are included unless marked open.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;
  bool high_open = false;

  [[nodiscard]] bool contains(double value) const;
  /// For messages: ">= 0 N", "> 0 and <= 1".
  [[nodiscard]] std::string describe(std::string_view unit) const;
};

inline constexpr Range positive = {.low = 0.0, .low_open = true};
inline constexpr Range not_negative = {.low = 0.0};

/// Seeds: whole numbers that a double and a JSON reader keep exactly.
inline constexpr Range seed_range = {.low = 0.0, .high = 9007199254740991.0};

enum class ParameterKind {
  number,
  count,   ///< a whole number
  seed,    ///< a whole number in `seed_range`
  choice,  ///< one of `words`
  flag,    ///< true or false
  record,  ///< a map of `fields`
  list,    ///< a list of such maps
};

struct Parameter {
  std::string_view name;  ///< YAML key
  ParameterKind kind = ParameterKind::number;
  std::string_view unit{};                ///< of a number: SI, in udunits2 spelling: "N", "N/m", "N.s/m", "m", "1"
  std::vector<std::string_view> words{};  ///< of a choice
  std::vector<Parameter> fields{};        ///< of a record, and of each item of a list
  std::size_t max_items = 10'000;         ///< of a list, which has one at least
  std::optional<ParameterValues::Value> fallback{};  ///< default
  std::string_view same_as{};                        ///< default is the value of this earlier parameter
  bool is_optional = false;                          ///< may be absent and then has no value
  /// A law may have two forms: one with the parameter named here, which is earlier in the table, and one with this
  /// parameter instead. This parameter is refused beside the earlier one. Without the earlier one it is required,
  /// unless it has a default. The earlier one is required if no parameter of this form is given.
  std::string_view instead_of{};
  std::string_view not_beside{};  ///< refused beside this earlier parameter, unless that is 0
  Range range{};
  std::string_view at_least{};  ///< must be >= the value of this earlier parameter
  /// Names of the speed at which the law has this force, and of the power of the speed with which the force grows.
  std::string_view at_speed{};
  std::string_view power{};
  bool sums_to_one = false;  ///< of a field of a list: the values of all items add to 1
  /// A fit seeks it although it has a default: with the default other parameters have no effect.
  bool needed_in_fit = false;
  std::string_view meaning{};  ///< one line for documentation

  /// No default and not optional. With `instead_of` it is required in its form only.
  [[nodiscard]] bool required() const { return !fallback && same_as.empty() && !is_optional; }
  /// `range`; for a seed `seed_range`.
  [[nodiscard]] Range allowed_range() const { return kind == ParameterKind::seed ? seed_range : range; }
  /// For messages: ">= 0 N", "gaussian, lorentz", "a list of 1 to 10000 records of stiffness, limit".
  [[nodiscard]] std::string describe(core::Coordinate coordinate = core::Coordinate::displacement) const;
};

/// The value of a parameter that is not given, in words: "2", "that of 'kinetic'", "required"; empty for none.
[[nodiscard]] std::string describe_default(const std::vector<Parameter>& table, const Parameter& parameter);

/// The parameters of the form without `name`; empty when there is no other form.
[[nodiscard]] std::vector<std::string> names_instead_of(const std::vector<Parameter>& table, std::string_view name);

/// One fault of one parameter; the reader gives it its place in the file.
struct ParameterFault {
  std::string name;  ///< with the way to it: "elements[2].limit"
  std::string message;
  std::string allowed;
  std::string found;
  bool is_missing = false;  ///< the value is not there
};

/// Fills in the defaults of `values` and returns every fault: a value that is missing, unknown, of the wrong kind,
/// not finite, out of range, or below the parameter named by `at_least`, and parameters of both forms of a law.
/// `values` is complete when the returned list is empty.
[[nodiscard]] std::vector<ParameterFault> complete(const std::vector<Parameter>& table, ParameterValues& values);

}  // namespace dualdamp::friction
