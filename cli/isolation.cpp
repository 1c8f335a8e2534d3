#include "cli/isolation.hpp"

#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <iostream>
#include <new>
#include <optional>
#include <string>

#include "cli/commands.hpp"
#include "cli/guarded.hpp"
#include "cli/interrupt.hpp"
#include "core/diagnostics.hpp"
#include "core/numbers.hpp"

namespace dualdamp::cli {

namespace {

using core::ExitStatus;
using Clock = std::chrono::steady_clock;

int say(ExitStatus status, const std::string& message, const Call& call) {
  const CommandOutput output = refused(status, message);
  if (call.json) output.json(std::cout);
  print(output, {.json = call.json});
  std::cout.flush();
  return static_cast<int>(output.status);
}

std::string names(const std::vector<std::string>& plugins) {
  return plugins.empty() ? "none" : core::joined(plugins);
}

/// The status with which the child is about to end, in memory that it shares with its parent. A child that a plugin
/// ends by _exit, or by a system call, has announced none.
std::atomic<int>* announced = nullptr;
static_assert(std::atomic<int>::is_always_lock_free);
constexpr int none_announced = -1;

bool share_announcement() {
  void* memory = ::mmap(nullptr, sizeof *announced, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return false;
  announced = new (memory) std::atomic<int>(none_announced);
  return true;
}

/// The call that has not returned yet.
const Call* unfinished = nullptr;

/// A plugin that calls exit would leave its own status, and no result.
void end_unfinished() {
  if (unfinished == nullptr) return;
  const int status =
      say(ExitStatus::numerical_failure,
          "a plugin ended the program (exit); there were the plugins: " + names(unfinished->plugins), *unfinished);
  announce_end(status);
  ::_exit(status);
}

[[noreturn]] void be_child(const Call& call, const sigset_t& before) {
  (void)::prctl(PR_SET_PDEATHSIG, SIGKILL);  // otherwise it would run on after its parent
  (void)::sigprocmask(SIG_SETMASK, &before, nullptr);
  watch_for_interrupt();
  const int status = execute_to_its_end(call);
  announce_end(status);
  std::exit(status);
}

timespec until(Clock::time_point end) {
  const std::chrono::duration<double> left = std::max(end - Clock::now(), Clock::duration::zero());
  const double whole = std::floor(left.count());
  return {.tv_sec = static_cast<time_t>(whole), .tv_nsec = static_cast<long>((left.count() - whole) * 1e9)};
}

/// The status of the child. Nothing if it did not end in time; it is then killed.
std::optional<int> wait_for(pid_t child, const sigset_t& signals, Clock::time_point end) {
  int status = 0;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    const timespec left = until(end);
    siginfo_t signal{};
    const int number = ::sigtimedwait(&signals, &signal, &left);
    // Signals from a terminal also reach the child; others are passed on.
    if ((number == SIGINT || number == SIGTERM) && signal.si_code == SI_USER) (void)::kill(child, number);
    if (number > 0 || errno == EINTR || Clock::now() < end) continue;
    (void)::kill(child, SIGKILL);
    (void)::waitpid(child, &status, 0);
    return std::nullopt;
  }
  return status;
}

std::string crash(int signal, const Call& call) {
  return std::string("the process of the command was ended by a signal (") + ::strsignal(signal) +
         "); it had the plugins: " + names(call.plugins);
}

std::string early_end(int status, const Call& call) {
  return "a plugin ended the program (_exit, status " + std::to_string(status) +
         "); there were the plugins: " + names(call.plugins);
}

std::string no_end(const Call& call) {
  constexpr int digits = 6;
  return "the command did not end within " + core::format_number(call.isolation, digits) +
         " s, the limit of --isolate-plugins, and was stopped; it had the plugins: " + names(call.plugins);
}

}  // namespace

int execute_to_its_end(const Call& call) noexcept {
  if (!call.plugins.empty() && std::atexit(end_unfinished) == 0) unfinished = &call;
  const int status = execute(call);
  unfinished = nullptr;
  return status;
}

void announce_end(int status) noexcept {
  if (announced != nullptr) *announced = status;
}

int execute_isolated(const Call& call) noexcept {
  sigset_t signals;
  sigset_t before;
  sigemptyset(&signals);
  for (const int number : {SIGCHLD, SIGINT, SIGTERM}) sigaddset(&signals, number);
  (void)::sigprocmask(SIG_BLOCK, &signals, &before);
  const Clock::time_point end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(call.isolation));
  const pid_t child = share_announcement() ? ::fork() : -1;
  if (child == 0) be_child(call, before);
  if (child < 0)
    return say(ExitStatus::usage, std::string("no process for --isolate-plugins: ") + std::strerror(errno), call);
  const std::optional<int> status = wait_for(child, signals, end);
  if (!status) return say(ExitStatus::numerical_failure, no_end(call), call);
  // Nobody reads the output any more, which ends this process in the same way.
  if (WIFSIGNALED(*status) && WTERMSIG(*status) == SIGPIPE) (void)::raise(SIGPIPE);
  if (!WIFEXITED(*status)) return say(ExitStatus::numerical_failure, crash(WTERMSIG(*status), call), call);
  const int exited = WEXITSTATUS(*status);
  if (exited == *announced) return exited;
  return say(ExitStatus::numerical_failure, early_end(exited, call), call);
}

}  // namespace dualdamp::cli
