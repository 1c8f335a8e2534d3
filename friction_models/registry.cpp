#include "friction_models/registry.hpp"

#include <algorithm>

#include "friction_models/bouc_wen.hpp"
#include "friction_models/bristle.hpp"
#include "friction_models/contact_compliance.hpp"
#include "friction_models/coulomb.hpp"
#include "friction_models/dahl.hpp"
#include "friction_models/elasto_plastic.hpp"
#include "friction_models/friction_lag.hpp"
#include "friction_models/generalized_maxwell_slip.hpp"
#include "friction_models/iwan.hpp"
#include "friction_models/lugre.hpp"
#include "friction_models/modified.hpp"
#include "friction_models/modifiers.hpp"
#include "friction_models/normal_vibration.hpp"
#include "friction_models/rate_state.hpp"
#include "friction_models/reset_integrator.hpp"
#include "friction_models/stribeck.hpp"
#include "friction_models/viscous_power.hpp"
#include "friction_models/viscous_saturating.hpp"

namespace dualdamp::friction {

namespace {

using Values = ParameterValues;

/// Limits that vary break the order in which its elements slide, so they then go each by itself.
std::vector<Law> make_iwan(const Values& p) {
  if (!p.has("drift") && !p.has("fluctuation")) return {Law(Iwan(Iwan::elements(p)))};
  std::vector<Law> laws;
  for (const auto& [stiffness, limit] : Iwan::elements(p))
    laws.push_back(modified(Law(ContactCompliance(limit, limit, stiffness, 0.0)), p));
  return laws;
}

std::vector<Law> make_friction_lag(const Values& p) {
  const StribeckCurve curve(p);
  const double lag = p.number("lag");
  const Law law = p.flag("delay") ? Law(DelayedFriction(curve, lag)) : Law(FrictionLag(curve, lag));
  return {modified(law, p, {p.number("kinetic"), p.number("static")})};
}

std::vector<LawEntry> make_list() {
  const std::vector<std::string_view> all_modifiers = {"drift", "position_slope", "fluctuation", "warming"};
  return {
      {.name = "bouc_wen",
       .summary = "hysteretic spring that yields gradually (Bouc and Wen)",
       .equation =
           "F = stiffness (ratio x + (1 - ratio) z);  z' = v (1 - |z/z0|^exponent (b sgn(v z) + 1 - b)), z0 "
           "= limit/stiffness, b = beta_share",
       .engine = EngineKind::smooth,
       .states = "hysteretic deflection z",
       .is_passive = false,
       .caution = "A loop does not close where it began: it has no return-point memory.",
       .sources = "bouc1967, wen1976, erlicher2004",
       .modifiers = {"drift", "fluctuation", "warming"},
       .parameters = BoucWen::parameters(),
       .make = [](const Values& p) -> std::vector<Law> {
         const Law law(BoucWen(p.number("limit"), p.number("stiffness"), p.number("exponent"), p.number("ratio"),
                               p.number("beta_share")));
         return {modified(law, p)};
       },
       .warnings = BoucWen::warnings},
      {.name = "bristle",
       .summary = "bonds that stretch, snap and form anew at random (Haessig and Friedland)",
       .equation = "F = sum of stiffness (x - b);  at |x - b| = snap_distance: b = x + snap_distance U(-1, 1)",
       .states = "place of each bristle",
       .is_random = true,
       .is_odd = false,
       .sources = "haessig1991",
       .modifiers = {"fluctuation"},
       .parameters = Bristle::parameters(),
       .make = [](const Values& p) -> std::vector<Law> {
         const Law law(Bristle(p.number("stiffness"), p.number("snap_distance"), static_cast<int>(p.count("count")),
                               p.seed("seed")));
         return {modified(law, p)};
       }},
      {.name = "contact_compliance",
       .summary = "Coulomb slider behind a contact spring, which may be damped",
       .equation =
           "stuck: F = contact_stiffness (x - a) + contact_damping v, |F| < static;  slipping: F = +-kinetic",
       .states = "position of the slider",
       .sources = "liang2004identifying, jenkins1962, iwan1966",
       .modifiers = all_modifiers,
       .parameters = ContactCompliance::parameters(),
       .make = [](const Values& p) -> std::vector<Law> {
         const Law law(ContactCompliance(p.number("kinetic"), p.number("static"), p.number("contact_stiffness"),
                                         p.number("contact_damping")));
         return {modified(law, p, {p.number("kinetic"), p.number("static")})};
       }},
      {.name = "coulomb",
       .summary = "constant force against the motion, static limit at rest",
       .equation = "slip: F = kinetic sgn v;  rest: F = pull while |pull| <= static",
       .sources = "coulomb1785, denhartog1931",
       .modifiers = all_modifiers,
       .parameters = Coulomb::parameters(),
       .make = [](const Values& p) -> std::vector<Law> {
         const Law law(Coulomb(p.number("kinetic"), p.number("static")));
         return {modified(law, p, {p.number("kinetic"), p.number("static")})};
       }},
      {.name = "dahl",
       .summary = "bristles that give way gradually, whatever the speed (Dahl)",
       .equation = "F = sigma0 z;  z' = v |1 - sigma0 z sgn v/kinetic|^exponent sgn(1 - sigma0 z sgn v/kinetic)",
       .engine = EngineKind::smooth,
       .states = "mean deflection z of the bristles",
       .sources = "dahl1976",
       .modifiers = all_modifiers,
       .parameters = Dahl::parameters(),
       .make = [](const Values& p) -> std::vector<Law> {
         const Law law(Dahl(p.number("kinetic"), p.number("sigma0"), p.number("exponent")));
         return {modified(law, p, {p.number("kinetic")})};
       }},
      {.name = "elasto_plastic",
       .summary = "LuGre bristles with an elastic range, which do not drift (Dupont and others)",
       .equation =
           "F = sigma0 z + sigma1 z' + sigma2 v;  z' = v (1 - alpha(z, v) sigma0 sgn(v) z/g(v)), alpha = 0 up "
           "to elastic_limit, g as in lugre",
       .engine = EngineKind::smooth,
       .states = "mean deflection z of the bristles",
       .is_passive = false,
       .sources = "dupont2002",
       .modifiers = all_modifiers,
       .parameters = ElastoPlastic::parameters(),
       .make = [](const Values& p) -> std::vector<Law> {
         return {
             modified(Law(ElastoPlastic(p)), p,
                      {p.number("sigma0") * p.number("elastic_limit"), p.number("kinetic"), p.number("static")})};
       },
       .check = ElastoPlastic::check,
       .warnings = Lugre::warnings},
      {.name = "friction_lag",
       .summary = "force against the motion at a level that follows the speed late",
       .equation =
           "slip: F = level sgn v;  rest: F = pull while |pull| <= level, level = g(|w|), w' = (v - w)/lag, or "
           "with delay g(|v(t - lag)|), g as the level of stribeck",
       .engine = EngineKind::smooth,
       .states = "late velocity w; with delay the velocities of the last lag",
       .sources = "rice1983, hess1990",
       .modifiers = all_modifiers,
       .parameters = FrictionLag::parameters(),
       .make = make_friction_lag,
       .check = StribeckCurve::check_shape},
      {.name = "generalized_maxwell_slip",
       .summary = "springs in parallel that slip one after the other at a level that falls with speed",
       .equation =
           "stuck: F_i' = stiffness v until sgn(v) F_i = share s(v);  slipping: F_i' = attraction (share sgn v "
           "- F_i/s(v));  F = sum of F_i, s(v) as g(v) of lugre",
       .engine = EngineKind::smooth,
       .states = "force of each element, and whether it slips",
       .is_passive = false,
       .sources = "lampaert2003, albender2005",
       .modifiers = all_modifiers,
       .parameters = GeneralizedMaxwellSlip::parameters(),
       .make = [](const Values& p) -> std::vector<Law> {
         return {modified(Law(GeneralizedMaxwellSlip(p)), p, {p.number("kinetic"), p.number("static")})};
       },
       .check = GeneralizedMaxwellSlip::check,
       .warnings = GeneralizedMaxwellSlip::warnings},
      {.name = "iwan",
       .summary = "springs with Coulomb sliders in parallel, which slide one after the other",
       .equation = "F = sum of stiffness (x - a) over stuck elements, of +-limit over sliding ones",
       .states = "turning points that are remembered",
       .sources = "iwan1966, masing1926",
       .modifiers = {"drift", "fluctuation"},
       .parameters = Iwan::parameters(),
       .make = make_iwan},
      {.name = "lugre",
       .summary = "bristles that bend, with damping, and give way at a level that falls with speed",
       .equation = "F = sigma0 z + sigma1 z' + sigma2 v;  z' = v - sigma0 |v| z/g(v), g(v) = kinetic + (static - "
                   "kinetic) exp(-(v/stribeck_velocity)^2)",
       .engine = EngineKind::smooth,
       .states = "mean deflection z of the bristles",
       .is_passive = false,
       .caution = "Under a load that oscillates below break-away about a mean the mass drifts.",
       .sources = "canudas1995, barabanov2000, dupont2002",
       .modifiers = all_modifiers,
       .parameters = Lugre::parameters(),
       .make = [](const Values& p) -> std::vector<Law> {
         return {modified(Law(Lugre(p)), p, {p.number("kinetic"), p.number("static")})};
       },
       .warnings = Lugre::warnings},
      {.name = "normal_vibration",
       .summary = "Coulomb friction under a normal load that vibrates, lifted by slip",
       .equation =
           "F = mu N sgn v, N = weight (1 - y/h0)^2 while y < h0;  normal_mass y'' + d y' = N - weight + lift "
           "|v|/(1 + |v|/lift_velocity);  rest: F = pull while |pull| <= mu_static N",
       .engine = EngineKind::smooth,
       .states = "separation y and its rate, and whether the contact is open",
       .sources = "tolstoi1967, oden1985",
       .modifiers = {"drift", "fluctuation", "warming"},
       .parameters = NormalVibration::parameters(),
       .make = [](const Values& p) -> std::vector<Law> { return {modified(Law(NormalVibration(p)), p)}; },
       .warnings = NormalVibration::warnings},
      {.name = "rate_state",
       .summary = "friction that grows with ln of speed at once and falls with it over a distance of slip",
       .equation = "F = a normal_force asinh(v/(2 V0) exp((mu0 + b psi)/a));  aging: psi' = (V0/Dc) (exp(-psi) - "
                   "|v|/V0);  slip: psi' = -(|v|/Dc) (ln(|v|/V0) + psi)",
       .engine = EngineKind::smooth,
       .states = "age psi of the contacts, ln",
       .sources = "dieterich1979, ruina1983, rice1983, rice2001",
       .modifiers = {"drift", "fluctuation", "warming"},
       .parameters = RateState::parameters(),
       .make = [](const Values& p) -> std::vector<Law> { return {modified(Law(RateState(p)), p)}; },
       .warnings = RateState::warnings},
      {.name = "reset_integrator",
       .summary = "bond that stretches, breaks and is dragged along (Haessig and Friedland)",
       .equation = "stick: z' = v, F = (1 + static_gain) stiffness z + damping v, |z| < z0 = kinetic/stiffness;  "
                   "slip: F = +-kinetic",
       .states = "other end of the bond",
       .sources = "haessig1991",
       .modifiers = {"drift", "position_slope", "fluctuation"},
       .parameters = ResetIntegrator::parameters(),
       .make = [](const Values& p) -> std::vector<Law> {
         const Law law(ResetIntegrator(p.number("kinetic"), p.number("stiffness"), p.number("static_gain"),
                                       p.number("damping")));
         return {modified(law, p, {p.number("kinetic")})};
       }},
      {.name = "stribeck",
       .summary = "force against the motion that falls with speed, static limit at rest",
       .equation = "slip: F = level(|v|) sgn v, level(u) = kinetic + (static - kinetic) h(u/stribeck_velocity);  "
                   "rest: F = pull while |pull| <= static",
       .engine = EngineKind::smooth,
       .sources = "stribeck1902, armstrong1994, bo1982",
       .modifiers = all_modifiers,
       .parameters = Stribeck::parameters(),
       .make = [](const Values& p) -> std::vector<Law> {
         return {modified(Law(Stribeck(StribeckCurve(p))), p, {p.number("kinetic"), p.number("static")})};
       },
       .check = StribeckCurve::check_shape},
      {.name = "viscous_power",
       .summary = "force against the motion that goes with a power of speed: drag, films that thin under shear",
       .equation = "F = coefficient (|v|/reference_velocity)^exponent sgn v",
       .engine = EngineKind::smooth,
       .sources = "ostwald1925, jacobsen1930",
       .modifiers = {"drift", "fluctuation", "warming"},
       .parameters = ViscousPower::parameters(),
       .make = [](const Values& p) -> std::vector<Law> {
         const Law law(ViscousPower(p.number("coefficient"), p.number("reference_velocity"), p.number("exponent")));
         return {modified(law, p)};
       }},
      {.name = "viscous_saturating",
       .summary = "viscous friction that levels off with speed",
       .equation = "F = coefficient v/(1 + |v|/saturation_velocity)",
       .engine = EngineKind::smooth,
       .sources = "cross1965",
       .modifiers = {"drift", "fluctuation", "warming"},
       .parameters = ViscousSaturating::parameters(),
       .make = [](const Values& p) -> std::vector<Law> {
         const Law law(ViscousSaturating(p.number("coefficient"), p.number("saturation_velocity")));
         return {modified(law, p)};
       }},
  };
}

std::vector<LawEntry>& all_laws() {
  static std::vector<LawEntry> list = [] {
    std::vector<LawEntry> entries = make_list();
    for (LawEntry& entry : entries) entry.parameters = with_modifiers(std::move(entry.parameters), entry.modifiers);
    return entries;
  }();
  return list;
}

}  // namespace

const std::vector<LawEntry>& laws() { return all_laws(); }

void add_law(LawEntry entry) {
  entry.parameters = with_modifiers(std::move(entry.parameters), entry.modifiers);
  std::vector<LawEntry>& list = all_laws();
  const auto place = std::ranges::lower_bound(list, entry.name, {}, &LawEntry::name);
  list.insert(place, std::move(entry));
}

const LawEntry* find_law(std::string_view name) {
  const auto& list = laws();
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const LawEntry& entry) { return entry.name == name; });
  return found == list.end() ? nullptr : &*found;
}

std::vector<ParameterFault> complete(const LawEntry& law, ParameterValues& values) {
  std::vector<ParameterFault> faults = complete(law.parameters, values);
  return faults.empty() && law.check != nullptr ? law.check(values) : faults;
}

}  // namespace dualdamp::friction
