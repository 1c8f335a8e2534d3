#pragma once
/// Computations without the interpreter's lock, which Ctrl-C ends.
///
///     const RunResult result = interruptible([&] { return scenarios::run(scenario, options); });
///
/// While the main thread of the interpreter computes, the first Ctrl-C requests a cancellation
/// (`core/cancellation.hpp`) and reaches Python's own handler as well; the call ends with KeyboardInterrupt, or
/// with what that handler raises. Other threads are not watched over, but a cancellation ends their computations,
/// too.

#include <pybind11/pybind11.h>

#include <exception>
#include <functional>
#include <memory>

#include "core/cancellation.hpp"

namespace dualdamp::python {

class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  /// Throws what the cancellation means in Python.
  [[noreturn]] void raise() const;
  /// The same once Ctrl-C was pressed: a function of the user's may have ended the computation with its error.
  void raise_if_pressed() const;

 private:
  bool is_set_ = false;
};

/// The first exception that a function of the user's raised inside a computation.
class CallbackError {
 public:
  /// Keeps the exception that is being handled and cancels the computation. With the interpreter's lock.
  void keep();
  void rethrow_if_any() const;

 private:
  std::exception_ptr error_;
};

template <typename Work>
auto unlocked(Work& work) {
  const pybind11::gil_scoped_release release;
  return work();
}

template <typename Work>
auto interruptible(Work work, const CallbackError* callbacks = nullptr) {
  const InterruptWatch watch;
  try {
    auto result = unlocked(work);
    // A run that was nearly over does not notice a cancellation.
    if (callbacks != nullptr) callbacks->rethrow_if_any();
    watch.raise_if_pressed();
    return result;
  } catch (const core::Cancelled&) {
    // The lock is back by now.
  }
  if (callbacks != nullptr) callbacks->rethrow_if_any();
  watch.raise();
}

}  // namespace dualdamp::python
