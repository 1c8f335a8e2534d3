#pragma once
/// Treatment of the cases of an earlier run by a campaign.

namespace dualdamp::scenarios {

/// Cases that are in its directory before it begins.
enum class FoundCases {
  refuse,     ///< except complete cases of this same campaign, which are kept
  resume,     ///< cases of this campaign are kept, others refused
  overwrite,  ///< they are deleted
};

}  // namespace dualdamp::scenarios
