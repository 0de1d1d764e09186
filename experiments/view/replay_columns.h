#pragma once
// Encodes the events of a structure and the changes of its layers, column by column (docs/formats.md): equal
// columns compress well, and most numbers are small differences.

#include "experiments/view/replay_blocks.h"
#include "structures/session/replay_recorder.h"

namespace kds {

/// Times of events are whole multiples of 1 / `replay_time_scale` of a step.
inline constexpr double replay_time_scale = 0x1p32;

/// A time of a step for display, in multiples of 1 / `replay_time_scale`. If `reach` is 0, the time is
/// exactly `middle`. Otherwise the time lies strictly between `middle` - 2^(`reach` - 1) and `middle` +
/// 2^(`reach` - 1).
struct ShownTime {
  std::int64_t middle = 0;
  std::uint8_t reach = 0;
};
/// Returns the narrowest shown time around the middle of a bracket in [0, 1]. A time after 0 is shown after
/// 0, so that it does not belong to the frame.
[[nodiscard]] ShownTime shown_time(double lower, double upper);

/// Returns the bytes of a block `events-S`.
[[nodiscard]] BlockBytes event_columns(const ReplayRecorder::Events& events);
/// Returns the bytes of a block `changes-S-L` of a layer whose changes are made by `events`.
[[nodiscard]] BlockBytes change_columns(const ReplayRecorder::Layer& layer,
                                        const ReplayRecorder::Events& events);

}  // namespace kds
