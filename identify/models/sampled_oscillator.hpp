#pragma once
/// The motion of  m x'' + c x' + k x + F0 sgn x' = k y(t) + f(t)  where y and f are known by samples, and its
/// derivatives with respect to the parameters and the initial state.
///
/// Between samples y and f are polynomials (drive_polynomials.hpp). Under a polynomial the motion is a Taylor
/// series that converges. It is summed to double precision: nothing is integrated in steps. Reversals, stops and
/// releases are roots of that series. The exact engine (`sim/`) is not used here, because it takes harmonic drives
/// and ramps alone, and a measured base motion is neither.
///
/// A drive that steps between two samples (drive_steps.hpp) is that of the samples before up to its place, and that
/// of the samples after from there on. The place is a parameter: there the acceleration of a mass that slides jumps
/// from a- to a+, and S_v by a- - a+.
///
/// Further forces, smooth within an interval, are approximated by polynomials along the motion. Force and motion
/// are computed in three rounds.
///
/// A contact may yield by the distance d before it slides (jenkins1962): its force F0 z/d, |z| <= d, takes the
/// place of F0 sgn x'. While it holds, z moves with x; while it slides, z is d sgn x'. Its force has no jump.
///
/// Derivatives S = dx/dp obey  m S'' + c S' + k S = terms of dm, dc, dk, dF0  within an interval. At v = 0 the
/// acceleration jumps from a- to a+, and S_x+ = S_x-, S_v+ = S_v- a+/a- (filippov1988, leine2004); at a stop S_v =
/// 0.
///
/// Errors: two reversals within a quarter of a sample interval may be missed. Cost: about 0.2 us a
/// sample; 0.05 us more for each derivative by a parameter, and 0.15 us for each by a further force.

#include <Eigen/Core>
#include <array>
#include <functional>
#include <vector>

#include "identify/models/drive_polynomials.hpp"
#include "identify/record.hpp"

namespace dualdamp::identify {

class SampledOscillator {
 public:
  static constexpr int nodes = DrivePolynomials::nodes;
  struct Parameters {
    double m = 1.0;   ///< kg, > 0
    double c = 0.0;   ///< N.s/m
    double k = 1.0;   ///< N/m, >= 0
    double F0 = 0.0;  ///< N, >= 0
    double x0 = 0.0;  ///< m
    double v0 = 0.0;  ///< m/s
    /// Coefficients of the `forces` of `run`; empty: all zero.
    std::vector<double> further = {};
    double yield = 0.0;  ///< of the contact before it slides [m]; 0: it is rigid
    /// Where in its interval each step of the drive is, from 0 to 1; empty: in the middle.
    std::vector<double> places = {};
  };
  /// State of the motion that a further force depends on.
  struct Instant {
    double x = 0.0;          ///< m
    double v = 0.0;          ///< m/s
    double direction = 0.0;  ///< of sliding, 1 or -1
    double y = 0.0;          ///< m
    double drive = 0.0;      ///< k y + f [N]
    double path = 0.0;       ///< distance since the last reversal [m]; very large before the first
    double course = 0.0;     ///< share of the history that is over
  };
  /// A force on the mass, positive against its positive direction; smooth except at reversals; in any unit.
  using Force = std::function<double(const Instant&)>;
  /// What the motion is differentiated by; `yield` only where it is not zero; the first `place` is that of the
  /// first step. For internal use: `force`, a further force, and `constant`, a force of 1 N.
  enum class By { mass, damping, stiffness, friction, position, velocity, place, yield, force, constant };

  /// From one sample to the next: how a small disturbance of (x, v) changes, and the effect of a force of 1 N.
  struct Step {
    Eigen::Matrix2d carried;
    Eigen::Vector2d pushed;
  };
  /// Derivatives of the motion at the samples, by the parameters and by time.
  struct Derivatives {
    bool with_steps = false;  ///< fill `steps`; this costs as much as three parameters
    Eigen::MatrixXd x = {};   ///< a row for each sample, a column for each of `by` and then of `forces`
    Eigen::MatrixXd v = {};
    std::vector<Step> steps = {};  ///< to each sample from the one before; the first means nothing
    Eigen::VectorXd a = {};        ///< the acceleration, to rounding
  };

  /// The drive of a history: y and force, each zero when it was not measured. At least eight samples.
  explicit SampledOscillator(const History& history);
  /// The same with steps in these intervals, those of a like drive.
  SampledOscillator(const History& history, std::vector<std::size_t> steps);

  [[nodiscard]] const std::vector<std::size_t>& steps() const { return steps_; }  ///< intervals with a step

  /// x at the samples. `derivatives`, if not null: those by `by` and `forces`. `v`, if not null: the velocity.
  /// False: the motion is too fast for the sample rate, or a value is not finite.
  bool run(const Parameters& parameters, const std::vector<By>& by, Eigen::VectorXd& x, Derivatives* derivatives,
           Eigen::VectorXd* v = nullptr, const std::vector<Force>& forces = {});

 private:
  static constexpr int side_by_side = 4;  ///< derivatives that are computed together
  static constexpr int most_terms = 28;
  using Drive = DrivePolynomials::Polynomial;
  using Series = std::array<double, most_terms>;

  /// Parameters that the motion is differentiated by, with the derivatives at the present time, v by the sample
  /// interval. The processor computes four side by side: the number of rows is a multiple of four.
  struct Tangents {
    std::vector<By> by;
    std::vector<const Force*> forces;  ///< null but for By::force
    Eigen::ArrayXd x, v;
    Eigen::ArrayXd anchor;    ///< of a contact that yields
    Eigen::ArrayXXd forcing;  ///< its Taylor series [N per unit of the parameter]

    void add(By what, const Force* force = nullptr);
    void start(double per_velocity);
  };

  /// At zero velocity: the pull on the mass, and the largest force that friction can hold [N].
  struct Balance {
    double pull = 0.0;
    double limit = 0.0;
  };
  /// A further force with a coefficient that is not zero.
  struct Acting {
    const Force* force;
    double coefficient;
  };

  bool walk_interval(std::size_t interval);
  void walk(double begin, double end);
  void pass_step(double at);
  [[nodiscard]] double place_of(std::size_t step) const { return p_.places.empty() ? 0.5 : p_.places[step]; }
  double slip(double begin, double end);
  double slip_or_yield(double begin, double end);
  double rest(double begin, double end) const;
  void expand(double begin);
  void expand_motion(const Drive& drive);
  void force_tangent(std::size_t number);
  void force_contact(Eigen::Index row, double factor);
  void move_tangents(double u);
  void linearise();
  void look_along();
  void start_tangents(const std::vector<By>& by, const std::vector<Force>& forces, bool with_steps);
  void store(std::size_t sample, Eigen::VectorXd& x, Derivatives* derivatives, Eigen::VectorXd* v);
  void store_step(std::vector<Step>& steps);
  [[nodiscard]] double acceleration(std::size_t sample) const;
  [[nodiscard]] Drive push(const Force& force) const;
  void move_to(double u);
  void settle(double at);
  [[nodiscard]] Balance balance(double at) const;
  /// Share of the history that is over at a time within the present interval.
  [[nodiscard]] double course(double at) const;
  [[nodiscard]] Instant instant(double u) const;
  [[nodiscard]] double first_reversal(double length) const;
  /// Time at which a contact that holds begins to slide; negative: it does not.
  [[nodiscard]] double first_slide(double length) const;
  void start_contact();
  void hold(double stretch);
  void let_slide(int direction);
  [[nodiscard]] bool yields() const { return p_.yield > 0.0; }
  /// Force of friction on the mass at this position [N].
  [[nodiscard]] double friction_at(double x) const {
    return holds_ ? contact_ * (x - anchor_) : p_.F0 * direction_;
  }

  std::size_t count_;
  double rate_;
  std::vector<std::size_t> steps_;
  DrivePolynomials y_, force_;

  Parameters p_;
  double inertia_ = 0.0;  ///< m, and below c, with the sample interval as unit of time
  double damping_ = 0.0;
  Series integration_{};  ///< factor from a coefficient of the force to the coefficient of x two powers higher
  int terms_ = 0;
  std::size_t interval_ = 0;
  std::size_t next_step_ = 0;  ///< the first of `steps_` that is not passed
  int direction_ = 0;
  double x_ = 0.0;
  double v_ = 0.0;  ///< m per sample interval
  double fastest_ = 0.0;
  double reversal_ = 0.0;  ///< position of the last one [m]
  bool holds_ = false;     ///< a contact that yields, and has not yielded so far that it slides
  double contact_ = 0.0;   ///< its stiffness while it holds [N/m]; else 0
  double anchor_ = 0.0;    ///< position at which it has no force [m]
  double begin_ = 0.0;     ///< of the expansion, within the interval
  Drive y_piece_{};        ///< y in the present interval, up to a step or from it on
  Drive drive_{};          ///< the drive there
  Drive y_here_{};
  Drive drive_here_{};
  Series series_{};
  std::array<Instant, nodes> along_{};  ///< the motion of that series at the points where forces are evaluated
  std::vector<Acting> acting_;
  double local_stiffness_ = 0.0;  ///< with the slopes of the acting forces; unit of time as for damping_
  double local_damping_ = 0.0;
  Tangents tangents_;
};

}  // namespace dualdamp::identify
