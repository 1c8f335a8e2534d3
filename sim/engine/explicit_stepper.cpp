#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

// GCC 12 loses track of what Odeint's resizers initialise, and warns inside system headers too.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>

#include "sim/engine/stepper.hpp"

namespace dualdamp::sim {
namespace {

using State = std::vector<double>;

bool all_finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
}

/// Passes Odeint's calls on to the field, and keeps the sixth stage, which Odeint does not show.
struct ObservedField {
  const VectorField& field;
  State& stage;
  State& stage_rates;
  int calls = 0;

  void operator()(std::span<const double> x, std::span<double> rates, double t) {
    constexpr int sixth_stage = 4;  // the first stage is evaluated before the step
    field.evaluate(x, t, rates);
    if (calls++ != sixth_stage) return;
    std::ranges::copy(x, stage.begin());
    std::ranges::copy(rates, stage_rates.begin());
  }
};

/// A step with all that its dense output needs.
struct Step {
  boost::numeric::odeint::runge_kutta_dopri5<State> method;
  State start;
  State start_rates;
  State end_rates;
  double t = 0.0;
  double h = 0.0;

  void resize(std::size_t size) {
    for (State* state : {&start, &start_rates, &end_rates}) state->resize(size);
    method.adjust_size(start);
  }
};

class ExplicitStepper final : public Stepper {
 public:
  [[nodiscard]] bool step(const VectorField& field, std::span<const double> x, double t, double h,
                          std::span<const double> allowed, std::span<double> end,
                          std::span<double> error) override {
    if (stage_.size() != x.size()) resize(x.size());
    Step& step = steps_[1 - last_];
    step.t = t;
    step.h = h;
    std::ranges::copy(x, step.start.begin());
    field.evaluate(x, t, step.start_rates);
    ObservedField observed{field, stage_, stage_rates_};
    step.method.do_step(std::ref(observed), step.start, step.start_rates, t, end, step.end_rates, h, error);
    if (!all_finite(end) || !all_finite(error)) return false;
    last_ = 1 - last_;
    stiffness_ = h * fastest_rate(end, step.end_rates, allowed);
    return true;
  }

  void at(double part, std::span<double> x) const override {
    const Step& step = steps_[last_];
    // Odeint's formula reads neither end; at part = 1 it repeats the sum that gave the end, bit for bit.
    step.method.calc_state(part * step.h, x, step.start, step.start_rates, 0.0, x, step.end_rates, step.h);
  }

  [[nodiscard]] int order() const override { return 4; }
  [[nodiscard]] double stiffness() const override { return stiffness_; }

 private:
  void resize(std::size_t size) {
    for (Step& step : steps_) step.resize(size);
    stage_.resize(size);
    stage_rates_.resize(size);
  }

  /// |f(end) - f(sixth stage)| / |end - sixth stage| [1/s]: both belong to the end of the step, and what separates
  /// them is mostly the fastest motion (hairer1996, IV.2).
  [[nodiscard]] double fastest_rate(std::span<const double> end, const State& end_rates,
                                    std::span<const double> allowed) const {
    double rates = 0.0;
    double states = 0.0;
    for (std::size_t i = 0; i < end.size(); ++i) {
      const double rate = (end_rates[i] - stage_rates_[i]) / allowed[i];
      const double state = (end[i] - stage_[i]) / allowed[i];
      rates += rate * rate;
      states += state * state;
    }
    return states > 0.0 ? std::sqrt(rates / states) : 0.0;
  }

  std::array<Step, 2> steps_;
  std::size_t last_ = 0;
  State stage_;
  State stage_rates_;
  double stiffness_ = 0.0;
};

}  // namespace

std::unique_ptr<Stepper> make_explicit_stepper() { return std::make_unique<ExplicitStepper>(); }

}  // namespace dualdamp::sim
