#pragma once
/// The period map gives the state one forcing period later, or several, and the monodromy matrix, which is the
/// derivative of this state by the state at the start. Its eigenvalues are the Floquet multipliers.
///
/// Coordinates of a state are x, v and the states of every law, in this order. The monodromy matrix is singular if
/// the mass sticks at a period boundary or if a law is in a mode whose state does not act: a Floquet multiplier is
/// zero.

#include <Eigen/Core>
#include <complex>
#include <limits>
#include <vector>

#include "core/outcome.hpp"
#include "sim/engine/engine.hpp"
#include "sim/engine/state.hpp"
#include "sim/model.hpp"

namespace dualdamp::sim {

/// Distance of two states relative to `size` [m], the size of the motion; velocities scaled by omega [rad/s], law
/// states relative to their own size. Infinite if a law is in another mode.
[[nodiscard]] double distance(const State& a, const State& b, double size, double omega);

/// One period of the map, which may be several forcing periods: its start, its end, and the derivative of the end
/// by the start.
struct ForcingPeriod {
  State begin;
  State end;
  Eigen::MatrixXd monodromy;  ///< empty if not computed
  double peak = 0.0;          ///< max x [m]
  double trough = 0.0;        ///< min x [m]
  double size = 0.0;          ///< largest |x| in the period [m]
  bool moves = false;

  /// Distance of end and start.
  [[nodiscard]] double closure(double omega) const { return distance(begin, end, size, omega); }
  /// Whether it ends in the mode in which it began: the monodromy matrix then maps coordinates to the same
  /// coordinates.
  [[nodiscard]] bool ends_in_its_mode() const;
  /// Floquet multipliers; empty if the period ends in another mode.
  [[nodiscard]] std::vector<std::complex<double>> multipliers() const;
  /// The largest modulus of a Floquet multiplier. Infinite if there is none or the monodromy matrix is not finite:
  /// an unknown orbit must not count as attracting.
  [[nodiscard]] double radius() const;
  /// radius() without coordinates that a period never changes, such as sliders that never slip. The Floquet
  /// multiplier of such a coordinate is 1.
  [[nodiscard]] double free_radius() const;
  /// All coordinates except those that a period never changes.
  [[nodiscard]] std::vector<Eigen::Index> free_coordinates() const;
  /// Whether the period never changes law state `row` (2, 3, ...), whatever the other coordinates are.
  [[nodiscard]] bool holds(Eigen::Index row) const;
};

/// Whether to compute the monodromy matrix.
enum class Monodromy { without, with };

/// Observer of the intervals of a period.
class PeriodObserver {
 public:
  virtual ~PeriodObserver() = default;
  virtual void begin(const State& start) = 0;
  /// `x`: position at the end of the interval [m].
  virtual void observe(const Interval& interval, double x) = 0;
};

class PeriodMap {
 public:
  /// A map over `periods` forcing periods.
  explicit PeriodMap(const Model& model, int periods = 1) : engine_(make_engine(model)), periods_(periods) {}

  /// The period from x, v at t = 0, with all laws at their start.
  [[nodiscard]] ForcingPeriod from_start(double x, double v, Monodromy monodromy);
  [[nodiscard]] ForcingPeriod from(const State& state, Monodromy monodromy, PeriodObserver* observer = nullptr);
  /// The period that starts at the end of the last one.
  [[nodiscard]] ForcingPeriod next(Monodromy monodromy);

  /// The outcome of the engine, or that the limit of work was reached.
  [[nodiscard]] const core::Outcome& outcome() const { return exhausted_.ok() ? engine_->outcome() : exhausted_; }
  /// Limits the total work of the engine (`Engine::work`); a period during which it exceeds this is given up.
  void limit(long work) { most_work_ = work; }
  [[nodiscard]] Engine& engine() { return *engine_; }
  [[nodiscard]] int periods() const { return periods_; }

 private:
  ForcingPeriod pass(Monodromy monodromy, PeriodObserver* observer = nullptr);

  std::unique_ptr<Engine> engine_;
  int periods_;
  long most_work_ = std::numeric_limits<long>::max();
  core::Outcome exhausted_;
};

[[nodiscard]] Eigen::VectorXd coordinates(const State& state);
/// `state` with its coordinates changed by `change`. A mass that sticks still sticks; one that slips keeps its
/// direction unless it turns freely.
[[nodiscard]] State displaced(const State& state, const Eigen::VectorXd& change);

/// Sizes of the coordinates, powers of two: x as the motion, v as omega [rad/s] times that, and a law state such
/// that it acts on the motion as the motion acts on it. In them the entries of the monodromy matrix are of one
/// order whatever the units of length, force and time, and a change of these units by powers of two changes no
/// digit.
[[nodiscard]] Eigen::VectorXd sizes_of_coordinates(const ForcingPeriod& period, double omega);

struct Solution {
  Eigen::VectorXd value;
  bool is_unique = false;  ///< the equations are regular
};

/// Solves linear equations whose rows and unknowns have these sizes.
[[nodiscard]] Solution solve_in_sizes(const Eigen::MatrixXd& system, const Eigen::VectorXd& right,
                                      const Eigen::VectorXd& rows, const Eigen::VectorXd& unknowns);

/// The change of the start by which Newton's method makes end = begin; `omega` [rad/s]: of the drive. Empty if the
/// period ends in another mode or the equations are singular. A coordinate that the period does not change and that
/// depends on itself alone (a slider that never slips) stays as it is.
[[nodiscard]] Eigen::VectorXd newton_step(const ForcingPeriod& period, double omega);

}  // namespace dualdamp::sim
