#pragma once
/// Options of the identification methods, each declared once. The declaration gives the key of a scenario, its
/// check, its line in the schema and in the pages, and its row in `dualdamp methods NAME`.
///
/// A method names its options in a struct of their values, and receives that struct:
///
///     struct FreeDecayOptions {
///       bool zero_offset = false;
///       static constexpr auto declared() { return std::tuple{Use{&zero_offset_option,
///       &FreeDecayOptions::zero_offset}}; }
///     };
///
/// An option of several methods is a shared constant in this file; an option of one method is in the header of the
/// method. A method cannot read an option that it does not declare.

#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/constants.hpp"
#include "core/diagnostics.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::identify {

enum class OptionKind {
  flag,     ///< true or false; default false
  count,    ///< a whole number
  number,   ///< a number with a unit
  numbers,  ///< a list of them
  counts,   ///< a list of whole numbers
  names,    ///< a list of words
};

/// In the order of `OptionKind`.
using OptionValue =
    std::variant<bool, int, double, std::vector<double>, std::vector<int>, std::vector<std::string>>;

struct Option {
  std::string_view name;  ///< key under `analysis`
  OptionKind kind = OptionKind::flag;
  std::string_view unit{};                        ///< of a number: SI, in udunits2 spelling
  friction::Range range{};                        ///< of a number, or of each of a list
  std::size_t least_items = 1;                    ///< of a list
  std::size_t most_items = 1;                     ///< of a list
  double per_unit = 1.0;                          ///< methods receive the number divided by this: Hz for rad/s
  std::string_view otherwise{};                   ///< the default, in words
  std::string_view meaning{};                     ///< one line
  std::vector<std::string> (*words)() = nullptr;  ///< the words that a list of words may hold

  /// For messages: "> 0 and <= 1", "1 to 16 numbers > 0 rad/s".
  [[nodiscard]] std::string describe() const;
};

/// Values of options by name, in the units of their declarations.
using OptionValues = std::map<std::string, OptionValue, std::less<>>;

/// Ties an option to the member of a struct of values that holds it.
template <class Value, class Owner>
struct Use {
  const Option* option;
  Value Owner::* member;

  void take(const OptionValues& values, Owner& options) const {
    const auto found = values.find(option->name);
    if (found == values.end()) return;
    Value value = std::get<Value>(found->second);
    if constexpr (std::is_same_v<Value, double>) value /= option->per_unit;
    if constexpr (std::is_same_v<Value, std::vector<double>>)
      for (double& item : value) item /= option->per_unit;
    options.*member = std::move(value);
  }
};
template <class Value, class Owner>
Use(const Option*, Value Owner::*) -> Use<Value, Owner>;

/// The options that a struct of values declares.
template <class Options>
inline constexpr auto declarations_of =
    std::apply([](const auto&... use) { return std::array<const Option*, sizeof...(use)>{use.option...}; },
               Options::declared());

/// The struct with the given values; the others keep their defaults. `values` must have no `faults_of`.
template <class Options>
[[nodiscard]] Options taken_from(const OptionValues& values) {
  Options options;
  std::apply([&](const auto&... use) { (use.take(values, options), ...); }, Options::declared());
  return options;
}

/// What is wrong with these values for a method that declares `options`: an option that is not among them, a value
/// of another kind, not finite, or out of range.
[[nodiscard]] std::vector<core::Diagnostic> faults_of(const OptionValues& values,
                                                      std::span<const Option* const> options);

inline constexpr Option sigma_x_option{
    .name = "sigma_x",
    .kind = OptionKind::number,
    .unit = "m",
    .range = friction::not_negative,
    .otherwise = "from the data",
    .meaning = "known standard deviation of a measured output amplitude or extreme"};
inline constexpr Option sigma_Y_option{.name = "sigma_Y",
                                       .kind = OptionKind::number,
                                       .unit = "m",
                                       .range = friction::not_negative,
                                       .otherwise = "from the data",
                                       .meaning = "known standard deviation of a measured input amplitude"};
inline constexpr Option bootstrap_option{.name = "bootstrap",
                                         .kind = OptionKind::count,
                                         .range = {.low = 0.0, .high = 1e6},
                                         .otherwise = "0",
                                         .meaning = "replicates of a bootstrap by sweeps"};
inline constexpr Option profile_option{.name = "profile", .meaning = "profiles of the likelihood of zeta and F0"};
inline constexpr Option approximate_G_option{.name = "approximate_G",
                                             .meaning = "G from the approximation Eq (15) instead of Eq (4)"};
inline constexpr Option cutoffs_option{
    .name = "cutoffs",
    .kind = OptionKind::numbers,
    .unit = "rad/s",
    .range = friction::positive,
    .most_items = 16,
    .per_unit = core::two_pi,
    .otherwise = "from the sample rate and the motion",
    .meaning =
        "cut-off frequencies of the filter that histories are differentiated with; the estimate uses the first; "
        "the others show the effect of the choice"};
inline constexpr Option least_speed_option{
    .name = "least_speed",
    .kind = OptionKind::number,
    .unit = "m/s",
    .range = friction::not_negative,
    .otherwise =
        "1 % of the largest speed (acceleration_velocity_displacement), or 5 % of it (friction_force, "
        "recursive_least_squares)",
    .meaning = "samples slower than this are left out of the regression of friction on speed"};

/// Known standard deviations of one measured output and input amplitude [m]. If either is positive, they replace
/// the scatter of the residuals, so that even two pairs give standard errors.
struct KnownDeviations {
  double sigma_x = 0.0;
  double sigma_Y = 0.0;

  static constexpr auto declared() {
    return std::tuple{Use{&sigma_x_option, &KnownDeviations::sigma_x},
                      Use{&sigma_Y_option, &KnownDeviations::sigma_Y}};
  }
};

/// Options of the resonance methods.
struct ResonanceOptions : KnownDeviations {
  bool approximate_G = false;  ///< from Eq (15) instead of the exact Eq (4) at w = wn

  static constexpr auto declared() {
    return std::tuple_cat(KnownDeviations::declared(),
                          std::tuple{Use{&approximate_G_option, &ResonanceOptions::approximate_G}});
  }
};

/// Options of the resonance methods that fit one line.
struct LineOptions : ResonanceOptions {
  int bootstrap = 0;     ///< replicates, by sweeps (by residuals if there is only one sweep); 0: none
  bool profile = false;  ///< curves of the likelihood of zeta and F0, with the intervals that follow from them

  static constexpr auto declared() {
    return std::tuple_cat(ResonanceOptions::declared(), std::tuple{Use{&bootstrap_option, &LineOptions::bootstrap},
                                                                   Use{&profile_option, &LineOptions::profile}});
  }
};

/// Options of the methods that filter histories.
struct FilterOptions {
  /// Hz. The first gives the estimate; the estimates with the others show the effect of the choice. Empty: the
  /// method's own.
  std::vector<double> cutoffs;

  static constexpr auto declared() { return std::tuple{Use{&cutoffs_option, &FilterOptions::cutoffs}}; }
};

/// Options of the methods that regress forces on speeds.
struct RegressionOptions : FilterOptions {
  double least_speed = 0.0;  ///< slower samples are left out [m/s]; 0: the method's own choice

  static constexpr auto declared() {
    return std::tuple_cat(FilterOptions::declared(),
                          std::tuple{Use{&least_speed_option, &RegressionOptions::least_speed}});
  }
};

}  // namespace dualdamp::identify
