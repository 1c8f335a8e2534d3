#include "friction_models/laws/elasto_plastic.hpp"

#include <cmath>
#include <numbers>

#include "core/numbers.hpp"
#include "friction_models/law_entry.hpp"
#include "friction_models/modifiers/modified.hpp"
#include "friction_models/modifiers/modifiers.hpp"

namespace dualdamp::friction {

const std::vector<Parameter>& ElastoPlastic::parameters() {
  static const std::vector<Parameter> table = [] {
    std::vector<Parameter> list = Lugre::parameters();
    list.push_back({.name = "elastic_limit",
                    .unit = "m",
                    .range = positive,
                    .meaning = "deflection up to which the bristles do not yield, < kinetic/sigma0"});
    return list;
  }();
  return table;
}

std::vector<ParameterFault> ElastoPlastic::check(const ParameterValues& values) {
  const double limit = values.number("elastic_limit");
  const double beyond = values.number("kinetic") / values.number("sigma0");
  if (limit < beyond) return {};
  const std::string unit = values.unit("m");
  return {{.name = "elastic_limit",
           .message = "'elastic_limit' is not below kinetic/sigma0",
           .allowed = "> 0 " + unit + " and < " + core::format_number(beyond) + " " + unit,
           .found = core::format_number(limit) + " " + unit}};
}

ElastoPlastic::ElastoPlastic(const ParameterValues& values)
    : ElastoPlastic(StribeckCurve(values), Lugre::bristles(values), values.number("elastic_limit")) {}

double ElastoPlastic::plastic_share(const Instant& now, double stretch, double level) const {
  const double largest = level / bristles_.sigma0;
  if (stretch >= largest) return 1.0;
  const double least = now.force_limit_now(elastic_force_) / bristles_.sigma0;
  return 0.5 * std::sin(std::numbers::pi * (stretch - (largest + least) / 2.0) / (largest - least)) + 0.5;
}

double ElastoPlastic::respond(const Memory& memory, const Instant& now, Direction direction,
                              std::span<double> rates) const {
  const double z = memory.state[0];
  rates[0] = now.v;
  if (memory.mode == yielding) {
    const double speed = sign(direction) * now.v;
    const double level = curve_.divisor(now, speed);
    const double share = plastic_share(now, sign(direction) * z, level);
    rates[0] -= share * bristles_.sigma0 * speed * z / level;
  }
  return bristles_.force(z, rates[0], now.v);
}

void ElastoPlastic::guards(const Memory& memory, const Instant& now, Direction direction,
                           std::vector<double>& values) const {
  if (direction == Direction::none) return;
  const double room = now.force_limit_now(elastic_force_) - sign(direction) * bristles_.sigma0 * memory.state[0];
  values.push_back(memory.mode == elastic ? room : -room);
}

double ElastoPlastic::dissipation(const Memory& memory, const Instant& now, Direction direction) const {
  double rate = 0.0;
  static_cast<void>(respond(memory, now, direction, {&rate, 1}));
  return bristles_.heat(memory.state[0], rate, now.v);
}

namespace {

std::vector<Law> make_elasto_plastic(const ParameterValues& p) {
  const double elastic = p.number("sigma0") * p.number("elastic_limit");
  return {modified(ElastoPlastic(p), p, {elastic, p.number("kinetic"), p.number("static")},
                   {.damping = p.number("sigma2")})};
}

}  // namespace

LawEntry elasto_plastic_entry() {
  return {
      .name = "elasto_plastic",
      .summary = "LuGre bristles with an elastic range, so that they do not drift (Dupont and others)",
      .equation =
          "F = sigma0 z + sigma1 z' + sigma2 v;  z' = v (1 - alpha(z, v) sigma0 sgn(v) z/g(v)), g as in "
          "lugre;  alpha = 0 for |z| <= elastic_limit or sgn z != sgn v, 1 for |z| >= z_m = g(v)/sigma0, else (1 "
          "+ sin(pi (|z| - (z_m + elastic_limit)/2)/(z_m - elastic_limit)))/2",
      .engine = EngineKind::smooth,
      .states = "mean deflection z of the bristles",
      .is_passive = false,
      .sources = "dupont2002",
      // Where the load is lost the deflection would relax infinitely fast.
      .modifiers = all_modifiers_but("load_gradient"),
      .parameters = ElastoPlastic::parameters(),
      .make = make_elasto_plastic,
      .check = ElastoPlastic::check,
      .warnings = Lugre::warnings};
}

}  // namespace dualdamp::friction
