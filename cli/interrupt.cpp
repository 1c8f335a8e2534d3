#include "cli/interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include <ctime>
#include <system_error>
#include <thread>

#include "core/cancellation.hpp"
#include "core/diagnostics.hpp"

namespace dualdamp::cli {

namespace {

/// How long a cancelled computation may take to end.
constexpr timespec patience{.tv_sec = 0, .tv_nsec = 500'000'000};

void wait_for_interrupt(const sigset_t& signals) {
  int number = 0;
  if (sigwait(&signals, &number) != 0) return;
  {
    // Results that are being written are complete first.
    const std::lock_guard lock(output_mutex());
    core::request_cancellation();
  }
  (void)sigtimedwait(&signals, nullptr, &patience);
  const std::lock_guard lock(output_mutex());
  say_interrupted();
  ::_exit(static_cast<int>(core::ExitStatus::interrupted));
}

}  // namespace

void watch_for_interrupt() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  // A file that may not grow further is an error of the one who writes it.
  (void)::signal(SIGXFSZ, SIG_IGN);
  // Threads started later inherit the mask, so that the signal goes to the watcher alone.
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  try {
    std::thread([signals] { wait_for_interrupt(signals); }).detach();
  } catch (const std::system_error&) {
    // No thread is to be had: an interrupt ends the program as it ends any other.
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  }
}

void say_interrupted() {
  static constexpr char message[] = "interrupted\n";
  if (::write(STDERR_FILENO, message, sizeof message - 1) < 0) {
    // Nobody is left to tell.
  }
}

std::mutex& output_mutex() {
  // Never destroyed: the watcher outlives main.
  static auto* const mutex = new std::mutex;
  return *mutex;
}

}  // namespace dualdamp::cli
