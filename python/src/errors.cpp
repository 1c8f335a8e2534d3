#include <system_error>
#include <utility>

#include "core/diagnostics.hpp"
#include "friction_models/law_fault.hpp"
#include "python/src/parts.hpp"
#include "scenarios/results/files.hpp"

namespace dualdamp::python {

namespace py = pybind11;

namespace {

/// The text of a file name, which need not be UTF-8: other bytes become surrogates.
py::object text(const std::string& bytes) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(bytes.data(), static_cast<Py_ssize_t>(bytes.size()), "surrogateescape"));
}

py::dict fields_of(const core::Diagnostic& problem) {
  py::dict fields;
  fields["file"] = text(problem.place.file);
  fields["line"] = problem.place.line;
  fields["column"] = problem.place.column;
  fields["text"] = text(problem.place.text);
  fields["message"] = text(problem.message);
  fields["allowed"] = text(problem.allowed);
  fields["found"] = text(problem.found);
  fields["suggestion"] = text(problem.suggestion);
  return fields;
}

void set_error(const char* name, const py::object& argument) {
  const py::object type = py::module_::import("dualdamp._errors").attr(name);
  PyErr_SetObject(type.ptr(), type(argument).ptr());
}

void set_input_error(const core::InputError& error) {
  py::list problems;
  std::string message;
  for (const core::Diagnostic& problem : error.diagnostics()) {
    problems.append(fields_of(problem));
    message += (message.empty() ? "" : "\n") + core::format(problem);
  }
  const py::object type = py::module_::import("dualdamp._errors").attr("InvalidScenario");
  PyErr_SetObject(type.ptr(), type(text(message), problems).ptr());
}

}  // namespace

void add_errors(py::module_& /*module*/) {
  py::register_exception_translator([](std::exception_ptr error) {
    try {
      std::rethrow_exception(std::move(error));
    } catch (const core::InputError& fault) {
      set_input_error(fault);
    } catch (const scenarios::EarlierFiles& fault) {
      const std::string more = fault.may_resume() ? ": resume=True goes on with them, " : ": ";
      set_error("OutputError",
                text(fault.what() + more + "overwrite=True begins anew, another out keeps them apart"));
    } catch (const scenarios::OutputError& fault) {
      set_error("OutputError", text(fault.what()));
    } catch (const std::system_error& fault) {
      const py::tuple arguments = py::make_tuple(fault.code().value(), text(fault.what()));
      PyErr_SetObject(PyExc_OSError, arguments.ptr());
    } catch (const friction::LawFault& fault) {
      set_error("NumericalFailure", text(fault.what()));
    }
  });
}

}  // namespace dualdamp::python
