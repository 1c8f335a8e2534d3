#include "bench/crosscheck/walk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/engine/engine.hpp"
#include "sim/motion/observers.hpp"

namespace dualdamp::crosscheck {

namespace {

/// The largest terms of the energy, at samples and at the ends of intervals; a walk that ends early may have no
/// sample.
struct Extent {
  double x = 0.0;
  double v = 0.0;
  double y = 0.0;
  double f = 0.0;

  void add(const sim::Sample& sample) {
    x = std::max(x, std::abs(sample.x));
    v = std::max(v, std::abs(sample.v));
    y = std::max(y, std::abs(sample.y));
    f = std::max(f, std::abs(sample.external));
  }
};

/// Sum of the energies exchanged, the scale for rounding of the energy account.
double exchanged(const sim::Model& model, const Walk& walk, Extent size) {
  const sim::Oscillator& o = model.oscillator;
  for (const sim::Sample& sample : walk.samples) size.add(sample);
  const double extent = size.x + size.y;
  const double events = static_cast<double>(walk.events.size()) + 1.0;
  const double stored = o.mass * size.v * size.v + o.stiffness * extent * extent +
                        std::abs(o.cubic_stiffness) * extent * extent * extent * extent + size.f * size.x;
  return stored * events + std::abs(walk.energy.input) + std::abs(walk.energy.friction) +
         std::abs(walk.energy.viscous);
}

void take_samples(const sim::Interval& interval, double spacing, std::vector<sim::Sample>& samples) {
  while (samples.size() < static_cast<std::size_t>(walk_samples)) {
    const double t = spacing * static_cast<double>(samples.size() + 1);
    if (t > interval.end()) return;
    samples.push_back(interval.state_at(t));
  }
}

/// A step of the smooth engine is short; an interval of the exact engine lasts from event to event, and may be the
/// whole walk.
int pieces_of(const sim::Interval& interval, double spacing) {
  constexpr double fewest = 8.0;
  return static_cast<int>(std::clamp(std::ceil(interval.duration / spacing), fewest, double{walk_samples}));
}

void cut(const sim::Interval& interval, int count, std::vector<Piece>& pieces) {
  double before = std::abs(interval.at(0.0).v);
  for (int i = 1; i <= count; ++i) {
    const double middle = std::abs(interval.at((i - 0.5) / count * interval.duration).v);
    const double after = std::abs(interval.at(static_cast<double>(i) / count * interval.duration).v);
    pieces.push_back(
        {interval.begin + static_cast<double>(i) / count * interval.duration, std::max({before, middle, after})});
    before = after;
  }
}

bool all_finite(const Walk& walk) {
  const auto is_finite = [](const auto& item) {
    return std::isfinite(item.t) && std::isfinite(item.x) && std::isfinite(item.v);
  };
  return std::ranges::all_of(walk.events, is_finite) && std::ranges::all_of(walk.samples, is_finite);
}

}  // namespace

bool is_slow(const Walk& walk, double from, double to, double speed) {
  auto piece = std::ranges::lower_bound(walk.pieces, from, {}, &Piece::end);
  for (; piece != walk.pieces.end(); ++piece) {
    if (!(piece->speed <= speed)) return false;
    if (piece->end >= to) return true;
  }
  return false;
}

double way(const Walk& walk, double from, double to) {
  double result = 0.0;
  auto piece = std::ranges::lower_bound(walk.pieces, from, {}, &Piece::end);
  for (double begin = from; piece != walk.pieces.end(); ++piece) {
    result += piece->speed * (std::min(piece->end, to) - begin);
    if (piece->end >= to) return result;
    begin = piece->end;
  }
  return std::numeric_limits<double>::infinity();
}

std::string fault_of_sticks(const std::vector<sim::Event>& events) {
  const sim::Event* last = nullptr;
  for (const sim::Event& event : events) {
    if (event.kind == sim::EventKind::switching || event.kind == sim::EventKind::grazing) continue;
    const bool was_held = last != nullptr && last->kind == sim::EventKind::stop;
    if (last != nullptr && was_held != (event.kind == sim::EventKind::release))
      return fmt::format("{} at t = {:.9g} s after {} at t = {:.9g} s", sim::name_of(event.kind), event.t,
                         sim::name_of(last->kind), last->t);
    last = &event;
  }
  return {};
}

Walk walk(const sim::Model& model, const WalkOptions& options) {
  Walk result;
  const std::unique_ptr<sim::Engine> engine = sim::make_engine(model);
  sim::EnergyAudit audit(model.oscillator);
  Extent size;
  const double spacing = options.duration / walk_samples;
  while (const sim::Interval* interval = engine->next(std::min(options.duration, options.until))) {
    if (options.with_energy) {
      audit.observe(*interval);
      size.add(interval->at(0.0));
      size.add(interval->at(interval->duration));
    }
    take_samples(*interval, spacing, result.samples);
    cut(*interval, engine->accuracy() > 0.0 ? 1 : pieces_of(*interval, spacing), result.pieces);
    result.end = interval->end();
    if (interval->ending)
      result.events.push_back({interval->end(), *interval->ending, engine->position(), engine->velocity()});
    if (engine->work() >= options.most_work) {
      result.ended_early = true;
      break;
    }
  }
  result.outcome = engine->outcome();
  // The error of velocities is the tolerance (1e-11) times omega x: 1e-7 of a speed of 1e-4 omega x.
  if (engine->accuracy() > 0.0) result.slowest = 1e-4 * sim::natural_frequency(model.oscillator);
  result.finite = all_finite(result);
  if (options.with_energy) {
    result.energy = audit.account();
    result.energy_scale = exchanged(model, result, size);
    const double force = model.oscillator.stiffness * size.y + size.f;
    result.drive_energy = force * force / model.oscillator.stiffness;
  }
  return result;
}

}  // namespace dualdamp::crosscheck
