#include "bench/speed/smooth_case.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "friction_models/registry.hpp"

namespace dualdamp::bench::speed {
namespace {

constexpr double kinetic = 2.0;             // N
constexpr double static_level = 3.0;        // N
constexpr double stribeck_velocity = 0.05;  // m/s

double level(double v) {
  const double r = v / stribeck_velocity;
  return kinetic + (static_level - kinetic) * std::exp(-r * r);
}

constexpr double sigma0 = 1e5;    // N/m
constexpr double sigma1 = 316.0;  // N.s/m

LawResponse lugre(double v, double z, double direction) {
  const double rate = v - sigma0 * direction * v * z / level(v);
  return {sigma0 * z + sigma1 * rate, rate};
}

constexpr double elastic_limit = 1e-5;  // m

LawResponse elasto_plastic(double v, double z, double direction) {
  const double largest = level(v) / sigma0;
  const double stretch = direction * z;
  double share = 0.0;
  if (stretch >= largest) {
    share = 1.0;
  } else if (stretch > elastic_limit) {
    const double middle = 0.5 * (largest + elastic_limit);
    share = 0.5 + 0.5 * std::sin(std::numbers::pi * (stretch - middle) / (largest - elastic_limit));
  }
  const double rate = v * (1.0 - share * stretch / largest);
  return {sigma0 * z + sigma1 * rate, rate};
}

constexpr double dahl_stiffness = 1000.0;  // N/m

LawResponse dahl(double v, double z, double direction) {
  return {dahl_stiffness * z, v * (1.0 - dahl_stiffness * direction * z / kinetic)};
}

LawResponse stribeck(double v, double, double direction) { return {direction * level(v), 0.0}; }

constexpr double yield = kinetic / dahl_stiffness;  // m

LawResponse bouc_wen(double v, double z, double direction) {
  const double ratio = z / yield;
  const double both = direction * z > 0.0 ? 1.0 : 0.0;  // for beta_share = 1/2
  return {dahl_stiffness * z, v * (1.0 - both * ratio * ratio)};
}

constexpr double normal_force = 10.0;  // N
constexpr double mu0 = 0.2;
constexpr double a = 0.02;
constexpr double b = 0.015;
constexpr double slip_distance = 1e-3;       // m
constexpr double reference_velocity = 0.01;  // m/s

LawResponse rate_state(double v, double psi, double direction) {
  const double ratio = v / reference_velocity;
  const double rate = reference_velocity / slip_distance * (std::exp(-psi) - direction * ratio);
  return {normal_force * a * std::asinh(0.5 * ratio * std::exp((mu0 + b * psi) / a)), rate};
}

friction::ParameterValues stribeck_values() {
  return {{"kinetic", kinetic}, {"static", static_level}, {"stribeck_velocity", stribeck_velocity}};
}

/// Adds the orbit, computed with steps far finer than those of any contender.
SmoothCase prepared(SmoothCase work) {
  work.model = model_under(work.law, work.values);
  sim::Model fine = work.model;
  fine.solver.tolerance = 1e-14;
  const sim::SteadyState orbit = sim::steady_state(fine, {.detail = sim::OrbitDetail::extremes});
  if (!orbit.outcome.ok()) throw std::runtime_error(work.law + " has no steady state: " + orbit.outcome.reason);
  work.start = orbit.start;
  work.amplitude = orbit.amplitude;
  return work;
}

}  // namespace

sim::Model model_under(const std::string& law, friction::ParameterValues values) {
  sim::Model model = model_of({});
  const friction::LawEntry* entry = friction::find_law(law);
  if (entry == nullptr || !friction::complete(*entry, values).empty())
    throw std::logic_error("no such law: " + law);
  model.friction = entry->make(values);
  return model;
}

friction::ParameterValues lugre_values() {
  friction::ParameterValues values = stribeck_values();
  values.set("sigma0", sigma0);
  values.set("sigma1", sigma1);
  return values;
}

std::vector<SmoothCase> smooth_cases() {
  friction::ParameterValues elastic = lugre_values();
  elastic.set("elastic_limit", elastic_limit);
  std::vector<SmoothCase> cases = {
      {.law = "lugre", .values = lugre_values(), .respond = lugre, .z_scale = kinetic / sigma0, .stiff = true},
      {.law = "elasto_plastic",
       .values = elastic,
       .respond = elasto_plastic,
       .z_scale = kinetic / sigma0,
       .stiff = true},
      {.law = "dahl",
       .values = {{"kinetic", kinetic}, {"sigma0", dahl_stiffness}},
       .respond = dahl,
       .z_scale = yield},
      {.law = "bouc_wen",
       .values = {{"limit", kinetic}, {"stiffness", dahl_stiffness}, {"exponent", 2.0}},
       .respond = bouc_wen,
       .z_scale = yield},
      {.law = "stribeck", .values = stribeck_values(), .respond = stribeck, .has_state = false, .jumps = true},
      {.law = "rate_state",
       .values = {{"normal_force", normal_force},
                  {"mu0", mu0},
                  {"a", a},
                  {"b", b},
                  {"slip_distance", slip_distance},
                  {"reference_velocity", reference_velocity}},
       .respond = rate_state,
       .stiff = true},
  };
  for (SmoothCase& work : cases) work = prepared(std::move(work));
  return cases;
}

double amplitude_error(std::span<const double> turning_points, double amplitude) {
  if (turning_points.empty()) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (const double x : turning_points) largest = std::max(largest, std::abs(std::abs(x) / amplitude - 1.0));
  return largest;
}

}  // namespace dualdamp::bench::speed
