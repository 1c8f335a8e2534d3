#pragma once
/// The motion between two events in closed form, and the next event by the oracle's rigorous search: for an
/// oscillator with plain friction under a harmonic drive. It uses the numbers of the model and shares no code with
/// the engines.

#include <vector>

#include "sim/engine/interval.hpp"
#include "sim/model.hpp"
#include "sim/sampled_signal.hpp"
#include "tests/support/exponential_sum.hpp"
#include "tests/support/oracle.hpp"
#include "tests/support/plain_friction.hpp"

namespace dualdamp::test {

/// The mass at an event, and its direction after it: -1, 0 (it sticks) or 1.
struct MassState {
  double t = 0.0;
  double x = 0.0;
  double v = 0.0;
  int direction = 0;
  double v_error = 0.0;  ///< m/s, error of v from the interval before
};

/// The next event.
struct NextEvent {
  enum class What { reversal, release, spring, contact } what = What::reversal;
  int side = 0;  ///< of the release, or to which the spring lets go or the contact breaks away
  std::size_t contact = 0;
  double s = 0.0;          ///< after the start of the interval [s]
  double uncertainty = 0;  ///< its change by rounding of state, places and drive [s]
};

/// Level and rate at t of a drive with steps or straight lines from sample to sample, in the piece of t.
[[nodiscard]] std::pair<double, double> sampled_drive(const sim::SampledSignal& samples, std::size_t piece,
                                                      double t);

/// Applies the event to friction and direction, by the equations of the laws. A mass that has come to rest sticks
/// while the pull is within the static level.
sim::EventKind take_place(const sim::Model& model, const NextEvent& event, PlainFriction& friction,
                          MassState& mass);

class PlainInterval {
 public:
  PlainInterval(const sim::Model& model, const PlainFriction& friction, const MassState& from);

  /// False near critical damping and undamped resonance, where the terms of the closed form cancel.
  [[nodiscard]] bool is_regular() const;
  /// The first event, with all events within rounding of it, any of which may be the first. Empty: none.
  [[nodiscard]] std::vector<NextEvent> next_events(double horizon) const;
  [[nodiscard]] double position(double s) const;
  /// All forces on the mass at v = 0 at the start; for a mass at rest without those that hold it [N].
  [[nodiscard]] double net_force() const;
  /// A velocity below this is rounding [m/s]: of the forces, or of the terms of its sum.
  [[nodiscard]] double velocity_error() const;
  /// Sum of the moduli of all forces [N].
  [[nodiscard]] double force_scale() const { return force_scale_; }
  /// Some guard begins with a double root.
  [[nodiscard]] bool begins_with_double_root() const;

 private:
  /// constant + by_position x + by_velocity v + by_drive Re sum p exp(i w s) + transient exp(-decay s) > 0, zero at
  /// the start to the order `zeros`.
  struct Guard {
    NextEvent event;
    double constant = 0.0;
    double by_position = 0.0;
    double by_velocity = 0.0;
    double by_drive = 0.0;
    double transient = 0.0;
    double decay = 0.0;
    int zeros = 0;
    double error = 0.0;  ///< beyond that of position and velocity
  };

  void set_drive();
  void add_guards();
  void add_spring_guard(int side);
  void add_contact_guards(std::size_t index);
  [[nodiscard]] oracle::ExponentialSum sum(const Guard& guard) const;
  [[nodiscard]] double uncertainty(const Guard& guard, const oracle::ExponentialSum& f, double s) const;
  [[nodiscard]] double rate() const;
  [[nodiscard]] double start_velocity_error() const;

  const sim::Model& model_;
  const PlainFriction& friction_;
  MassState from_;
  LinearForce force_;
  oracle::LinearProblem problem_;
  std::vector<oracle::Exponential> velocity_;
  double force_scale_ = 0.0;
  double force_error_ = 0.0;
  double position_error_ = 0.0;
  std::vector<Guard> guards_;
};

}  // namespace dualdamp::test
