#pragma once
/// Packs: one number of each of `width` oscillators, side by side in a vector register.
///
/// The templates of this folder use only +, -, *, /, sqrt, comparisons and the pack's own exp, sincos and atan2,
/// which give the same bits for every width. So a lane's result depends on that lane alone, not on the width or on
/// its neighbours. These templates must not call an inline library function: the linker keeps one copy of it, which
/// may be compiled for another processor.

#include <concepts>

namespace dualdamp::sim::batch {

/// What a pack provides. `Vector` is double or a vector of doubles, `Mask` the type of its comparisons.
template <class P>
concept Pack = requires(typename P::Vector v, typename P::Mask mask, const double* from, double* to) {
  { P::width } -> std::convertible_to<int>;
  { P::any(mask) } -> std::same_as<bool>;
  P::choose(mask, v, v);
  P::load(from);
  P::store(v, to);
  P::sqrt(v);
  P::exp(v);
  P::sincos(v, v, v);
  P::atan2(v, v);
};

template <Pack P>
typename P::Vector splat(double value) {
  return typename P::Vector{} + value;
}

template <Pack P>
typename P::Vector abs(typename P::Vector v) {
  return P::choose(v < 0.0, -v, v);
}

template <Pack P>
typename P::Vector larger(typename P::Vector a, typename P::Vector b) {
  return P::choose(a > b, a, b);
}

/// 1 where true, else 0.
template <Pack P>
typename P::Vector flag(typename P::Mask mask) {
  return P::choose(mask, splat<P>(1.0), splat<P>(0.0));
}

/// A complex number in each lane.
template <Pack P>
struct ComplexPack {
  using Vector = typename P::Vector;
  Vector re;
  Vector im;

  [[nodiscard]] Vector norm() const { return re * re + im * im; }

  friend ComplexPack operator*(const ComplexPack& a, const ComplexPack& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend ComplexPack operator/(const ComplexPack& a, const ComplexPack& b) {
    const Vector scale = 1.0 / b.norm();
    return {(a.re * b.re + a.im * b.im) * scale, (a.im * b.re - a.re * b.im) * scale};
  }
};

/// Replaces the lanes of `target` for which `mask` is true.
template <Pack P>
void update(typename P::Vector& target, typename P::Mask mask, typename P::Vector value) {
  target = P::choose(mask, value, target);
}
template <Pack P>
void update(ComplexPack<P>& target, typename P::Mask mask, const ComplexPack<P>& value) {
  update<P>(target.re, mask, value.re);
  update<P>(target.im, mask, value.im);
}

/// exp(-decay + i angle)
template <Pack P>
ComplexPack<P> exponential(typename P::Vector decay, typename P::Vector angle) {
  typename P::Vector sine;
  typename P::Vector cosine;
  P::sincos(angle, sine, cosine);
  const typename P::Vector size = P::exp(-decay);
  return {size * cosine, size * sine};
}

/// exp(i angle)
template <Pack P>
ComplexPack<P> rotation(typename P::Vector angle) {
  ComplexPack<P> result;
  P::sincos(angle, result.im, result.re);
  return result;
}

}  // namespace dualdamp::sim::batch
