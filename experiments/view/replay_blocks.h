#pragma once
// The data blocks of a replay page (docs/formats.md): numbers as bytes, compressed, in base64.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kds {

/// The bytes of a block before compression. Numbers are little endian.
class BlockBytes {
 public:
  void add_byte(std::uint8_t byte) { bytes_.push_back(static_cast<char>(byte)); }
  void add_word(std::uint32_t word) { add_little_endian(word, 4); }
  void add_double(double value) { add_little_endian(std::bit_cast<std::uint64_t>(value), 8); }
  /// Adds a signed number as a zigzag varint (LEB128): 7 bits a byte, the lowest first.
  void add_varint(std::int64_t value);
  void add(const BlockBytes& others) { bytes_ += others.bytes_; }

  [[nodiscard]] std::string_view bytes() const { return bytes_; }
  [[nodiscard]] bool empty() const { return bytes_.empty(); }
  void clear() { bytes_.clear(); }

 private:
  void add_little_endian(std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) add_byte(static_cast<std::uint8_t>(value >> (8 * i)));
  }

  std::string bytes_;
};

/// Receives a finished block.
using BlockSink = std::function<void(const std::string& name, std::string_view bytes)>;

/// Encodes the frames of a replay as blocks `positions-K`, and the curves between frames as blocks
/// `controls-K`. Holds one block of each in memory.
class FrameBlocks {
 public:
  /// Numbers of one frame or control point: all beads on the first axis, then on the next.
  using Numbers = std::vector<std::int32_t>;

  FrameBlocks(std::size_t beads, int degree, std::size_t block_frames, BlockSink sink);

  /// Adds a frame. `controls` are the inner control points of the step that ends at this frame, one after
  /// another. There are none for the first frame or for a motion of degree 1.
  void add(Numbers positions, std::span<const Numbers> controls);
  /// Passes on the last blocks.
  void finish();

 private:
  void add_positions(const Numbers& positions);
  void add_controls(const Numbers& positions, std::span<const Numbers> controls);
  void pass_on(const char* name, std::size_t frames, BlockBytes& block);

  std::size_t beads_;
  int degree_;
  std::size_t block_frames_, frames_ = 0, steps_ = 0;
  BlockSink sink_;
  Numbers last_;
  BlockBytes positions_, controls_;
};

}  // namespace kds
