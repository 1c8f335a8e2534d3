#include "identify/fit/first_load.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/constants.hpp"
#include "core/numbers.hpp"
#include "identify/fit/search/steps.hpp"
#include "identify/statistics/decompositions.hpp"
#include "identify/statistics/distributions.hpp"
#include "identify/statistics/residual_covariance.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::identify {

namespace {

using core::infinity;

/// Whether the load of the contacts of a record is open.
bool may_be_loaded(const FitTask& task, const Eigen::VectorXd& values, std::size_t index) {
  const Experiment& experiment = *task.experiments[index];
  if (experiment.kind == ExperimentKind::steady_states || experiment.knows_load) return false;
  if (task.problem.known()[index][RecordParameter::travel] != 0.0) return false;
  const bool is_sought = std::ranges::any_of(task.parameters, [index](const FitParameter& parameter) {
    return parameter.is_of_record(index, RecordParameter::travel);
  });
  if (is_sought) return false;
  const std::optional<Rig> rig = with_values(task.rig, task.parameters, values);
  const std::optional<sim::Model> model = rig ? model_of(*rig) : std::nullopt;
  return model && std::ranges::any_of(model->friction, &friction::Law::remembers_path);
}

class LoadSearch {
 public:
  LoadSearch(const FitTask& before, const SearchResult& found, std::size_t index, double length,
             const SearchOptions& options, long most_work)
      : before_(before),
        found_(found),
        index_(index),
        length_(length),
        options_(begun_at(options, found)),
        most_work_(most_work),
        leaves_motion_(holds_motion(found, before.problem, index)) {}

  [[nodiscard]] std::optional<LoadedFit> run() const {
    const std::vector<double> travels = best_travels();
    if (travels.empty()) return std::nullopt;
    std::optional<LoadedFit> loaded = with_travel(travels);
    if (!loaded) return std::nullopt;
    std::optional<LoadedFit> yielded = once_yielded(*loaded);
    if (yielded) loaded = std::move(yielded);
    if (!(chance_of(*loaded) < most_chance)) return std::nullopt;
    return loaded;
  }

 private:
  static constexpr double most_chance = 2e-3;

  /// The weights of several signals take many rounds to settle: a search with a load begins with those without it.
  [[nodiscard]] static SearchOptions begun_at(SearchOptions options, const SearchResult& found) {
    if (found.deviations.size() > 1) options.deviations = found.deviations;
    return options;
  }

  [[nodiscard]] std::unique_ptr<FitTask> task_with(std::vector<FitParameter> parameters, std::vector<double> sizes,
                                                   double travel) const {
    std::vector<RecordValues> known = before_.problem.known();
    known[index_][RecordParameter::travel] = travel;
    auto task = std::make_unique<FitTask>(before_.rig, before_.experiments, std::move(parameters), std::move(sizes),
                                          std::move(known));
    task->problem.limit(most_work_);
    task->problem.set_stepped(before_.problem.stepped());
    return task;
  }

  [[nodiscard]] Eigen::VectorXd weighted_misses(const FitProblem& problem, const Eigen::VectorXd& q,
                                                const Eigen::VectorXd& weights) const {
    Eigen::VectorXd outputs;
    if (!problem.outputs(q, outputs)) return {};
    return problem.readings().misses(outputs).cwiseProduct(weights);
  }

  [[nodiscard]] double squares(const FitTask& task, const SearchResult& at, const Eigen::VectorXd& weights) const {
    const Eigen::VectorXd misses = weighted_misses(task.problem, at.coordinates, weights);
    return misses.size() > 0 && misses.allFinite() ? misses.squaredNorm() : infinity;
  }

  /// The travels with the smallest sums of squares, without what the other parameters can make up for. None if no
  /// travel reduces the sum by more than noise may do.
  [[nodiscard]] std::vector<double> best_travels() const {
    constexpr int steps = 9;
    std::vector<double> travels;
    for (int i = 0; i < steps; ++i)
      for (const double side : {1.0, -1.0}) travels.push_back(side * length_ * std::pow(10.0, -0.5 * i));
    Eigen::VectorXd outputs;
    Eigen::MatrixXd jacobian;
    if (!before_.problem.derivatives(found_.coordinates, outputs, jacobian)) return {};
    const Eigen::MatrixXd basis = orthonormal_basis(found_.weights.asDiagonal() * jacobian);
    const auto left_of = [&](const Eigen::VectorXd& misses) {
      return misses.size() > 0 && misses.allFinite()
                 ? misses.squaredNorm() - (basis.transpose() * misses).squaredNorm()
                 : infinity;
    };
    const double least =
        left_of(Eigen::VectorXd(before_.problem.readings().misses(outputs).cwiseProduct(found_.weights)));
    std::vector<std::pair<double, double>> order(travels.size());
    sim::in_parts(travels.size(), 1, 0, [&](std::size_t i, std::size_t) {
      const std::unique_ptr<FitTask> trial = task_with(before_.parameters, before_.sizes, travels[i]);
      order[i] = {left_of(weighted_misses(trial->problem, found_.coordinates, found_.weights)), travels[i]};
    });
    std::ranges::sort(order);
    const double variance = least / std::max(1.0, freedom(before_));
    constexpr double enough = 4.0;
    if (!std::isfinite(order.front().first)) return {};
    if (!leaves_motion_ && least - order.front().first < enough * variance) return {};
    constexpr std::size_t wanted = 3;
    std::vector<double> best;
    for (const auto& [left, travel] : order)
      if (std::isfinite(left) && best.size() < wanted) best.push_back(travel);
    return best;
  }

  [[nodiscard]] static double freedom(const FitTask& task) {
    return task.problem.readings().count() - static_cast<double>(task.parameters.size());
  }

  [[nodiscard]] std::optional<LoadedFit> with_travel(const std::vector<double>& travels) const {
    double size = infinity;
    for (const double travel : travels) size = std::min(size, std::abs(travel));
    std::vector<FitParameter> parameters = before_.parameters;
    std::vector<double> sizes = before_.sizes;
    parameters.push_back(parameter_of_record(*before_.experiments[index_], index_, RecordParameter::travel,
                                             before_.experiments.size() == 1));
    parameters.back().stated = 0.0;
    // Contacts that yield later than over the whole motion are not contacts.
    constexpr double most = 10.0;
    parameters.back().range = {-most * length_, most * length_};
    sizes.push_back(size);
    LoadedFit loaded{task_with(std::move(parameters), std::move(sizes), 0.0), {}, {}};
    const FitProblem& problem = loaded.task->problem;
    std::vector<Eigen::VectorXd> points;
    for (const double travel : travels) {
      points.emplace_back(found_.coordinates.size() + 1);
      points.back() << found_.coordinates, travel / size;
    }
    loaded.task->problem.set_stepped(stepped_parameters(problem, points.front()));
    std::optional<SearchResult> best = search_near(problem, points, options_);
    // Beside other records, which determine the rig as well, or where no load gains anything near the end of the
    // fit, the full search costs more than it finds.
    const bool is_alone = before_.experiments.size() == 1;
    const auto has_gained = [&] {
      constexpr double most = 0.95;
      return squares(*loaded.task, *best, found_.weights) < most * squares(before_, found_, found_.weights);
    };
    if (leaves_motion_ && (!best || (is_alone && has_gained() && holds_motion(*best, problem, index_)))) {
      std::optional<SearchResult> other =
          search_parameters(problem, loaded.task->parameters, loaded.task->sizes, options_);
      if (other) other = search_far_from(std::move(*other), problem, loaded.task->parameters, options_);
      if (other &&
          (!best || squares(*loaded.task, *other, found_.weights) < squares(*loaded.task, *best, found_.weights)))
        best = std::move(other);
    }
    if (!best) return std::nullopt;
    loaded.found = std::move(*best);
    const double travel = problem.space().values(loaded.found.coordinates)[loaded.found.coordinates.size() - 1];
    loaded.text = before_.experiments[index_]->label +
                  ": the contacts were loaded when the record began, as by a path of " +
                  core::format_number(travel, 3) + " " +
                  core::unit_for(before_.rig.known.oscillator.coordinate, loaded.task->parameters.back().unit) +
                  " from an unloaded state: it is sought as travel; state 'initial' if they were not";
    return loaded;
  }

  /// A fit with a known travel, in the direction that `loaded` found, if a longer one changes nothing.
  [[nodiscard]] std::optional<LoadedFit> once_yielded(const LoadedFit& loaded) const {
    const Eigen::VectorXd& q = loaded.found.coordinates;
    const Eigen::Index last = q.size() - 1;
    Eigen::VectorXd outputs;
    Eigen::MatrixXd jacobian;
    if (!loaded.task->problem.derivatives(q, outputs, jacobian)) return std::nullopt;
    constexpr double nothing = 0.1;  // deviations, all readings together, for a change of 100 %
    const double effect = jacobian.col(last).cwiseProduct(loaded.found.weights).norm() * std::abs(q[last]);
    if (!(effect < nothing)) return std::nullopt;
    const double travel = loaded.task->problem.space().values(q)[last];
    LoadedFit yielded{
        task_with(before_.parameters, before_.sizes, std::copysign(std::max(std::abs(travel), length_), travel)),
        {},
        before_.experiments[index_]->label + ": the contacts had yielded when the record began, in the " +
            (travel > 0.0 ? "positive" : "negative") + " direction; state 'initial' if they were unloaded"};
    std::optional<SearchResult> found = search_from(yielded.task->problem, q.head(last), options_);
    if (!found) return std::nullopt;
    yielded.found = std::move(*found);
    const double least = squares(*loaded.task, loaded.found, loaded.found.weights);
    const double now = squares(*yielded.task, yielded.found, loaded.found.weights);
    if (now > least + least / std::max(1.0, freedom(*loaded.task))) return std::nullopt;
    return yielded;
  }

  /// The chance that a load that does not exist reduces the sum of squares as much.
  [[nodiscard]] double chance_of(const LoadedFit& loaded) const {
    const Eigen::VectorXd& weights = loaded.found.weights;
    const double with = squares(*loaded.task, loaded.found, weights);
    const double without = squares(before_, found_, weights);
    if (!std::isfinite(with) || !std::isfinite(without)) return std::isfinite(with) ? 0.0 : 1.0;
    const Eigen::VectorXd misses = weighted_misses(loaded.task->problem, loaded.found.coordinates, weights);
    double independent = 0.0;
    double all = 0.0;
    for (const SignalRows& rows : loaded.task->problem.readings().signals()) {
      const Eigen::Index size = rows.size();
      independent += independent_samples(misses.segment(rows.begin, size),
                                         loaded.task->problem.readings().signal(rows).is_sampled);
      all += static_cast<double>(size);
    }
    // The parameter of the load counts also where the readings leave only its sign.
    const double left = freedom(before_) - 1.0;
    if (!(left >= 1.0)) return 1.0;
    const double share = std::min(1.0, independent / all);
    const double statistic = share * (without - with) / (with / left);
    return f_test_p_value(std::max(statistic, 0.0), 1.0, std::max(1.0, share * left));
  }

  const FitTask& before_;
  const SearchResult& found_;
  std::size_t index_;
  double length_;
  SearchOptions options_;
  long most_work_;
  bool leaves_motion_;
};

}  // namespace

std::optional<LoadedFit> with_first_load(const FitTask& before, const SearchResult& found, std::size_t index,
                                         double length, const SearchOptions& options, long most_work) {
  if (!may_be_loaded(before, before.problem.space().values(found.coordinates), index)) return std::nullopt;
  return LoadSearch(before, found, index, length, options, most_work).run();
}

}  // namespace dualdamp::identify
