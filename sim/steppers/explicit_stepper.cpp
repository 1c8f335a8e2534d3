#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

// GCC 12 does not see that Odeint's resizers initialise the states, and warns inside system headers too.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <boost/fusion/container/generation/make_vector.hpp>
#include <boost/numeric/odeint/stepper/explicit_generic_rk.hpp>

#include "sim/steppers/dop853.hpp"
#include "sim/steppers/sized_stepper.hpp"

namespace dualdamp::sim {
namespace {

namespace odeint = boost::numeric::odeint;

/// The method for states of N components, or of any number.
template <std::size_t N>
class Dop853 final : public Stepper {
 public:
  static constexpr int estimate_order = 7;

  explicit Dop853(std::size_t n) : method_(make_method(std::make_index_sequence<dop853::stages - 1>{})) {
    for (Step& step : steps_) step.resize(n);
    resize(last_stage_, n);
    resize(end_, n);
  }

  [[nodiscard]] bool step(const VectorField& field, std::span<const double> x, double t, double h,
                          std::span<const double> allowed, std::span<double> end,
                          std::span<double> error) override {
    Step& step = steps_[1 - last_];
    std::ranges::copy(x, step.start.begin());
    field.evaluate(x, t, step.rates[0]);
    ObservedField observed{field, step.rates, last_stage_};
    method_.do_step(std::ref(observed), step.start, step.rates[0], t, end_, h);
    field.evaluate(end_, t + h, step.rates[dop853::stages]);
    std::ranges::copy(end_, end.begin());
    estimate(step, h, allowed, error);
    if (!all_finite(end) || !all_finite(error)) return false;
    stiffness_ = h * fastest_rate(step, allowed);
    compute_dense_output(field, step, t, h);
    last_ = 1 - last_;
    return true;
  }

  void at(double part, std::span<double> x) const override {
    const Step& step = steps_[last_];
    const double rest = 1.0 - part;
    for (std::size_t k = 0; k < x.size(); ++k) {
      double sum = 0.0;
      for (std::size_t i = coefficients; i-- > 0;) sum = (i % 2 == 0 ? part : rest) * (step.inside[i][k] + sum);
      x[k] = part == 1.0 ? step.end[k] : step.start[k] + sum;
    }
  }

  [[nodiscard]] int order() const override { return estimate_order; }
  [[nodiscard]] double stiffness() const override { return stiffness_; }

 private:
  using State = std::conditional_t<N == any_size, std::vector<double>, std::array<double, N>>;
  using Method = odeint::explicit_generic_rk<dop853::stages, 8, State>;
  static constexpr std::size_t coefficients = 7;  ///< of the dense output

  static void resize(State& state, std::size_t n) {
    if constexpr (N == any_size) state.resize(n);
  }

  /// A step with the data for its dense output.
  struct Step {
    State start;
    State end;
    std::array<State, dop853::all_stages> rates;
    std::array<State, coefficients> inside;

    void resize(std::size_t n) {
      Dop853::resize(start, n);
      Dop853::resize(end, n);
      for (State& state : rates) Dop853::resize(state, n);
      for (State& state : inside) Dop853::resize(state, n);
    }
  };

  /// Passes Odeint's calls on to the field, and keeps the rates of all stages and the state of the last stage,
  /// which Odeint does not give out.
  struct ObservedField {
    const VectorField& field;
    std::array<State, dop853::all_stages>& rates;
    State& last_stage;
    std::size_t stage = 0;

    void operator()(const State& x, State& out, double t) {
      field.evaluate(x, t, out);
      rates[++stage] = out;
      if (stage + 1 == dop853::stages) last_stage = x;
    }
  };

  /// The first n coefficients of a row, as Odeint takes them.
  template <std::size_t n>
  static boost::array<double, n> leading(const dop853::Row& row) {
    boost::array<double, n> part{};
    std::copy_n(row.begin(), n, part.begin());
    return part;
  }
  template <std::size_t... i>
  static Method make_method(std::index_sequence<i...>) {
    return Method(boost::fusion::make_vector(leading<i + 1>(dop853::weights[i + 1])...),
                  leading<dop853::stages>(dop853::weights[dop853::stages]), leading<dop853::stages>(dop853::nodes));
  }

  [[nodiscard]] static bool all_finite(std::span<const double> values) {
    return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
  }

  /// sum_j weights_j rates_j, component k.
  [[nodiscard]] static double combine(const dop853::Row& weights, const Step& step, std::size_t k) {
    double sum = 0.0;
    for (std::size_t j = 0; j < dop853::all_stages; ++j) sum += weights[j] * step.rates[j][k];
    return sum;
  }

  /// The estimate of order 5, corrected by that of order 3: |e5|^2/sqrt(|e5|^2 + |e3|^2/100) (hairer1993, II.10).
  static void estimate(const Step& step, double h, std::span<const double> allowed, std::span<double> error) {
    double fifth = 0.0;
    double third = 0.0;
    for (std::size_t k = 0; k < error.size(); ++k) {
      double e5 = 0.0;
      double e3 = -dop853::third_0 * step.rates[0][k] - dop853::third_8 * step.rates[8][k] -
                  dop853::third_11 * step.rates[11][k];
      for (std::size_t j = 0; j < dop853::stages; ++j) {
        e5 += dop853::fifth[j] * step.rates[j][k];
        e3 += dop853::weights[dop853::stages][j] * step.rates[j][k];
      }
      error[k] = h * e5;
      fifth += (e5 / allowed[k]) * (e5 / allowed[k]);
      third += (e3 / allowed[k]) * (e3 / allowed[k]);
    }
    const double both = fifth + 0.01 * third;
    const double part = both > 0.0 ? std::sqrt(fifth / both) : 0.0;
    for (double& e : error) e *= part;
  }

  /// |f(end) - f(last stage)| / |end - last stage| [1/s]. Both states belong to the end of the step and differ
  /// mostly in the fastest motion (hairer1996, IV.2).
  [[nodiscard]] double fastest_rate(const Step& step, std::span<const double> allowed) const {
    double rates = 0.0;
    double states = 0.0;
    for (std::size_t k = 0; k < allowed.size(); ++k) {
      const double rate = (step.rates[dop853::stages][k] - step.rates[dop853::stages - 1][k]) / allowed[k];
      const double state = (end_[k] - last_stage_[k]) / allowed[k];
      rates += rate * rate;
      states += state * state;
    }
    return states > 0.0 ? std::sqrt(rates / states) : 0.0;
  }

  /// x(part) = start + part (c0 + (1 - part) (c1 + part (c2 + (1 - part) (c3 + ...)))).
  void compute_dense_output(const VectorField& field, Step& step, double t, double h) {
    step.end = end_;
    State& state = last_stage_;
    for (std::size_t i = dop853::stages + 1; i < dop853::all_stages; ++i) {
      for (std::size_t k = 0; k < state.size(); ++k) {
        double sum = 0.0;
        for (std::size_t j = 0; j < i; ++j) sum += dop853::weights[i][j] * step.rates[j][k];
        state[k] = step.start[k] + h * sum;
      }
      field.evaluate(state, t + dop853::nodes[i] * h, step.rates[i]);
    }
    for (std::size_t k = 0; k < state.size(); ++k) {
      const double change = step.end[k] - step.start[k];
      const double first = h * step.rates[0][k];
      step.inside[0][k] = change;
      step.inside[1][k] = first - change;
      step.inside[2][k] = 2.0 * change - h * step.rates[dop853::stages][k] - first;
      for (std::size_t i = 3; i < coefficients; ++i)
        step.inside[i][k] = h * combine(dop853::inside[i - 3], step, k);
    }
  }

  Method method_;
  std::array<Step, 2> steps_;
  std::size_t last_ = 0;
  State last_stage_{};
  State end_{};
  double stiffness_ = 0.0;
};

}  // namespace

std::unique_ptr<Stepper> make_explicit_stepper() { return std::make_unique<SizedStepper<Dop853>>(); }

}  // namespace dualdamp::sim
