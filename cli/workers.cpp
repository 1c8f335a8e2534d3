#include "cli/workers.hpp"

#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace dualdamp::cli {

void share_among(std::size_t threads, std::size_t count, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr fault;
  const auto take = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) work(i);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!fault) fault = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::jthread> others;
    others.reserve(threads);
    bool has_more = true;
    while (has_more && others.size() + 1 < threads) {
      try {
        others.emplace_back(take);
      } catch (const std::system_error&) {
        has_more = false;  // the threads that there are take the items of the others
      }
    }
    take();
  }
  if (fault) std::rethrow_exception(fault);
}

}  // namespace dualdamp::cli
