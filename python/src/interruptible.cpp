#include "python/src/interruptible.hpp"

#include <pthread.h>
#include <signal.h>

#include <atomic>
#include <chrono>
#include <thread>

namespace dualdamp::python {

namespace py = pybind11;

namespace {

/// Python's handler, while the one of this module replaces it.
struct sigaction before;
bool is_watching = false;
volatile sig_atomic_t was_pressed = 0;

/// Computations that do not hold the interpreter's lock.
std::atomic<int> computations = 0;
bool is_ending = false;  // read and written with the interpreter's lock

bool is_main_thread() {
  static const auto main_thread =
      py::module_::import("threading").attr("main_thread")().attr("ident").cast<unsigned long>();
  return PyThread_get_thread_ident() == main_thread;
}

/// Functions that are called at exit, in the main thread, may compute.
void end_thread_if_ending() {
  if (!is_ending || is_main_thread()) return;
  PyErr_SetNone(PyExc_SystemExit);
  throw py::error_already_set();
}

/// Called while the interpreter and its other threads still work. A function of the user that hangs is not awaited.
void end_computations() {
  constexpr auto longest = std::chrono::seconds(2);
  constexpr auto pause = std::chrono::milliseconds(1);
  is_ending = true;
  const py::gil_scoped_release release;
  core::request_cancellation();
  const auto start = std::chrono::steady_clock::now();
  while (computations > 0 && std::chrono::steady_clock::now() - start < longest) std::this_thread::sleep_for(pause);
  core::clear_cancellation();
}

extern "C" void cancel_and_pass_on(int number) {
  was_pressed = 1;
  core::request_cancellation();
  before.sa_handler(number);
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
  end_thread_if_ending();
  if (PyErr_CheckSignals() == 0) PyErr_SetNone(PyExc_KeyboardInterrupt);
  throw py::error_already_set();
}

void InterruptWatch::raise_if_pressed() const {
  if (is_set_ && was_pressed != 0) raise();
}

Unlocked::Counted::Counted() {
  end_thread_if_ending();
  ++computations;
}
Unlocked::Counted::~Counted() { --computations; }

void end_computations_at_exit() {
  ::pthread_atfork(nullptr, nullptr, [] { computations = 0; });  // a child has no other threads
  py::module_::import("atexit").attr("register")(py::cpp_function(&end_computations));
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
