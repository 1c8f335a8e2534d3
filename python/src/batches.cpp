#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "python/src/interruptible.hpp"
#include "python/src/parts.hpp"
#include "sim/batch/batch.hpp"
#include "sim/orbits/batch_steady_states.hpp"
#include "sim/parallel.hpp"

namespace dualdamp::python {

namespace py = pybind11;

namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Shape = std::vector<py::ssize_t>;

/// A number, or an array of numbers that is broadcast to a larger shape.
class Input {
 public:
  explicit Input(const py::object& value) {
    if (PyFloat_CheckExact(value.ptr()) != 0) {
      number_ = PyFloat_AS_DOUBLE(value.ptr());
      return;
    }
    array_ = Numbers(value);  // throws the exception of Python: not a number, no memory
    if (array_.ndim() == 0) number_ = *array_.data();
  }

  [[nodiscard]] bool is_number() const { return !array_ || array_.ndim() == 0; }
  [[nodiscard]] Shape shape() const {
    return array_ ? Shape(array_.shape(), array_.shape() + array_.ndim()) : Shape{};
  }

  /// Broadcasts to this shape. The own shape must allow it.
  void broadcast(const Shape& shape) {
    const Shape own = this->shape();
    shape_ = shape;
    strides_.assign(shape.size(), 0);
    py::ssize_t stride = 1;
    for (std::size_t i = own.size(); i-- > 0;) {
      if (own[i] != 1) strides_[shape.size() - own.size() + i] = stride;
      stride *= own[i];
    }
  }

  /// Copies the numbers `first` to `first + out.size()` of the flattened shape. Needs no lock of the interpreter.
  void read(std::size_t first, std::vector<double>& out) const {
    if (is_number()) {
      std::ranges::fill(out, number_);
      return;
    }
    const auto length = static_cast<std::size_t>(shape_.back());
    for (std::size_t done = 0; done < out.size();) {
      // A row of the last dimension, or the rest of it.
      const std::size_t column = (first + done) % length;
      const std::size_t count = std::min(length - column, out.size() - done);
      const double* place = start_of_row((first + done) / length);
      const auto to = out.begin() + static_cast<std::ptrdiff_t>(done);
      if (strides_.back() == 1)
        std::copy_n(place + column, count, to);
      else
        std::fill_n(to, count, *place);
      done += count;
    }
  }

 private:
  [[nodiscard]] const double* start_of_row(std::size_t row) const {
    py::ssize_t offset = 0;
    for (std::size_t i = shape_.size() - 1; i-- > 0;) {
      const auto length = static_cast<std::size_t>(shape_[i]);
      offset += static_cast<py::ssize_t>(row % length) * strides_[i];
      row /= length;
    }
    return array_.data() + offset;
  }

  Numbers array_{py::reinterpret_steal<Numbers>(py::handle())};
  double number_ = 0.0;
  Shape shape_;
  Shape strides_;
};

Shape common_shape(const std::vector<Input>& inputs) {
  Shape common;
  for (const Input& input : inputs) {
    const Shape shape = input.shape();
    if (shape.size() > common.size()) common.insert(common.begin(), shape.size() - common.size(), 1);
    for (std::size_t i = 0; i < shape.size(); ++i) {
      py::ssize_t& length = common[common.size() - shape.size() + i];
      if (length == 1)
        length = shape[i];
      else if (shape[i] != 1 && shape[i] != length)
        throw py::value_error("the arrays cannot be broadcast to one shape: lengths " + std::to_string(length) +
                              " and " + std::to_string(shape[i]));
    }
  }
  return common;
}

/// Number of entries of an array of this shape.
std::size_t size_of(const Shape& shape) {
  std::size_t size = 1;
  for (const py::ssize_t length : shape)
    if (__builtin_mul_overflow(size, static_cast<std::size_t>(length), &size))
      throw py::value_error("the arrays together have more entries than can be counted");
  return size;
}

/// An array of this shape that owns the numbers; a plain number if there is no dimension.
template <typename Number>
py::object output(std::unique_ptr<Number[]> numbers, const Shape& shape) {
  if (shape.empty()) return py::cast(numbers[0]);
  Number* const kept = numbers.release();
  const py::capsule owner(kept, [](void* memory) { delete[] static_cast<Number*>(memory); });
  return py::array_t<Number>(shape, kept, owner);
}

/// The results, one entry for each oscillator. NaN if there is no steady state.
struct Output {
  explicit Output(std::size_t size)
      : peak(std::make_unique_for_overwrite<double[]>(size)),
        trough(std::make_unique_for_overwrite<double[]>(size)),
        lag(std::make_unique_for_overwrite<double[]>(size)),
        radius(std::make_unique_for_overwrite<double[]>(size)),
        stops(std::make_unique_for_overwrite<int[]>(size)),
        outcome(std::make_unique_for_overwrite<unsigned char[]>(size)) {}

  void take(const sim::BatchSteadyStates& states, std::size_t first) {
    std::ranges::copy(states.peak, &peak[first]);
    std::ranges::copy(states.trough, &trough[first]);
    std::ranges::copy(states.lag, &lag[first]);
    std::ranges::copy(states.radius, &radius[first]);
    std::ranges::copy(states.stops, &stops[first]);
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    bool are_done = true;
    for (std::size_t i = 0; i < states.outcome.size(); ++i) {
      outcome[first + i] = static_cast<unsigned char>(states.outcome[i]);
      are_done &= states.outcome[i] == core::OutcomeKind::done;
    }
    if (are_done) return;
    for (std::size_t i = 0; i < states.outcome.size(); ++i) {
      if (states.outcome[i] == core::OutcomeKind::done) continue;
      for (double* numbers : {peak.get(), trough.get(), lag.get(), radius.get()}) numbers[first + i] = none;
    }
  }

  // Not initialised, so that the memory of a large array is touched only once, when it is written.
  std::unique_ptr<double[]> peak, trough, lag, radius;
  std::unique_ptr<int[]> stops;
  std::unique_ptr<unsigned char[]> outcome;
};

/// Size of a chunk. Each thread copies the numbers of its own chunk, which stay in the cache of its core.
constexpr std::size_t chunk_size = 2'048;

/// Fills a chunk with `count` oscillators from `first` on.
void fill(sim::OscillatorBatch& chunk, const std::vector<Input>& inputs, std::size_t first, std::size_t count) {
  std::vector<double>* const columns[] = {&chunk.mass,         &chunk.damping,   &chunk.stiffness, &chunk.kinetic,
                                          &chunk.static_level, &chunk.amplitude, &chunk.frequency};
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    columns[i]->resize(count);
    inputs[i].read(first, *columns[i]);
  }
}

/// Reports from time to time how many oscillators are done. May be called from any thread.
class BatchMeter {
 public:
  BatchMeter(ProgressCall& told, std::size_t all) : told_(told), all_(all) {}

  void add(std::size_t count) {
    if (!told_.is_wanted()) return;
    const std::lock_guard lock(mutex_);
    done_ += count;
    if (done_ < all_ && done_ < next_) return;
    next_ = done_ + pause_;
    told_(done_, all_);
  }

 private:
  static constexpr std::size_t pause_ = 131'072;
  ProgressCall& told_;
  std::size_t all_;
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::size_t next_ = pause_;
};

/// `values`: mass, damping, stiffness, kinetic, static, amplitude, frequency.
py::tuple steady_states(bool moves_base, bool damper_to_base, int threads, const py::tuple& values,
                        std::optional<ProgressCall::Function> progress) {
  std::vector<Input> inputs;
  for (const py::handle value : values) inputs.emplace_back(py::reinterpret_borrow<py::object>(value));
  constexpr std::size_t columns = 7;
  if (inputs.size() != columns) throw py::value_error("seven values are needed");
  const Shape shape = common_shape(inputs);
  const std::size_t size = size_of(shape);
  for (Input& input : inputs) input.broadcast(shape);
  const auto type = moves_base ? sim::ExcitationType::base_harmonic : sim::ExcitationType::force_harmonic;
  const auto damper_to = damper_to_base ? sim::DamperTo::base : sim::DamperTo::ground;
  ProgressCall told(std::move(progress));
  const auto compute = [&] {
    Output all(size);
    BatchMeter meter(told, size);
    sim::in_parts(size, chunk_size, threads, [&](std::size_t first, std::size_t count) {
      thread_local sim::OscillatorBatch chunk;  // its memory is reused
      chunk.type = type;
      chunk.damper_to = damper_to;
      fill(chunk, inputs, first, count);
      all.take(sim::steady_states(chunk), first);
      meter.add(count);
    });
    return all;
  };
  Output found = interruptible(compute, &told);
  return py::make_tuple(output(std::move(found.peak), shape), output(std::move(found.trough), shape),
                        output(std::move(found.lag), shape), output(std::move(found.radius), shape),
                        output(std::move(found.stops), shape), output(std::move(found.outcome), shape));
}

}  // namespace

void add_batches(py::module_& module) {
  module.def("steady_states", &steady_states, py::arg("moves_base"), py::arg("damper_to_base"), py::arg("threads"),
             py::arg("values"), py::arg("progress") = py::none());
  module.attr("outcomes") = py::make_tuple("done", "no_steady_state", "not_unique", "event_limit", "jump_cycle",
                                           "not_finite", "not_identifiable");
}

}  // namespace dualdamp::python
