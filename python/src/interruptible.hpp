#pragma once
/// Runs computations without the interpreter's lock, so that Ctrl-C can end them.
///
///     const RunResult result = interruptible([&] { return scenarios::run(scenario, options); });
///
/// While the main thread of the interpreter computes, the first Ctrl-C requests a cancellation
/// (`core/cancellation.hpp`) and is passed on to Python's own handler. The call ends with KeyboardInterrupt, or
/// with the exception of that handler. Only the main thread watches for Ctrl-C, but a cancellation also ends the
/// computations of other threads.
///
/// When the interpreter ends, daemon threads may still compute. A thread that asks for the interpreter's lock after
/// that is ended by Python in the middle of C++ code, which aborts the process. So they are cancelled before, and
/// end with SystemExit.

#include <pybind11/pybind11.h>

#include <exception>
#include <functional>
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

  /// Throws the exception of Python that belongs to the cancellation.
  [[noreturn]] void raise() const;
  /// Throws that exception if Ctrl-C was pressed. A function of the user may have ended the computation with an
  /// error of its own.
  void raise_if_pressed() const;

 private:
  bool is_set_ = false;
};

/// Work without the interpreter's lock. The end of the interpreter waits for it, and then no thread may begin
/// another one.
class Unlocked {
 private:
  struct Counted {
    Counted();
    ~Counted();
    Counted(const Counted&) = delete;
    Counted& operator=(const Counted&) = delete;
  };
  Counted counted_;  // until the lock is held again
  pybind11::gil_scoped_release release_;
};

/// Lets the computations of other threads end before the interpreter does.
void end_computations_at_exit();

/// A function of the user that is called with the progress of a computation.
class ProgressCall {
 public:
  using Function = std::function<void(std::size_t done, std::size_t all)>;
  explicit ProgressCall(std::optional<Function> function) : function_(std::move(function)) {}

  [[nodiscard]] bool is_wanted() const { return function_.has_value(); }

  /// To be called without the interpreter's lock. The first exception of the function is kept and ends this
  /// computation only: from then on, each call throws `core::Cancelled`, in every thread.
  void operator()(std::size_t done, std::size_t all);
  void rethrow_if_any() const;

 private:
  std::optional<Function> function_;
  std::exception_ptr error_;
};

template <typename Work>
auto unlocked(Work& work) {
  const Unlocked unlocked;
  return work();
}

template <typename Work>
auto interruptible(Work work, const ProgressCall* progress = nullptr) {
  const InterruptWatch watch;
  try {
    auto result = unlocked(work);
    // A run that is nearly finished does not check for a cancellation any more.
    if (progress != nullptr) progress->rethrow_if_any();
    watch.raise_if_pressed();
    return result;
  } catch (const core::Cancelled&) {
    // The interpreter's lock is held again here; exceptions of Python can be thrown below.
  }
  if (progress != nullptr) progress->rethrow_if_any();
  watch.raise();
}

}  // namespace dualdamp::python
