#include "sim/curves/curve_part.hpp"

#include <algorithm>

namespace dualdamp::sim {

namespace {

std::uint32_t number_in(std::vector<std::string>& list, const std::string& text) {
  const auto found = std::ranges::find(list, text);
  const auto number = static_cast<std::uint32_t>(found - list.begin());
  if (found == list.end()) list.push_back(text);
  return number;
}

}  // namespace

void CurvePart::take(const SlidingOrbit& orbit, const SteadyStateOptions& options, CurvePoint& point) {
  certificate_ += orbit.certificate;
  point.x = orbit.peak;
  if (options.detail != OrbitDetail::extremes) point.phase = orbit.lag;
  point.stable = true;
}

void CurvePart::take(const SteadyState& state, CurvePoint& point, std::size_t index) {
  certificate_ += state.certificate;
  if (state.outcome.ok()) {
    point.x = state.amplitude;
    point.phase = state.phase;
    point.stops = state.stops_per_cycle;
    point.sticks = state.stick_count;
    point.stable = state.stable();
  } else {
    point.reason = number_in(reasons_, state.outcome.reason) + 1;
    remarks_.add(state.outcome.reason, index);
  }
  for (const std::string& warning : state.warnings) remarks_.add(warning, index);
}

void CurvePart::merge_into(Curve& curve, std::span<CurvePoint> points, Remarks& remarks) {
  std::vector<std::uint32_t> numbers = {0};
  for (const std::string& reason : reasons_) numbers.push_back(number_in(curve.reasons, reason));
  for (CurvePoint& point : points) point.reason = numbers[point.reason];
  for (const Remark& remark : remarks_.take()) remarks.add(remark.text, remark.first, remark.count);
  curve.certificate += certificate_;
}

}  // namespace dualdamp::sim
