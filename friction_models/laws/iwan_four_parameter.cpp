#include "friction_models/laws/iwan_four_parameter.hpp"

#include <cmath>

#include "friction_models/law_entry.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& IwanFourParameter::parameters() {
  static const std::vector<Parameter> table = {
      {.name = "stiffness",
       .unit = "N/m",
       .range = positive,
       .meaning = "stiffness of the joint before anything slides, K_T"},
      {.name = "limit",
       .unit = "N",
       .range = positive,
       .meaning = "force at which everything slides (macroslip), F_S"},
      {.name = "exponent",
       .unit = "1",
       // Beyond 20 powers of small slip distances leave double precision; joints have -1 to 0.
       .range = {.low = -1.0, .high = 20.0, .low_open = true},
       .meaning = "chi: the work of a loop is proportional to the power chi + 3 of its amplitude"},
      {.name = "beta",
       .unit = "1",
       .range = {.low = 0.0, .high = 1e6},
       .meaning = "stiffness of the element that slides last, divided by that of all others"},
      {.name = "count",
       .kind = ParameterKind::count,
       .fallback = 100.0,
       .range = {.low = 2.0, .high = 10'000.0},
       .meaning = "number of elements beside the last one"},
      {.name = "smallest",
       .unit = "1",
       .fallback = 1e-4,
       .range = {.low = 1e-12, .high = 1.0, .high_open = true},
       .meaning = "smallest slip distance at which the elements resolve the power law, relative to the largest "
                  "one"},
  };
  return table;
}

double IwanFourParameter::phi_max() const {
  return limit / stiffness * (1.0 + beta) / (beta + (exponent + 1.0) / (exponent + 2.0));
}

double IwanFourParameter::S() const { return stiffness * beta / (1.0 + beta); }

double IwanFourParameter::R() const {
  return stiffness / (1.0 + beta) * (exponent + 1.0) / std::pow(phi_max(), exponent + 1.0);
}

std::vector<Iwan::Element> IwanFourParameter::elements(int count, double smallest) const {
  const double largest = phi_max();
  const double power = exponent + 1.0;
  const double spread = stiffness / (1.0 + beta);  // of all elements but the last [N/m]
  const double ratio = count > 1 ? -std::log(smallest) / (count - 1) : 0.0;
  std::vector<Iwan::Element> elements;
  double below = 0.0;  // edges over the largest slip distance
  for (int i = 0; i < count; ++i) {
    const double edge = std::exp(ratio * (i - (count - 1)));
    const double k = spread * (std::pow(edge, power) - std::pow(below, power));
    const double f =
        spread * largest * power / (power + 1.0) * (std::pow(edge, power + 1.0) - std::pow(below, power + 1.0));
    // With a steep power the smallest cells may be empty.
    if (k > 0.0 && f > 0.0) elements.push_back({k, f});
    below = edge;
  }
  if (beta > 0.0) elements.push_back({S(), S() * largest});
  return elements;
}

LawEntry iwan_four_parameter_entry() {
  return {
      .name = "iwan_four_parameter",
      .summary = "Segalman's model of a bolted joint: slip distances by a power law, dissipation A^(exponent+3)",
      .equation =
          "F = sum of stiffness (x - a) over stuck elements, of +-limit over sliding ones; slip distances phi "
          "of density rho = R phi^exponent up to phi_max, and S at phi_max: stiffness = R "
          "phi_max^(exponent+1)/(exponent+1) + S, limit = R phi_max^(exponent+2)/(exponent+2) + S phi_max, beta = "
          "S/(stiffness - S)",
      .states = "turning points that are remembered",
      .sources = "segalman2005, iwan1966",
      .modifiers = Iwan::modifiers(),
      .parameters = IwanFourParameter::parameters(),
      .make = [](const ParameterValues& p) -> std::vector<Law> {
        const IwanFourParameter joint{p.number("stiffness"), p.number("limit"), p.number("exponent"),
                                      p.number("beta")};
        return Iwan::laws(joint.elements(static_cast<int>(p.count("count")), p.number("smallest")), p);
      }};
}

}  // namespace dualdamp::friction
