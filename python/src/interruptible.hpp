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
#include <optional>
#include <utility>

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

/// A function of the user's that is told how far a computation is.
class ProgressCall {
 public:
  using Function = std::function<void(std::size_t done, std::size_t all)>;
  explicit ProgressCall(std::optional<Function> function) : function_(std::move(function)) {}

  [[nodiscard]] bool is_wanted() const { return function_.has_value(); }

  /// Without the interpreter's lock. The first exception of the function is kept, and ends this computation alone:
  /// `core::Cancelled` leaves here, from then on in every thread.
  void operator()(std::size_t done, std::size_t all);
  void rethrow_if_any() const;

 private:
  std::optional<Function> function_;
  std::exception_ptr error_;
};

template <typename Work>
auto unlocked(Work& work) {
  const pybind11::gil_scoped_release release;
  return work();
}

template <typename Work>
auto interruptible(Work work, const ProgressCall* progress = nullptr) {
  const InterruptWatch watch;
  try {
    auto result = unlocked(work);
    // A run that was nearly over does not notice a cancellation.
    if (progress != nullptr) progress->rethrow_if_any();
    watch.raise_if_pressed();
    return result;
  } catch (const core::Cancelled&) {
    // The lock is back by now.
  }
  if (progress != nullptr) progress->rethrow_if_any();
  watch.raise();
}

}  // namespace dualdamp::python
