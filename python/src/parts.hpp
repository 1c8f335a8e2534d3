#pragma once
/// The parts of the module `dualdamp._core`. Each adds its functions and classes; `dualdamp/*.py` is what users
/// see.

#include <pybind11/pybind11.h>

namespace dualdamp::python {

/// InputError, OutputError and LawFault become the exceptions of `dualdamp._errors`.
void add_errors(pybind11::module_& module);
/// Scenarios are run and checked.
void add_runs(pybind11::module_& module);
/// The tables of the format, as JSON: laws, excitations, analyses, methods.
void add_tables(pybind11::module_& module);
/// Many oscillators at once.
void add_batches(pybind11::module_& module);

}  // namespace dualdamp::python
