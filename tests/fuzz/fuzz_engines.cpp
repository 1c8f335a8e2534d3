/// The engines: bytes lead to a scenario (`bench/crosscheck`), whose motion two engines compute. Both end within
/// their budget with finite numbers or a stated reason; where they differ, or the energy does not balance, the
/// whole comparison of the campaign of random systems decides, which knows how strongly the motion depends on its
/// data. An even first byte asks for the steady state besides.

#include <cmath>
#include <string>
#include <string_view>

#include "bench/crosscheck/case.hpp"
#include "bench/crosscheck/differences.hpp"
#include "bench/crosscheck/motions.hpp"
#include "bench/crosscheck/random_scenario.hpp"
#include "bench/crosscheck/walk.hpp"
#include "core/diagnostics.hpp"
#include "friction_models/law_fault.hpp"
#include "scenarios/scenario.hpp"
#include "sim/engine/engine.hpp"
#include "sim/orbits/steady_state.hpp"
#include "tests/fuzz/harness.hpp"

namespace {

using namespace dualdamp;
using fuzz::require;

/// A tenth of a second.
constexpr long most_work = 20'000;

void require_reason(const core::Outcome& outcome) {
  require(outcome.ok() || !outcome.reason.empty(), "an end without a result has a reason");
}

/// Whether a closer look is needed.
bool is_suspect(const sim::Model& model, double duration) {
  const crosscheck::WalkOptions options{.duration = duration, .most_work = most_work, .with_energy = true};
  const crosscheck::Walk first = crosscheck::walk(model, options);
  require(first.finite, "a motion is finite");
  require_reason(first.outcome);
  if (!first.outcome.ok()) return false;
  constexpr double energy_tolerance = 1e-7;
  if (!(std::abs(first.energy.defect) <= energy_tolerance * first.energy_scale)) return true;
  sim::Model other = model;
  other.solver = {sim::is_exact(model) ? sim::SolverKind::explicit_steps : sim::SolverKind::implicit_steps, 1e-13};
  const crosscheck::Walk second = crosscheck::walk(other, options);
  require(second.finite, "a motion of another engine is finite");
  require_reason(second.outcome);
  constexpr double tolerance = 1e-7;
  return second.outcome.ok() && !crosscheck::difference(first, second, {}, tolerance).fault.empty();
}

void require_steady(const sim::Model& model) {
  const sim::SteadyState state = sim::steady_state(model, {.max_periods = 100, .most_work = most_work});
  require_reason(state.outcome);
  if (!state.outcome.ok()) return;
  for (const double value : {state.peak, state.trough, state.amplitude, state.fundamental, state.period,
                             state.max_speed, state.mean_square_speed, state.energy.defect})
    require(std::isfinite(value), "a number of a steady state is finite");
  // A motion without a fundamental has no phase.
  require(std::isfinite(state.phase) || std::isnan(state.phase), "a phase is finite or there is none");
  require(state.peak >= state.trough, "a peak is not below its trough");
}

}  // namespace

void dualdamp::fuzz::consume(std::string_view input) {
  if (input.empty()) return;
  const bool is_steady = static_cast<unsigned char>(input.front()) % 2 == 0;
  const scenarios::Json scenario = crosscheck::random_scenario(input.substr(1));
  const std::string text = crosscheck::yaml(scenario);
  try {
    const sim::Model model = scenarios::parse_scenario(text, "case.yaml").model;
    if (is_steady && model.excitation.is_harmonic()) require_steady(model);
    if (!is_suspect(model, crosscheck::duration_of(scenario, model))) return;
    for (const crosscheck::Finding& finding : crosscheck::compare_motions(scenario, 0))
      require(finding.verdict != crosscheck::Verdict::disagree || finding.text.starts_with("only "),
              finding.comparison + ": " + finding.text + "\n" + text);
  } catch (const core::InputError& error) {
    require(!error.diagnostics().empty(), "a refusal says why");
  } catch (const friction::LawFault& fault) {
    require(*fault.what() != '\0', "a law's fault has a reason");
  }
}
