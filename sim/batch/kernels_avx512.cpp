#include <immintrin.h>
#include <sleef.h>

#include "sim/batch/pass_periods.hpp"
#include "sim/batch/vector_register.hpp"

namespace dualdamp::sim::batch {
namespace {

/// AVX-512 (F, DQ) without fused multiply-add, which rounds differently.
struct Avx512 : VectorRegister<8> {
  static bool any(Mask mask) { return _mm512_movepi64_mask(reinterpret_cast<__m512i>(mask)) != 0; }
  // The masked form, because GCC 12 warns about its own header in the plain form.
  static Vector sqrt(Vector v) { return _mm512_maskz_sqrt_pd(0xff, v); }
  static Vector exp(Vector v) { return Sleef_cinz_expd8_u10avx512fnofma(v); }
  static Vector atan2(Vector y, Vector x) { return Sleef_cinz_atan2d8_u10avx512fnofma(y, x); }
  static void sincos(Vector v, Vector& sine, Vector& cosine) {
    split(Sleef_cinz_sincosd8_u10avx512fnofma(v), sine, cosine);
  }
};

}  // namespace

const Kernels avx512_kernels{Avx512::width, find_orbits<Avx512>, pass_periods<Avx512>};

}  // namespace dualdamp::sim::batch
