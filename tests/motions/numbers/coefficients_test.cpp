#include "motions/numbers/bernstein.h"

#include <gtest/gtest.h>

#include <numeric>
#include <type_traits>

#include "motions/numbers/exact_number.h"

namespace kds::coefficients_test {
namespace {

Coefficients<double> counting(std::size_t size) {
  Coefficients<double> row;
  row.resize(size);
  std::iota(row.begin(), row.end(), 1.0);
  return row;
}

void expect_counting(const Coefficients<double>& row, std::size_t size) {
  ASSERT_EQ(row.size(), size);
  EXPECT_EQ(row.end() - row.begin(), static_cast<std::ptrdiff_t>(size));
  for (std::size_t i = 0; i < size; ++i) EXPECT_EQ(row[i], static_cast<double>(i + 1));
}

constexpr std::size_t room = Coefficients<double>::room;

TEST(Coefficients, LieWhereThereIsRoom) {
  for (const std::size_t size : {std::size_t{1}, room - 1, room, room + 1, 5 * room}) {
    SCOPED_TRACE(size);
    const Coefficients<double> row = counting(size);
    expect_counting(row, size);
    EXPECT_EQ(row.back(), static_cast<double>(size));
    const auto* first = reinterpret_cast<const std::byte*>(row.begin());
    const auto* object = reinterpret_cast<const std::byte*>(&row);
    EXPECT_EQ(object <= first && first < object + sizeof row, size <= room);
  }
}

TEST(Coefficients, AreCopiedWhateverTheirLengths) {
  for (const std::size_t from : {std::size_t{3}, room, room + 7, 3 * room}) {
    for (const std::size_t to : {std::size_t{2}, room, room + 1, 4 * room}) {
      const Coefficients<double> row = counting(from);
      const Coefficients<double> copy(row);  // NOLINT: the copy is the thing under test
      expect_counting(copy, from);
      Coefficients<double> assigned = counting(to);
      assigned = row;
      expect_counting(assigned, from);
      assigned[0] = -1;
      expect_counting(row, from);
    }
  }
  Coefficients<double> self = counting(room + 3);
  const Coefficients<double>& same = self;
  self = same;
  expect_counting(self, room + 3);
}

TEST(Coefficients, KeepWhatTheyHaveWhenTheyGrowAndShrink) {
  Coefficients<double> row = counting(5);
  std::size_t known = 5;
  for (const std::size_t size : {room, room + 1, 2 * room, std::size_t{4}, 6 * room}) {
    row.resize(size);
    known = std::min(known, size);
    ASSERT_EQ(row.size(), size);
    for (std::size_t i = 0; i < known; ++i) EXPECT_EQ(row[i], static_cast<double>(i + 1));
    std::iota(row.begin(), row.end(), 1.0);
    known = size;
  }
}

static_assert(std::is_same_v<Coefficients<Integer>, std::vector<Integer>>);

}  // namespace
}  // namespace kds::coefficients_test
