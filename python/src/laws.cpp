#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/diagnostics.hpp"
#include "core/provenance.hpp"
#include "friction_models/plugin.hpp"
#include "friction_models/registry.hpp"
#include "python/src/parts.hpp"

namespace dualdamp::python {

namespace py = pybind11;

namespace {

struct Added {
  const dualdamp_law_table* table = nullptr;  ///< that the caller keeps for good (dualdamp/_python_laws.py)
  std::string origin;
  std::string sha256;
};

/// The laws written in Python, by name. They change only when the list of laws does (friction_models/registry.hpp).
std::map<std::string, Added>& added() {
  static std::map<std::string, Added> laws;
  return laws;
}

void remove_law(const std::string& name) {
  friction::remove_added_law(name);
  added().erase(name);
}

void add(const Added& law) {
  friction::add_plugin(*law.table, law.origin, law.sha256);
  added().insert_or_assign(law.table->name, law);
}

/// `address`: of the table. A law that is refused does not replace an earlier one.
void add_law(std::uintptr_t address, const std::string& origin, const std::string& source) {
  const Added law = {reinterpret_cast<const dualdamp_law_table*>(address),  // NOLINT(performance-no-int-to-ptr)
                     origin, core::sha256(source)};
  const std::string name = law.table->name;
  const auto found = added().find(name);
  const std::optional<Added> earlier = found == added().end() ? std::nullopt : std::optional(found->second);
  remove_law(name);
  try {
    add(law);
  } catch (const core::InputError&) {
    if (earlier) add(*earlier);
    throw;
  }
}

}  // namespace

bool names_a_law_of_python(std::string_view resolved) {
  return std::ranges::any_of(
      added(), [&](const auto& law) { return resolved.find('"' + law.first + '"') != std::string_view::npos; });
}

void add_laws(py::module_& module) {
  module.def("load_plugin", &friction::load_plugin, py::arg("file"));
  module.def("add_law", &add_law, py::arg("table"), py::arg("origin"), py::arg("source"));
  module.def("remove_law", &remove_law, py::arg("name"));
}

}  // namespace dualdamp::python
