#include <immintrin.h>
#include <sleef.h>

#include "sim/batch/pass_periods.hpp"
#include "sim/batch/vector_register.hpp"

namespace dualdamp::sim::batch {
namespace {

/// AVX2 without FMA: a fused product rounds differently.
struct Avx2 : VectorRegister<4> {
  static bool any(Mask mask) {
    return _mm256_movemask_pd(_mm256_castsi256_pd(reinterpret_cast<__m256i>(mask))) != 0;
  }
  static Vector sqrt(Vector v) { return _mm256_sqrt_pd(v); }
  static Vector exp(Vector v) { return Sleef_cinz_expd4_u10avx(v); }
  static Vector atan2(Vector y, Vector x) { return Sleef_cinz_atan2d4_u10avx(y, x); }
  static void sincos(Vector v, Vector& sine, Vector& cosine) { split(Sleef_cinz_sincosd4_u10avx(v), sine, cosine); }
};

}  // namespace

const Kernels avx2_kernels{Avx2::width, find_orbits<Avx2>, pass_periods<Avx2>};

}  // namespace dualdamp::sim::batch
