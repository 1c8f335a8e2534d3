#pragma once
/// The derivative of a motion with respect to where it started: d(x, v, states of the laws)(now)/d(same)(start).
///
/// Each column is a perturbation of the start. Within an interval (x, v) obey the mode's propagator and the force
/// that perturbed states exert. At an event a perturbed motion is late or early by its own `shift`. The
/// perturbation is carried to its crossing along the motion before the event, through the laws' jumps, and back
/// along the motion after the event; this gives the saltation matrix (filippov1988, leine2004).
///
/// Laws state no derivatives. Their forms and jumps are affine in their states (law.hpp), so the difference of two
/// evaluations is the derivative, exact to rounding for a perturbation of any size.
///
/// Cost: per interval and column some ten multiplications and, where laws have states, two evaluations of their
/// forms.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "friction_models/law.hpp"

namespace dualdamp::sim {

class Sensitivity {
 public:
  using Laws = std::span<const friction::Law>;
  using Memories = std::vector<friction::Memory>;

  /// An event, with the motion just before it.
  struct Event {
    double by_position = 0.0;  ///< dg/dx of the guard that ends the interval
    double by_velocity = 0.0;  ///< dg/dv
    double slope = 0.0;        ///< dg/dt
    double velocity = 0.0;     ///< m/s
    double acceleration = 0.0;
  };

  /// Sets the derivative to identity for a motion that begins with these memories. `with_memory`: some law may have
  /// states now or later. `units`: the perturbation of each coordinate, a power of two of the size of the motion:
  /// one far below it would be lost in rounding, and beside one far above it the motion would be.
  void begin(const Memories& memories, bool with_memory, const std::vector<double>& units);

  /// Computes the forces that perturbed states exert in the interval that begins now. `decays`: of the transients.
  void begin_interval(Laws laws, const Memories& memories, const friction::Instant& now,
                      friction::Direction direction, const std::vector<double>& decays);

  /// Carries the derivative over a slip. `responses`: (x, v) at its end under a unit constant force and under a
  /// unit of each transient, from rest at zero.
  void slip(const Eigen::Matrix2d& propagator, std::span<const Eigen::Vector2d> responses);
  /// Carries the derivative over a stick.
  void stick();

  /// Computes the change of a guard of law `law` by perturbed states at the end of the present interval;
  /// `duration`: of the interval [s]. Call it before the memories are advanced.
  void perturb_guard(Laws laws, const Memories& memories, const friction::Instant& begin,
                     friction::Direction direction, std::size_t law, std::size_t guard, double duration);
  /// Computes the change of the guard of the pull: `factor` times the perturbed force.
  void perturb_limit(double factor, const std::vector<double>& decays, double duration);

  /// Carries the states of law `law` over the interval, for a law that advances. `before`: its memory at the start.
  void advance(const friction::Law& law, std::size_t index, const friction::Memory& before,
               const friction::Memory& after, const friction::Instant& begin, const friction::Instant& end,
               double duration, friction::Direction direction);

  /// Carries the perturbations to their own crossings of the guard.
  void enter(const Event& event, Laws laws, const Memories& memories, const friction::Instant& now,
             friction::Direction direction);
  /// Carries the states through the jump of one law; `after`: its memory after the jump.
  void jump(const friction::Law& law, std::size_t index, const friction::Memory& before,
            const friction::Memory& after, friction::Trigger trigger, const friction::Instant& now,
            friction::Direction direction);
  /// Carries the perturbations back to the common time along the motion that begins now.
  void leave(double acceleration, Laws laws, const Memories& memories, const friction::Instant& now,
             friction::Direction direction);

  /// Whether some law has states, now or later.
  [[nodiscard]] bool has_states() const { return with_states_; }
  /// Whether the perturbations are at their crossings: between enter() and leave().
  [[nodiscard]] bool at_crossing() const { return crossing_; }

  /// Rows: x, v, states of the laws now; columns: the same at the start.
  [[nodiscard]] Eigen::MatrixXd matrix() const;

 private:
  [[nodiscard]] bool perturbed(std::size_t law, std::size_t column) const;
  const friction::Memory& displaced(const friction::Memory& memory, std::size_t law, std::size_t column);
  [[nodiscard]] friction::Instant displaced(const friction::Instant& now, std::size_t column) const;
  [[nodiscard]] double difference(std::size_t law, std::size_t k, std::size_t column,
                                  const friction::Memory& before, const friction::Memory& after) const;
  void flow(double factor, Laws laws, const Memories& memories, const friction::Instant& now,
            friction::Direction direction);

  std::vector<double> units_;            ///< of the perturbations at the start, powers of two
  std::vector<Eigen::Vector2d> motion_;  ///< of each column
  std::vector<Eigen::Vector2d> begin_;   ///< motion_ at the start of the interval
  std::vector<Eigen::MatrixXd> states_;  ///< of each law: state by column
  std::vector<Eigen::VectorXd> force_;   ///< of each column: constant part, then the transients [N]
  std::vector<double> guard_;            ///< of each column: change of the guard by its states
  std::vector<double> shift_;            ///< of each column: delay of its crossing [s]
  bool with_states_ = false;
  bool crossing_ = false;
  friction::Memory probe_;
  friction::Memory unchanged_;  ///< probe_ before its law changed it
  std::vector<friction::Affine> forms_;
  std::vector<double> rates_;
};

}  // namespace dualdamp::sim
