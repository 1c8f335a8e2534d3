#pragma once
/// The exact engine: the motion from event to event for laws that are affine in every mode.
///
/// Between events the motion has a closed form (`sim/engine/linear_mode.hpp`); the certified search finds the next
/// event (`core/crossing/first_crossing.hpp`). No law is known by name here.
///
/// Cost: for Coulomb friction about one exp, two sincos and a few dozen multiplications an event; no allocation
/// after the first period.

#include <Eigen/Core>
#include <array>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/crossing/guard.hpp"
#include "core/crossing/interval_start.hpp"
#include "core/crossing/search_result.hpp"
#include "sim/engine/engine.hpp"
#include "sim/engine/interval.hpp"
#include "sim/engine/linear_mode.hpp"
#include "sim/engine/sensitivity.hpp"

namespace dualdamp::sim {

class ExactEngine final : public Engine {
 public:
  /// Every law of the model must be affine, the spring linear.
  explicit ExactEngine(const Model& model);
  ~ExactEngine() override;

  [[nodiscard]] double accuracy() const override { return 0.0; }
  [[nodiscard]] bool has_past() const override { return false; }
  [[nodiscard]] long work() const override { return Engine::work() + long_work_; }

  void reset_sensitivity() override;
  [[nodiscard]] Eigen::MatrixXd sensitivity() const override { return sensitivity_.matrix(); }

 private:
  /// What identifies a mode.
  struct ModeKey {
    double damping = 0.0;
    double stiffness = 0.0;
    LinearMode::Layout layout;

    friend auto operator<=>(const ModeKey&, const ModeKey&) = default;
  };
  /// Relative rounding of a sum of parts.
  static constexpr double rounding = 16.0 * std::numeric_limits<double>::epsilon();
  /// A value farther than this (relative) from a limit is decided by its sign, a closer one by its Taylor germ.
  static constexpr double clearly = 1e-9;
  /// Terms of all guards of a mode up to which a panel takes one unit of work; with more of them it takes more.
  static constexpr long terms_in_unit = 12;
  /// The longest time, as an angle of the fastest element, over which a guard is taken as its tangent parabola.
  static constexpr double parabolic = 0.1;

  /// A guard of the present interval: the event that it ends with, and how it depends on the motion.
  struct Watch {
    Ending ending;
    double by_position = 0.0;  ///< dg/dx
    double by_velocity = 0.0;  ///< dg/dv
    double tolerance = 0.0;    ///< rounding of g at the start, in addition to that of its amplitudes
    bool is_speed = false;     ///< g is a positive multiple of the speed in a slip
    bool is_position = false;  ///< g is a function of x alone, and the mass slips
  };
  /// All laws together, affine in the interval.
  struct Total {
    friction::Affine force;  ///< without its transient
    friction::Affine limit;  ///< of static friction in a stick; the constant is that of the present position
    bool lasting = false;    ///< stays the same in later intervals of this direction
    int degree = 0;          ///< highest power of time in any part: modes without such elements are cheaper
    std::vector<double> transients;
    std::vector<double> decays;
  };
  /// A function that is within rounding of zero at the start, at the first time at which it is not.
  struct Later {
    double value = 0.0;  ///< 0: it stays within rounding
    double error = 0.0;  ///< its rounding then
  };
  class ExactInterval;

  /// Speed and its rate in a slip, from the first guard: velocity and acceleration times the direction.
  [[nodiscard]] const core::ModeFunction& speed() const { return guards_.front().value; }
  [[nodiscard]] const core::ModeFunction& speed_rate() const { return guards_.front().slope; }
  [[nodiscard]] double start_acceleration() const;
  void collect(bool with_guards);
  void add_force(const friction::Affine& part);
  void add_limit(const friction::Affine& part);
  void add_transient(double size, double decay);
  const LinearMode& mode_for(double damping, double stiffness);
  void load_forcing(double extra_constant);
  const LinearMode& pull_on_mode(core::ModeFunction& pull);
  void limit_guard(const core::ModeFunction& pull, double direction, core::ModeFunction& guard) const;
  void build_interval();
  void build_stick();
  void build_slip();
  void add_law_guards();
  core::Guard& new_guard(const Watch& watch);
  [[nodiscard]] core::Germ slip_germ(const core::Guard& guard, double tolerance) const;
  [[nodiscard]] bool rises_in_time(const core::Guard& guard, double tolerance) const;
  [[nodiscard]] core::Germ start_germ(const core::Guard& guard, const Watch& watch, double tolerance) const;
  [[nodiscard]] core::Germ position_germ(const Watch& watch) const;
  bool find_violated();
  void drop_guard(std::size_t i);
  bool search(double horizon);
  [[nodiscard]] Balance balance() override;
  friction::Direction leaves_limit(double tolerance);
  [[nodiscard]] friction::Direction moved_later(const core::ModeFunction& pull, double tolerance) const;
  [[nodiscard]] Later clear_of_rounding(const core::ModeFunction& f, double tolerance) const;
  bool lift_speed(core::Guard& guard, double tolerance) const;
  [[nodiscard]] double pull_now() const;
  void jumped(std::size_t law, const friction::Memory& before, friction::Trigger trigger) override;
  void track_begin(const friction::Instant& begin, bool at_once);
  void track_motion(const friction::Instant& begin, double s);
  void track_states(const friction::Instant& begin, double s, bool event);
  [[nodiscard]] bool is_forced() const;
  [[nodiscard]] bool coincides() const;
  void describe_interval(double begin);
  void begin_motion() override;
  [[nodiscard]] const Interval* step(double left, bool to_period_end) override;
  void keep_rounding(double s);
  void keep_time_rounding(double error, double slope, double curvature);
  void advance(double s, bool to_period_end);
  [[nodiscard]] double force_scale() const;
  [[nodiscard]] double force_rounding() const;
  [[nodiscard]] double velocity_rounding() const;

  double x_rounding_ = 0.0;  ///< of x_ from the interval before; v_rounding_: of v_
  double v_rounding_ = 0.0;
  double time_rounding_ = 0.0;  ///< of the time of the events at this instant [s]
  std::map<ModeKey, LinearMode> modes_;
  ModeKey key_;
  const LinearMode* mode_ = nullptr;  ///< of the present interval
  ModeForcing forcing_;
  std::array<Total, 3> totals_;    ///< by direction
  Total* total_ = totals_.data();  ///< of the present interval
  double force_scale_ = 0.0;
  bool follows_at_once_ = false;  ///< the interval before took no time
  double instant_scale_ = 0.0;    ///< largest force scale of all intervals that meet at this instant
  core::ModeFunction motion_;
  std::vector<core::Guard> guards_;
  std::vector<Watch> watches_;
  std::size_t guard_count_ = 0;
  std::vector<friction::Affine> law_guards_;   ///< of all laws
  std::vector<std::size_t> law_guard_counts_;  ///< of each law
  core::Crossing crossing_;
  long long_work_ = 0;  ///< of modes with more terms than a unit has, in addition to one unit a panel
  std::optional<std::size_t> changed_law_;  ///< whose guard ended the interval before

  Sensitivity sensitivity_;
  std::vector<double> units_of_perturbations_;
  std::vector<friction::Memory> memories_before_;  ///< at the start of the interval, while tracking
  std::vector<Eigen::Vector2d> responses_;
  std::unique_ptr<ExactInterval> interval_;
};

}  // namespace dualdamp::sim
