#pragma once
/// A number that a result may hold. The reference page lists them, an `expect` is checked against them before
/// anything runs, and the printed summary takes names and units from them.

#include <string>

namespace dualdamp::scenarios {

struct ResultField {
  std::string path;  ///< into the result, with `[]` for any index
  std::string unit;  ///< SI; "1" for a plain number, empty for what is no number
  std::string meaning;
};

}  // namespace dualdamp::scenarios
