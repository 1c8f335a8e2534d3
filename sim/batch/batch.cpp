#include "sim/batch/batch.hpp"

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <complex>

#include "friction_models/coulomb.hpp"
#include "sim/batch/kernels.hpp"
#include "sim/exact_engine.hpp"
#include "sim/steady_state.hpp"

namespace dualdamp::sim {

namespace {

using batch::Kernels;

/// Oscillators of one task. A multiple of every width, so that only the last task is filled up.
constexpr std::size_t chunk = 512;
static_assert(chunk % batch::widest == 0);

/// Those the processor has, ascending.
std::vector<const Kernels*> kernels_here() {
  std::vector<const Kernels*> list{&batch::scalar_kernels};
#ifdef __x86_64__
  list.push_back(&batch::sse2_kernels);
  if (__builtin_cpu_supports("avx2")) list.push_back(&batch::avx2_kernels);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"))
    list.push_back(&batch::avx512_kernels);
#endif
  return list;
}

const Kernels& kernels_of(int width) {
  const std::vector<const Kernels*> list = kernels_here();
  const auto fits = std::find_if(list.begin(), list.end(), [=](const Kernels* k) { return k->width == width; });
  assert(width == 0 || fits != list.end());
  return fits == list.end() ? *list.back() : **fits;
}

batch::DriveOn drive_on(const OscillatorBatch& batch) {
  assert(batch.type == ExcitationType::base_harmonic || batch.type == ExcitationType::force_harmonic);
  if (batch.type == ExcitationType::force_harmonic) return batch::DriveOn::mass;
  return batch.damper_to == DamperTo::base ? batch::DriveOn::base_and_damper : batch::DriveOn::base;
}

/// One column of a task's oscillators: the caller's own, or a copy whose last entry is repeated up to a whole pack.
class Column {
 public:
  Column(const std::vector<double>& all, std::size_t first, std::size_t count, std::size_t padded) {
    data_ = all.data() + first;
    if (count == padded) return;
    std::copy_n(data_, count, copy_.begin());
    std::fill(copy_.begin() + static_cast<std::ptrdiff_t>(count),
              copy_.begin() + static_cast<std::ptrdiff_t>(padded), data_[count - 1]);
    data_ = copy_.data();
  }
  Column(const Column&) = delete;
  Column& operator=(const Column&) = delete;
  ~Column() = default;

  [[nodiscard]] const double* data() const { return data_; }

 private:
  const double* data_;
  std::array<double, chunk> copy_;
};

/// The oscillators [first, first + count) filled up to whole packs.
class Task {
 public:
  Task(const OscillatorBatch& batch, std::size_t first, std::size_t count)
      : padded_((count + batch::widest - 1) / batch::widest * batch::widest),
        mass_(batch.mass, first, count, padded_),
        damping_(batch.damping, first, count, padded_),
        stiffness_(batch.stiffness, first, count, padded_),
        kinetic_(batch.kinetic, first, count, padded_),
        static_level_(batch.static_level, first, count, padded_),
        amplitude_(batch.amplitude, first, count, padded_),
        frequency_(batch.frequency, first, count, padded_),
        drive_(drive_on(batch)) {}

  [[nodiscard]] std::size_t padded() const { return padded_; }
  [[nodiscard]] batch::Oscillators oscillators() const {
    return {.drive = drive_,
            .count = padded_,
            .mass = mass_.data(),
            .damping = damping_.data(),
            .stiffness = stiffness_.data(),
            .kinetic = kinetic_.data(),
            .static_level = static_level_.data(),
            .amplitude = amplitude_.data(),
            .frequency = frequency_.data()};
  }

 private:
  std::size_t padded_;
  Column mass_, damping_, stiffness_, kinetic_, static_level_, amplitude_, frequency_;
  batch::DriveOn drive_;
};

Model model_of(const OscillatorBatch& batch, std::size_t i) {
  Model model;
  model.oscillator = {.mass = batch.mass[i],
                      .stiffness = batch.stiffness[i],
                      .damping = batch.damping[i],
                      .damper_to = batch.damper_to};
  model.excitation = {.type = batch.type, .amplitude = batch.amplitude[i], .frequency = batch.frequency[i]};
  model.friction.emplace_back(friction::Coulomb(batch.kinetic[i], batch.static_level[i]));
  return model;
}

void steady_state_by_engine(const OscillatorBatch& batch, std::size_t i, BatchSteadyStates& result) {
  const SteadyState state = steady_state(model_of(batch, i));
  result.engine[i] = 1;
  result.outcome[i] = state.outcome.kind;
  result.peak[i] = state.peak;
  result.trough[i] = state.trough;
  result.lag[i] = state.phase;
  result.stops[i] = state.stops_per_cycle;
  for (const std::complex<double>& value : state.multipliers)
    result.radius[i] = std::max(result.radius[i], std::abs(value));
}

void steady_states_of(const OscillatorBatch& batch, const Kernels& kernels, std::size_t first, std::size_t count,
                      BatchSteadyStates& result) {
  const Task task(batch, first, count);
  std::array<double, chunk> peak;
  std::array<double, chunk> lag;
  std::array<double, chunk> radius;
  std::array<double, chunk> certified;
  kernels.find_orbits(task.oscillators(), {peak.data(), lag.data(), radius.data(), certified.data()});
  for (std::size_t lane = 0; lane < count; ++lane) {
    const std::size_t i = first + lane;
    if (certified[lane] == 0.0) {
      steady_state_by_engine(batch, i, result);
      continue;
    }
    result.peak[i] = peak[lane];
    result.trough[i] = -peak[lane];
    result.lag[i] = lag[lane];
    result.radius[i] = radius[lane];
  }
}

void follow_by_engine(const OscillatorBatch& batch, int periods, std::size_t i, BatchMotions& motions) {
  ExactEngine engine(model_of(batch, i));
  engine.start(motions.position[i], motions.velocity[i]);
  double turning = 0.0;
  while (engine.cycle() < periods) {
    const Interval* interval = engine.next_in_period();
    if (interval == nullptr) break;
    if (interval->ending != EventKind::reversal) continue;
    motions.amplitude[i] = 0.5 * std::abs(engine.position() - turning);
    turning = engine.position();
    ++motions.reversals[i];
  }
  motions.engine[i] = 1;
  motions.position[i] = engine.position();
  motions.velocity[i] = engine.velocity();
}

void follow_some(const OscillatorBatch& batch, const Kernels& kernels, int periods, std::size_t first,
                 std::size_t count, BatchMotions& motions) {
  const Task task(batch, first, count);
  std::array<double, chunk> x{};
  std::array<double, chunk> v{};
  std::array<double, chunk> amplitude;
  std::array<double, chunk> reversals;
  std::array<double, chunk> certified;
  std::copy_n(motions.position.begin() + static_cast<std::ptrdiff_t>(first), count, x.begin());
  std::copy_n(motions.velocity.begin() + static_cast<std::ptrdiff_t>(first), count, v.begin());
  kernels.follow(task.oscillators(),
                 {periods, x.data(), v.data(), amplitude.data(), reversals.data(), certified.data()});
  for (std::size_t lane = 0; lane < count; ++lane) {
    const std::size_t i = first + lane;
    if (certified[lane] == 0.0) {
      follow_by_engine(batch, periods, i, motions);
      continue;
    }
    motions.position[i] = x[lane];
    motions.velocity[i] = v[lane];
    motions.amplitude[i] = amplitude[lane];
    motions.reversals[i] = std::lround(reversals[lane]);
  }
}

/// Calls work(first, count) for chunks that cover `size` oscillators, on several threads.
template <class Work>
void in_chunks(std::size_t size, int threads, const Work& work) {
  namespace tbb = oneapi::tbb;
  const int cores = tbb::info::default_concurrency();
  tbb::task_arena arena(threads > 0 ? std::min(threads, cores) : cores);
  arena.execute([&] {
    const std::size_t chunks = (size + chunk - 1) / chunk;
    tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t i) {
      const std::size_t first = i * chunk;
      work(first, std::min(chunk, size - first));
    });
  });
}

}  // namespace

std::vector<int> batch_widths() {
  std::vector<int> widths;
  for (const Kernels* kernels : kernels_here()) widths.push_back(kernels->width);
  return widths;
}

BatchSteadyStates steady_states(const OscillatorBatch& batch, const BatchOptions& options) {
  BatchSteadyStates result;
  result.outcome.resize(batch.size(), core::OutcomeKind::done);
  for (std::vector<double>* column : {&result.peak, &result.trough, &result.lag, &result.radius})
    column->resize(batch.size(), 0.0);
  result.stops.resize(batch.size(), 0);
  result.engine.resize(batch.size(), 0);
  const Kernels& kernels = kernels_of(options.width);
  in_chunks(batch.size(), options.threads,
            [&](std::size_t first, std::size_t count) { steady_states_of(batch, kernels, first, count, result); });
  return result;
}

void follow(const OscillatorBatch& batch, int periods, BatchMotions& motions, const BatchOptions& options) {
  assert(motions.position.size() == batch.size() && motions.velocity.size() == batch.size());
  motions.amplitude.assign(batch.size(), 0.0);
  motions.reversals.assign(batch.size(), 0);
  motions.engine.assign(batch.size(), 0);
  const Kernels& kernels = kernels_of(options.width);
  in_chunks(batch.size(), options.threads, [&](std::size_t first, std::size_t count) {
    follow_some(batch, kernels, periods, first, count, motions);
  });
}

}  // namespace dualdamp::sim
