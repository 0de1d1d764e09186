// Public queries of continuous collision, and the files that hold them.

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>

#include "experiments/impacts/query_file.h"
#include "structures/impacts/impact_search.h"

namespace kds::test::ccd_test {
namespace {

namespace fs = std::filesystem;

/// Answers all queries of files in folders of this name; returns their number.
std::size_t answer_all(const std::string& folder, ImpactKind kind, std::size_t& collide) {
  ImpactSearch search(kind);
  std::size_t queries = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(KDS_DATA_DIR) / "ccd")) {
    if (entry.path().extension() != ".gz" || entry.path().parent_path().filename() != folder) continue;
    QueryFile file(entry.path());
    ImpactQuery query;
    for (std::size_t in_file = 0; file.next(query); ++in_file, ++queries) {
      const auto all = search.all_impacts(query.points);
      EXPECT_EQ(query.answer, !all.empty()) << entry.path() << ", query " << in_file;
      if (!all.empty()) ++collide;
      for (std::size_t k = 1; k < all.size(); ++k) EXPECT_LE(all[k - 1].upper, all[k].upper);
      // The step backwards has as many impacts, unless they last.
      std::array<double, 24> backwards = query.points;
      for (std::size_t point = 0; point < 4; ++point)
        std::swap_ranges(&backwards[6 * point], &backwards[6 * point + 3], &backwards[6 * point + 3]);
      EXPECT_EQ(search.first_impact(backwards).has_value(), !all.empty()) << entry.path();
    }
  }
  return queries;
}

TEST(Ccd, PublicQueriesOfEdges) {
  std::size_t collide = 0;
  EXPECT_EQ(answer_all("edge-edge", ImpactKind::edge_edge, collide), 2944U);
  EXPECT_EQ(collide, 108U);
}
TEST(Ccd, PublicQueriesOfFaces) {
  std::size_t collide = 0;
  EXPECT_EQ(answer_all("vertex-face", ImpactKind::vertex_face, collide), 1835U);
  EXPECT_EQ(collide, 187U);
}

}  // namespace
}  // namespace kds::test::ccd_test
