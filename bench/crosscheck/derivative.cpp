#include "bench/crosscheck/derivative.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "bench/crosscheck/patience.hpp"
#include "friction_models/state_sizes.hpp"
#include "sim/engine/smooth_engine.hpp"
#include "sim/orbits/transient.hpp"

namespace dualdamp::crosscheck {

namespace {

using sim::ForcingPeriod;
using sim::State;

/// Error of a central difference at its best step, relative to the column, or to 1 where the column is smaller.
constexpr double tolerance = 1e-4;
/// A quotient this close is not improved.
constexpr double clearly = 0.1 * tolerance;
/// A larger relative difference of the one-sided quotients is a corner.
constexpr double most_bend = 1e-2;
/// Where a corner shows at steps below this fraction of the size, it is at this state.
constexpr double nearby = 2e-5;

/// The size of every coordinate: that of the motion where a law states none.
Eigen::VectorXd sizes(const sim::Model& model, const State& state, double length, double omega) {
  std::vector<double> list = {length, length * omega};
  for (std::size_t i = 0; i < state.memories.size(); ++i) {
    const friction::Memory& memory = state.memories[i];
    std::vector<double> scales(memory.state.size());
    model.friction[i].scales(memory, scales);
    for (const double scale : scales) {
      const bool is_velocity = scale == friction::size_of_velocity;
      list.push_back(is_velocity ? length * omega : scale > 0.0 ? scale : length);
    }
  }
  return Eigen::Map<const Eigen::VectorXd>(list.data(), static_cast<Eigen::Index>(list.size()));
}

struct Quotient {
  Eigen::VectorXd column;
  Eigen::VectorXd bend;  ///< difference of the one-sided quotients
  bool same_sequence = false;
};

class Quotients {
 public:
  Quotients(const sim::Model& model, const State& state) : map_(model), state_(state) {
    allow_more_work();
    period_ = map_.from(state, sim::Monodromy::with, &events_);
  }

  void allow_more_work() { map_.limit(map_.engine().work() + most_work_of_quotients); }
  [[nodiscard]] bool ok() const { return map_.outcome().ok(); }
  [[nodiscard]] const std::string& reason() const { return map_.outcome().reason; }
  [[nodiscard]] double accuracy() { return map_.engine().accuracy(); }
  [[nodiscard]] const ForcingPeriod& period() const { return period_; }

  Quotient central(Eigen::Index coordinate, double step) {
    Eigen::VectorXd change = Eigen::VectorXd::Zero(sim::coordinates(state_).size());
    change[coordinate] = step;
    const Pair pair = both_ways(change);
    // The step of a slider far from zero is rounded: take the difference that remains.
    if (!pair.is_known || pair.taken[coordinate] == 0.0) return {};
    const double taken = pair.taken[coordinate];
    return {(pair.upper - pair.lower) / taken,
            (pair.upper + pair.lower - 2.0 * sim::coordinates(period_.end)) / (0.5 * taken), pair.same_sequence};
  }

  /// What the monodromy matrix misses of a central difference along `change`; infinite if the events differ.
  Eigen::VectorXd missed(const Eigen::VectorXd& change) {
    const Pair pair = both_ways(change);
    if (!pair.is_known || !pair.same_sequence)
      return Eigen::VectorXd::Constant(change.size(), std::numeric_limits<double>::infinity());
    return pair.upper - pair.lower - period_.monodromy * pair.taken;
  }

 private:
  /// The ends of two motions from either side of the state.
  struct Pair {
    Eigen::VectorXd upper;
    Eigen::VectorXd lower;
    Eigen::VectorXd taken;  ///< difference of their starts
    bool same_sequence = false;
    bool is_known = false;  ///< both were followed, and begin and end in the modes of the period
  };

  Pair both_ways(const Eigen::VectorXd& change) {
    sim::PeriodEvents above_events;
    sim::PeriodEvents below_events;
    const ForcingPeriod above = map_.from(sim::displaced(state_, change), sim::Monodromy::without, &above_events);
    const bool above_ok = map_.outcome().ok();
    const ForcingPeriod below = map_.from(sim::displaced(state_, -change), sim::Monodromy::without, &below_events);
    if (!above_ok || !map_.outcome().ok()) return {};
    for (const auto& [one, other] : {std::pair{&above, &below}, {&above, &period_}})
      if (!sim::same_mode(one->begin, other->begin) || !sim::same_mode(one->end, other->end)) return {};
    return {sim::coordinates(above.end), sim::coordinates(below.end),
            sim::coordinates(above.begin) - sim::coordinates(below.begin),
            above_events.sequence() == events_.sequence() && below_events.sequence() == events_.sequence(), true};
  }

  sim::PeriodMap map_;
  State state_;
  sim::PeriodEvents events_;
  ForcingPeriod period_;
};

struct Nearest {
  Eigen::VectorXd column;
  double error = std::numeric_limits<double>::infinity();  ///< relative to the column; infinite: none was found
  bool is_bent = false;                                    ///< one-sided quotients differ
  bool is_known = false;  ///< three quotients agree with each other: there is something to disagree with
};

/// Among steps from a thousandth of the size downwards: the first quotient that is clearly close, or else the
/// closest.
Nearest nearest_quotient(Quotients& quotients, Eigen::Index j, const Eigen::VectorXd& size,
                         const Patience& patience) {
  const Eigen::VectorXd column = quotients.period().monodromy.col(j).cwiseQuotient(size) * size[j];
  const auto apart = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return (a - b).norm() / std::max({1.0, a.norm(), b.norm()});
  };
  Nearest nearest;
  Eigen::VectorXd last;
  int agreeing = 0;  // in a row, each with the quotient before
  for (double part = 1e-3; part > 1e-9 && nearest.error > clearly && quotients.ok() && !patience.is_over();
       part *= 0.1) {
    const Quotient quotient = quotients.central(j, part * size[j]);
    if (!quotient.same_sequence) continue;
    const Eigen::VectorXd found = quotient.column.cwiseQuotient(size) * size[j];
    // Where two events of one kind are exchanged, the sequence is the same, but the one-sided quotients differ at
    // every step.
    const bool is_bent =
        quotient.bend.cwiseQuotient(size).norm() * size[j] > most_bend * std::max(1.0, found.norm());
    // Agreement of only two quotients may be chance: they may be rounding of the motion.
    agreeing = last.size() > 0 && !is_bent && apart(found, last) < 0.5 * tolerance ? agreeing + 1 : 0;
    nearest.is_known = nearest.is_known || agreeing >= 2;
    nearest.is_bent = nearest.is_bent || (is_bent && part < nearby);
    last = found;
    if (const double error = apart(found, column); error < nearest.error) {
      nearest.column = quotient.column;
      nearest.error = error;
    }
  }
  return nearest;
}

/// All columns at once: along one direction, in which each column has a part of at most one, a difference must be
/// as close as one that is clearly close must be for a single column. The error of one column would show there; the
/// errors of two do not cancel but by chance. Infinite if no step is that close: then each column is compared.
double clear_error_of_all(Quotients& quotients, bool moves, const Eigen::VectorXd& size) {
  const Eigen::MatrixXd& monodromy = quotients.period().monodromy;
  const Eigen::MatrixXd scaled = size.cwiseInverse().asDiagonal() * monodromy * size.asDiagonal();
  Eigen::VectorXd direction(size.size());
  for (Eigen::Index j = 0; j < size.size(); ++j)
    direction[j] = (j % 3 == 1 ? -1.0 : 1.0) / std::max(1.0, scaled.col(j).norm());
  if (!moves) direction[1] = 0.0;
  for (double part = 1e-3; part > 1e-7 && quotients.ok(); part *= 0.1) {
    const Eigen::VectorXd missed = quotients.missed(part * direction.cwiseProduct(size));
    const double error = missed.cwiseQuotient(size).norm() / (2.0 * part);
    if (error <= clearly) return error;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

Finding compare_derivative(const std::string& name, const sim::Model& model, const State& state, double omega) {
  Finding finding{name, Verdict::agreed, 0.0, {}};
  Quotients quotients(model, state);
  if (!quotients.ok()) return {name, Verdict::refused, 0.0, quotients.reason()};
  const Eigen::MatrixXd& monodromy = quotients.period().monodromy;
  const double length = quotients.period().size;
  if (monodromy.rows() != monodromy.cols() || length == 0.0) return {name, Verdict::not_compared, 0.0, "no motion"};
  if (!monodromy.allFinite()) return {name, Verdict::disagree, 0.0, "the monodromy matrix is not finite"};
  if (sim::is_below_steps(model, length, quotients.accuracy()))
    return {name, Verdict::not_compared, 0.0, "the motion is smaller than steps resolve"};
  const Eigen::VectorXd size = sizes(model, state, length, omega);
  const bool moves = state.direction != friction::Direction::none;
  const double error_of_all = clear_error_of_all(quotients, moves, size);
  if (error_of_all <= clearly) return {name, Verdict::agreed, error_of_all, {}};
  quotients.allow_more_work();
  const Patience patience;
  for (Eigen::Index j = 0; j < monodromy.cols(); ++j) {
    if (j == 1 && !moves) continue;
    const Nearest nearest = nearest_quotient(quotients, j, size, patience);
    if (nearest.error <= tolerance) {
      finding.worst = std::max(finding.worst, nearest.error);
      continue;
    }
    if (patience.is_over() || !quotients.ok()) {
      if (finding.verdict == Verdict::agreed)
        finding = {name, Verdict::not_compared, finding.worst,
                   j == 0 ? "a period takes too long"
                          : fmt::format("from column {} on: the difference quotients take too long", j)};
      return finding;
    }
    if (!nearest.is_known || nearest.is_bent) {
      finding.verdict = Verdict::exception;
      finding.text = std::isinf(nearest.error) || nearest.is_bent
                         ? "corner: the sequence of events changes at this state"
                         : "rough: no three difference quotients agree";
      continue;
    }
    Eigen::Index row = 0;
    (nearest.column - monodromy.col(j)).cwiseQuotient(size).cwiseAbs().maxCoeff(&row);
    finding.verdict = Verdict::disagree;
    finding.text = fmt::format("row {}, column {}: {:.6g}, by differences {:.6g}", row, j, monodromy(row, j),
                               nearest.column[row]);
    return finding;
  }
  return finding;
}

}  // namespace dualdamp::crosscheck
