#include "experiments/view/replay_blocks.h"

#include <cstddef>
#include <utility>

namespace kds {

void BlockBytes::add_varint(std::int64_t value) {
  auto rest = (static_cast<std::uint64_t>(value) << 1U) ^ static_cast<std::uint64_t>(value >> 63);
  for (; rest >= 0x80; rest >>= 7U) add_byte(static_cast<std::uint8_t>(rest | 0x80));
  add_byte(static_cast<std::uint8_t>(rest));
}

FrameBlocks::FrameBlocks(std::size_t beads, int degree, std::size_t block_frames, BlockSink sink)
    : beads_(beads), degree_(degree), block_frames_(block_frames), sink_(std::move(sink)) {}

void FrameBlocks::add(Numbers positions, std::span<const Numbers> controls) {
  if (frames_ > 0 && degree_ > 1) add_controls(positions, controls);
  add_positions(positions);
  last_ = std::move(positions);
}

void FrameBlocks::add_positions(const Numbers& positions) {
  const bool begins = frames_ % block_frames_ == 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const std::int64_t before = !begins ? last_[i] : i % beads_ == 0 ? 0 : positions[i - 1];
    positions_.add_varint(positions[i] - before);
  }
  if (++frames_ % block_frames_ == 0) pass_on("positions", frames_, positions_);
}

void FrameBlocks::add_controls(const Numbers& positions, std::span<const Numbers> controls) {
  const std::int64_t d = degree_;
  for (std::int64_t j = 1; j < d; ++j) {
    const Numbers& control = controls[static_cast<std::size_t>(j) - 1];
    for (std::size_t i = 0; i < positions.size(); ++i) {
      // On the straight line, rounded half up.
      const std::int64_t twice = 2 * ((d - j) * last_[i] + j * positions[i]) + d;
      const std::int64_t straight = twice / (2 * d) - (twice % (2 * d) < 0 ? 1 : 0);
      controls_.add_varint(control[i] - straight);
    }
  }
  if (++steps_ % block_frames_ == 0) pass_on("controls", steps_, controls_);
}

void FrameBlocks::pass_on(const char* name, std::size_t frames, BlockBytes& block) {
  sink_(name + ('-' + std::to_string((frames - 1) / block_frames_)), block.bytes());
  block.clear();
}

void FrameBlocks::finish() {
  if (!positions_.empty()) pass_on("positions", frames_, positions_);
  if (!controls_.empty()) pass_on("controls", steps_, controls_);
}

}  // namespace kds
