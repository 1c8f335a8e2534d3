#include "friction_models/laws/lugre.hpp"

#include "core/numbers.hpp"
#include "friction_models/law_entry.hpp"
#include "friction_models/modifiers/modified.hpp"
#include "friction_models/modifiers/modifiers.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& Lugre::parameters() {
  static const std::vector<Parameter> table = [] {
    std::vector<Parameter> list = StribeckCurve::parameters(positive);
    list.push_back({.name = "sigma0", .unit = "N/m", .range = positive, .meaning = "stiffness of the bristles"});
    list.push_back(
        {.name = "sigma1", .unit = "N.s/m", .range = not_negative, .meaning = "damping of the bristles"});
    list.push_back(
        {.name = "sigma2", .unit = "N.s/m", .fallback = 0.0, .range = not_negative, .meaning = "viscous friction"});
    return list;
  }();
  return table;
}

std::vector<std::string> Lugre::warnings(const ParameterValues& values) {
  const double kinetic = values.number("kinetic");
  const double least = values.number("sigma1") * (values.number("static") - kinetic) / kinetic;
  if (values.number("sigma2") >= least) return {};
  return {"it may give out more work than it took in: sigma2 is below sigma1 (static - kinetic)/kinetic = " +
          core::format_number(least, 4) + " " + values.unit("N.s/m")};
}

Lugre::Bristles Lugre::bristles(const ParameterValues& values) {
  return {values.number("sigma0"), values.number("sigma1"), values.number("sigma2")};
}

Lugre::Lugre(const ParameterValues& values) : Lugre(StribeckCurve(values), bristles(values)) {}

double Lugre::respond(const Memory& memory, const Instant& now, Direction direction,
                      std::span<double> rates) const {
  const double z = memory.state[0];
  const double speed = sign(direction) * now.v;
  rates[0] = now.v - bristles_.sigma0 * speed * z / curve_.divisor(now, speed);
  return bristles_.force(z, rates[0], now.v);
}

double Lugre::dissipation(const Memory& memory, const Instant& now, Direction direction) const {
  double rate = 0.0;
  static_cast<void>(respond(memory, now, direction, {&rate, 1}));
  return bristles_.heat(memory.state[0], rate, now.v);
}

LawEntry lugre_entry() {
  return {.name = "lugre",
          .summary = "bristles with stiffness and damping that yield at a level that falls with speed",
          .equation =
              "F = sigma0 z + sigma1 z' + sigma2 v;  z' = v - sigma0 |v| z/g(v), g(v) = kinetic + (static - "
              "kinetic) exp(-(v/stribeck_velocity)^2)",
          .engine = EngineKind::smooth,
          .states = "mean deflection z of the bristles",
          .is_passive = false,
          .caution = "Under a load that oscillates below break-away about a mean the mass drifts.",
          .sources = "canudas1995, barabanov2000, dupont2002",
          // Where the load is lost the deflection would relax infinitely fast.
          .modifiers = all_modifiers_but("load_gradient"),
          .parameters = Lugre::parameters(),
          .make = [](const ParameterValues& p) -> std::vector<Law> {
            const Lugre law(p);
            return {modified(law, p, {p.number("kinetic"), p.number("static")}, {.damping = p.number("sigma2")})};
          },
          .warnings = Lugre::warnings};
}

}  // namespace dualdamp::friction
