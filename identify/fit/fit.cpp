#include "identify/fit/fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "core/constants.hpp"
#include "core/coordinate.hpp"
#include "core/diagnostics.hpp"
#include "core/numbers.hpp"
#include "friction_models/law_fault.hpp"
#include "identify/experiments/starts.hpp"
#include "identify/fit/comparison.hpp"
#include "identify/fit/first_load.hpp"
#include "identify/fit/fitted_signals.hpp"
#include "identify/fit/intervals/uncertainty.hpp"
#include "identify/fit/residual_test.hpp"
#include "identify/fit/residual_warnings.hpp"
#include "identify/fit/search/search.hpp"
#include "identify/fit/search/steps.hpp"

namespace dualdamp::identify {

namespace {

/// Why the motion cannot be computed at the start values; empty if it can. What is wrong with a plugin or with what
/// is stated of the rig is so at all values.
std::string motion_fault(const Rig& rig, const std::vector<FitParameter>& parameters,
                         const std::vector<double>& sizes, const Experiments& experiments) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i)
    values[static_cast<Eigen::Index>(i)] = std::isnan(parameters[i].stated) ? sizes[i] : parameters[i].stated;
  try {
    const std::optional<Rig> there = with_values(rig, parameters, values);
    const std::optional<sim::Model> model = there ? model_of(*there) : std::nullopt;
    Eigen::VectorXd outputs;
    if (model)
      for (const auto& experiment : experiments)
        static_cast<void>(experiment->predict(*model, experiment->record_start, outputs));
  } catch (const friction::LawFault& fault) {
    return fault.what();
  } catch (const core::InputError& error) {
    return error.diagnostics().front().message;
  }
  return {};
}

struct Request {
  const Rig& rig;
  const std::vector<FitParameter>& parameters;
  const Experiments& experiments;
  const FitOptions& options;
};

std::string cut_short(long most_work) {
  return "search cut short: the motions took more than " + std::to_string(most_work) +
         " steps. Data that do not determine a parameter lead the search to values of it that make a law stiff: "
         "state values or bounds, or free fewer parameters";
}

/// The search ended where the motion cannot be simulated for values close to the estimate, most often at the end of
/// a parameter's range: a contact as stiff as the search allows.
core::Outcome without_derivative(const FitProblem& problem, const Request& request, const Eigen::VectorXd& q) {
  const Eigen::VectorXd values = problem.space().values(q);
  const core::Coordinate coordinate = request.rig.known.oscillator.coordinate;
  const auto has_stuck = [](const Signal& signal) { return !signal.stuck.empty(); };
  const bool sticks = std::ranges::any_of(request.experiments, [&](const auto& experiment) {
    return std::ranges::any_of(experiment->signals, has_stuck);
  });
  std::vector<std::string> all;
  std::vector<std::string> ends;
  for (std::size_t i = 0; i < request.parameters.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const SearchCoordinate& range = problem.space()[i];
    const FitParameter& parameter = request.parameters[i];
    const std::string unit = parameter.unit == "1" ? "" : " " + core::unit_for(coordinate, parameter.unit);
    all.push_back(parameter.name + " = " + core::format_number(values[at], 3) + unit);
    constexpr double near = 1e-3;
    const bool is_value = values[at] == 0.0;  // of a force: no friction is no stiff law
    if (!is_value && (q[at] - range.low < near || range.high - q[at] < near)) ends.push_back(all.back());
  }
  return {
      core::OutcomeKind::not_identifiable,
      "no uncertainty can be computed: the motion cannot be simulated for values close to the estimate. " +
          (ends.empty()
               ? core::joined(all) + " is the estimate. State values or bounds, or free fewer parameters"
               : core::joined(ends) + (ends.size() == 1 ? " is" : " are") +
                     " at the limit of the search, because the data do not bound it. State a value or bounds, or fit a "
                     "law without it") +
          (sticks
               ? ". The mass sticks in this loop: at rest, a contact as good as rigid needs finer positions than "
                 "those measured, and a rigid law, such as 'coulomb', gives these samples no weight"
               : "")};
}

/// Warns of parameters of records that are sought because of what the record shows.
void say_why_sought(const Request& request, Fit& result) {
  for (std::size_t e = 0; e < request.experiments.size(); ++e)
    for (const auto& [which, why] : request.experiments[e]->remarks)
      if (std::ranges::any_of(request.parameters, [e, which](const FitParameter& parameter) {
            return parameter.is_of_record(e, which);
          }))
        result.warnings.push_back(request.experiments[e]->label + ": " + why);
}

/// Warns of what readings without weight say against the fit.
void add_objections(const Request& request, Fit& result) {
  const std::optional<sim::Model> model = model_of(result.rig);
  for (std::size_t e = 0; model && e < request.experiments.size(); ++e)
    for (const std::string& objection : request.experiments[e]->objections(*model, result.of_records[e]))
      result.warnings.push_back(request.experiments[e]->label + ": " + objection);
}

/// Warns of histories that are shorter than one period of their drive or, without one, of the rig.
void warn_of_short(const Request& request, Fit& result) {
  for (const auto& experiment : request.experiments) {
    if (experiment->kind != ExperimentKind::history) continue;
    const sim::Excitation& drive = drive_of(*experiment, result.rig);
    const sim::Oscillator& o = result.rig.known.oscillator;
    const bool is_driven = drive.is_harmonic() && drive.frequency > 0.0;
    const double omega = is_driven ? drive.frequency : std::sqrt(o.stiffness / o.mass);
    const std::vector<double>& at = experiment->signals.front().at;
    const double period = core::two_pi / omega;
    if (!std::isfinite(period) || !(at.back() - at.front() < period)) continue;
    result.warnings.push_back(experiment->label + ": the record lasts " +
                              core::format_number(at.back() - at.front(), 3) + " s, less than one period of " +
                              (is_driven ? "the drive" : "the rig") + ", " + core::format_number(period, 3) +
                              " s: a law that does not hold may fit so short a motion as well");
  }
}

/// The covariance knows the motions near the estimate only. Beside a parameter at the end of its range, others may
/// trade off with it farther inside.
void warn_of_ends(Fit& result) {
  std::vector<std::string> names;
  for (const FittedParameter& fitted : result.parameters)
    if (fitted.at_bound) names.push_back(fitted.parameter.name);
  if (names.empty() || names.size() == result.parameters.size()) return;
  result.warnings.push_back(
      core::joined(names, " and ") + (names.size() == 1 ? " is" : " are") +
      " at the end of the range: without profiles, the intervals of the other parameters may be "
      "too narrow");
}

/// Sets all results of a fit at the end of a search. Returns coordinates with a smaller sum of squares, if a
/// profile found any.
std::optional<Eigen::VectorXd> describe(const FitProblem& problem, const Request& request,
                                        const SearchResult& found, Fit& result) {
  const Eigen::VectorXd& q = found.coordinates;
  Eigen::MatrixXd jacobian;
  LastMotions motions;
  problem.limit(std::numeric_limits<long>::max());
  if (!problem.derivatives(q, result.outputs, jacobian, false, &motions)) {
    result.outcome = without_derivative(problem, request, q);
    return std::nullopt;
  }
  const Eigen::VectorXd values = problem.space().values(q);
  result.rig = with_values(request.rig, request.parameters, values).value_or(request.rig);
  result.of_records = problem.of_records(values);
  const Eigen::VectorXd misses = problem.readings().misses(result.outputs);
  describe_signals(problem, found, misses, jacobian, request.options.robust, result);
  for (std::size_t i = 0; i < request.parameters.size(); ++i)
    result.parameters.push_back(
        {.parameter = request.parameters[i], .value = values[static_cast<Eigen::Index>(i)]});
  say_why_sought(request, result);
  add_objections(request, result);
  warn_of_short(request, result);
  warn_of_residuals(request.experiments, request.options.robust,
                    zero_gains_of(problem, found.weights, misses, jacobian), result);
  problem.limit(request.options.most_work);
  std::optional<Eigen::VectorXd> lower =
      add_uncertainty({problem, found.weights, found.unbounded, q, misses, jacobian, motions, found.rivals,
                       request.options.profile, request.options.robust},
                      result);
  if (!request.options.profile) warn_of_ends(result);
  return lower;
}

void warn_of_search(const SearchResult& found, long most_work, Fit& result) {
  if (found.is_cut_short)
    result.warnings.push_back(cut_short(most_work) + ". The estimates are the best until then");
  else if (!found.is_settled)
    result.warnings.emplace_back(
        "searches that began far from the estimate found a better one each time, until no more were made: it may "
        "not be the best. State values or bounds, or compare with a fit of more starts");
}

/// Lets a force at a speed be sought at the speed of the data, unless bounds hold for it.
void seek_at_speed(double speed, std::vector<FitParameter>& parameters) {
  for (FitParameter& parameter : parameters)
    if (parameter.at_speed && parameter.at_speed->is_found() && !parameter.is_bounded())
      parameter.at_speed->sought_at = speed;
}

/// Seeks the loads of contacts at the first samples, record after record.
void seek_loads(std::unique_ptr<FitTask>& task, SearchResult& found, double length, const SearchOptions& options,
                long most_work, std::vector<std::string>& remarks) {
  for (std::size_t e = 0; e < task->experiments.size(); ++e) {
    std::optional<LoadedFit> loaded = with_first_load(*task, found, e, length, options, most_work);
    if (!loaded) continue;
    task = std::move(loaded->task);
    found = std::move(loaded->found);
    remarks.push_back(std::move(loaded->text));
  }
}

SearchOptions search_options(const Request& request, const DataScale& scale) {
  const bool all_stated = std::ranges::none_of(
      request.parameters, [](const FitParameter& parameter) { return std::isnan(parameter.stated); });
  const int starts = request.options.starts;
  return {.points = starts > 0   ? starts
                    : all_stated ? 8
                                 : 40,
          .most_starts = all_stated ? 2U : 3U,
          .robust = request.options.robust,
          .scale = scale,
          .elements = ParallelElements::of(request.rig, request.parameters, request.experiments)};
}

void turn_phases(const SearchSpace& space, SearchResult& found) {
  found.coordinates = space.within_one_turn(found.coordinates);
  for (Eigen::VectorXd& rival : found.rivals) rival = space.within_one_turn(rival);
}

/// Tells the elements of laws in the order in which they slip.
void sort_elements(const std::vector<ParallelElements>& all, const FitProblem& problem, SearchResult& found) {
  if (all.empty()) return;
  const auto sort = [&](Eigen::VectorXd& q) {
    Eigen::VectorXd values = problem.space().values(q);
    for (const ParallelElements& elements : all) elements.sort(values);
    q = problem.space().point(values);
  };
  sort(found.coordinates);
  std::ranges::for_each(found.rivals, sort);
}

/// The fit of one rig, step by step.
class RigFit {
 public:
  RigFit(const RigToFit& one, const Experiments& experiments, const FitOptions& options)
      : rig_(one.rig), experiments_(experiments), options_(options), scale_(scale_of(one.rig, experiments)) {
    result_.rig = rig_;
    std::vector<FitParameter> parameters = one.parameters;
    seek_at_speed(scale_.speed, parameters);
    std::vector<double> sizes = sizes_of(parameters, scale_);
    search_ = search_options({rig_, parameters, experiments, options}, scale_);
    task_ = std::make_unique<FitTask>(rig_, experiments, std::move(parameters), std::move(sizes), options.known);
  }

  /// All steps of the search but those that begin far from its end.
  void search() {
    const FitProblem& problem = task_->problem;
    const auto count = static_cast<Eigen::Index>(task_->parameters.size());
    const auto readings = static_cast<Eigen::Index>(problem.readings().count());
    if (readings <= count) {
      result_.outcome = {core::OutcomeKind::not_identifiable,
                         std::to_string(count) + " parameters need more than " + std::to_string(readings) +
                             " readings" +
                             (readings < problem.readings().size()
                                  ? "; samples beside a jump, or at rest under rigid friction, do not count"
                                  : "")};
      return;
    }
    result_.starts = search_.points;
    problem.limit(options_.most_work);
    task_->problem.set_stepped(stepped_parameters(
        problem, problem.space().point(Eigen::Map<const Eigen::VectorXd>(task_->sizes.data(), count))));
    found_ = search_parameters(problem, task_->parameters, task_->sizes, search_);
    if (!found_) result_.outcome = why_none();
    spent_ = problem.spent();
  }

  /// The searches that begin far from the end of the last one, and those for the loads of contacts.
  void search_on() {
    if (!found_) return;
    task_->problem.limit(options_.most_work, spent_);
    found_ = search_far_from(std::move(*found_), task_->problem, task_->parameters, search_);
    warn_of_search(*found_, options_.most_work, result_);
    if (!found_->is_cut_short && options_.seeks_loads)
      seek_loads(task_, *found_, scale_.length, search_, options_.most_work, result_.warnings);
  }

  /// The fit where the search ended, or where a profile found less.
  [[nodiscard]] Fit described(bool profile) {
    if (!found_) return result_;
    FitOptions options = options_;
    options.profile = profile;
    constexpr int most_rounds = 4;
    for (int round = 1;; ++round) {
      Fit described = result_;
      sort_elements(search_.elements, task_->problem, *found_);
      turn_phases(task_->problem.space(), *found_);
      const std::optional<Eigen::VectorXd> lower =
          describe(task_->problem, {rig_, task_->parameters, experiments_, options}, *found_, described);
      if (!lower) return described;
      std::optional<SearchResult> next;
      task_->problem.limit(options.most_work);
      SearchOptions there = search_;
      there.deviations = found_->deviations;  // with others the search may lead back
      if (round < most_rounds) next = search_from(task_->problem, *lower, there);
      if (!next) {
        described.warnings.emplace_back(
            "a profile found a smaller sum of squares than that of the estimate, and the search from there did not "
            "end: try more starts, bounds or stated values");
        return described;
      }
      next->rivals = std::move(found_->rivals);
      next->rivals.push_back(std::move(found_->coordinates));
      found_ = std::move(next);
    }
  }

 private:
  /// Why no search found a motion.
  [[nodiscard]] core::Outcome why_none() const {
    if (task_->problem.is_exhausted()) return {core::OutcomeKind::not_identifiable, cut_short(options_.most_work)};
    const std::string fault = motion_fault(rig_, task_->parameters, task_->sizes, experiments_);
    return {core::OutcomeKind::not_identifiable, "the rig has no such motion with any of " +
                                                     std::to_string(result_.starts) + " starts" +
                                                     (fault.empty() ? "" : ": " + fault)};
  }

  const Rig& rig_;
  const Experiments& experiments_;
  const FitOptions& options_;
  DataScale scale_;
  SearchOptions search_;
  std::unique_ptr<FitTask> task_;
  std::optional<SearchResult> found_;
  long spent_ = 0;  ///< work of `search`
  Fit result_;      ///< what is known of it before it is described
};

bool leaves_noise(const Fit& fit) {
  constexpr double near = 1.3;
  return fit.outcome.ok() && fit.noise_units < near &&
         std::ranges::all_of(fit.signals, [](const FittedSignal& signal) { return is_noise(signal.p_value); });
}

bool leaves_far_more(const Fit& fit) {
  constexpr double far = 3.0;
  return fit.noise_units > far;
}

}  // namespace

Fit fit_rig(const Rig& rig, std::vector<FitParameter> parameters, const Experiments& experiments,
            const FitOptions& options) {
  std::vector<Fit> fits = fit_rigs({{rig, std::move(parameters)}}, experiments, options);
  return std::move(fits.front());
}

std::vector<Fit> fit_rigs(const std::vector<RigToFit>& rigs, const Experiments& experiments,
                          const FitOptions& options) {
  std::vector<RigFit> all;
  std::vector<Fit> fits;
  all.reserve(rigs.size());
  for (const RigToFit& one : rigs) all.emplace_back(one, experiments, options).search();
  if (all.size() > 1)
    for (RigFit& one : all) fits.push_back(one.described(false));
  const bool has_law = std::ranges::any_of(fits, leaves_noise);
  fits.resize(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (has_law && leaves_far_more(fits[i])) continue;
    all[i].search_on();
    fits[i] = all[i].described(options.profile && all.size() == 1);
  }
  if (!options.profile || all.size() == 1) return fits;
  compare_fits(fits, options.robust);
  double least = core::infinity;
  for (const Fit& fit : fits) least = std::min(least, std::isnan(fit.AICc) ? core::infinity : fit.AICc);
  constexpr double rivals = 10.0;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!(fits[i].AICc > least + rivals)) fits[i] = all[i].described(true);
  return fits;
}

}  // namespace dualdamp::identify
