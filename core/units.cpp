#include "core/units.hpp"

#include <udunits2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <numbers>
#include <stdexcept>

#include "core/numbers.hpp"

namespace dualdamp::core {

namespace {

struct Dimension {
  std::string_view si_unit;
  std::string_view noun;
  std::string_view example;
  std::vector<std::string_view> units;
};

const std::vector<Dimension>& dimensions() {
  static const std::vector<Dimension> table = {
      {"1", "a number", "0.2", {"1", "%"}},
      {"kg", "a mass", "5 kg", {"kg", "g", "mg", "t", "lb"}},
      {"m", "a length", "3 mm", {"m", "mm", "um", "µm", "nm", "cm", "km", "in", "ft"}},
      {"s", "a time", "20 s", {"s", "ms", "us", "µs", "min", "h"}},
      {"N", "a force", "2 N", {"N", "mN", "kN", "MN", "lbf"}},
      {"N/m",
       "a stiffness",
       "1568 N/m",
       {"N/m", "kN/m", "MN/m", "N/mm", "kN/mm", "N/um", "N/µm", "N/cm", "lbf/in"}},
      {"N.s/m",
       "a damping coefficient",
       "4 N.s/m",
       {"N.s/m", "N*s/m", "N s/m", "kN.s/m", "mN.s/m", "N.s/mm", "N.s/cm", "kg/s", "lbf.s/in"}},
      {"m/s", "a velocity", "0.1 m/s", {"m/s", "mm/s", "um/s", "µm/s", "cm/s", "km/h", "in/s", "ft/s"}},
      {"m/s^2", "an acceleration", "9.81 m/s^2", {"m/s^2", "mm/s^2", "m/s2", "mm/s2", "g_n", "g"}},
      {"N/s", "a force rate", "0.5 N/s", {"N/s", "mN/s", "kN/s", "N/ms"}},
      {"N/m^3", "a cubic stiffness", "2000 N/m^3", {"N/m^3", "kN/m^3", "MN/m^3", "N/m3", "N/mm^3", "N/mm3"}},
      {"1/s", "a rate", "1 kHz", {"1/s", "Hz", "mHz", "kHz", "MHz", "1/ms", "1/min", "1/h"}},
      {"N.m",
       "a torque",
       "2 N.m",
       {"N.m", "N m", "N*m", "mN.m", "uN.m", "kN.m", "N.cm", "N.mm", "lbf.in", "lbf.ft"}},
      {"J", "an energy", "1 J", {"J", "mJ", "kJ", "N.m"}},
      {"W", "a power", "2 W", {"W", "mW", "kW"}},
      {"m^2.s", "a spectral density", "2 mm^2/Hz", {"m^2.s", "mm^2.s", "m^2/Hz", "mm^2/Hz", "um^2/Hz"}},
      {"N^2.s", "a spectral density", "2 N^2/Hz", {"N^2.s", "mN^2.s", "N^2/Hz", "mN^2/Hz"}},
      {"rad", "an angle", "90 deg", {"rad", "mrad", "deg"}},
      {"rad/s", "a frequency", "6.17 Hz", {"rad/s", "Hz", "mHz", "kHz", "rpm"}},
  };
  return table;
}

/// What dimensions become where the coordinate is an angle. An angular velocity is not a frequency: it may be
/// negative, and without unit it is in rad/s.
const std::vector<Dimension>& dimensions_of_rotation() {
  static const std::vector<Dimension> table = {
      {"kg.m^2",
       "a moment of inertia",
       "0.3 kg.m^2",
       {"kg.m^2", "kg m^2", "kg*m^2", "kg.m2", "g.m^2", "kg.cm^2", "g.cm^2", "kg.mm^2", "g.mm^2", "lb.in^2"}},
      {"N.m/rad",
       "a torsional stiffness",
       "12 N.m/rad",
       {"N.m/rad", "N m/rad", "N*m/rad", "mN.m/rad", "kN.m/rad", "N.mm/rad", "N.m/deg", "mN.m/deg", "lbf.in/rad"}},
      {"N.m.s/rad",
       "a torsional damping coefficient",
       "0.04 N.m.s/rad",
       {"N.m.s/rad", "N m s/rad", "N*m*s/rad", "mN.m.s/rad", "kN.m.s/rad", "N.mm.s/rad", "N.m.s/deg",
        "lbf.in.s/rad"}},
      {"rad/s", "an angular velocity", "0.5 rad/s", {"rad/s", "mrad/s", "deg/s", "rpm"}},
      {"rad/s^2", "an angular acceleration", "3 rad/s^2", {"rad/s^2", "mrad/s^2", "deg/s^2", "rad/s2", "deg/s2"}},
      {"N.m/s", "a torque rate", "0.5 N.m/s", {"N.m/s", "mN.m/s", "kN.m/s"}},
      {"N.m/rad^3",
       "a cubic torsional stiffness",
       "20 N.m/rad^3",
       {"N.m/rad^3", "mN.m/rad^3", "kN.m/rad^3", "N.m/rad3", "N.m/deg^3"}},
      {"rad^2.s", "a spectral density", "2 rad^2/Hz", {"rad^2.s", "rad^2/Hz", "mrad^2/Hz", "deg^2/Hz"}},
      {"N^2.m^2.s", "a spectral density", "2 N^2.m^2/Hz", {"N^2.m^2.s", "N^2.m^2/Hz", "mN^2.m^2/Hz"}},
  };
  return table;
}

const Dimension* find_in(const std::vector<Dimension>& table, std::string_view si_unit) {
  const auto found = std::ranges::find(table, si_unit, &Dimension::si_unit);
  return found == table.end() ? nullptr : &*found;
}

const Dimension* find_dimension(std::string_view si_unit, Coordinate coordinate) {
  const std::string unit = unit_for(coordinate, si_unit);
  const Dimension* changed = unit == si_unit ? nullptr : find_in(dimensions_of_rotation(), unit);
  return changed != nullptr ? changed : find_in(dimensions(), unit);
}

/// value * multiply / divide: kept apart so that 90 deg and 3 um round once where one rounding is enough.
struct Factor {
  double multiply = 1.0;
  double divide = 1.0;

  [[nodiscard]] double apply(double value) const { return value * multiply / divide; }
};

constexpr double pi = std::numbers::pi;

std::optional<Factor> angle_factor(std::string_view unit) {
  if (unit.empty() || unit == "rad" || unit == "radian" || unit == "radians") return Factor{};
  if (unit == "mrad") return Factor{1.0, 1000.0};
  if (unit == "deg" || unit == "degree" || unit == "degrees") return Factor{pi, 180.0};
  return std::nullopt;
}

std::optional<Factor> frequency_factor(std::string_view unit) {
  if (unit == "rad/s") return Factor{};
  if (unit == "Hz") return Factor{2.0 * pi, 1.0};
  if (unit == "mHz") return Factor{2.0 * pi, 1000.0};
  if (unit == "kHz") return Factor{2000.0 * pi, 1.0};
  if (unit == "rpm") return Factor{pi, 30.0};
  return std::nullopt;
}

/// ASCII spelling of the characters an engineer may type.
std::string to_ascii(std::string_view unit) {
  static constexpr std::array<std::array<std::string_view, 2>, 8> spellings = {{{"\u00b5", "u"},
                                                                                {"\u03bc", "u"},
                                                                                {"\u00b7", "."},
                                                                                {"\u22c5", "."},
                                                                                {"\u00b2", "^2"},
                                                                                {"\u00b3", "^3"},
                                                                                {"\u00b0", "deg"},
                                                                                {"**", "^"}}};
  std::string text(unit);
  for (const auto& [from, to] : spellings)
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  return text;
}

/// The part of udunits2's grammar that means one thing only: products of names with integer powers. Keeps numbers
/// (`2 N`), fractional powers, offsets and references (`K @ 273`, `s since 1990`, `lg(re 1 mW)`) from udunits2.
class UnitGrammar {
 public:
  explicit UnitGrammar(std::string_view text) : text_(text) {}

  [[nodiscard]] bool accepts() { return product() && at_ == text_.size(); }

 private:
  [[nodiscard]] char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  [[nodiscard]] static bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
  [[nodiscard]] static bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

  void skip_spaces() {
    while (peek() == ' ') ++at_;
  }

  bool product() {
    if (!factor(true)) return false;
    while (at_ < text_.size() && peek() != ')') {
      const std::size_t before = at_;
      skip_spaces();
      if (peek() == '.' || peek() == '*' || peek() == '/') ++at_;
      skip_spaces();
      if (at_ == before || !factor(false)) return false;
    }
    return true;
  }

  bool factor(bool first) {
    if (first && peek() == '1') {  // 1/s
      ++at_;
      return peek() == '/';
    }
    if (peek() == '(') {
      ++at_;
      if (++depth_ > 4 || !product() || peek() != ')') return false;
      --depth_;
      ++at_;
      return power();
    }
    return name() && power();
  }

  bool name() {
    const std::size_t begin = at_;
    while (is_letter(peek()) || peek() == '_' || peek() == '%') ++at_;
    const std::string_view word = text_.substr(begin, at_ - begin);
    static constexpr std::array<std::string_view, 5> references = {"since", "after", "from", "ref", "re"};
    return !word.empty() && peek() != '(' && std::ranges::find(references, word) == references.end();
  }

  bool power() {
    const bool caret = peek() == '^';
    if (caret) ++at_;
    if (peek() == '-') {
      ++at_;
      if (!is_digit(peek())) return false;
    }
    const std::size_t digits = at_;
    while (is_digit(peek())) ++at_;
    if (at_ - digits > 1) return false;
    return !caret || at_ > digits;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

/// udunits2's parser has global state: one system, one mutex.
class UnitSystem {
 public:
  static UnitSystem& instance() {
    static UnitSystem system;
    return system;
  }

  /// Factor to `si_unit`; no value when the unit is unknown or of another dimension.
  struct Answer {
    bool known = false;
    std::optional<Factor> factor;
  };

  Answer factor(const std::string& unit, const std::string& si_unit) {
    const std::lock_guard lock(mutex_);
    const auto cached = answers_.find({unit, si_unit});
    if (cached != answers_.end()) return cached->second;
    Answer answer = convert(unit, si_unit);
    if (answers_.size() < max_cached) answers_.emplace(std::pair{unit, si_unit}, answer);
    return answer;
  }

  /// Whether it is a product of base units and nothing else.
  bool is_coherent(const std::string& text) {
    const std::lock_guard lock(mutex_);
    const Unit unit = parse(text);
    if (!unit || angle_power(unit) != 0) return false;
    const std::optional<std::string> base = definition(unit);
    // A factor comes first and an offset last, each beside a space.
    return base && !base->empty() && *base != "1" && base->find(' ') == std::string::npos;
  }

 private:
  using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;
  using Converter = std::unique_ptr<cv_converter, decltype(&cv_free)>;

  UnitSystem() : system_((ut_set_error_message_handler(ut_ignore), ut_read_xml(nullptr)), &ut_free_system) {
    if (!system_)
      throw std::runtime_error("the unit database of udunits2 cannot be read; is libudunits2-data installed?");
  }

  [[nodiscard]] Unit parse(const std::string& text) const {
    return {ut_parse(system_.get(), text.c_str(), UT_ASCII), &ut_free};
  }

  /// In base units: "9.8 m.kg.s-2".
  static std::optional<std::string> definition(const Unit& unit) {
    std::array<char, 256> buffer{};
    const int length = ut_format(unit.get(), buffer.data(), buffer.size(), UT_ASCII | UT_DEFINITION);
    if (length < 0) return std::nullopt;
    return std::string(buffer.data(), static_cast<std::size_t>(length));
  }

  /// Exponent of the radian: udunits2 counts an angle as the number 1; here an angle is an angle.
  static std::optional<int> angle_power(const Unit& unit) {
    const std::optional<std::string> text = definition(unit);
    if (!text) return std::nullopt;
    const std::size_t at = text->find("rad");
    if (at == std::string::npos) return 0;
    const std::string_view rest = std::string_view(*text).substr(at + 3);
    if (rest.empty() || rest.front() == '.') return 1;
    const std::optional<double> power = read_number(rest).value;
    return power ? std::optional(static_cast<int>(*power)) : std::nullopt;
  }

  [[nodiscard]] Answer convert(const std::string& unit_text, const std::string& si_text) const {
    const Unit unit = parse(unit_text);
    const Unit si = parse(si_text);
    if (!unit || !si) return {};
    const std::optional<int> power = angle_power(unit);
    if (!power || power != angle_power(si) || ut_are_convertible(unit.get(), si.get()) == 0)
      return {true, std::nullopt};
    const Converter converter(ut_get_converter(unit.get(), si.get()), &cv_free);
    if (!converter) return {true, std::nullopt};
    const double factor = cv_convert_double(converter.get(), 1.0);
    // udunits2 also converts seconds to hertz (a reciprocal) and degrees Celsius to kelvin (an offset).
    const bool linear =
        cv_convert_double(converter.get(), 0.0) == 0.0 &&
        std::abs(cv_convert_double(converter.get(), 2.0) - 2.0 * factor) <= 1e-12 * std::abs(factor);
    if (!linear || !std::isfinite(factor) || factor <= 0.0) return {true, std::nullopt};
    return {true, rounded(factor)};
  }

  /// 1e-6 is not a double but 1e6 is: dividing by it rounds once. What is left is a decimal of few digits (an inch
  /// is 0.0254 m) that udunits2 has reached over several roundings.
  static Factor rounded(double factor) {
    constexpr double tolerance = 4e-16;
    const double up = std::nearbyint(factor);
    if (up >= 1.0 && std::abs(factor / up - 1.0) <= tolerance) return {up, 1.0};
    const double down = std::nearbyint(1.0 / factor);
    if (down >= 1.0 && std::abs(factor * down - 1.0) <= tolerance) return {1.0, down};
    const std::optional<double> decimal = parse_number(format_number(factor, 14)).value;
    if (decimal && std::abs(*decimal / factor - 1.0) <= tolerance) return {*decimal, 1.0};
    return {factor, 1.0};
  }

  static constexpr std::size_t max_cached = 1000;

  std::mutex mutex_;
  std::unique_ptr<ut_system, decltype(&ut_free_system)> system_;
  std::map<std::pair<std::string, std::string>, Answer> answers_;
};

std::string trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(' ') - begin + 1));
}

std::string quoted(std::string_view text) {
  return "'" + std::string(text.substr(0, 80)) + (text.size() > 80 ? "...'" : "'");  // some are of a megabyte
}

QuantityText refused(std::string fault) { return {std::nullopt, std::move(fault), {}}; }

/// A usual unit that differs in case only, or in nothing but the prefix's spelling, or that has a radian more.
std::string similar_unit(std::string_view unit, std::string_view si_unit, Coordinate coordinate) {
  const auto lower = [](std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
  };
  for (const std::string_view candidate : usual_units(si_unit, coordinate))
    if (lower(candidate) == lower(unit) || candidate == std::string(unit) + "/rad") return std::string(candidate);
  return {};
}

/// Where an acceleration is asked for, g is no gram but standard gravity, as on the label of an accelerometer.
std::string with_gravity(std::string_view unit) {
  static constexpr std::array<std::array<std::string_view, 2>, 6> names = {{{"g", "gravity"},
                                                                            {"g_n", "gravity"},
                                                                            {"gn", "gravity"},
                                                                            {"mg", "milligravity"},
                                                                            {"mg_n", "milligravity"},
                                                                            {"ug", "microgravity"}}};
  const auto found = std::ranges::find(names, unit, [](const auto& name) { return name[0]; });
  return std::string(found == names.end() ? unit : (*found)[1]);
}

/// udunits2 does not know `deg`.
std::string with_degrees(std::string_view unit) {
  const auto is_letter = [&](std::size_t at) {
    return at < unit.size() && std::isalpha(static_cast<unsigned char>(unit[at])) != 0;
  };
  std::string result;
  for (std::size_t at = 0; at < unit.size();) {
    const bool stands_alone =
        unit.substr(at).starts_with("deg") && !is_letter(at + 3) && (at == 0 || !is_letter(at - 1));
    result += stands_alone ? "arc_degree" : std::string(1, unit[at]);
    at += stands_alone ? 3 : 1;
  }
  return result;
}

struct UnitAnswer {
  std::optional<Factor> factor;
  std::string fault;
};

UnitAnswer frequency_unit(std::string_view unit) {
  if (const std::optional<Factor> factor = frequency_factor(unit)) return {factor, {}};
  if (unit.empty()) return {std::nullopt, "a frequency needs its unit, because Hz and rad/s differ by 2 pi"};
  return {std::nullopt, quoted(unit) + " is not a unit of a frequency"};
}

UnitAnswer factor_of(std::string_view text, std::string_view dimension_name, Coordinate coordinate) {
  const std::string unit = to_ascii(trimmed(text));
  const std::string si_unit = unit_for(coordinate, dimension_name);
  if (dimension_name == "rad/s") return frequency_unit(unit);
  if (const auto angle = si_unit == "rad" ? angle_factor(unit) : std::nullopt) return {angle, {}};
  if (unit.empty() || unit == si_unit) return {Factor{}, {}};
  constexpr std::size_t max_length = 64;
  if (unit.size() > max_length || !UnitGrammar(unit).accepts())
    return {std::nullopt,
            quoted(trimmed(text)) +
                " is not a unit: a product of unit names with integer powers is needed, such as 'N.s/m'"};
  const UnitSystem::Answer answer =
      UnitSystem::instance().factor(si_unit == "m/s^2" ? with_gravity(unit) : with_degrees(unit), si_unit);
  if (answer.factor) return {answer.factor, {}};
  if (!answer.known) return {std::nullopt, "the unit " + quoted(trimmed(text)) + " is not known"};
  const Dimension* dimension = find_dimension(dimension_name, coordinate);
  return {std::nullopt, quoted(trimmed(text)) + " is not a unit of " +
                            (dimension != nullptr ? std::string(dimension->noun) : quoted(si_unit))};
}

}  // namespace

QuantityText parse_quantity(std::string_view text, std::string_view si_unit, Coordinate coordinate) {
  const std::string body = trimmed(text);
  const NumberText number = read_number(body);
  if (!number.value) {
    if (number.length == 0) return refused("there is no number at the beginning of " + quoted(body));
    return refused("the number " + quoted(body.substr(0, number.length)) + " " + number.fault);
  }
  const std::string unit = trimmed(std::string_view(body).substr(number.length));
  const UnitAnswer answer = factor_of(unit, si_unit, coordinate);
  if (!answer.factor) {
    QuantityText result = refused(answer.fault);
    const std::string similar = similar_unit(unit, si_unit, coordinate);
    if (!similar.empty()) result.suggestion = body.substr(0, number.length) + " " + similar;
    return result;
  }
  const double value = answer.factor->apply(*number.value);
  if (!std::isfinite(value) || (value == 0.0 && *number.value != 0.0))
    return refused(quoted(body) + " is outside the range of double precision");
  return {value, {}, {}};
}

bool is_si(std::string_view unit) {
  if (find_in(dimensions(), unit) != nullptr) return true;
  return UnitGrammar(unit).accepts() && UnitSystem::instance().is_coherent(std::string(unit));
}

QuantityText unit_factor(std::string_view unit, std::string_view si_unit, Coordinate coordinate) {
  // A column of frequencies without unit is as ambiguous as a bare frequency.
  const UnitAnswer answer = factor_of(unit, si_unit, coordinate);
  if (!answer.factor) return {std::nullopt, answer.fault, similar_unit(trimmed(unit), si_unit, coordinate)};
  return {answer.factor->apply(1.0), {}, {}};
}

std::string describe_dimension(std::string_view si_unit, Coordinate coordinate) {
  const Dimension* dimension = find_dimension(si_unit, coordinate);
  if (dimension == nullptr) return "a quantity in " + unit_for(coordinate, si_unit);
  return std::string(dimension->noun) + " such as " + quoted(dimension->example);
}

const std::vector<std::string_view>& usual_units(std::string_view si_unit, Coordinate coordinate) {
  static const std::vector<std::string_view> none;
  const Dimension* dimension = find_dimension(si_unit, coordinate);
  return dimension == nullptr ? none : dimension->units;
}

}  // namespace dualdamp::core
