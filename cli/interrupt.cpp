#include "cli/interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <ctime>
#include <system_error>
#include <thread>

#include "cli/isolation.hpp"
#include "core/cancellation.hpp"
#include "core/diagnostics.hpp"

namespace dualdamp::cli {

namespace {

/// Time that a cancelled computation has to end.
constexpr timespec patience{.tv_sec = 0, .tv_nsec = 500'000'000};

void wait_for_interrupt(const sigset_t& signals) {
  int number = 0;
  if (sigwait(&signals, &number) != 0) return;
  {
    // Wait until results that are being written are complete.
    const std::lock_guard lock(output_mutex());
    core::request_cancellation();
  }
  (void)sigtimedwait(&signals, nullptr, &patience);
  const std::lock_guard lock(output_mutex());
  say_interrupted();
  constexpr int status = static_cast<int>(core::ExitStatus::interrupted);
  announce_end(status);
  ::_exit(status);
}

/// As in the background of a shell without job control: what is sent to the foreground is not meant for it.
bool is_ignored(int number) {
  struct sigaction action{};
  return ::sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

}  // namespace

void watch_for_interrupt() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int number : {SIGINT, SIGTERM})
    if (!is_ignored(number)) sigaddset(&signals, number);
  // The limit on the size of a file is then an error of the write, not a signal that ends the program.
  (void)::signal(SIGXFSZ, SIG_IGN);
  // Threads that start later inherit the mask, so only the watcher gets the signals.
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  try {
    std::thread([signals] { wait_for_interrupt(signals); }).detach();
  } catch (const std::system_error&) {
    // Without a thread, an interrupt ends the program at once.
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  }
}

/// Once: while the program ends slowly, the watcher's patience may be over, too.
void say_interrupted() {
  static std::atomic_flag is_reported = ATOMIC_FLAG_INIT;
  if (is_reported.test_and_set()) return;
  static constexpr char message[] = "interrupted\n";
  if (::write(STDERR_FILENO, message, sizeof message - 1) < 0) {
    // There is no way left to report the failure.
  }
}

std::mutex& output_mutex() {
  // Never destroyed, because the watcher outlives main.
  static auto* const mutex = new std::mutex;
  return *mutex;
}

}  // namespace dualdamp::cli
