#pragma once
/// The friction laws a second time, directly from their equations, for comparison in tests. Every slider stores its
/// own place and is evaluated separately. No code is shared with friction_models; bristles use the same random
/// numbers.

#include <cstdint>
#include <vector>

namespace dualdamp::test {

/// constant + stiffness x + damping v [N]
struct LinearForce {
  double constant = 0.0;
  double stiffness = 0.0;
  double damping = 0.0;
};

/// A spring from the mass to a foot on the ground. When it is stretched to its reach, it lets go: it drags its foot
/// until v = 0, or, if it is a bristle, sets the foot down at another place.
struct Spring {
  double stiffness = 0.0;  ///< N/m
  double damping = 0.0;    ///< N.s/m, while the foot stands
  double reach = 0.0;      ///< m
  double kinetic = 0.0;    ///< N, the force that drags the foot
  double trail = 0.0;      ///< m, the stretch while it drags
  bool bristle = false;
  double foot = 0.0;  ///< m, while it stands
  int side = 0;       ///< to which the foot is dragged; 0: it stands
};

/// Spring and damper in parallel, in series with a slider. While it sticks, f = stiffness stretch + damping v, up
/// to static_level. While it slides, f = +-kinetic, until the slider's speed v - stretch' is zero, or, with the
/// mass at rest, is `stopped`.
struct DampedContact {
  double stiffness = 0.0;     ///< N/m
  double damping = 0.0;       ///< N.s/m
  double kinetic = 0.0;       ///< N
  double static_level = 0.0;  ///< N
  double foot = 0.0;          ///< m, while stuck
  double stretch = 0.0;       ///< m, while sliding
  int side = 0;               ///< of the slide; 0: stuck

  [[nodiscard]] double settled() const { return side * kinetic / stiffness; }
  [[nodiscard]] double decay() const { return stiffness / damping; }
  /// m/s
  [[nodiscard]] double stopped() const { return 1e-12 * static_level / damping; }
  /// The slip continues for s [s].
  void relax(double s);
  void break_away(int towards, double x);
  void stick(double x);
};

class PlainFriction {
 public:
  double kinetic = 0.0;       ///< N, of all Coulomb friction
  double static_level = 0.0;  ///< N
  std::vector<Spring> springs;
  std::vector<DampedContact> contacts;

  void add_coulomb(double kinetic_level, double static_limit);
  void add_contact(double kinetic_level, double static_limit, double stiffness, double damping);
  void add_iwan(double stiffness, double limit) { add_contact(limit, limit, stiffness, 0.0); }
  void add_reset_integrator(double kinetic_level, double stiffness, double static_gain, double damping);
  /// Once only.
  void add_bristles(double stiffness, double snap_distance, int count, std::uint64_t seed);
  /// Springs are unstretched, bristles are at their random places.
  void start(double x);

  /// Force on the mass that moves in this direction (-1, 1); 0: at rest, without the force that holds it there.
  [[nodiscard]] LinearForce force(int direction) const;
  /// Where on this side the next spring lets go [m]; infinite: none does.
  [[nodiscard]] double edge(int side) const;
  /// All springs that let go there.
  void let_go(int side);
  /// The mass stops at x: feet that were dragged now stand.
  void reverse(double x);
  /// Time passes.
  void relax(double s);

 private:
  [[nodiscard]] double drawn_foot(const Spring& spring, double x);

  std::uint64_t seed_ = 0;
  std::uint64_t draws_ = 0;
};

}  // namespace dualdamp::test
