#include "bench/crosscheck/motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bench/crosscheck/differences.hpp"
#include "bench/crosscheck/variants.hpp"
#include "core/constants.hpp"
#include "friction_models/registry.hpp"
#include "scenarios/scenario.hpp"
#include "sim/engine/engine.hpp"
#include "sim/engine/smooth_engine.hpp"

namespace dualdamp::crosscheck {

namespace {

using scenarios::Json;

constexpr double agreed_tolerance = 1e-7;
constexpr double energy_tolerance_exact = 1e-10;
constexpr double energy_tolerance_smooth = 1e-7;
constexpr double change = 1e-10;
/// Factor on the tolerance of the smooth engine by which its resolution is measured.
constexpr double looser = 10.0;
constexpr double tight = 1e-13;  // tolerance of the other integration
constexpr Scales odd = {.force = 3.7, .length = 0.41, .time = 2.3};
constexpr Scales even = {.force = 0x1p-9, .length = 0x1p-9, .time = 1.0};
constexpr const char* away = "runs away: the energy has left the range of double precision";

sim::Model model_of(const Json& scenario) { return scenarios::parse_scenario(scenario.dump(), "case").model; }

double extent(const Walk& walk) {
  double result = 0.0;
  for (const sim::Sample& sample : walk.samples)
    result = std::max({result, std::abs(sample.x), std::abs(sample.y)});
  return result;
}

/// Transforms a walk of a variant to the units and the sign of the first walk.
void map_back(Walk& walk, const Scales& scales, double sign) {
  const double length = sign / scales.length;
  const double speed = sign / scales.length * scales.time;
  for (sim::Event& event : walk.events)
    event = {event.t / scales.time, event.kind, event.x * length, event.v * speed};
  for (sim::Sample& sample : walk.samples) {
    sample.t /= scales.time;
    sample.x *= length;
    sample.v *= speed;
  }
  for (Piece& piece : walk.pieces) piece = {piece.end / scales.time, piece.speed * std::abs(speed)};
  walk.end /= scales.time;
}

/// Whether two walks agree with nothing to name.
bool is_clean(const Difference& gap) {
  return gap.fault.empty() && gap.exception.empty() && gap.resting + gap.coincident + gap.silent == 0;
}

class Motions {
 public:
  Motions(const Json& scenario, std::uint64_t draw)
      : scenario_(scenario), draw_(draw), model_(model_of(scenario)), is_exact_(sim::is_exact(model_)) {
    options_.duration = duration_of(scenario, model_);
    options_.with_energy = true;
    first_ = walk(model_, options_);
    options_.with_energy = false;
  }

  Findings compare() {
    const std::string name = is_exact_ ? "exact against smooth engine" : "automatic against implicit steps";
    if (!first_.finite) {
      findings_.push_back(
          {name, Verdict::disagree, 0.0, "the motion is not finite, outcome: " + first_.outcome.reason});
      return std::move(findings_);
    }
    compare_engines(name);
    check_sticks(first_);
    if (!first_.outcome.ok()) return std::move(findings_);
    check_energy();
    compare_variants();
    return std::move(findings_);
  }

 private:
  /// Measured once, when a comparison needs it: motions that agree within the tolerance need it not.
  const Sensitivity& sensitivity() {
    if (!sensitivity_) sensitivity_ = measured_sensitivity();
    return *sensitivity_;
  }

  /// Later walks end where the first changed ones have parted.
  [[nodiscard]] Sensitivity measured_sensitivity() {
    constexpr std::uint32_t count = 4;
    Sensitivity result{.change = change};
    if (!first_.outcome.ok() || !first_.finite) return result;
    const double length = extent(first_);
    for (std::uint32_t i = 0; i < count; ++i) {
      Draws draws(draw_, i);
      widen(result, first_, walk(model_of(perturbed(scenario_, change, length, draws)), options_));
      const std::size_t beyond = first_parted(result) + 1;
      if (beyond < first_.samples.size()) options_.until = first_.samples[beyond].t;
    }
    return result;
  }

  /// The difference from another walk by the tolerance alone, whatever the motion's dependence on its data.
  [[nodiscard]] Difference strict_difference(const Walk& other) const {
    return difference(first_, other, {.deviation = std::vector<double>(first_.samples.size(), 0.0)},
                      agreed_tolerance);
  }

  void judge(const std::string& name, const Walk& other) {
    if (other.finite) {
      const Difference gap = strict_difference(other);
      if (is_clean(gap)) return findings_.push_back({name, Verdict::agreed, gap.worst, {}});
    }
    judge(name, other, sensitivity());
  }

  void judge(const std::string& name, const Walk& other, const Sensitivity& sensitivity) {
    if (!other.finite) {
      findings_.push_back({name, Verdict::disagree, 0.0, "the other motion is not finite"});
      return;
    }
    const Difference gap = difference(first_, other, sensitivity, agreed_tolerance);
    Finding finding{name, Verdict::agreed, gap.worst, {}};
    if (!(gap.fault.empty() && gap.exception.empty()) && is_unresolved()) {
      finding.verdict = Verdict::exception;
      finding.text = "at rest within the tolerance: the mass creeps less far than steps resolve";
    } else if (!gap.fault.empty()) {
      finding.verdict = Verdict::disagree;
      finding.text = gap.fault;
    } else if (!gap.exception.empty()) {
      finding.verdict = Verdict::exception;
      finding.text = gap.exception;
    } else if (gap.resting > 0) {
      finding.verdict = Verdict::exception;
      finding.text = fmt::format("at rest within the tolerance: {} groups", gap.resting);
    } else if (gap.coincident > 0) {
      finding.verdict = Verdict::exception;
      finding.text = fmt::format("coincident events: {} groups", gap.coincident);
    } else if (gap.silent > 0) {
      finding.verdict = Verdict::exception;
      finding.text = fmt::format("switching that leaves the motion as it is: {}", gap.silent);
    }
    findings_.push_back(std::move(finding));
  }

  /// Whether steps do not resolve the motion: differences of such motions are errors of the steps.
  [[nodiscard]] bool is_unresolved() const {
    double length = 0.0;
    for (const sim::Sample& sample : first_.samples) length = std::max(length, std::abs(sample.x));
    return !is_exact_ && sim::is_below_steps(model_, length, sim::make_engine(model_)->accuracy());
  }

  /// Whether the motion grows without bound: x is still finite, its square is not.
  [[nodiscard]] bool runs_away() const {
    return !std::isfinite(first_.energy_scale) || !std::isfinite(first_.energy.defect);
  }

  /// Whether implicit steps have the motion of the exact engine, with its events, whatever explicit ones make of
  /// it.
  [[nodiscard]] bool implicit_steps_agree() {
    if (!is_exact_) return false;
    sim::Model model = model_;
    model.solver = {sim::SolverKind::implicit_steps, tight};
    const Walk other = walk(model, options_);
    if (!other.outcome.ok() || !other.finite || other.ended_early) return false;
    return difference(first_, other, sensitivity(), agreed_tolerance).fault.empty();
  }

  /// Compares with the other integration: explicit steps, or implicit steps where the explicit ones are too many.
  void compare_engines(const std::string& name) {
    sim::Model model = model_;
    Walk other;
    for (const sim::SolverKind kind : {sim::SolverKind::explicit_steps, sim::SolverKind::implicit_steps}) {
      if (!is_exact_ && kind == sim::SolverKind::explicit_steps) continue;
      model.solver = {kind, tight};
      other = walk(model, options_);
      if (other.outcome.ok()) break;
    }
    check_sticks(other);
    if (!first_.outcome.ok()) {
      const bool cost = first_.outcome.kind == core::OutcomeKind::event_limit;
      const bool refused = cost || !other.outcome.ok() || other.ended_early;
      findings_.push_back({name, refused ? Verdict::refused : Verdict::disagree, 0.0,
                           (refused ? "" : "only one engine gives up: ") + first_.outcome.reason});
    } else if (!other.outcome.ok()) {
      const bool cost = other.outcome.kind == core::OutcomeKind::event_limit;
      if (runs_away()) return findings_.push_back({name, Verdict::exception, 0.0, away});
      findings_.push_back(
          {name, cost ? Verdict::not_compared : Verdict::disagree, 0.0,
           (cost ? "smooth engine: " : "only the smooth engine gives up: ") + other.outcome.reason});
    } else if (!other.finite || is_clean(strict_difference(other)) ||
               difference(first_, other, sensitivity(), agreed_tolerance).fault.empty()) {
      judge(name, other);
    } else {
      Sensitivity wider = sensitivity();
      model.solver.tolerance *= looser;
      wider.unresolved = resolution(other, walk(model, options_));
      if (!is_exact_) {
        model.solver = model_.solver;
        model.solver.tolerance *= looser;
        add(wider.unresolved, resolution(first_, walk(model, options_)));
      }
      const Difference gap = difference(first_, other, wider, agreed_tolerance);
      if (is_exact_ && !gap.fault.empty() && gap.same_events) {
        model.solver.tolerance = tight / looser;
        add(wider.unresolved, approach(first_, other, walk(model, options_)));
      }
      if (!difference(first_, other, wider, agreed_tolerance).fault.empty() && implicit_steps_agree())
        return findings_.push_back({name, Verdict::exception, gap.worst, "only implicit steps resolve it"});
      judge(name, other, wider);
    }
  }

  void check_sticks(const Walk& walk) {
    const std::string fault = fault_of_sticks(walk.events);
    findings_.push_back({"stops and releases", fault.empty() ? Verdict::agreed : Verdict::disagree, 0.0, fault});
  }

  /// Adds the numbers of two lists; after its end a list counts as 0.
  static void add(std::vector<double>& to, const std::vector<double>& more) {
    to.resize(std::max(to.size(), more.size()));
    for (std::size_t i = 0; i < more.size(); ++i) to[i] += more[i];
  }

  /// No passive law gives out more work than it took in since its unstretched start. The bonds of `bristle` start
  /// stretched, and so may a `gap_spring`.
  [[nodiscard]] bool friction_gives_out_work() const {
    const auto starts_unstretched = [](const Json& law) {
      const std::string name = law.at("law");
      return name != "bristle" && name != "gap_spring" && friction::find_law(name)->is_passive;
    };
    constexpr double rounding = 1e-9;
    // A mass attached to one that moves at the start moves with it.
    double given = 0.0;
    const double speed = scenario_.value(Json::json_pointer("/initial/velocity"), 0.0);
    for (const Json& law : scenario_.at("system").at("friction"))
      if (law.at("law") == "attached_mass") given += 0.5 * law.at("mass").get<double>() * speed * speed;
    return std::ranges::all_of(scenario_.at("system").at("friction"), starts_unstretched) &&
           first_.energy.friction < -given - rounding * first_.energy_scale;
  }

  void check_energy() {
    if (runs_away()) {
      findings_.push_back({"energy balance", Verdict::exception, 0.0, away});
      return;
    }
    // If a walk is given up at its start, all its energies are rounding.
    constexpr double begin = 1e-9;
    if (first_.ended_early && first_.end < begin * options_.duration) {
      findings_.push_back({"energy balance", Verdict::not_compared, 0.0, "given up at its start"});
      return;
    }
    const double defect = std::abs(first_.energy.defect) / first_.energy_scale;
    const double allowed = is_exact_ ? energy_tolerance_exact : energy_tolerance_smooth;
    Finding finding{"energy balance", Verdict::agreed, defect, {}};
    if (first_.energy_scale == 0.0) finding.worst = 0.0;
    // The error of positions of the smooth engine is its tolerance times a thousandth of the displacement that the
    // drive can cause.
    constexpr double unresolved = 1e-12;
    if (!is_exact_ && std::abs(first_.energy.defect) <= unresolved * first_.drive_energy &&
        !(finding.worst <= allowed)) {
      finding.verdict = Verdict::exception;
      finding.text = "at rest within the tolerance: the mass creeps";
    } else if (!(finding.worst <= allowed)) {
      finding.verdict = Verdict::disagree;
      finding.text = fmt::format("defect {:.2e} of the energy exchanged", defect);
    }
    if (finding.verdict == Verdict::agreed && friction_gives_out_work()) {
      finding.verdict = Verdict::disagree;
      finding.text = fmt::format("friction gives out {:.3e} J", -first_.energy.friction);
    }
    findings_.push_back(std::move(finding));
  }

  /// The motion mirrored and in other units. Walks of the smooth engine cost more: one walk has both, and each is
  /// compared alone only if that one differs by more than the tolerance alone.
  void compare_variants() {
    if (!is_exact_ && is_same_mirrored_in_other_units()) return;
    if (has_mirror(scenario_)) compare_variant("mirror", mirrored(scenario_), {}, -1.0);
    compare_variant("other units", scaled(scenario_, odd), odd, 1.0);
    compare_variant("force and length by a power of two", scaled(scenario_, even), even, 1.0);
    if (!is_exact_) return;
    // The intensity of a noise is the square of a force and would overflow.
    const bool is_square = scenario_.at("excitation").contains("intensity");
    const double least = is_square ? 0x1p-80 : 0x1p-150;
    const Scales tiny = {.force = least, .length = least, .time = 1.0};
    compare_variant("force and length by 2^-150", scaled(scenario_, tiny), tiny, 1.0);
  }

  bool is_same_mirrored_in_other_units() {
    constexpr Scales all = {
        .force = odd.force * even.force, .length = odd.length * even.length, .time = odd.time * even.time};
    const bool is_odd = has_mirror(scenario_);
    const Walk other =
        variant_walk(scaled(is_odd ? mirrored(scenario_) : scenario_, all), all, is_odd ? -1.0 : 1.0);
    if (!other.outcome.ok() || !other.finite) return false;
    const Difference gap = strict_difference(other);
    if (!is_clean(gap)) return false;
    findings_.push_back({is_odd ? "mirror and other units" : "other units", Verdict::agreed, gap.worst, {}});
    return true;
  }

  /// The walk of a variant in the units and the sign of the first one.
  [[nodiscard]] Walk variant_walk(const Json& variant, const Scales& scales, double sign) const {
    WalkOptions options = options_;
    options.duration *= scales.time;
    options.until *= scales.time;
    Walk other = walk(model_of(variant), options);
    map_back(other, scales, sign);
    return other;
  }

  void compare_variant(const std::string& name, const Json& variant, const Scales& scales, double sign) {
    const Walk other = variant_walk(variant, scales, sign);
    if (!other.outcome.ok()) {
      findings_.push_back({name, Verdict::disagree, 0.0, "only the variant gives up: " + other.outcome.reason});
      return;
    }
    judge(name, other);
  }

  const Json& scenario_;
  std::uint64_t draw_;
  sim::Model model_;
  bool is_exact_;
  WalkOptions options_;
  Walk first_;
  std::optional<Sensitivity> sensitivity_;
  Findings findings_;
};

}  // namespace

/// Three forcing and ten natural periods, but not more than sixty of the shorter one.
double duration_of(const Json& scenario, const sim::Model& model) {
  const Json& analysis = scenario.at("analysis");
  if (analysis.contains("duration")) return analysis.at("duration").get<double>();
  const double natural = sim::natural_period(model.oscillator);
  const double forcing = core::two_pi / model.excitation.frequency;
  return std::min(3.0 * forcing + 10.0 * natural, 60.0 * std::min(natural, forcing));
}

Findings compare_motions(const scenarios::Json& scenario, std::uint64_t draw) {
  return Motions(scenario, draw).compare();
}

}  // namespace dualdamp::crosscheck
