#include "python/src/interruptible.hpp"

#include <signal.h>

namespace dualdamp::python {

namespace py = pybind11;

namespace {

/// Python's handler, while the one of this module replaces it.
struct sigaction before;
bool is_watching = false;
volatile sig_atomic_t was_pressed = 0;

extern "C" void cancel_and_pass_on(int number) {
  was_pressed = 1;
  core::request_cancellation();
  before.sa_handler(number);
}

bool is_main_thread() {
  static const auto main_thread =
      py::module_::import("threading").attr("main_thread")().attr("ident").cast<unsigned long>();
  return PyThread_get_thread_ident() == main_thread;
}

}  // namespace

InterruptWatch::InterruptWatch() {
  if (!is_main_thread() || is_watching) return;
  if (::sigaction(SIGINT, nullptr, &before) != 0) return;
  // If Python has no handler, the signal ends the process or is ignored; that is left unchanged.
  if ((before.sa_flags & SA_SIGINFO) != 0 || before.sa_handler == SIG_DFL || before.sa_handler == SIG_IGN) return;
  was_pressed = 0;
  struct sigaction ours = before;
  ours.sa_handler = cancel_and_pass_on;
  is_watching = is_set_ = ::sigaction(SIGINT, &ours, nullptr) == 0;
}

InterruptWatch::~InterruptWatch() {
  if (!is_set_) return;
  ::sigaction(SIGINT, &before, nullptr);
  is_watching = false;
  core::clear_cancellation();
}

void InterruptWatch::raise() const {
  if (PyErr_CheckSignals() == 0) PyErr_SetNone(PyExc_KeyboardInterrupt);
  throw py::error_already_set();
}

void InterruptWatch::raise_if_pressed() const {
  if (is_set_ && was_pressed != 0) raise();
}

void ProgressCall::operator()(std::size_t done, std::size_t all) {
  const py::gil_scoped_acquire lock;
  if (!error_) {
    try {
      (*function_)(done, all);
      return;
    } catch (const py::error_already_set&) {
      error_ = std::current_exception();
    }
  }
  throw core::Cancelled{};
}

void ProgressCall::rethrow_if_any() const {
  if (error_) std::rethrow_exception(error_);
}

}  // namespace dualdamp::python
