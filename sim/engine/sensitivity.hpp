#pragma once
/// The derivative of a motion with respect to where it started: d(x, v, states of the laws)(now)/d(same)(start).
///
/// Columns are perturbations of the start. Within an interval (x, v) obey the mode's propagator and the force that
/// perturbed states exert; at an event a perturbation comes late or early by its own `shift`, and the saltation
/// matrix follows from that (filippov1988, leine2004): a perturbation is carried to the crossing with the motion
/// before, through the laws' jumps, and back with the motion behind.
///
/// The laws know nothing of this. Their forms and jumps are affine in their states (law.hpp), so that the
/// difference of two evaluations is the derivative, exact to rounding however large the perturbation.
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

  /// The instant of an event, on the motion before it.
  struct Event {
    double by_position = 0.0;  ///< dg/dx of the guard that ends the interval
    double by_velocity = 0.0;  ///< dg/dv
    double slope = 0.0;        ///< dg/dt
    double velocity = 0.0;     ///< m/s
    double acceleration = 0.0;
  };

  /// Identity, for a motion that begins with these memories. `modal`: some law may come to have states.
  void begin(const Memories& memories, bool modal);

  /// Asks the laws what perturbed states exert in the interval that begins now. `decays`: of the transients.
  void lay(Laws laws, const Memories& memories, const friction::Instant& now, friction::Direction direction,
           const std::vector<double>& decays);

  /// Over a slip. `responses`: (x, v) at its end to a unit constant force and to a unit of each transient,
  /// from rest at zero.
  void slip(const Eigen::Matrix2d& propagator, std::span<const Eigen::Vector2d> responses);
  /// Over a stick.
  void stick();

  /// What perturbed states add to a guard of law `law` at the end of the interval laid last; `duration` of it [s].
  /// Call before the memories move on.
  void perturb_guard(Laws laws, const Memories& memories, const friction::Instant& begin,
                     friction::Direction direction, std::size_t law, std::size_t guard, double duration);
  /// The same of the pull's limit: `factor` times the perturbed force.
  void perturb_limit(double factor, const std::vector<double>& decays, double duration);

  /// States of law `law` over the interval, for a law that advances. `before`: its memory at the begin.
  void advance(const friction::Law& law, std::size_t index, const friction::Memory& before,
               const friction::Memory& after, const friction::Instant& begin, const friction::Instant& end,
               double duration, friction::Direction direction);

  /// Carries the perturbations to their own crossings of the guard.
  void enter(const Event& event, Laws laws, const Memories& memories, const friction::Instant& now,
             friction::Direction direction);
  /// Jump of one law; `after`: its memory behind the jump.
  void jump(const friction::Law& law, std::size_t index, const friction::Memory& before,
            const friction::Memory& after, friction::Trigger trigger, const friction::Instant& now,
            friction::Direction direction);
  /// Carries them back to the common time with the motion that begins now.
  void leave(double acceleration, Laws laws, const Memories& memories, const friction::Instant& now,
             friction::Direction direction);

  /// False: no law has states, now or later.
  [[nodiscard]] bool has_states() const { return with_states_; }
  /// Between enter() and leave().
  [[nodiscard]] bool at_crossing() const { return crossing_; }

  /// Rows: x, v, states of the laws as they are now; columns: the same at the begin.
  [[nodiscard]] Eigen::MatrixXd matrix() const;

 private:
  [[nodiscard]] bool perturbed(std::size_t law, std::size_t column) const;
  const friction::Memory& displaced(const friction::Memory& memory, std::size_t law, std::size_t column);
  [[nodiscard]] friction::Instant displaced(const friction::Instant& now, std::size_t column) const;
  void flow(double factor, Laws laws, const Memories& memories, const friction::Instant& now,
            friction::Direction direction);

  std::vector<Eigen::Vector2d> motion_;  ///< of each column
  std::vector<Eigen::Vector2d> begin_;   ///< motion_ at the start of the interval
  std::vector<Eigen::MatrixXd> states_;  ///< of each law: state by column
  std::vector<Eigen::VectorXd> force_;   ///< of each column: constant part, then the transients [N]
  std::vector<double> guard_;            ///< of each column: what its states add to the guard
  std::vector<double> shift_;            ///< of each column [s]
  bool with_states_ = false;
  bool crossing_ = false;
  friction::Memory probe_;
  std::vector<friction::Affine> forms_;
  std::vector<double> rates_;
};

}  // namespace dualdamp::sim
