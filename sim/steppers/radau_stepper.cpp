#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>
#include <vector>

#include "sim/steppers/lu_factors.hpp"
#include "sim/steppers/radau_collocation.hpp"
#include "sim/steppers/sized_stepper.hpp"

namespace dualdamp::sim {
namespace {

using Complex = std::complex<double>;
using Vector = std::vector<double>;
using Row = RadauCollocation::Row;
using Matrix = RadauCollocation::Matrix;
constexpr std::size_t pairs = RadauCollocation::pairs;
/// Real matrices that cost as much as the factors of a step: a complex operation is four real ones.
constexpr long real_matrices = 1 + 4 * static_cast<long>(pairs);
constexpr std::size_t middle = radau_stages / 2;
/// The component that is the speed of the mass, on which friction acts (`flow.hpp`).
constexpr std::size_t speed = 1;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// sum_j weights_j values_j
double combine(const Row& weights, const Row& values) {
  double sum = 0.0;
  for (std::size_t j = 0; j < radau_stages; ++j) sum += weights[j] * values[j];
  return sum;
}

/// The method for states of N components, or of any number.
template <std::size_t N>
class RadauStepper final : public Stepper {
 public:
  static constexpr int estimate_order = radau_stages;

  explicit RadauStepper(std::size_t n)
      : n_(extent<N>(n)),
        jacobian_(n * n),
        factored_jacobian_(n * n),
        real_factors_(n),
        pair_factors_(make_pair_factors(n, std::make_index_sequence<pairs>{})) {
    if constexpr (N == any_size) {
      for (State* state : {&start_, &end_, &state_, &slope_, &middle_state_, &middle_rates_, &probed_, &real_})
        state->resize(n);
      for (Stages* stages : {&polynomial_, &z_, &defect_, &correction_, &last_correction_, &last_move_})
        stages->resize(n);
      pair_.resize(n);
    }
  }

  [[nodiscard]] bool step(const VectorField& field, std::span<const double> x, double t, double h,
                          std::span<const double> allowed, std::span<double> end,
                          std::span<double> error) override {
    const bool predicted = predict(t, h);
    if (!(predicted && solve(field, x, t, h, allowed))) {
      if (predicted && skips_other_starts(t)) return false;
      const bool solved = solve_from_other_starts(field, x, t, h, allowed);
      if (predicted) note_other_starts(solved);
      if (!solved) return false;
    }
    if (!estimate(field, x, t, h, error)) return false;
    for (std::size_t k = 0; k < n_(); ++k) end[k] = x[k] + z_[k].back();
    std::ranges::copy(x, start_.begin());
    std::ranges::copy(end, end_.begin());
    std::swap(polynomial_, z_);
    t_ = t;
    h_ = h;
    return true;
  }

  void at(double part, std::span<double> x) const override {
    if (part == 1.0) {
      std::ranges::copy(end_, x.begin());
      return;
    }
    const Row basis = radau_.basis(part);
    for (std::size_t k = 0; k < n_(); ++k) x[k] = start_[k] + combine(basis, polynomial_[k]);
  }

  [[nodiscard]] bool end_rates(std::span<double> rates) const override {
    for (std::size_t k = 0; k < n_(); ++k) rates[k] = combine(radau_.slopes.back(), polynomial_[k]) / h_;
    return true;
  }

  [[nodiscard]] int order() const override { return estimate_order; }
  [[nodiscard]] double stiffness() const override { return 0.0; }
  [[nodiscard]] long operations() const override { return operations_; }

 private:
  using State = std::conditional_t<N == any_size, Vector, std::array<double, N>>;
  /// Each component at all stages.
  using Stages = std::conditional_t<N == any_size, std::vector<Row>, std::array<Row, N>>;

  template <std::size_t... k>
  static std::array<LuFactors<Complex, N>, pairs> make_pair_factors(std::size_t n, std::index_sequence<k...>) {
    return {((void)k, LuFactors<Complex, N>(n))...};
  }

  /// A step that is too long for its prediction is mostly too long for the other starts as well; only creeps that
  /// friction holds are solved from these. So after each time that they failed too they are left out for up to
  /// seven failures, but not for a second one from the same time.
  bool skips_other_starts(double t) {
    if (skips_ == 0 || t == skipped_t_) return false;
    --skips_;
    skipped_t_ = t;
    return true;
  }

  void note_other_starts(bool solved) {
    constexpr int most_skips = 7;
    patience_ = solved ? 0 : std::min(2 * patience_ + 1, most_skips);
    skips_ = patience_;
  }

  bool solve_from_other_starts(const VectorField& field, std::span<const double> x, double t, double h,
                               std::span<const double> allowed) {
    std::ranges::fill(z_, Row{});
    if (solve(field, x, t, h, allowed)) return true;
    begin_straight(field, x, t, h);
    return solve(field, x, t, h, allowed);
  }

  /// Predicts z from the last step's polynomial, also beyond its end; false if this step is not close enough to it.
  bool predict(double t, double h) {
    constexpr double farthest = 4.0;
    constexpr double latest = 1.0 + 1e-6;  // times are rounded: the next step may seem to begin after the last one
    const double from = (t - t_) / h_;
    const double length = h / h_;
    if (!(from >= 0.0 && from <= latest && length > 0.0 && from + length <= farthest)) return false;
    const Row here = radau_.basis(from);
    for (std::size_t i = 0; i < radau_stages; ++i) {
      Row basis = radau_.basis(from + length * radau_.nodes[i]);
      for (std::size_t j = 0; j < radau_stages; ++j) basis[j] -= here[j];
      for (std::size_t k = 0; k < n_(); ++k) z_[k][i] = combine(basis, polynomial_[k]);
    }
    return true;
  }

  /// Predicts z from the rates at the start: this leaves a speed at which alone friction is steep.
  void begin_straight(const VectorField& field, std::span<const double> x, double t, double h) {
    field.evaluate(x, t, slope_);
    for (std::size_t k = 0; k < n_(); ++k)
      for (std::size_t i = 0; i < radau_stages; ++i) z_[k][i] = radau_.nodes[i] * h * slope_[k];
  }

  /// Newton's method on z with a Jacobian in the middle of the step, where z puts it. If z moves far from there,
  /// the iteration is repeated with a new Jacobian: it could otherwise seem to converge with a force that is steep
  /// at one speed alone.
  bool solve(const VectorField& field, std::span<const double> x, double t, double h,
             std::span<const double> allowed) {
    constexpr int most_jacobians = 20;
    factorise(field, x, t, h, 0.01);
    for (int i = 0; i < most_jacobians; ++i) {
      const Pace pace = iterate(field, x, t, h, allowed);
      if (pace == Pace::lost) return false;
      const bool is_stale = has_moved_on(x) && factorise(field, x, t, h, 0.5);
      if (!is_stale) return pace == Pace::converged && !is_held_falsely(field, x, t, h, allowed);
    }
    return false;
  }

  /// If friction changes its sign at one speed alone, a correction below `allowed` may leave a force that moves the
  /// mass. The iteration has then stopped although no speed within `allowed` of z satisfies the equation.
  [[nodiscard]] bool is_held_falsely(const VectorField& field, std::span<const double> x, double t, double h,
                                     std::span<const double> allowed) {
    constexpr double round_off = 64.0 * epsilon;
    if (n_() <= speed) return false;
    for (std::size_t i = 0; i < radau_stages; ++i) {
      if (!(h * std::abs(speed_defect_[i]) > allowed[speed])) continue;
      set_state_at_stage(x, i);
      const double slope = combine(radau_.slopes[i], z_[speed]) / h;
      const double here = state_[speed];
      const double known = std::max(allowed[speed], round_off * (std::abs(x[speed]) + std::abs(here)));
      const auto defect_at = [&](double there) {
        state_[speed] = there;
        field.evaluate(state_, t + radau_.nodes[i] * h, probed_);
        return probed_[speed] - slope;
      };
      const double above = defect_at(here + known);
      const double below = defect_at(here - known);
      if (above * below > 0.0 && h * std::min(std::abs(above), std::abs(below)) > known) return true;
    }
    return false;
  }

  enum class Pace { converged, slow, lost };

  /// Newton's iteration with the present factors.
  Pace iterate(const VectorField& field, std::span<const double> x, double t, double h,
               std::span<const double> allowed) {
    constexpr int most_iterations = 20;
    double before = 0.0;
    double earlier = 0.0;  // contraction
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
      correct(field, x, t, h, iteration == 0);
      const double size = correction_size(x, allowed);
      move(allowed, iteration == 0);
      if (!std::isfinite(size)) return Pace::lost;
      if (iteration == 0 && size <= 1.0) return Pace::converged;
      if (iteration > 0) {
        const double contraction = size / before;
        if (contraction >= 1.0) return size <= 1.0 ? Pace::converged : Pace::lost;
        // At this rate it will not converge in time. A quick iteration may go on: its rate is below 0.1.
        if (contraction > 0.1 && size * std::pow(contraction, most_iterations - 1 - iteration) > 1.0)
          return Pace::slow;
        // A correction that acceleration made small may be followed by one that it does not.
        const double surely = std::max(contraction, earlier);
        if (size * std::min(1.0, surely / (1.0 - surely)) <= 1.0) return Pace::converged;
        earlier = contraction;
      }
      before = size;
    }
    return Pace::slow;
  }

  /// Adds the correction to z. From the second iteration on, of all combinations of the last two iterates that one
  /// whose correction is smallest (Anderson's acceleration, walker2011): where the Jacobian changes by tens of per
  /// cent within the step, most of the error that an iteration leaves is along the last correction.
  void move(std::span<const double> allowed, bool is_first) {
    const double share = is_first ? 0.0 : share_of_last(allowed);
    for (std::size_t k = 0; k < n_(); ++k) {
      for (std::size_t i = 0; i < radau_stages; ++i) {
        const double correction = correction_[k][i];
        double moved = correction;
        if (share != 0.0) moved -= share * (last_move_[k][i] + correction - last_correction_[k][i]);
        last_correction_[k][i] = correction;
        last_move_[k][i] = moved;
        z_[k][i] += moved;
      }
    }
  }

  /// The share of the last iterate in that combination. 0 if more than as much again would have to be added.
  [[nodiscard]] double share_of_last(std::span<const double> allowed) const {
    double product = 0.0;
    double square = 0.0;
    for (std::size_t k = 0; k < n_(); ++k) {
      const double unit = 1.0 / allowed[k];
      for (std::size_t i = 0; i < radau_stages; ++i) {
        const double correction = unit * correction_[k][i];
        const double change = unit * (correction_[k][i] - last_correction_[k][i]);
        product += change * correction;
        square += change * change;
      }
    }
    const double share = product / square;
    return std::abs(share) < 1.0 ? share : 0.0;
  }

  /// Whether the middle of the step is far from the state at which the Jacobian was taken, relative to that state.
  [[nodiscard]] bool has_moved_on(std::span<const double> x) const {
    for (std::size_t k = 0; k < n_(); ++k) {
      const double now = x[k] + z_[k][middle];
      if (std::abs(now - middle_state_[k]) > 0.5 * std::abs(middle_state_[k])) return true;
    }
    return false;
  }

  /// Computes the Jacobian and its factors. False: each entry is within `closeness` (relative) of the Jacobian
  /// whose factors are kept.
  bool factorise(const VectorField& field, std::span<const double> x, double t, double h, double closeness) {
    for (std::size_t k = 0; k < n_(); ++k) middle_state_[k] = x[k] + z_[k][middle];
    field.linearize(middle_state_, t + radau_.nodes[middle] * h, middle_rates_, jacobian_);
    const auto close = [&](double a, double b) { return std::abs(a - b) <= closeness * std::abs(b); };
    if (h == factored_h_ && std::ranges::equal(jacobian_, factored_jacobian_, close)) return false;
    factored_h_ = h;
    operations_ += real_matrices * static_cast<long>(n_() * n_() * n_()) / 3;
    std::swap(factored_jacobian_, jacobian_);
    real_factors_.compute(radau_.real_eigenvalue / h, factored_jacobian_);
    for (std::size_t p = 0; p < pairs; ++p) pair_factors_[p].compute(radau_.eigenvalues[p] / h, factored_jacobian_);
    return true;
  }

  /// The correction of one iteration; z is as it was for the Jacobian in the first one.
  void correct(const VectorField& field, std::span<const double> x, double t, double h, bool is_first) {
    operations_ += real_matrices * static_cast<long>(n_() * n_());
    for (std::size_t i = 0; i < radau_stages; ++i) {
      const bool is_known = is_first && i == middle;
      if (!is_known) {
        set_state_at_stage(x, i);
        field.evaluate(state_, t + radau_.nodes[i] * h, slope_);
      }
      const State& slope = is_known ? middle_rates_ : slope_;
      for (std::size_t k = 0; k < n_(); ++k) defect_[k][i] = slope[k];
    }
    const double rate = 1.0 / h;
    for (std::size_t k = 0; k < n_(); ++k)
      for (std::size_t i = 0; i < radau_stages; ++i) defect_[k][i] -= rate * combine(radau_.slopes[i], z_[k]);
    if (n_() > speed) speed_defect_ = defect_[speed];
    transform(radau_.from_stages, defect_);
    solve_parts();
    transform(radau_.to_stages, correction_);
  }

  /// The state at stage i.
  void set_state_at_stage(std::span<const double> x, std::size_t i) {
    for (std::size_t k = 0; k < n_(); ++k) state_[k] = x[k] + z_[k][i];
  }

  /// correction_ = matrix times `from`, which may be correction_ itself.
  void transform(const Matrix& matrix, const Stages& from) {
    for (std::size_t k = 0; k < n_(); ++k) {
      const Row values = from[k];
      for (std::size_t i = 0; i < radau_stages; ++i) correction_[k][i] = combine(matrix[i], values);
    }
  }

  /// Replaces the transformed defects by the solutions.
  void solve_parts() {
    for (std::size_t k = 0; k < n_(); ++k) real_[k] = correction_[k][0];
    real_factors_.solve(real_.data());
    for (std::size_t k = 0; k < n_(); ++k) correction_[k][0] = real_[k];
    for (std::size_t p = 0; p < pairs; ++p) {
      const std::size_t first = 1 + 2 * p;
      for (std::size_t k = 0; k < n_(); ++k) pair_[k] = {correction_[k][first], correction_[k][first + 1]};
      pair_factors_[p].solve(pair_.data());
      for (std::size_t k = 0; k < n_(); ++k) {
        correction_[k][first] = pair_[k].real();
        correction_[k][first + 1] = pair_[k].imag();
      }
    }
  }

  /// The largest component of the correction in units of its tolerance: a thousandth of `allowed`, or round-off.
  /// Not finite if a component is not, which std::max would pass over.
  [[nodiscard]] double correction_size(std::span<const double> x, std::span<const double> allowed) const {
    double size = 0.0;
    double sum = 0.0;
    for (std::size_t k = 0; k < n_(); ++k) {
      double change = 0.0;
      double reach = 0.0;
      for (std::size_t i = 0; i < radau_stages; ++i) {
        const double correction = std::abs(correction_[k][i]);
        sum += correction;
        change = std::max(change, correction);
        reach = std::max(reach, std::abs(z_[k][i]));
      }
      const double left = std::max(1e-3 * allowed[k], 16.0 * epsilon * (std::abs(x[k]) + reach));
      size = std::max(size, change / left);
    }
    return std::isfinite(sum) ? size : sum;
  }

  /// The defect of the polynomial at the start of the step, f(x, t) - u'(0)/h, times (gamma/h - J)^-1, which damps
  /// a fast component as the step does (hairer1996, IV.8).
  bool estimate(const VectorField& field, std::span<const double> x, double t, double h, std::span<double> error) {
    field.evaluate(x, t, error);
    for (std::size_t k = 0; k < n_(); ++k) error[k] -= combine(radau_.start_slope, z_[k]) / h;
    real_factors_.solve(error.data());
    return std::ranges::all_of(error, [](double value) { return std::isfinite(value); });
  }

  const RadauCollocation& radau_ = RadauCollocation::once();
  Extent<N> n_;
  // The last successful step.
  double t_ = 0.0;
  double h_ = 0.0;
  State start_{};
  State end_{};
  Stages polynomial_{};
  // Failures of the prediction.
  int patience_ = 0;
  int skips_ = 0;  ///< so many failures without other starts
  double skipped_t_ = std::numeric_limits<double>::quiet_NaN();
  // The iteration.
  Stages z_{};
  Stages defect_{};  ///< f - u'
  Stages correction_{};
  Stages last_correction_{};
  Stages last_move_{};  ///< what the last iteration added to z
  State state_{};
  State slope_{};
  State middle_state_{};  ///< where the Jacobian was taken
  State middle_rates_{};
  State probed_{};
  Row speed_defect_{};  ///< at the stages before the last correction
  State real_{};
  std::conditional_t<N == any_size, std::vector<Complex>, std::array<Complex, N>> pair_{};
  double factored_h_ = 0.0;
  Vector jacobian_;
  Vector factored_jacobian_;
  LuFactors<double, N> real_factors_;
  std::array<LuFactors<Complex, N>, pairs> pair_factors_;
  long operations_ = 0;
};

}  // namespace

std::unique_ptr<Stepper> make_implicit_stepper() { return std::make_unique<SizedStepper<RadauStepper>>(); }

}  // namespace dualdamp::sim
