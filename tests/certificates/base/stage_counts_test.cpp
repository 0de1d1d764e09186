#include "certificates/base/kernel.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace kds::stage_counts_test {
namespace {

TEST(Stages, AreEachListedOnce) {
  StageCounts counts;
  std::set<std::string_view> names;
  for (const Stage& stage : stage_table) {
    EXPECT_EQ(counts.*stage.count, 0U) << stage.name << " counts what another one does";
    counts.*stage.count = 1;
    EXPECT_TRUE(names.insert(stage.name).second) << stage.name;
    EXPECT_FALSE(stage.label.empty()) << stage.name;
  }
}

TEST(Stages, AddUpButForSizes) {
  StageCounts sum, more;
  for (const Stage& stage : stage_table) {
    sum.*stage.count = 5;
    more.*stage.count = 3;
  }
  sum += more;
  for (const Stage& stage : stage_table)
    EXPECT_EQ(sum.*stage.count, stage.of == Stage::Of::size ? 5U : 8U) << stage.name;
}

// Each row of the table in docs/exactness.md begins with a key that the results use.
TEST(Stages, AreThoseOfTheDocuments) {
  std::ifstream file(KDS_DATA_DIR "/../docs/exactness.md");
  ASSERT_TRUE(file.is_open());
  std::vector<std::string> documented, expected;
  bool in_table = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("| key | the decision came from |")) in_table = true;
    if (line.empty()) in_table = false;
    if (in_table && line.starts_with("| `")) documented.push_back(line.substr(3, line.find('`', 3) - 3));
  }
  for (const Stage& stage : stage_table) expected.emplace_back(stage.name);
  EXPECT_EQ(documented, expected);
}

}  // namespace
}  // namespace kds::stage_counts_test
