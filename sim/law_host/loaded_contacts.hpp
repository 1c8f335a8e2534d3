#pragma once
/// Contacts that are loaded when a motion begins, as in a record cut out of a running test, or after a pull.
///
/// Before t = 0 the mass has moved by `travel` [m], at constant speed within one second, from a place where all
/// laws were unloaded. Laws that remember the path of the mass (`Law::remembers_path`) begin with what that motion
/// leaves: a contact spring with the stretch `travel`, or with that of break-away if `travel` is larger. All other
/// laws start as without it. One number thus gives every state of a law with a single spring. Of a law of several
/// elements it gives those of the first loading.
///
/// Cost: that of the law along this path.

#include "sim/law_host/law_host.hpp"
#include "sim/model.hpp"

namespace dualdamp::sim {

/// Sets the memories of the initial state. False if a law cannot be moved so far: they are empty then. Zero
/// travel: the laws start unloaded.
[[nodiscard]] bool load_contacts(Model& model, double travel);

/// The host of one law after this path, at `at`. Its direction is that of the path, or none without one.
[[nodiscard]] LawHost loaded_host(const friction::Law& law, const friction::Instant& at, double travel);

}  // namespace dualdamp::sim
