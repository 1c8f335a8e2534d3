#pragma once
#include <set>
#include <string>
#include <vector>

namespace dualdamp::sim {

/// A list of faults with each kind of fault once.
class Faults {
 public:
  void add(const std::string& kind) {
    if (kinds_.insert(kind).second) list_.push_back(kind);
  }
  [[nodiscard]] const std::vector<std::string>& list() const { return list_; }

 private:
  std::set<std::string> kinds_;
  std::vector<std::string> list_;
};

}  // namespace dualdamp::sim
