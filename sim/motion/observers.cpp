#include "sim/motion/observers.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "sim/engine/closed_form.hpp"

namespace dualdamp::sim {

namespace {

/// A change of the base at one instant by more than this part of its motion is a jump; less is rounding.
constexpr double jump = 1e-12;

/// Calls visit(begin, width) for panels that cover the interval; a polynomial of low degree represents the motion
/// on each of them.
template <class Visit>
void for_panels(const Interval& interval, const Visit& visit) {
  double s = 0.0;
  while (s < interval.duration) {
    const double width = std::min(interval.resolution(s), interval.duration - s);
    visit(s, width);
    s += width;
  }
}

/// Calls visit(s, weight) for the nodes of Gauss and Legendre's rule on a panel.
template <unsigned points, class Visit>
void apply_rule(double begin, double width, const Visit& visit) {
  using Rule = boost::math::quadrature::gauss<double, points>;
  const double half = 0.5 * width;
  for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
    const double offset = half * Rule::abscissa()[i];
    const double weight = half * Rule::weights()[i];
    visit(begin + half + offset, weight);
    if (offset != 0.0) visit(begin + half - offset, weight);
  }
}

/// Calls visit(s, weight) so that sum weight f(s) = int f ds over the interval, where f is a product of two
/// quantities. On a panel as wide as the resolution these are exp(z s) with |z s| <= 1.6. On an eighth of that
/// width the error of five points is 4e-17, on a 128th that of three points is 1.2e-16.
template <class Visit>
void quadrature(const Interval& interval, const Visit& visit) {
  for_panels(interval, [&](double begin, double width) {
    const double resolution = interval.resolution(begin);
    if (128.0 * width <= resolution) {
      apply_rule<3>(begin, width, visit);
    } else if (8.0 * width <= resolution) {
      apply_rule<5>(begin, width, visit);
    } else {
      apply_rule<15>(begin, width, visit);
    }
  });
}

/// The speed is largest where the acceleration changes sign. A panel is divided into this number of cells to
/// bracket such a place.
constexpr int cells = 8;

/// A product would underflow in a small motion.
bool changes_sign(double left, double right) { return (left < 0.0 && right > 0.0) || (left > 0.0 && right < 0.0); }

/// The time between low and high at which the acceleration changes sign, by bisection; `sign` is its sign at low.
double speed_extreme(const Interval& interval, double low, double high, double sign) {
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    ((interval.at(middle).a > 0.0) == (sign > 0.0) ? low : high) = middle;
  }
  return low;
}

/// The largest |v| at sign changes of the acceleration; 0 if there is none.
double largest_inner_speed(const Interval& interval) {
  double largest = 0.0;
  double left = 0.0;
  double left_a = interval.at(0.0).a;
  for_panels(interval, [&](double from, double width) {
    for (int cell = 1; cell <= cells; ++cell) {
      const double right = from + width * cell / cells;
      const double right_a = interval.at(right).a;
      if (changes_sign(left_a, right_a)) {
        const double at = speed_extreme(interval, left, right, left_a);
        largest = std::max(largest, std::abs(interval.at(at).v));
      }
      left = right;
      left_a = right_a;
    }
  });
  return largest;
}

/// |v| at the time between `low` and `high` at which the acceleration vanishes; `left_a` has its sign at `low`. By
/// Newton's method from `s`, kept between both ends. An error of s changes the speed only by its square.
double speed_between(const ClosedForm& form, const core::ModeFunction& jerk, double low, double high, double s,
                     double left_a) {
  const core::ExponentialBasis& basis = *form.basis;
  core::ExponentialBasis::Values values;
  basis.evaluate(s, values);
  for (int i = 0; i < 60; ++i) {
    const double a = core::evaluate(basis, form.a, values);
    ((a > 0.0) == (left_a > 0.0) ? low : high) = s;
    const double newton = -a / core::evaluate(basis, jerk, values);
    const bool last = std::abs(newton) * basis.fastest() < 1e-6;
    const bool inside = s + newton > low && s + newton < high;
    const double step = last || inside ? newton : 0.5 * (low + high) - s;
    s += step;
    if (!basis.shift(step, values)) basis.evaluate(s, values);
    if (last) break;
  }
  return std::abs(core::evaluate(basis, form.v, values));
}

/// Changes E_k(s) to E_k(s + delta); by = E_k(delta).
void turn_by(const core::ExponentialBasis& basis, const core::ExponentialBasis::Values& by,
             core::ExponentialBasis::Values& values) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(basis.size()); ++k) {
    const core::Complex value = core::Complex(values.re[k], values.im[k]) * core::Complex(by.re[k], by.im[k]);
    values.re[k] = value.real();
    values.im[k] = value.imag();
  }
}

/// The same on the closed form. Without chains it goes from cell to cell by one product for each element.
double largest_inner_speed(const Interval& interval, const ClosedForm& form) {
  const core::ExponentialBasis& basis = *form.basis;
  core::ModeFunction jerk;
  core::differentiate(basis, form.a, jerk);
  core::ExponentialBasis::Values here;
  core::ExponentialBasis::Values turn;
  basis.start(here);
  double turned = 0.0;
  double largest = 0.0;
  double left_a = core::at_start(basis, form.a);
  for_panels(interval, [&](double from, double width) {
    const double step = width / cells;
    if (step != turned) basis.evaluate(step, turn);
    turned = step;
    for (int cell = 0; cell < cells; ++cell) {
      if (basis.has_chains()) {
        basis.evaluate(from + step * (cell + 1), here);
      } else {
        turn_by(basis, turn, here);
      }
      const double right_a = core::evaluate(basis, form.a, here);
      if (changes_sign(left_a, right_a)) {
        const double low = from + step * cell;
        const double crossing = low + step * (left_a / (left_a - right_a));
        largest = std::max(largest, speed_between(form, jerk, low, low + step, crossing, left_a));
      }
      left_a = right_a;
    }
  });
  return largest;
}

/// The motion at both ends of an interval.
struct Ends {
  Sample begin;
  Sample end;

  explicit Ends(const Interval& interval) {
    const ClosedForm* form = interval.closed_form();
    if (form == nullptr) {
      begin = interval.at(0.0);
      end = interval.at(interval.duration);
      return;
    }
    const core::ExponentialBasis& basis = *form->basis;
    begin = {.y = core::at_start(basis, form->y),
             .x = core::at_start(basis, form->x),
             .v = core::at_start(basis, form->v)};
    end = {.y = form->at_end(form->y), .x = form->at_end(form->x), .v = form->at_end(form->v)};
  }
};

}  // namespace

double Sampler::next() const {
  const std::size_t taken = samples_.size();
  if (rate_ > 0.0) return static_cast<double>(taken) / rate_;
  return taken < times_.size() ? times_[taken] : std::numeric_limits<double>::infinity();
}

void Sampler::observe(const Interval& interval) {
  for (;;) {
    const double t = next();
    if (t >= interval.end()) return;
    Sample sample = interval.state_at(std::max(t, interval.begin));
    sample.t = t;
    samples_.push_back(sample);
  }
}

void Sampler::finish(const Sample& final) {
  const double t = next();
  const double spacing = rate_ > 0.0 ? 1.0 / rate_ : final.t;
  if (!(std::abs(t - final.t) <= 1e-9 * spacing)) return;
  samples_.push_back(final);
  samples_.back().t = t;
}

void PeakAndTrough::observe(const Interval& interval) {
  const auto [begin, end] = Ends(interval);
  if (!seen_) peak_ = trough_ = begin.x;
  seen_ = true;
  peak_ = std::max({peak_, begin.x, end.x});
  trough_ = std::min({trough_, begin.x, end.x});
  max_speed_ = std::max({max_speed_, std::abs(begin.v), std::abs(end.v)});
  if (interval.direction == friction::Direction::none || interval.duration <= 0.0) return;
  const ClosedForm* form = interval.closed_form();
  const double inside = form == nullptr ? largest_inner_speed(interval) : largest_inner_speed(interval, *form);
  max_speed_ = std::max(max_speed_, inside);
}

double EnergyAudit::stored(const Sample& sample) const {
  const double stretch = sample.y - sample.x;
  return 0.5 * oscillator_.mass * sample.v * sample.v + spring_energy(oscillator_, stretch);
}

void EnergyAudit::observe(const Interval& interval) {
  const auto [begin, end] = Ends(interval);
  if (!started_) {
    first_ = stored(begin);
  } else if (std::abs(begin.y - base_) > jump * reach_) {
    // The work of a jump of the base is the increase of the energy in the spring.
    input_.add(spring_energy(oscillator_, begin.y - begin.x) - spring_energy(oscillator_, base_ - begin.x));
  }
  started_ = true;
  base_ = end.y;
  reach_ = std::max({reach_, std::abs(begin.y), std::abs(end.y)});
  last_ = stored(end);
  if (const ClosedForm* form = interval.closed_form()) {
    add_in_closed_form(*form);
  } else {
    add_by_quadrature(interval);
  }
}

void EnergyAudit::add_by_quadrature(const Interval& interval) {
  const bool damper_moves = oscillator_.damper_to == DamperTo::base;
  quadrature(interval, [&](double at, double weight) {
    const Sample s = interval.at(at);
    const double damper_speed = damper_moves ? s.v - s.y_rate : s.v;
    const double stretch = s.y - s.x;
    const double base_force =
        spring_force(oscillator_, stretch) - (damper_moves ? oscillator_.damping * damper_speed : 0.0);
    input_.add(weight * (base_force * s.y_rate + s.external * s.v));
    friction_.add(weight * s.force * s.v);
    viscous_.add(weight * oscillator_.damping * damper_speed * damper_speed);
    square_speed_.add(weight * s.v * s.v);
  });
}

void EnergyAudit::add_in_closed_form(const ClosedForm& form) {
  const core::ExponentialBasis& basis = *form.basis;
  const bool damper_moves = oscillator_.damper_to == DamperTo::base;
  core::ModeFunction damper_speed;
  core::assign(basis, 1.0, form.v, damper_speed);
  if (damper_moves) core::accumulate(basis, -1.0, form.y_rate, damper_speed);
  core::ModeFunction base_force;
  core::assign(basis, oscillator_.stiffness, form.y, base_force);
  core::accumulate(basis, -oscillator_.stiffness, form.x, base_force);
  if (damper_moves) core::accumulate(basis, -oscillator_.damping, damper_speed, base_force);
  const ClosedIntegrals integrals(form);
  input_.add(integrals.product(base_force, form.y_rate));
  input_.add(integrals.product(form.external, form.v));
  friction_.add(integrals.product(form.force, form.v));
  const double square = integrals.product(damper_speed, damper_speed);
  viscous_.add(oscillator_.damping * square);
  square_speed_.add(damper_moves ? integrals.product(form.v, form.v) : square);
}

Energy EnergyAudit::account() const {
  Energy result{.input = input_.value(), .friction = friction_.value(), .viscous = viscous_.value()};
  result.stored = last_ - first_;
  result.defect = result.input - result.friction - result.viscous - result.stored;
  return result;
}

void Fundamental::observe(const Interval& interval) {
  if (const ClosedForm* form = interval.closed_form()) {
    sum_ += std::polar(1.0, -omega_ * interval.begin) * integral_against_turn(*form, form->x, omega_);
    return;
  }
  const auto add = [&](double s, double weight) {
    sum_ += weight * interval.position(s) * std::polar(1.0, -omega_ * (interval.begin + s));
  };
  // On a panel x is a polynomial of degree 7 at most. Seven points leave an error in the 14th power only, which
  // needs seven terms of the turn: a part 1e-12 of the last term of x.
  constexpr double short_turn = 0.5;
  if (omega_ * interval.duration <= short_turn && interval.resolution(0.0) >= interval.duration)
    apply_rule<7>(0.0, interval.duration, add);
  else
    quadrature(interval, add);
}

std::complex<double> Fundamental::coefficient() const { return sum_ * (omega_ / std::numbers::pi); }

}  // namespace dualdamp::sim
