#include "cli/interrupt.hpp"

#include <signal.h>
#include <unistd.h>

#include <thread>

#include "core/diagnostics.hpp"

namespace dualdamp::cli {

void watch_for_interrupt() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  // Threads started later inherit the mask, so that the signal goes to the watcher alone.
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::thread([signals] {
    int number = 0;
    if (sigwait(&signals, &number) != 0) return;
    const std::lock_guard lock(output_mutex());
    static constexpr char message[] = "interrupted\n";
    if (::write(STDERR_FILENO, message, sizeof message - 1) < 0) {
      // Nobody is left to tell.
    }
    ::_exit(static_cast<int>(core::ExitStatus::interrupted));
  }).detach();
}

std::mutex& output_mutex() {
  // Never destroyed: the watcher outlives main.
  static auto* const mutex = new std::mutex;
  return *mutex;
}

}  // namespace dualdamp::cli
