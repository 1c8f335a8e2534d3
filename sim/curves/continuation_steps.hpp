#pragma once
/// The continuation of a branch (`continuation.hpp`) as a class. Its steps from one orbit to the next, also into
/// another mode, are in continuation_steps.cpp; the branch and its ends in continuation.cpp; changes of stability
/// and folds in continuation_changes.cpp.

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/curves/continuation.hpp"
#include "sim/orbits/newton.hpp"
#include "sim/orbits/period_map.hpp"

namespace dualdamp::sim {

/// A point of the branch with the data for the next step.
struct Node {
  double parameter = 0.0;
  ForcingPeriod period;
  Eigen::VectorXd tangent;    ///< scaled: coordinates, then the parameter; empty before the first step
  Eigen::VectorXd bend;       ///< derivative of the tangent along the branch; empty if it is not known
  std::vector<double> reach;  ///< of the laws' states within the period (`state_reach.hpp`)
};

/// What a branch has cost so far, including failed attempts, and what one period of an attempt may cost.
struct Effort {
  core::SearchCount count;
  long work = 0;                                      ///< Engine::work
  long of_period = std::numeric_limits<long>::max();  ///< an attempt that exceeds it has run away from every orbit
};

/// A period map that adds its cost to that of a branch and limits the work of each of its periods.
class CountedMap {
 public:
  CountedMap(const Model& model, int periods, Effort& total) : map_(model, periods), total_(total) {}
  ~CountedMap() {
    total_.count += map_.engine().count();
    total_.work += map_.engine().work();
  }
  CountedMap(const CountedMap&) = delete;
  CountedMap& operator=(const CountedMap&) = delete;

  [[nodiscard]] ForcingPeriod from(const State& state, Monodromy monodromy, PeriodObserver* observer = nullptr) {
    renew_limit();
    return map_.from(state, monodromy, observer);
  }
  [[nodiscard]] ForcingPeriod next(Monodromy monodromy) {
    renew_limit();
    return map_.next(monodromy);
  }
  /// The map itself, without a limit: for an orbit that was found.
  [[nodiscard]] PeriodMap& unlimited() {
    map_.limit(std::numeric_limits<long>::max());
    return map_;
  }
  [[nodiscard]] const core::Outcome& outcome() const { return map_.outcome(); }
  [[nodiscard]] Engine& engine() { return map_.engine(); }

 private:
  void renew_limit() {
    const long most = std::numeric_limits<long>::max();
    map_.limit(total_.of_period < most ? map_.engine().work() + total_.of_period : most);
  }

  PeriodMap map_;
  Effort& total_;
};

/// The displacement by the drive's force against the spring or the inertia, whichever is less [m].
[[nodiscard]] double driven_displacement(const Model& model);

class Continuation {
 public:
  Continuation(const Model& model, BranchParameter parameter, double from, double to, const BranchOptions& options)
      : model_(model),
        quantity_(parameter == BranchParameter::amplitude ? &Excitation::amplitude : &Excitation::frequency),
        options_(options),
        from_(from),
        to_(to),
        range_(std::max(std::abs(to - from), 1e-12 * std::abs(from))) {
    limit_by_accuracy(make_engine(at(from))->accuracy());
  }

  Branch run();
  [[nodiscard]] const core::SearchCount& count() const { return effort_.count; }

 private:
  void limit_by_accuracy(double accuracy);
  [[nodiscard]] bool closes(const Node& node, double before);
  [[nodiscard]] Model at(double parameter) const;
  [[nodiscard]] std::optional<Node> node_at(double parameter, const State& start);
  [[nodiscard]] double omega(double parameter) const;
  [[nodiscard]] double parameter_scale(double parameter) const;
  [[nodiscard]] Eigen::VectorXd scale(const Node& node) const;
  [[nodiscard]] std::optional<Eigen::VectorXd> by_parameter(const Node& node, const Eigen::VectorXd& along);
  [[nodiscard]] double amplification(const Node& node) const;
  [[nodiscard]] std::optional<Eigen::VectorXd> tangent(const Node& node, const Eigen::VectorXd& along);
  [[nodiscard]] std::optional<Eigen::VectorXd> tangent_near(const Node& node, const Eigen::VectorXd& along,
                                                            const Eigen::VectorXd& guess);
  [[nodiscard]] Solution along_branch(const Node& node, const Eigen::VectorXd& slope, const Eigen::VectorXd& across,
                                      const Eigen::VectorXd& right) const;
  [[nodiscard]] std::optional<Node> orbit(double parameter, const State& guess);
  [[nodiscard]] std::optional<Node> correct(const Node& from, double step);
  [[nodiscard]] std::optional<Node> cross_modes(const Node& from, double step);
  [[nodiscard]] Eigen::VectorXd predicted(const Node& from, double step) const;
  [[nodiscard]] Eigen::VectorXd bend_at(const Node& node, const Node& from) const;
  [[nodiscard]] Eigen::VectorXd arc(const Node& from, const Node& node) const;
  [[nodiscard]] bool turns_too_far(const Node& from, const Node& node, const Eigen::VectorXd& tangent) const;
  [[nodiscard]] Eigen::Vector3d way(const Node& from, const Node& node) const;
  [[nodiscard]] double farthest(double step) const;
  [[nodiscard]] bool is_ahead(const Node& from, const Node& node, double step) const;
  [[nodiscard]] bool lies_between(const State& low, const Node& node, const State& high, double farthest) const;
  [[nodiscard]] std::optional<Node> at_edge(Node inner, Node outer, double step);
  [[nodiscard]] bool was_passed(const Node& node) const;
  [[nodiscard]] std::optional<Node> advance(const Node& from, double& step);
  [[nodiscard]] BranchPoint describe(const Node& node);
  [[nodiscard]] bool inside(double parameter) const;
  [[nodiscard]] bool is_exhausted() const { return effort_.work > options_.most_work; }
  [[nodiscard]] std::optional<Branch> ended_ahead(const Node& node);
  [[nodiscard]] std::optional<double> grazing_ahead() const;
  [[nodiscard]] bool ends_ahead(const Node& node) const;
  [[nodiscard]] std::string parting_at(const Node& node) const;
  [[nodiscard]] std::string meeting() const;
  [[nodiscard]] std::string where_held(double held, double other);
  [[nodiscard]] std::optional<double> rest_ahead(const Node& node);
  [[nodiscard]] bool comes_to_rest(double parameter, const State& start);
  [[nodiscard]] std::string with_unit(double parameter, int digits) const;
  [[nodiscard]] Branch at_rest(const Node& node, double place);
  [[nodiscard]] Branch ended(BranchEnd end, const std::string& warning);
  [[nodiscard]] bool record(const Node& before, const Node& after);
  [[nodiscard]] std::optional<Node> after_jump(const Node& node);
  [[nodiscard]] bool jumps_on(Node& node, double& step);
  void locate_stability(const Node& before, BranchPoint low, BranchPoint high);
  template <class Changed>
  [[nodiscard]] bool bisect(BranchPoint& low, BranchPoint& high, const State& guess, const Changed& changed);
  template <class Changed>
  [[nodiscard]] std::pair<Node, Node> close_in(Node low, Node high, const Changed& changed);
  [[nodiscard]] bool are_apart(const BranchPoint& a, const BranchPoint& b);
  [[nodiscard]] bool locate_sequences(const Node& before, const Node& after, BranchPoint& low,
                                      const BranchPoint& last);
  [[nodiscard]] bool locate_fold(const Node& before, const Node& after, BranchPoint& low);
  void add_change(ChangeKind kind, const BranchPoint& before, const BranchPoint& after);

  Model model_;
  double Excitation::* quantity_;
  BranchOptions options_;
  double from_;
  double to_;
  double range_;
  int ratio_ = 1;  ///< forcing periods in a period of the motion
  Branch branch_;
  Closure closure_;
  double nudge_ = 1e-7;   ///< relative change of the parameter for the difference quotient by it
  double nearest_ = 0.0;  ///< smallest closure of the corrections of the last step over its rounding
  Effort effort_;
};

}  // namespace dualdamp::sim
