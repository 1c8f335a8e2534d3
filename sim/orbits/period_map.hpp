#pragma once
/// The period map: the state one forcing period later, or several, and the monodromy matrix: the derivative of that
/// state by the state at the start. Its eigenvalues are the Floquet multipliers.
///
/// Coordinates of a state are x, v and the states of every law, in this order. A mass at rest at a period boundary
/// and a law in a mode whose state does not act make the monodromy matrix singular: their Floquet multipliers are
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
/// states relative to their own size. Infinite when a law is in another mode.
[[nodiscard]] double distance(const State& a, const State& b, double size, double omega);

/// One forcing period, or as many as the map passes: where it starts, where it ends, how the end depends on the
/// start.
struct ForcingPeriod {
  State begin;
  State end;
  Eigen::MatrixXd monodromy;  ///< empty unless asked for
  double size = 0.0;          ///< largest |x| met [m]
  bool moves = false;

  /// Distance of end and begin.
  [[nodiscard]] double closure(double omega) const { return distance(begin, end, size, omega); }
  /// It ends in the mode in which it began, so that the monodromy matrix maps displacements to such of the same
  /// kind.
  [[nodiscard]] bool ends_in_its_mode() const;
  /// Floquet multipliers; none of a period that ends in another mode.
  [[nodiscard]] std::vector<std::complex<double>> multipliers() const;
  /// The largest modulus of them; infinite when there are none or the monodromy matrix is not finite: what is not
  /// known does not attract.
  [[nodiscard]] double radius() const;
  /// The same without the coordinates that a period leaves as they are, whatever the others do: sliders that never
  /// slip. Their Floquet multipliers are 1.
  [[nodiscard]] double free_radius() const;
  /// These coordinates.
  [[nodiscard]] std::vector<Eigen::Index> free_coordinates() const;
  /// Whether the period leaves law state `row` (2, 3, ...) as it is.
  [[nodiscard]] bool holds(Eigen::Index row) const;
};

/// Whether the monodromy matrix is computed too.
enum class Monodromy { without, with };

/// Is told of the period on the way.
class PeriodObserver {
 public:
  virtual ~PeriodObserver() = default;
  virtual void begin(const State& start) = 0;
  /// `x`: where the interval ends [m].
  virtual void observe(const Interval& interval, double x) = 0;
};

class PeriodMap {
 public:
  /// Over `periods` forcing periods.
  explicit PeriodMap(const Model& model, int periods = 1) : engine_(make_engine(model)), periods_(periods) {}

  /// From the model's initial state, laws at their start.
  [[nodiscard]] ForcingPeriod from_start(double x, double v, Monodromy monodromy);
  [[nodiscard]] ForcingPeriod from(const State& state, Monodromy monodromy, PeriodObserver* observer = nullptr);
  /// From where the last one ended.
  [[nodiscard]] ForcingPeriod next(Monodromy monodromy);

  /// Of the engine, or that the map has done more work than it may.
  [[nodiscard]] const core::Outcome& outcome() const { return exhausted_.ok() ? engine_->outcome() : exhausted_; }
  /// How much work (`Engine::work`) the engine may have done in all; a period during which it does more is not
  /// followed to its end.
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
/// `state` with its coordinates changed by `change`; a mass that sticks goes on sticking, one that slips goes on in
/// its direction unless it turns freely.
[[nodiscard]] State displaced(const State& state, const Eigen::VectorXd& change);

/// The change of begin that Newton's method takes to make end = begin, or an empty vector where it has none:
/// the period ends in another mode, or the monodromy matrix is singular. A coordinate that the period does not
/// change and that depends on itself alone (a slider that never slips) stays as it is.
[[nodiscard]] Eigen::VectorXd newton_step(const ForcingPeriod& period);

}  // namespace dualdamp::sim
