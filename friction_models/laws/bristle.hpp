#pragma once
/// The bristle model of Haessig and Friedland: bonds between the surfaces that stretch, snap and form anew
/// elsewhere.
///
///   F = sum over the bristles of stiffness (x - b_i)     [N]
///   a bristle with |x - b_i| = d snaps to b_i = x + d u, u uniform in (-1, 1)
///
/// d is `snap_distance`. The positions b_i at the start are drawn in the same way, so the force does not start at
/// zero. After a long slip in one direction the stretch e of a bristle has the density (e + d)/(2 d^2), so the mean
/// force is count stiffness d/3. Each draw depends only on the seed and on its number. A modifier multiplies d;
/// while d is zero there is no force.
///
/// Source: haessig1991 in `docs/refs.bib`. Exact engine between snaps. Cost: about one event for each bristle and
/// length d travelled, an event costs O(count).

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/random.hpp"
#include "friction_models/law.hpp"
#include "friction_models/parameters.hpp"

namespace dualdamp::friction {

class Bristle {
 public:
  static constexpr bool remembers_path = true;
  static const std::vector<Parameter>& parameters();

  /// N/m of one bristle, > 0; m, > 0; at least one.
  Bristle(double stiffness, double snap_distance, int count, std::uint64_t seed)
      : stiffness_(stiffness), snap_distance_(snap_distance), count_(count), draws_{.seed = seed} {}

  [[nodiscard]] Memory start(const Instant& now) const;
  [[nodiscard]] Affine affine_force(const Memory& memory, const Instant& now, Direction) const;
  void affine_guards(const Memory& memory, const Instant& now, Direction, std::vector<Affine>& guards) const;
  void jump(Memory& memory, Trigger trigger, const Instant& now, Direction) const;
  [[nodiscard]] std::string_view aperiodic() const { return "its bristles snap at random"; }

 private:
  // State: the positions b_i in ascending order, so that the next to snap is the first or the last. Indices: the
  // number of draws so far.
  [[nodiscard]] bool has_length(const Instant& now) const;
  [[nodiscard]] double draw_position(Memory& memory, const Instant& now) const;

  double stiffness_;
  double snap_distance_;
  int count_;
  core::RandomStream draws_;
};

}  // namespace dualdamp::friction
