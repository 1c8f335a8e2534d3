#pragma once
/// JSON values inside this folder; public headers carry JSON as text.

#include <nlohmann/json.hpp>

namespace dualdamp::scenarios {

/// Keys keep the order in which they were added: that of the tables and of the contract.
using Json = nlohmann::ordered_json;

}  // namespace dualdamp::scenarios
