#include <immintrin.h>
#include <sleef.h>

#include "sim/batch/follow.hpp"

namespace dualdamp::sim::batch {
namespace {

/// SSE2, part of every x86-64.
struct Sse2 {
  using Vector = double __attribute__((vector_size(16)));
  using Mask = decltype(Vector{} < Vector{});
  static constexpr int width = 2;

  static bool any(Mask mask) { return _mm_movemask_pd(_mm_castsi128_pd(reinterpret_cast<__m128i>(mask))) != 0; }
  static Vector choose(Mask mask, Vector yes, Vector no) { return mask ? yes : no; }
  static Vector load(const double* from) { return _mm_loadu_pd(from); }
  static void store(Vector v, double* to) { _mm_storeu_pd(to, v); }
  static Vector sqrt(Vector v) { return _mm_sqrt_pd(v); }
  static Vector exp(Vector v) { return Sleef_cinz_expd2_u10sse2(v); }
  static Vector atan2(Vector y, Vector x) { return Sleef_cinz_atan2d2_u10sse2(y, x); }
  static void sincos(Vector v, Vector& sine, Vector& cosine) {
    const auto both = Sleef_cinz_sincosd2_u10sse2(v);
    sine = both.x;
    cosine = both.y;
  }
};

}  // namespace

const Kernels sse2_kernels{Sse2::width, find_orbits<Sse2>, follow<Sse2>};

}  // namespace dualdamp::sim::batch
