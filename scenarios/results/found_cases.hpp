#pragma once
/// What a campaign does about cases of an earlier run.

namespace dualdamp::scenarios {

/// Cases that are in its directory before it begins.
enum class FoundCases {
  refuse,     ///< but for those of this campaign when none is missing: they are kept
  resume,     ///< those of this campaign are kept, others refused
  overwrite,  ///< they are lost
};

}  // namespace dualdamp::scenarios
