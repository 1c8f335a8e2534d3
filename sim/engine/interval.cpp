#include "sim/engine/interval.hpp"

namespace dualdamp::sim {

std::string_view name_of(EventKind kind) {
  switch (kind) {
    case EventKind::reversal:
      return "reversal";
    case EventKind::stop:
      return "stop";
    case EventKind::release:
      return "release";
    case EventKind::grazing:
      return "grazing";
    case EventKind::switching:
      return "switching";
  }
  return "";
}

}  // namespace dualdamp::sim
