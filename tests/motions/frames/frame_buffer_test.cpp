#include "motions/frames/frame_buffer.h"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include "motions/base/input_error.h"

namespace kds::frame_buffer_test {
namespace {

/// Gives frames of one bead whose x is the number of the frame, and counts how often each frame is read.
class CountedFrames final : public FrameSource {
 public:
  CountedFrames(std::size_t frames, std::size_t fault, std::vector<int>& reads)
      : fault_(fault), reads_(reads) {
    reads_.assign(frames, 0);
  }
  [[nodiscard]] const std::vector<NecklaceBeads>& necklaces() const override { return necklaces_; }
  [[nodiscard]] bool next(FrameRead& frame) override {
    if (next_ == fault_) throw InputError("damaged");
    if (next_ == reads_.size()) return false;
    ++reads_[next_];
    frame.stamp.number = next_;
    frame.positions = Eigen::Matrix3Xd::Constant(3, 1, static_cast<double>(next_));
    ++next_;
    return true;
  }
  void seek(std::size_t k) override { next_ = k; }

 private:
  std::vector<NecklaceBeads> necklaces_{{.count = 1}};
  std::size_t fault_, next_ = 0;
  std::vector<int>& reads_;
};

std::unique_ptr<FrameBuffer> buffer_of(std::size_t frames, std::vector<int>& reads, std::size_t fault = 99) {
  return std::make_unique<FrameBuffer>(std::make_unique<CountedFrames>(frames, fault, reads));
}

void expect_next(FrameSource& source, std::size_t number) {
  FrameRead frame;
  ASSERT_TRUE(source.next(frame));
  EXPECT_EQ(frame.stamp.number, number);
  EXPECT_EQ(frame.positions(0, 0), static_cast<double>(number));
}

TEST(FrameBuffer, ReadsEachFrameOnce) {
  std::vector<int> reads;
  const auto buffer = buffer_of(10, reads);
  for (std::size_t first = 0; first < 9; first += 3) {
    const SharedFrames range = buffer->read_ahead(first, first + 3);
    ASSERT_EQ(range.frames.size(), 4U);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(range.frames[k]->stamp.number, first + k);
    if (first < 3) continue;  // the buffer's own reader follows one range behind
    for (std::size_t k = first - 3; k < first; ++k) {
      expect_next(*buffer, k);
      buffer->release(k);
    }
  }
  for (std::size_t k = 6; k < 10; ++k) expect_next(*buffer, k);
  FrameRead frame;
  EXPECT_FALSE(buffer->next(frame));
  EXPECT_EQ(reads, std::vector<int>(10, 1));
}

TEST(FrameBuffer, ReadsReleasedFramesAgain) {
  std::vector<int> reads;
  const auto buffer = buffer_of(5, reads);
  static_cast<void>(buffer->read_ahead(0, 4));
  buffer->release(3);
  buffer->seek(1);
  for (std::size_t k = 1; k < 5; ++k) expect_next(*buffer, k);
  EXPECT_EQ(reads, (std::vector<int>{1, 2, 2, 1, 1}));
}

TEST(FrameBuffer, PassesAnErrorOnAfterTheFramesBeforeIt) {
  std::vector<int> reads;
  const auto buffer = buffer_of(10, reads, 5);
  const SharedFrames before = buffer->read_ahead(0, 4), reaching = buffer->read_ahead(4, 8),
                     later = buffer->read_ahead(6, 9);
  EXPECT_EQ(before.error, nullptr);
  EXPECT_EQ(reaching.frames.size(), 1U);
  EXPECT_THROW(std::rethrow_exception(reaching.error), InputError);
  EXPECT_TRUE(later.frames.empty());
  EXPECT_NE(later.error, nullptr);
  FrameRanges ranges(buffer->necklaces());
  ranges.add(before);
  ranges.add(reaching);
  for (std::size_t k = 0; k < 5; ++k) expect_next(ranges, k);
  FrameRead frame;
  EXPECT_THROW(static_cast<void>(ranges.next(frame)), InputError);
}

TEST(FrameRanges, JoinsRangesThatOverlap) {
  std::vector<int> reads;
  const auto buffer = buffer_of(10, reads);
  FrameRanges ranges(buffer->necklaces());
  ranges.add(buffer->read_ahead(2, 5));
  ranges.seek(3);
  expect_next(ranges, 3);
  ranges.add(buffer->read_ahead(4, 9));
  ranges.release(4);
  for (std::size_t k = 4; k < 10; ++k) expect_next(ranges, k);
  ranges.seek(3);
  FrameRead frame;
  EXPECT_THROW(static_cast<void>(ranges.next(frame)), std::logic_error);
  EXPECT_THROW(ranges.add({20, {}, {}}), std::logic_error);
}

}  // namespace
}  // namespace kds::frame_buffer_test
