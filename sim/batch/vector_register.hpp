#pragma once
/// The part that all packs in vector registers share. The file of a kernel adds the square root, SLEEF's functions
/// and `any`.

namespace dualdamp::sim::batch {

template <int Width>
struct VectorRegister {
  // A typedef: GCC 12 drops the attribute from an alias declaration that depends on a template parameter.
  typedef double Vector __attribute__((vector_size(Width * sizeof(double))));
  typedef long Mask __attribute__((vector_size(Width * sizeof(double))));  // the type of a comparison
  static constexpr int width = Width;

  static Vector choose(Mask mask, Vector yes, Vector no) { return mask ? yes : no; }
  static Vector load(const double* from) {
    Vector v;
    __builtin_memcpy(&v, from, sizeof v);
    return v;
  }
  static void store(Vector v, double* to) { __builtin_memcpy(to, &v, sizeof v); }

 protected:
  /// SLEEF's pair of sine and cosine.
  template <class Pair>
  static void split(const Pair& both, Vector& sine, Vector& cosine) {
    sine = both.x;
    cosine = both.y;
  }
};

}  // namespace dualdamp::sim::batch
