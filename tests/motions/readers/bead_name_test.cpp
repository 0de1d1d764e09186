#include "motions/readers/bead_name.h"

#include <gtest/gtest.h>

namespace kds::bead_name_test {
namespace {

TEST(BeadName, GoesToTextAndBack) {
  for (const BeadName& name : {BeadName{"CA", "ALA", "12", "A"}, BeadName{"O5'", "DG", "-3B", ""},
                               BeadName{"N", "SEP", "52A", "AAA-2"}}) {
    const auto again = bead_name_of(text_of(name));
    ASSERT_TRUE(again) << text_of(name);
    EXPECT_EQ(*again, name);
  }
  EXPECT_EQ(text_of({"CA", "ALA", "12", "A"}), "CA of ALA 12 in chain A");
  EXPECT_EQ(text_of({"CA", "ALA", "12", ""}), "CA of ALA 12 in chain ' '");
  EXPECT_EQ(residue_text({"CA", "ALA", "12", "A"}, true), "ALA 12 in chain A");
  EXPECT_EQ(residue_text({"CA", "ALA", "12", "A"}, false), "ALA 12");
  EXPECT_EQ(residue_text({"CA", "ALA", "12", ""}, true), "ALA 12");
}

TEST(BeadName, OtherTextsAreNone) {
  for (const char* text : {"", "CA", "CA of ALA in chain A", " in chain A of ALA 12", "CA of ALA 12"})
    EXPECT_FALSE(bead_name_of(text)) << text;
}

}  // namespace
}  // namespace kds::bead_name_test
