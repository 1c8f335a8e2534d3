#include "sim/curves.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <span>

namespace dualdamp::sim {

namespace {

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

/// Consecutive points, done by one thread.
class Chunk {
 public:
  void compute(Model& model, const SteadyStateOptions& options, CurvePoint& point, std::size_t index) {
    model.excitation.frequency = point.omega;
    model.excitation.amplitude = point.Y;
    const SteadyState state = steady_state(model, options);
    certificate_ += state.certificate;
    if (state.outcome.ok()) {
      point.x = state.amplitude;
      point.phase = state.phase;
      point.stops = state.stops_per_cycle;
      point.sticks = static_cast<int>(state.sticks.size());
      point.stable = state.stable();
    } else {
      point.reason = number_of(state.outcome.reason);
      remarks_.add(state.outcome.reason, index);
    }
    for (const std::string& warning : state.warnings) remarks_.add(warning, index);
  }

  /// `points` are those of this chunk.
  void merge_into(Curve& curve, std::span<CurvePoint> points, Remarks& remarks) {
    std::vector<std::uint32_t> numbers = {0};
    for (const std::string& reason : reasons_) numbers.push_back(number_in(curve.reasons, reason));
    for (CurvePoint& point : points) point.reason = numbers[point.reason];
    for (const Remark& remark : remarks_.take()) remarks.add(remark.text, remark.first, remark.count);
    curve.certificate += certificate_;
  }

 private:
  static std::uint32_t number_in(std::vector<std::string>& list, const std::string& text) {
    const auto found = std::ranges::find(list, text);
    const auto number = static_cast<std::uint32_t>(found - list.begin());
    if (found == list.end()) list.push_back(text);
    return number;
  }
  [[nodiscard]] std::uint32_t number_of(const std::string& reason) { return number_in(reasons_, reason) + 1; }

  std::vector<std::string> reasons_;
  Remarks remarks_;
  core::SearchCount certificate_;
};

/// Fills in points that have their `omega` and `Y`.
Curve computed(const Model& model, std::vector<CurvePoint> points, const SteadyStateOptions& options) {
  constexpr std::size_t chunk_size = 64;
  std::vector<Chunk> chunks((points.size() + chunk_size - 1) / chunk_size);
  const auto part = [&](std::size_t number) {
    return std::span(points)
        .subspan(number * chunk_size)
        .first(std::min(chunk_size, points.size() - number * chunk_size));
  };
  oneapi::tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t number) {
    Model own = model;
    std::size_t index = number * chunk_size;
    for (CurvePoint& point : part(number)) chunks[number].compute(own, options, point, index++);
  });

  Curve curve;
  Remarks remarks;
  for (std::size_t number = 0; number < chunks.size(); ++number)
    chunks[number].merge_into(curve, part(number), remarks);
  curve.points = std::move(points);
  curve.remarks = remarks.take();
  return curve;
}

/// For points without a phase.
SteadyStateOptions brief(SteadyStateOptions options) {
  options.full_account = false;
  return options;
}

}  // namespace

Curve xy_curve(const Model& model, const std::vector<double>& amplitudes, const SteadyStateOptions& options) {
  std::vector<CurvePoint> points;
  points.reserve(amplitudes.size());
  for (const double Y : amplitudes) points.push_back({.omega = model.excitation.frequency, .Y = Y});
  return computed(model, std::move(points), brief(options));
}

Curve frequency_response(const Model& model, const std::vector<double>& frequencies,
                         const SteadyStateOptions& options) {
  std::vector<CurvePoint> points;
  points.reserve(frequencies.size());
  for (const double omega : frequencies) points.push_back({.omega = omega, .Y = model.excitation.amplitude});
  return computed(model, std::move(points), options);
}

Curve regime_map(const Model& model, const std::vector<double>& frequencies, const std::vector<double>& amplitudes,
                 const SteadyStateOptions& options) {
  std::vector<CurvePoint> points;
  points.reserve(frequencies.size() * amplitudes.size());
  for (const double omega : frequencies)
    for (const double Y : amplitudes) points.push_back({.omega = omega, .Y = Y});
  return computed(model, std::move(points), brief(options));
}

}  // namespace dualdamp::sim
