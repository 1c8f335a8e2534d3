// The mask of one lane is a bool, and the templates combine masks bit by bit.
#ifdef __clang__
#pragma clang diagnostic ignored "-Wbitwise-instead-of-logical"
#endif

#include <sleef.h>

#include "sim/batch/pass_periods.hpp"

namespace dualdamp::sim::batch {
namespace {

/// One lane, for any processor.
struct Scalar {
  using Vector = double;
  using Mask = bool;
  static constexpr int width = 1;

  static bool any(Mask mask) { return mask; }
  static Vector choose(Mask mask, Vector yes, Vector no) { return mask ? yes : no; }
  static Vector load(const double* from) { return *from; }
  static void store(Vector v, double* to) { *to = v; }
  static Vector sqrt(Vector v) { return __builtin_sqrt(v); }
  static Vector exp(Vector v) { return Sleef_cinz_expd1_u10purec(v); }
  static Vector atan2(Vector y, Vector x) { return Sleef_cinz_atan2d1_u10purec(y, x); }
  static void sincos(Vector v, Vector& sine, Vector& cosine) {
    const auto both = Sleef_cinz_sincosd1_u10purec(v);
    sine = both.x;
    cosine = both.y;
  }
};

}  // namespace

const Kernels scalar_kernels{Scalar::width, find_orbits<Scalar>, pass_periods<Scalar>};

}  // namespace dualdamp::sim::batch
