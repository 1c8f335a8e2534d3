#include <immintrin.h>
#include <sleef.h>

#include "sim/batch/follow.hpp"

namespace dualdamp::sim::batch {
namespace {

/// AVX-512 (F, DQ) without fused multiply-add, whose rounding differs.
struct Avx512 {
  using Vector = double __attribute__((vector_size(64)));
  using Mask = decltype(Vector{} < Vector{});
  static constexpr int width = 8;

  static bool any(Mask mask) { return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask)) != 0; }
  static Vector choose(Mask mask, Vector yes, Vector no) { return mask ? yes : no; }
  static Vector load(const double* from) { return _mm512_loadu_pd(from); }
  static void store(Vector v, double* to) { _mm512_storeu_pd(to, v); }
  // The masked form: GCC 12 warns about its own header in the plain one.
  static Vector sqrt(Vector v) { return _mm512_maskz_sqrt_pd(0xff, v); }
  static Vector exp(Vector v) { return Sleef_cinz_expd8_u10avx512fnofma(v); }
  static Vector atan2(Vector y, Vector x) { return Sleef_cinz_atan2d8_u10avx512fnofma(y, x); }
  static void sincos(Vector v, Vector& sine, Vector& cosine) {
    const auto both = Sleef_cinz_sincosd8_u10avx512fnofma(v);
    sine = both.x;
    cosine = both.y;
  }
};

}  // namespace

const Kernels avx512_kernels{Avx512::width, find_orbits<Avx512>, follow<Avx512>};

}  // namespace dualdamp::sim::batch
