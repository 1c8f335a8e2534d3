#pragma once
/// Standard deviation of white noise on a signal that is smooth except for jumps and kinks, such as the force of
/// friction or an acceleration: by its differences of fourth order (`noise_level.hpp`), without those that are too
/// large for noise and without their neighbours. Where that is not clearly smaller than `robust_noise_level`, it is
/// the latter.
///
/// A sharp jump makes four differences that are far too large. A contact that yields within some samples makes more
/// of them, some of which could pass for noise.

#include <span>

namespace dualdamp::identify {

/// 0 for fewer than five samples. Cost: linear.
[[nodiscard]] double noise_between_jumps(std::span<const double> signal);

}  // namespace dualdamp::identify
