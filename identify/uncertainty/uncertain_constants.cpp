#include "identify/uncertainty/uncertain_constants.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "core/numbers.hpp"
#include "identify/methods.hpp"
#include "identify/statistics/statistics.hpp"
#include "identify/statistics/ties.hpp"

namespace dualdamp::identify {

namespace {

/// A record and the constants that it is read with.
struct Input {
  Record record;
  KnownConstants constants;
};

using Signal = std::vector<double> History::*;

void multiply(std::vector<double>& values, double factor) {
  for (double& value : values) value *= factor;
}

void multiply(Record& record, Signal signal, double factor) {
  for (History& history : record.histories) multiply(history.*signal, factor);
}

void multiply_frequency(Input& input, double factor) {
  if (input.record.pairs)
    for (Pair& pair : input.record.pairs->pairs)
      if (is_same_frequency(pair.omega, input.constants.frequency)) pair.omega *= factor;
  input.constants.frequency *= factor;
}

void multiply_y(Input& input, double factor) {
  if (input.record.pairs)
    for (Pair& pair : input.record.pairs->pairs) pair.Y *= factor;
  multiply(input.record, &History::y, factor);
}

void multiply_x(Input& input, double factor) {
  if (input.record.pairs)
    for (Pair& pair : input.record.pairs->pairs) {
      pair.x *= factor;
      pair.fundamental *= factor;
    }
  if (input.record.decay) multiply(input.record.decay->extremes, factor);
  multiply(input.record, &History::x, factor);
}

/// A mean square speed from v changes with the square of the gain of v.
void multiply_v(Input& input, double factor) {
  if (input.record.pairs)
    for (Pair& pair : input.record.pairs->pairs) pair.mean_square_speed *= factor * factor;
  multiply(input.record, &History::v, factor);
}

template <Signal signal>
bool holds(const Input& input) {
  return std::ranges::any_of(input.record.histories, [](const History& h) { return !(h.*signal).empty(); });
}

bool has_pairs(const Input& input) { return input.record.pairs.has_value(); }

/// How an input reads with a stated number `factor` times as large, and whether it has this number.
struct Variable {
  StatedNumber number;
  void (*multiply)(Input& input, double factor);
  bool (*is_present)(const Input& input);
};

/// The stated number of this uncertainty.
consteval StatedNumber stated_number(double ConstantUncertainties::* uncertainty) {
  return *std::ranges::find(stated_numbers, uncertainty, &StatedNumber::uncertainty);
}

constexpr std::array<Variable, stated_numbers.size()> variables = {{
    {stated_number(&ConstantUncertainties::mass),
     [](Input& input, double factor) { input.constants.mass *= factor; },
     [](const Input& input) { return input.constants.mass > 0.0; }},
    {stated_number(&ConstantUncertainties::stiffness),
     [](Input& input, double factor) { input.constants.stiffness *= factor; },
     [](const Input& input) { return input.constants.stiffness > 0.0; }},
    {stated_number(&ConstantUncertainties::frequency), multiply_frequency,
     [](const Input& input) { return input.constants.frequency > 0.0 && !input.record.decay; }},
    {stated_number(&ConstantUncertainties::gain_y), multiply_y,
     [](const Input& input) { return has_pairs(input) || holds<&History::y>(input); }},
    {stated_number(&ConstantUncertainties::gain_x), multiply_x,
     [](const Input& input) { return has_pairs(input) || input.record.decay || holds<&History::x>(input); }},
    {stated_number(&ConstantUncertainties::gain_v), multiply_v,
     [](const Input& input) { return has_pairs(input) || holds<&History::v>(input); }},
    {stated_number(&ConstantUncertainties::gain_a),
     [](Input& input, double factor) { multiply(input.record, &History::a, factor); }, holds<&History::a>},
    {stated_number(&ConstantUncertainties::gain_force),
     [](Input& input, double factor) { multiply(input.record, &History::force, factor); }, holds<&History::force>},
}};

/// The estimates with one constant lower and higher than stated. If one fails, the stated one is in its place.
struct Bracket {
  const Estimate* stated = nullptr;
  const Estimate* low = nullptr;
  const Estimate* high = nullptr;
  double step = 0.0;  ///< from low to high, in deviations of the constant
};

/// A record read again with one constant off.
class Variation {
 public:
  Variation(const Reader& read, const Input& input, const Estimate& stated)
      : read_(read), input_(input), stated_(stated) {}

  /// The estimates at both sides; `deviation` is relative.
  [[nodiscard]] std::optional<Bracket> at(const Variable& variable, double deviation) {
    low_ = run(variable, 1.0 - deviation);
    high_ = run(variable, 1.0 + deviation);
    const bool has_low = low_.outcome.ok();
    const bool has_high = high_.outcome.ok();
    if (!has_low && !has_high) return std::nullopt;
    return Bracket{&stated_, has_low ? &low_ : &stated_, has_high ? &high_ : &stated_,
                   (has_low ? 1.0 : 0.0) + (has_high ? 1.0 : 0.0)};
  }

 private:
  Estimate run(const Variable& variable, double factor) const {
    Input input = input_;
    variable.multiply(input, factor);
    return read_(input.record, input.constants);
  }

  const Reader& read_;
  const Input& input_;
  const Estimate& stated_;
  Estimate low_;
  Estimate high_;
};

/// The value corrected for bias. A method that knows its bias corrects only its interval for it: if the bias
/// depends on a constant, only the middle of the interval shows this. The joint model is not in the list of
/// methods: it has no bias, and its intervals cover what is nearly seen.
double corrected(const Estimate& estimate, const ReportedParameter& member) {
  if (!estimate.interval95 || find_method(estimate.method) == nullptr) return estimate.value.*member.value;
  const auto& [low, high] = (*estimate.interval95).*member.interval;
  return 0.5 * (low + high);
}

/// Half the change from low to high. Where both sides change a parameter the same way, this would be nearly zero:
/// the constant is so uncertain that its effect has a turning point, and the larger change is taken.
double difference(const Bracket& bracket, const ReportedParameter& member) {
  const bool both = bracket.low->interval95.has_value() == bracket.high->interval95.has_value();
  const double change = both ? corrected(*bracket.high, member) - corrected(*bracket.low, member)
                             : bracket.high->value.*member.value - bracket.low->value.*member.value;
  if (!both || bracket.stated->interval95.has_value() != bracket.low->interval95.has_value())
    return change / bracket.step;
  const double stated = corrected(*bracket.stated, member);
  const double down = corrected(*bracket.low, member) - stated;
  const double up = corrected(*bracket.high, member) - stated;
  if (up * down > 0.0) return std::abs(up) > std::abs(down) ? up : down;
  return change / bracket.step;
}

/// Half the change of a further parameter of this name; nothing if one of the estimates lacks it.
std::optional<double> difference(const Bracket& bracket, const std::string& name) {
  const auto find = [&name](const Estimate& estimate) {
    return std::ranges::find(estimate.others, name, &FurtherParameter::name);
  };
  const auto low = find(*bracket.low);
  const auto high = find(*bracket.high);
  if (low == bracket.low->others.end() || high == bracket.high->others.end()) return std::nullopt;
  return (high->value - low->value) / bracket.step;
}

/// What an error of one standard uncertainty changes.
struct Change {
  ParameterSet values;
  std::vector<std::optional<double>> others;  ///< of the further parameters; nothing where one has none
};

Change change_by(const Bracket& bracket, const Estimate& estimate) {
  Change change;
  for (const ReportedParameter& member : reported_parameters)
    change.values.*member.value = difference(bracket, member);
  for (const FurtherParameter& other : estimate.others) change.others.push_back(difference(bracket, other.name));
  return change;
}

/// Parameter by parameter.
void take_larger(const Change& other, Change& change) {
  const auto larger = [](double a, double b) { return std::abs(b) > std::abs(a) ? b : a; };
  for (const ReportedParameter& member : reported_parameters)
    change.values.*member.value = larger(change.values.*member.value, other.values.*member.value);
  for (std::size_t i = 0; i < change.others.size(); ++i)
    if (change.others[i] && other.others[i]) change.others[i] = larger(*change.others[i], *other.others[i]);
}

void add(const Change& change, Estimate& estimate) {
  for (const ReportedParameter& member : reported_parameters) {
    const double moved = change.values.*member.value;
    if (estimate.std) (*estimate.std).*member.value = std::hypot((*estimate.std).*member.value, moved);
    if (!estimate.interval95) continue;
    Interval& interval = (*estimate.interval95).*member.interval;
    interval = widened(interval, estimate.value.*member.value, moved);
  }
  if (estimate.covariance) {
    const Eigen::Vector2d both(change.values.zeta, change.values.F0);
    *estimate.covariance += both * both.transpose();
    const Eigen::Matrix2d& c = *estimate.covariance;
    if (estimate.correlation) estimate.correlation = c(0, 1) / std::sqrt(c(0, 0) * c(1, 1));
  }
  for (std::size_t i = 0; i < estimate.others.size(); ++i) {
    FurtherParameter& other = estimate.others[i];
    if (!change.others[i]) continue;
    if (other.std) *other.std = std::hypot(*other.std, *change.others[i]);
    if (other.interval95) other.interval95 = widened(*other.interval95, other.value, *change.others[i]);
  }
}

/// Readings that leave no freedom have no interval that could include what the constants contribute: it is said.
void note_contribution(const ParameterSet& errors, const KnownConstants& constants, Estimate& estimate) {
  if (estimate.std || estimate.interval95) return;
  constexpr int digits = 2;
  const bool spring = std::isfinite(estimate.value.zeta);
  const std::string damping = spring
                                  ? core::format_number(errors.zeta, digits) + " of zeta"
                                  : core::format_number(errors.c, digits) + " " + constants.unit("N.s/m") + " of c";
  estimate.warnings.push_back(
      "there is no interval that could include the stated uncertainties of constants and gains: by themselves they "
      "give standard errors of " +
      damping + " and " + core::format_number(errors.F0, digits) + " " + constants.unit("N") + " of F0");
}

/// An interval that lacks the effect of a constant is too narrow by an unknown amount: there is none.
void drop_uncertainty(Estimate& estimate) {
  estimate.std.reset();
  estimate.interval95.reset();
  estimate.covariance.reset();
  estimate.correlation.reset();
  for (FurtherParameter& other : estimate.others) {
    other.std.reset();
    other.interval95.reset();
  }
}

/// Relative change of a parameter from one estimate to another. Zero if the value is zero; NaN if there is none, as
/// for zeta without a spring.
double relative_change(const Estimate& from, const Estimate& to, const ReportedParameter& member) {
  const double value = corrected(from, member);
  return value == 0.0 ? 0.0 : (corrected(to, member) - value) / value;
}

}  // namespace

bool ConstantUncertainties::any() const {
  return std::ranges::any_of(stated_numbers,
                             [this](const StatedNumber& number) { return this->*number.uncertainty > 0.0; });
}

double relative_of_inertia(const ConstantUncertainties& uncertainties, const KnownConstants& constants) {
  constexpr StatedNumber mass = stated_number(&ConstantUncertainties::mass);
  constexpr StatedNumber stiffness = stated_number(&ConstantUncertainties::stiffness);
  constexpr StatedNumber frequency = stated_number(&ConstantUncertainties::frequency);
  return std::hypot(mass.relative(uncertainties, constants), stiffness.relative(uncertainties, constants),
                    2.0 * frequency.relative(uncertainties, constants));
}

Estimate with_uncertainties(const Reader& read, const Record& record, const KnownConstants& constants,
                            const ConstantUncertainties& uncertainties) {
  Estimate stated = read(record, constants);
  if (!stated.outcome.ok() || !uncertainties.any()) return stated;
  const Input input{record, constants};
  Variation variation(read, input, stated);
  Estimate estimate = stated;
  ParameterSet contributed{0.0, 0.0, 0.0, 0.0};
  bool not_carried = false;
  bool is_moved = false;
  for (const Variable& variable : variables) {
    const double deviation = variable.number.relative(uncertainties, constants);
    if (!(deviation > 0.0)) continue;
    if (const std::optional<Bracket> bracket = variation.at(variable, deviation)) {
      Change change = change_by(*bracket, stated);
      // A record may tell a large error of a constant, and correct it: the smaller ones that it does not tell
      // count.
      constexpr double small = 0.05;
      for (double smaller = 0.5 * deviation; smaller > 0.5 * small; smaller *= 0.5)
        if (const std::optional<Bracket> inner = variation.at(variable, smaller))
          take_larger(change_by(*inner, stated), change);
      add(change, estimate);
      for (const ReportedParameter& member : reported_parameters)
        contributed.*member.value = std::hypot(contributed.*member.value, change.values.*member.value);
      is_moved = true;
    } else {
      not_carried = true;
      estimate.warnings.push_back("the uncertainty of the " + variable.number.text() +
                                  " allows no interval: with a value off by " + core::percent(deviation, 3) +
                                  " there is no estimate");
    }
  }
  if (not_carried)
    drop_uncertainty(estimate);
  else if (is_moved)
    note_contribution(contributed, constants, estimate);
  return estimate;
}

std::vector<Sensitivity> sensitivities(const Reader& read, const Estimate& stated, const Record& record,
                                       const KnownConstants& constants,
                                       const ConstantUncertainties& uncertainties) {
  constexpr double higher = 1.01;
  std::vector<Sensitivity> list;
  if (!stated.outcome.ok()) return list;
  for (const Variable& variable : variables) {
    if (variable.number.relative(uncertainties, constants) > 0.0) continue;
    Input input{record, constants};
    if (!variable.is_present(input)) continue;
    variable.multiply(input, higher);
    const Estimate moved = read(input.record, input.constants);
    if (!moved.outcome.ok()) continue;
    const Sensitivity found{variable.number.text(), relative_change(stated, moved, reported_parameters.front()),
                            relative_change(stated, moved, reported_parameters.back())};
    // A constant that the method does not use moves nothing.
    constexpr double nothing = 1e-5;
    if (std::abs(found.zeta_change) > nothing || std::abs(found.F0_change) > nothing) list.push_back(found);
  }
  const auto strength = [](const Sensitivity& one) {
    return std::fmax(std::abs(one.zeta_change), std::abs(one.F0_change));  // that of zeta may be NaN
  };
  const auto place = [](const Sensitivity& one) {
    return std::ranges::find(stated_numbers, one.constant, &StatedNumber::text);
  };
  sort_with_ties(list, strength, [&](const Sensitivity& a, const Sensitivity& b) { return place(a) < place(b); });
  return list;
}

}  // namespace dualdamp::identify
