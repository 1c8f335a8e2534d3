#include <immintrin.h>
#include <sleef.h>

#include "sim/batch/pass_periods.hpp"
#include "sim/batch/vector_register.hpp"

namespace dualdamp::sim::batch {
namespace {

/// SSE2, part of every x86-64.
struct Sse2 : VectorRegister<2> {
  static bool any(Mask mask) { return _mm_movemask_pd(_mm_castsi128_pd(reinterpret_cast<__m128i>(mask))) != 0; }
  static Vector sqrt(Vector v) { return _mm_sqrt_pd(v); }
  static Vector exp(Vector v) { return Sleef_cinz_expd2_u10sse2(v); }
  static Vector atan2(Vector y, Vector x) { return Sleef_cinz_atan2d2_u10sse2(y, x); }
  static void sincos(Vector v, Vector& sine, Vector& cosine) {
    split(Sleef_cinz_sincosd2_u10sse2(v), sine, cosine);
  }
};

}  // namespace

const Kernels sse2_kernels{Sse2::width, find_orbits<Sse2>, pass_periods<Sse2>};

}  // namespace dualdamp::sim::batch
