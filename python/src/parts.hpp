#pragma once
/// The parts of the module `dualdamp._core`. Each adds its functions and classes. Users see only `dualdamp/*.py`.

#include <pybind11/pybind11.h>

namespace dualdamp::python {

/// Translates InputError, OutputError and LawFault to the exceptions of `dualdamp._errors`.
void add_errors(pybind11::module_& module);
/// Functions that run and check scenarios.
void add_runs(pybind11::module_& module);
/// The tables of the scenario format as JSON: laws, excitations, analyses, methods.
void add_tables(pybind11::module_& module);
/// Steady states of many oscillators at once.
void add_batches(pybind11::module_& module);

}  // namespace dualdamp::python
