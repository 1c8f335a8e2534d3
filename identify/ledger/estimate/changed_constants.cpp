#include "identify/ledger/estimate/changed_constants.hpp"

#include <cmath>

#include "core/diagnostics.hpp"
#include "core/numbers.hpp"

namespace dualdamp::identify {

namespace {

constexpr int digits_of_constant = 4;

}  // namespace

std::vector<ChangedConstant> changed_constants(const KnownConstants& fitted, const KnownConstants& stated) {
  std::vector<ChangedConstant> list;
  const auto add = [&](const char* what, double now, double before, const char* unit) {
    constexpr double same = 1e-6;
    if (!(std::abs(now - before) > same * std::abs(before))) return;
    int digits = digits_of_constant;
    while (core::format_number(now, digits) == core::format_number(before, digits)) ++digits;
    const std::string in_unit = " " + stated.unit(unit);
    list.push_back(
        {what + core::format_number(now, digits) + in_unit, core::format_number(before, digits) + in_unit});
  };
  add("a stiffness of ", fitted.stiffness, stated.stiffness, "N/m");
  add("a mass of ", fitted.mass, stated.mass, "kg");
  return list;
}

std::string text_of(const KnownConstants& constants) {
  std::vector<std::string> texts;
  const auto add = [&](const char* what, double value, const char* unit) {
    if (std::isfinite(value))
      texts.push_back(what + core::format_number(value, digits_of_constant) + " " + constants.unit(unit));
  };
  add("stiffness of ", constants.stiffness, "N/m");
  add("mass of ", constants.mass, "kg");
  return core::joined(texts, " and ");
}

}  // namespace dualdamp::identify
