#pragma once
// A session for one type of motion. Each is compiled in a file of its own, made from session_instance.cpp.in.

#include <memory>

#include "experiments/run/session.h"
#include "motions/curves/bezier_motion.h"

namespace kds {

/// Of motions in the program: a power test of 5 times that degree has binomials that still fit 64 bits.
inline constexpr int highest_degree = 10;
/// Above this one they run in whole numbers only.
inline constexpr int highest_filtered_degree = 3;

template <Motion M>
[[nodiscard]] std::unique_ptr<Session> make_session_of(const Scene& scene, const SessionOptions& options);

}  // namespace kds
