#pragma once
/// The numbers each analysis returns: the reference page lists them, an `expect` is checked against them before
/// anything runs, and the printed summary takes names and units from them. answer.cpp fills them in.

#include <string>
#include <vector>

namespace dualdamp::scenarios {

struct ResultField {
  std::string path;  ///< into the result, with `[]` for any index
  std::string unit;  ///< SI; "1" for a plain number, empty for what is no number
  std::string meaning;
};

/// Of an analysis by name; of a formula by its name too.
[[nodiscard]] std::vector<ResultField> result_fields(const std::string& analysis, const std::string& formula = {});

}  // namespace dualdamp::scenarios
