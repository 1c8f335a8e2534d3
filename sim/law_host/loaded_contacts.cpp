#include "sim/law_host/loaded_contacts.hpp"

namespace dualdamp::sim {

using friction::Direction;
using friction::Instant;

bool load_contacts(Model& model, double travel) {
  InitialState& initial = model.initial;
  initial.travel = travel;
  initial.memories.clear();
  initial.direction = Direction::none;
  if (travel == 0.0) return true;
  const Direction direction = friction::direction_of(travel);
  const Instant now{.x = initial.position, .v = initial.velocity};
  for (const friction::Law& law : model.friction) {
    LawHost host = loaded_host(law, now, travel);
    if (host.direction() != direction) host.change_direction(direction);
    if (host.broken()) {
      initial.memories.clear();
      return false;
    }
    initial.memories.push_back(host.memory());
  }
  initial.direction = direction;
  return true;
}

LawHost loaded_host(const friction::Law& law, const Instant& at, double travel) {
  if (travel == 0.0 || !law.remembers_path()) return {law, at};
  constexpr long most_steps = 100'000;
  LawHost host(law, {.t = at.t - 1.0, .x = at.x - travel});
  host.limit_steps(most_steps);
  host.move_to(at.x);
  host.set_speed(at.v);
  return host;
}

}  // namespace dualdamp::sim
