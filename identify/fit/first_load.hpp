#pragma once
/// The load of contacts at the first sample of a record.
///
/// A law that remembers the path of the mass starts unloaded. In a record that was cut out of a running test, or
/// begins with the release from a pull, its contacts are loaded already. The `travel` of the record
/// (`sim/law_host/loaded_contacts.hpp`) gives this load. It is sought if the readings show it:
///
///   1. The fit with unloaded contacts is predicted with travels of either sign, from 1e-4 of the motion to all of
///      it. What the other parameters can make up for, to first order, does not count.
///   2. From the best of these, a search seeks the travel as well. If the residuals of the record are more than
///      noise with both fits, and there is no other record, all steps of a search are repeated with it.
///   3. The travel is kept if it reduces the sum of squares by more than chance does (F test, 0.002). So one in
///      some hundred records that begin unloaded gets a travel, which then is near zero.
///
/// Contacts that had yielded have the same state after any longer travel. It is then known, and not sought.
///
/// Cost: some 20 motions; if the readings show a load, that of a fit from good starts.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "identify/fit/problem.hpp"
#include "identify/fit/search/search.hpp"

namespace dualdamp::identify {

struct LoadedFit {
  std::unique_ptr<FitTask> task;
  SearchResult found;
  std::string text;  ///< what was found, for the user
};

/// The fit with a load of the contacts of record `index` at its first sample. Nothing if the readings show none, or
/// if it is known, sought already, or without effect. `before`: a fit without it; `length`: of the motion [m].
[[nodiscard]] std::optional<LoadedFit> with_first_load(const FitTask& before, const SearchResult& found,
                                                       std::size_t index, double length,
                                                       const SearchOptions& options, long most_work);

}  // namespace dualdamp::identify
