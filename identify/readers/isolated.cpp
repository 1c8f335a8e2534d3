#include "identify/readers/isolated.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <new>
#include <system_error>
#include <utility>

namespace dualdamp::identify {

namespace {

using Clock = std::chrono::steady_clock;

/// Marks the end of the bytes that `work` has written. A caller that ignores SIGCHLD cannot get the child's status.
constexpr char complete_mark = '\x06';

constexpr int status_of_exception = 1;
constexpr int status_of_memory = 2;

/// A file descriptor that the destructor closes.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor() { close(); }

  void close() {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

/// Bytes of address space in use; 0 if the system does not state them.
std::size_t address_space() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

/// Restores the default handling of signals: the child must not run the handlers of the caller.
void reset_signals() {
  for (const int number : {SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSEGV, SIGINT, SIGTERM, SIGXCPU, SIGPIPE})
    std::signal(number, SIG_DFL);
}

void limit(__rlimit_resource resource, rlim_t soft, rlim_t hard) {
  const rlimit both{soft, hard};
  ::setrlimit(resource, &both);
}

void set_limits(const IsolationLimits& limits, [[maybe_unused]] std::size_t used) {
  limit(RLIMIT_CORE, 0, 0);
  // The soft limit sends a signal (SIGXCPU), the hard limit kills the process.
  const auto seconds = static_cast<rlim_t>(limits.processor_time.count());
  limit(RLIMIT_CPU, seconds, seconds + 1);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // they reserve terabytes of address space
  if (used > 0) limit(RLIMIT_AS, used + limits.memory, used + limits.memory);
#endif
}

/// Drops the messages of the libraries and of the allocator about the damaged file.
void drop_standard_error() {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere < 0 || nowhere == STDERR_FILENO) return;
  ::dup2(nowhere, STDERR_FILENO);
  ::close(nowhere);
}

/// Closes all inherited files but those of this child. A pipe of another thread's child ends only if no process
/// holds its writing end.
void keep_only(int pipe) {
  constexpr int first = STDERR_FILENO + 1;
  if (pipe > first) ::close_range(first, static_cast<unsigned>(pipe) - 1, 0);
  ::close_range(static_cast<unsigned>(std::max(first, pipe + 1)), ~0U, 0);
}

[[noreturn]] void run_child(const IsolationLimits& limits, pid_t parent, std::size_t used, int pipe,
                            const std::function<void(const ByteSink&)>& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(status_of_exception);  // the parent ended before the line above
  keep_only(pipe);
  reset_signals();
  drop_standard_error();
  set_limits(limits, used);
  const auto send = [pipe](std::span<const char> bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(pipe, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) ::_exit(status_of_exception);
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
  };
  int status = 0;
  try {
    work(send);
    send({&complete_mark, 1});
  } catch (const std::bad_alloc&) {
    status = status_of_memory;
  } catch (...) {
    status = status_of_exception;
  }
  ::_exit(status);
}

/// Reads up to the end of the pipe. False at the deadline.
bool collect(int pipe, Clock::time_point deadline, std::string& bytes) {
  std::array<char, 1U << 16U> buffer;  // NOLINT(cppcoreguidelines-pro-type-member-init): read() fills it
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd ready{pipe, POLLIN, 0};
    const int count = ::poll(&ready, 1, static_cast<int>(std::max<std::int64_t>(left, 0)));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    const ssize_t size = ::read(pipe, buffer.data(), buffer.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return true;
    bytes.append(buffer.data(), static_cast<std::size_t>(size));
  }
}

IsolatedEnd reason_of(int status) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) return IsolatedEnd::out_of_time;
  if (WIFEXITED(status) && WEXITSTATUS(status) == status_of_memory) return IsolatedEnd::out_of_memory;
  return IsolatedEnd::crashed;
}

}  // namespace

IsolatedResult run_isolated(const IsolationLimits& limits, const std::function<void(const ByteSink&)>& work) {
  IsolatedResult result;
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  Descriptor from(ends[0]);
  Descriptor to(ends[1]);
  const Clock::time_point deadline = Clock::now() + limits.wall_clock;
  const std::size_t used = address_space();
  const pid_t parent = ::getpid();
  const pid_t child = ::fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) run_child(limits, parent, used, to.number(), work);
  to.close();
  const bool ended = collect(from.number(), deadline, result.bytes);
  if (!ended) ::kill(child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (ended && result.bytes.ends_with(complete_mark)) {
    result.end = IsolatedEnd::done;
    result.bytes.pop_back();
    return result;
  }
  result.end = ended ? reason_of(status) : IsolatedEnd::out_of_time;
  result.bytes.clear();
  return result;
}

}  // namespace dualdamp::identify
