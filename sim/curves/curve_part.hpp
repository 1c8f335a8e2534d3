#pragma once
/// Points of a curve with their remarks. One thread fills one part; the parts are merged in order.

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "sim/batch/batch.hpp"
#include "sim/curves/curves.hpp"
#include "sim/orbits/steady_state.hpp"

namespace dualdamp::sim {

/// Remarks and reasons in order of their first appearance.
class Remarks {
 public:
  void add(const std::string& text, std::size_t index, std::size_t count = 1) {
    const auto [place, is_new] = places_.emplace(text, list_.size());
    if (is_new) list_.push_back({text, index, 0});
    list_[place->second].count += count;
  }

  [[nodiscard]] std::vector<Remark> take() { return std::move(list_); }

 private:
  std::vector<Remark> list_;
  std::map<std::string, std::size_t> places_;
};

/// Some consecutive points of a curve.
class CurvePart {
 public:
  void take(const SlidingOrbit& orbit, const SteadyStateOptions& options, CurvePoint& point);
  /// Fills `point` from `state`. `index`: of the point in the curve.
  void take(const SteadyState& state, CurvePoint& point, std::size_t index);

  /// Adds the remarks of this part to the curve. `points`: those of this part.
  void merge_into(Curve& curve, std::span<CurvePoint> points, Remarks& remarks);

 private:
  std::vector<std::string> reasons_;
  Remarks remarks_;
  core::SearchCount certificate_;
};

}  // namespace dualdamp::sim
