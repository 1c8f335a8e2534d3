#pragma once
/// The parts of the module `dualdamp._core`. Each adds its functions and classes. Users see only `dualdamp/*.py`.

#include <pybind11/pybind11.h>

#include <string_view>

namespace dualdamp::python {

/// Translates InputError, OutputError and LawFault to the exceptions of `dualdamp._errors`.
void add_errors(pybind11::module_& module);
/// Functions that add and remove laws.
void add_laws(pybind11::module_& module);
/// Whether a scenario, as its resolved JSON, may use a law written in Python: the name of one stands in it as a
/// text.
[[nodiscard]] bool names_a_law_of_python(std::string_view resolved);
/// Functions that run and check scenarios.
void add_runs(pybind11::module_& module);
/// The tables of the scenario format as JSON: laws, excitations, analyses, methods.
void add_tables(pybind11::module_& module);
/// Steady states of many oscillators at once.
void add_batches(pybind11::module_& module);

}  // namespace dualdamp::python
