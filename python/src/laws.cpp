#include <algorithm>
#include <cstdint>
#include <set>
#include <string>

#include "core/provenance.hpp"
#include "friction_models/plugin.hpp"
#include "friction_models/registry.hpp"
#include "python/src/parts.hpp"

namespace dualdamp::python {

namespace py = pybind11;

namespace {

/// Changes only when the list of laws changes (friction_models/registry.hpp).
std::set<std::string>& names() {
  static std::set<std::string> laws;
  return laws;
}

void remove_law(const std::string& name) {
  friction::remove_added_law(name);
  names().erase(name);
}

/// `address`: of a table that the caller keeps (dualdamp/_python_laws.py).
void add_law(std::uintptr_t address, const std::string& origin, const std::string& source) {
  const auto* const table =
      reinterpret_cast<const dualdamp_law_table*>(address);  // NOLINT(performance-no-int-to-ptr)
  remove_law(table->name == nullptr ? "" : table->name);
  friction::add_plugin(*table, origin, core::sha256(source));
  names().insert(table->name);
}

}  // namespace

bool names_a_law_of_python(std::string_view resolved) {
  return std::ranges::any_of(
      names(), [&](const std::string& name) { return resolved.find('"' + name + '"') != std::string_view::npos; });
}

void add_laws(py::module_& module) {
  module.def("load_plugin", &friction::load_plugin, py::arg("file"));
  module.def("add_law", &add_law, py::arg("table"), py::arg("origin"), py::arg("source"));
  module.def("remove_law", &remove_law, py::arg("name"));
}

}  // namespace dualdamp::python
