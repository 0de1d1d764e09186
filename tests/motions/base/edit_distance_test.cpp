#include "motions/base/text_input.h"

#include <gtest/gtest.h>

namespace kds::edit_distance_test {
namespace {

TEST(EditDistance, CountsEdits) {
  EXPECT_EQ(edit_distance("", ""), 0U);
  EXPECT_EQ(edit_distance("", "pbc"), 3U);
  EXPECT_EQ(edit_distance("lattice", "lattice"), 0U);
  EXPECT_EQ(edit_distance("latice", "lattice"), 1U);
  EXPECT_EQ(edit_distance("latitce", "lattice"), 1U);  // an exchange of two letters counts once
  EXPECT_EQ(edit_distance("property", "properties"), 3U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("sitting", "kitten"), 3U);
  EXPECT_EQ(edit_distance("ca", "abc"), 3U);  // no letter is edited twice
}

}  // namespace
}  // namespace kds::edit_distance_test
