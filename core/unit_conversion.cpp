#include "core/unit_conversion.hpp"

#include <udunits2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

#include "core/numbers.hpp"

namespace dualdamp::core {

namespace {

/// Units whose exact definition udunits2 rounds to some seven digits, or that it lacks (`dyn`), or takes for a
/// volume (`oz`). A pound is 0.45359237 kg, an ounce a sixteenth of it; a foot is 0.3048 m; standard gravity is
/// 9.80665 m/s^2.
struct ExactUnit {
  const char* definition;
  std::vector<const char*> names;
};

const std::vector<ExactUnit>& exact_units() {
  static const std::vector<ExactUnit> table = {
      {"0.028349523125 kg", {"oz", "avoirdupois_ounce", "avoirdupois_ounces"}},
      {"0.0017718451953125 kg", {"dr", "dram", "drams"}},
      {"6.479891e-5 kg", {"gr", "grain", "grains"}},
      {"0.00155517384 kg", {"pennyweight", "pennyweights"}},
      {"0.0311034768 kg", {"troy_ounce", "troy_ounces", "apothecary_ounce", "apothecary_ounces"}},
      {"0.3732417216 kg", {"troy_pound", "troy_pounds", "apothecary_pound", "apothecary_pounds"}},
      {"45.359237 kg", {"short_hundredweight", "short_hundredweights"}},
      {"50.80234544 kg", {"long_hundredweight", "long_hundredweights"}},
      {"14.593902937206364829 kg", {"slug", "slugs"}},
      {"0.27801385095378125 N", {"ozf", "ounce_force", "ounces_force", "force_ounce", "force_ounces"}},
      {"0.138254954376 N", {"poundal", "poundals"}},
      {"1e-5 N", {"dyn"}},
      {"745.69987158227022 W", {"hp", "horsepower", "shaft_horsepower", "UK_horsepower"}},
      {"735.49875 W", {"metric_horsepower"}},
  };
  return table;
}

class UnitGrammar {
 public:
  explicit UnitGrammar(std::string_view text) : text_(text) {}

  /// A share is no factor of a unit, "1 % kg" is a slip; but it may grow: "2 %/min".
  [[nodiscard]] bool accepts() { return text_ == "%" || text_ == "percent" || (product() && at_ == text_.size()); }

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
    if (first && (peek() == '1' || peek() == '%')) {  // 1/s, %/min
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
    while (is_letter(peek()) || peek() == '_') ++at_;
    const std::string_view word = text_.substr(begin, at_ - begin);
    static constexpr std::array<std::string_view, 6> refused = {"since", "after", "from", "ref", "re", "percent"};
    return !word.empty() && peek() != '(' && std::ranges::find(refused, word) == refused.end();
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
/// Throws std::bad_alloc if there is little memory left: udunits2 ends the program where an allocation fails.
void require_memory() {
  constexpr std::size_t enough = std::size_t{8} << 20U;  // of the database and its parser, some 3 MB
  ::operator delete(::operator new(enough));
}

class UnitSystem {
 public:
  static UnitSystem& instance() {
    static UnitSystem system;
    return system;
  }

  Conversion conversion(const std::string& unit, const std::string& si_unit) {
    const std::lock_guard lock(mutex_);
    const auto cached = answers_.find({unit, si_unit});
    if (cached != answers_.end()) return cached->second;
    Conversion answer = convert(unit, si_unit);
    if (answers_.size() < max_cached) answers_.emplace(std::pair{unit, si_unit}, answer);
    return answer;
  }

  bool is_coherent(const std::string& text) {
    const std::lock_guard lock(mutex_);
    const Unit unit = parse(text);
    if (!unit || angle_power(unit) != 0) return false;
    const std::optional<std::string> base = definition(unit);
    // In a definition a factor is first and an offset last, each separated by a space.
    return base && !base->empty() && *base != "1" && base->find(' ') == std::string::npos;
  }

 private:
  using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;
  using Converter = std::unique_ptr<cv_converter, decltype(&cv_free)>;

  UnitSystem()
      : system_((require_memory(), ut_set_error_message_handler(ut_ignore), errno = 0, ut_read_xml(nullptr)),
                &ut_free_system) {
    // It is not installed, or there is no memory for it.
    if (!system_)
      throw std::system_error(errno == 0 ? EIO : errno, std::generic_category(),
                              "the unit database of udunits2 (package libudunits2-data) cannot be read");
    for (const ExactUnit& exact : exact_units())
      for (const char* name : exact.names) define(name, exact.definition);
  }

  /// udunits2 knows a unit by names, whose case does not matter, and by symbols, whose case does.
  void define(const char* name, const char* definition) {
    const Unit unit = parse(definition);
    ut_unmap_name_to_unit(system_.get(), name, UT_ASCII);
    ut_unmap_symbol_to_unit(system_.get(), name, UT_ASCII);
    ut_map_symbol_to_unit(name, UT_ASCII, unit.get());
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

  /// Exponent of the radian: udunits2 counts an angle as the number 1; here it is a dimension of its own.
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

  [[nodiscard]] Conversion convert(const std::string& unit_text, const std::string& si_text) const {
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

  /// The intended factor next to `factor`. 1e-6 is no double but 1e6 is, and a division by it rounds once. Other
  /// factors are decimals of few digits (an inch is 0.0254 m), which udunits2 computes with several roundings.
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
  std::map<std::pair<std::string, std::string>, Conversion> answers_;
};

}  // namespace

bool is_product_of_units(std::string_view text) { return UnitGrammar(text).accepts(); }

Conversion conversion(const std::string& unit, const std::string& si_unit) {
  return UnitSystem::instance().conversion(unit, si_unit);
}

bool is_coherent(const std::string& unit) { return UnitSystem::instance().is_coherent(unit); }

}  // namespace dualdamp::core
