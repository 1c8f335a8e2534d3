#include "scenarios/analyses/shared/formulas.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "scenarios/format/json.hpp"
#include "scenarios/format/values.hpp"
#include "sim/analytic/contact.hpp"
#include "sim/analytic/den_hartog.hpp"

namespace dualdamp::scenarios {

namespace {

Field damping_ratio() {
  return quantity("damping_ratio", {"1"}, "zeta = c / (2 sqrt(m k))").required().at_least(0);
}
Field stiffness(std::string name, std::string meaning) {
  return quantity(std::move(name), {"N/m"}, std::move(meaning)).required().above(0);
}
Field friction_displacements() {
  return quantities("x_f", {"m"}, "friction displacements F0/k").required().at_least(0).items(1, 10'000);
}

std::vector<double> list(const Json& values) {
  std::vector<double> result;
  for (const Json& value : values) result.push_back(number(value));
  return result;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

Json friction_force(const Json& arguments) {
  Json forces = Json::array();
  for (const double x_f : list(arguments.at("x_f"))) forces.push_back(number(arguments.at("stiffness")) * x_f);
  return {{"F0", forces}};
}

Json mean_estimate(const Json& arguments) {
  const double x_f = mean(list(arguments.at("x_f")));
  return {
      {"zeta", mean(list(arguments.at("zeta")))}, {"x_f", x_f}, {"F0", number(arguments.at("stiffness")) * x_f}};
}

Json parameter_functions(const Json& arguments) {
  const double zeta = number(arguments.at("damping_ratio"));
  const sim::analytic::DenHartog functions =
      sim::analytic::den_hartog(zeta, number(arguments.at("frequency_ratio")));
  const bool defined = !functions.singular;
  return {{"G", defined ? finite_or_null(functions.G) : Json(nullptr)},
          {"H", defined ? finite_or_null(functions.H) : Json(nullptr)},
          {"q", functions.q},
          {"approximate_G", zeta > 0.0 ? finite_or_null(sim::analytic::approximate_G(zeta)) : Json(nullptr)}};
}

Json stiffness_transfer(const Json& arguments) {
  const double from = number(arguments.at("stiffness"));
  const double to = number(arguments.at("new_stiffness"));
  const double x_f = number(arguments.at("x_f"));
  return {{"zeta", number(arguments.at("damping_ratio")) * std::sqrt(from / to)},
          {"x_f", x_f * from / to},
          {"F0", from * x_f}};
}

Json transition_velocity(const Json& arguments) {
  const auto speed = sim::analytic::transition_velocity(
      number(arguments.at("frequency")), number(arguments.at("amplitude")), number(arguments.at("kinetic")),
      number(arguments.at("contact_stiffness")));
  return {{"V_s", speed ? Json(*speed) : Json(nullptr)}};
}

}  // namespace

const std::vector<FormulaEntry>& formulas() {
  static const std::vector<FormulaEntry> list = {
      {"friction_force",
       "friction forces of friction displacements",
       "F0 = k x_f",
       {{stiffness("stiffness", "spring k"), friction_displacements()}},
       {{"F0[]", "N", "friction force of each x_f"}},
       friction_force},
      {"mean_estimate",
       "means of repeated estimates",
       "zeta = mean(zeta_i), x_f = mean(x_f_i), F0 = k x_f",
       {{stiffness("stiffness", "spring k"),
         quantities("zeta", {"1"}, "estimates of the damping ratio").required().at_least(0).items(1, 10'000),
         friction_displacements()}},
       {{"zeta", "1", "mean damping ratio"}, {"x_f", "m", "mean friction displacement"}, {"F0", "N", "k x_f"}},
       mean_estimate},
      {"parameter_functions",
       "Den Hartog's parameter functions, Eqs (4) to (6), and the approximation Eq (15)",
       "x_o = -G x_f + sqrt(Y^2/q^2 - H^2 x_f^2)",
       {{damping_ratio(), quantity("frequency_ratio", {"1"}, "r = w / wn").with_fallback(1.0).at_least(1e-4)}},
       {{"G", "1", "Eq (4)"},
        {"H", "1", "Eq (5)"},
        {"q", "1", "Eq (6), the bracket squared"},
        {"approximate_G", "1", "Eq (15)"}},
       parameter_functions},
      {"stiffness_transfer",
       "an estimate on another spring, the same damper and friction force assumed",
       "zeta' = zeta sqrt(k/k'), x_f' = x_f k/k'",
       {{damping_ratio(), quantity("x_f", {"m"}, "friction displacement F0/k").required().at_least(0),
         stiffness("stiffness", "spring k of the estimate"), stiffness("new_stiffness", "the other spring k'")}},
       {{"zeta", "1", "damping ratio on the other spring"},
        {"x_f", "m", "friction displacement on the other spring"},
        {"F0", "N", "friction force, the same on both"}},
       stiffness_transfer},
      {"transition_velocity",
       "speed at which a compliant contact begins to slide, Eq (18)",
       "V_s = 2 w sqrt(X F/K - (F/K)^2)",
       {{quantity("frequency", {"rad/s"}, "forcing frequency w").required().above(0),
         quantity("amplitude", {"m"}, "amplitude X of the motion").required().above(0),
         quantity("kinetic", {"N"}, "friction force F").required().above(0),
         stiffness("contact_stiffness", "contact stiffness K")}},
       {{"V_s", "m/s", "transition velocity; null when the contact does not slide"}},
       transition_velocity},
  };
  return list;
}

const FormulaEntry* find_formula(std::string_view name) {
  const auto found = std::ranges::find(formulas(), name, &FormulaEntry::name);
  return found == formulas().end() ? nullptr : &*found;
}

}  // namespace dualdamp::scenarios
