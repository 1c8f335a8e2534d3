#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "python/src/interruptible.hpp"
#include "python/src/parts.hpp"
#include "sim/batch/batch.hpp"

namespace dualdamp::python {

namespace py = pybind11;

namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Shape = std::vector<py::ssize_t>;

/// A number, or an array of them.
class Input {
 public:
  explicit Input(const py::object& value) {
    if (PyFloat_CheckExact(value.ptr()) != 0) {
      number_ = PyFloat_AS_DOUBLE(value.ptr());
      return;
    }
    array_ = Numbers::ensure(value);
    if (!array_) throw py::error_already_set();
    if (array_.ndim() == 0) number_ = *array_.data();
  }

  [[nodiscard]] Shape shape() const {
    return array_ ? Shape(array_.shape(), array_.shape() + array_.ndim()) : Shape{};
  }

  /// Its numbers for every place of the shape that all inputs have together.
  [[nodiscard]] std::vector<double> spread(const Shape& shape, std::size_t size) const {
    if (!array_ || array_.ndim() == 0) return std::vector<double>(size, number_);
    Numbers whole = array_;
    if (this->shape() != shape) {
      whole = Numbers::ensure(py::module_::import("numpy").attr("broadcast_to")(array_, py::cast(shape)));
    }
    return {whole.data(), whole.data() + size};
  }

 private:
  Numbers array_{py::reinterpret_steal<Numbers>(py::handle())};
  double number_ = 0.0;
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

/// An array of that shape which takes the numbers over; a plain number where there is no dimension.
template <typename Number>
py::object output(std::vector<Number> numbers, const Shape& shape) {
  if (shape.empty()) return py::cast(numbers.front());
  auto* const kept = new std::vector<Number>(std::move(numbers));
  const py::capsule owner(kept, [](void* memory) { delete static_cast<std::vector<Number>*>(memory); });
  return py::array_t<Number>(shape, kept->data(), owner);
}

/// Numbers of a steady state that does not exist mean nothing.
void blank(sim::BatchSteadyStates& states) {
  for (std::size_t i = 0; i < states.outcome.size(); ++i)
    if (states.outcome[i] != core::OutcomeKind::done)
      for (std::vector<double>* numbers : {&states.peak, &states.trough, &states.lag, &states.radius})
        (*numbers)[i] = std::numeric_limits<double>::quiet_NaN();
}

/// `values`: mass, damping, stiffness, kinetic, static, amplitude, frequency.
py::tuple steady_states(bool moves_base, bool damper_to_base, int threads, const py::tuple& values) {
  std::vector<Input> inputs;
  for (const py::handle value : values) inputs.emplace_back(py::reinterpret_borrow<py::object>(value));
  const Shape shape = common_shape(inputs);
  std::size_t size = 1;
  for (const py::ssize_t length : shape) size *= static_cast<std::size_t>(length);
  const auto column = [&](std::size_t i) { return inputs.at(i).spread(shape, size); };
  const sim::OscillatorBatch batch{
      .type = moves_base ? sim::ExcitationType::base_harmonic : sim::ExcitationType::force_harmonic,
      .damper_to = damper_to_base ? sim::DamperTo::base : sim::DamperTo::ground,
      .mass = column(0),
      .damping = column(1),
      .stiffness = column(2),
      .kinetic = column(3),
      .static_level = column(4),
      .amplitude = column(5),
      .frequency = column(6)};
  sim::BatchSteadyStates states = interruptible([&] {
    sim::BatchSteadyStates found = sim::steady_states(batch, {.threads = threads});
    blank(found);
    return found;
  });
  std::vector<unsigned char> outcome(size);
  std::ranges::transform(states.outcome, outcome.begin(),
                         [](core::OutcomeKind kind) { return static_cast<unsigned char>(kind); });
  return py::make_tuple(output(std::move(states.peak), shape), output(std::move(states.trough), shape),
                        output(std::move(states.lag), shape), output(std::move(states.radius), shape),
                        output(std::move(states.stops), shape), output(std::move(outcome), shape));
}

}  // namespace

void add_batches(py::module_& module) {
  module.def("steady_states", &steady_states, py::arg("moves_base"), py::arg("damper_to_base"), py::arg("threads"),
             py::arg("values"));
  module.attr("outcomes") = py::make_tuple("done", "no_steady_state", "not_unique", "event_limit", "jump_cycle",
                                           "not_finite", "not_identifiable");
}

}  // namespace dualdamp::python
