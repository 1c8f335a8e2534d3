#include "scenarios/verification/verification.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "core/numbers.hpp"
#include "friction_models/law_fault.hpp"
#include "sim/engine/engine.hpp"

namespace dualdamp::scenarios {

namespace {

/// Tolerance of the second computation: its errors are far below all differences that count. With a smaller one its
/// steps would add up more rounding than they save.
constexpr double tight = 1e-13;

/// A second computation of the same motions.
struct OtherComputation {
  std::string words;
  sim::Solver solver;
};

/// Whether explicit steps would be limited by the fast one of two decays: a thousand of them for an implicit one at
/// a damping ratio of a thousand.
bool is_heavily_damped(const sim::Oscillator& oscillator) {
  constexpr double heavy = 10.0;
  return oscillator.damping > 2.0 * heavy * oscillator.mass * sim::natural_frequency(oscillator);
}

/// Steps of the other kind; for a motion of the exact engine those of both kinds.
std::vector<OtherComputation> other_computations(const sim::Model& model) {
  const std::string end = " at tolerance " + core::format_number(tight, 1);
  const OtherComputation by_explicit = {"smooth engine, explicit steps" + end,
                                        {sim::SolverKind::explicit_steps, tight}};
  const OtherComputation by_implicit = {"smooth engine, implicit steps" + end,
                                        {sim::SolverKind::implicit_steps, tight}};
  if (sim::is_exact(model) && is_heavily_damped(model.oscillator)) return {by_implicit, by_explicit};
  if (sim::is_exact(model)) return {by_explicit, by_implicit};
  if (model.solver.kind == sim::SolverKind::implicit_steps) return {by_explicit};
  return {by_implicit};
}

Answer answer_by(const OtherComputation& computation, const Scenario& scenario, const Question& question,
                 const RunOptions& options, const sim::State* from) {
  sim::Model model = scenario.model;
  model.solver = computation.solver;
  try {
    return question.run({model, tight, scenario.resolved, options, from});
  } catch (const friction::LawFault& fault) {
    return failed(fault.what());
  }
}

/// Verification by the first computation that agrees, otherwise by the first with a result. `from`: as in
/// RunContext.
Verification compare_computations(const Scenario& scenario, const Question& question, const std::string& part,
                                  const RunOptions& options, const Answer& answer, const sim::State* from) {
  std::optional<Verification> apart;
  Verification none{.agrees = false};
  for (const OtherComputation& computation : other_computations(scenario.model)) {
    const Answer other = answer_by(computation, scenario, question, options, from);
    none.engine = computation.words + part;
    if (other.result.is_null()) {
      none.reason = answer.result.is_null() ? "there is no result to verify: " + other.failure
                                            : "the other computation has no result: " + other.failure;
      continue;
    }
    if (answer.result.is_null()) {
      none.reason = "the other computation has a result, this one none";
      return none;
    }
    Verification result = compare_answers(answer, other, scenario.result_fields, finest_sizes(scenario.model));
    result.engine = computation.words + part;
    if (result.agrees) return result;
    if (!apart) apart = std::move(result);
  }
  return apart ? *std::move(apart) : none;
}

/// The worse of two comparisons of one result, with the quantities of both.
Verification worse(Verification a, Verification b) {
  const long quantities = a.quantities + b.quantities;
  Verification result = b.quantities > 0 && is_worse(a, b) ? std::move(b) : std::move(a);
  result.quantities = quantities;
  return result;
}

}  // namespace

SizesOfUnits finest_sizes(const sim::Model& model) {
  const sim::Oscillator& oscillator = model.oscillator;
  const sim::Excitation& drive = model.excitation;
  const double omega = sim::natural_frequency(oscillator);
  double X = std::abs(model.initial.position) + std::abs(model.initial.velocity) / omega;
  if (drive.is_harmonic()) X += drive.moves_base() ? drive.amplitude : drive.amplitude / oscillator.stiffness;
  if (!std::isfinite(X)) return {};
  // Of the exact engine the accuracy is that of the computation with which it is compared. A larger tolerance of a
  // scenario is no excuse.
  const double accuracy = sim::is_exact(model) ? tight : std::min(model.solver.tolerance, sim::Solver{}.tolerance);
  const double length = accuracy / verification_tolerance("m") * X;
  // Times the tolerance of a work that is 1e-12 of the energy in the spring: beside a mass that rests, or far above
  // resonance, a base gives and takes that energy in each period, and what is left of both is rounding.
  constexpr double of_energy = 1e-6;
  return {{"m", length},
          {"m/s", length * omega},
          {"N", length * oscillator.stiffness},
          {"J", of_energy * oscillator.stiffness * X * X}};
}

Verification verify(const Scenario& scenario, const RunOptions& options, const Answer& all) {
  const std::optional<Sampled> sampled =
      all.result.is_null() ? std::optional<Sampled>() : scenario.question->sampled();
  const std::optional<Answer> part = sampled ? std::optional(sampled->part(all)) : std::nullopt;
  const Answer& answer = part ? *part : all;
  const Question& question = sampled ? *sampled->question : *scenario.question;
  const std::string points = sampled ? ", " + sampled->words : "";
  Verification result = compare_computations(scenario, question, points, options, answer, nullptr);
  if (answer.result.is_null()) return result;
  const std::optional<OtherWay> more =
      scenario.question->other_way({scenario.model, scenario.tolerance, scenario.resolved, options}, answer);
  // The way to an orbit may be too long for the other engine. It computes the orbit then, if the motion is known to
  // end there.
  if (result.quantities == 0 && answer.orbit && more && !more->answer.result.is_null())
    result = compare_computations(scenario, question, ", begun on the orbit", options, answer, answer.orbit.get());
  if (result.quantities == 0 || !more) return result;
  if (more->answer.result.is_null()) {
    result.engine += "; not by " + more->words + ": " + more->answer.failure;
    return result;
  }
  Answer same = failed({});
  for (const auto& [key, value] : more->answer.result.items())
    if (answer.result.contains(key)) same.result[key] = answer.result.at(key);
  const std::string words = result.engine + "; " + more->words;
  result = worse(std::move(result),
                 compare_answers(same, more->answer, scenario.result_fields, finest_sizes(scenario.model)));
  result.engine = words;
  return result;
}

}  // namespace dualdamp::scenarios
