#include "experiments/output/result_manifest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "experiments/output/output_files.h"
#include "experiments/output/result_json.h"
#include "experiments/output/spool.h"
#include "motions/base/input_error.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::result_manifest_test {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::ScratchDirectory;
using testing::HasSubstr;

void write_result(const ScratchDirectory& directory, std::initializer_list<const char*> names,
                  const std::string& content = "x") {
  AtomicFiles files(directory.path(), "collide", "--out");
  for (const char* name : names) files.write(name, content);
  commit_together({&files});
}

std::string refusal(const ScratchDirectory& directory, const char* command, const std::string& name) {
  try {
    ResultManifest(directory.path(), command, "--out").require_own(name);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(ResultManifest, KnowsItsOwnFilesByTheirContent) {
  const ScratchDirectory directory;
  write_result(directory, {"a.csv", "b.csv"});
  EXPECT_EQ(refusal(directory, "collide", "a.csv"), "");
  EXPECT_EQ(refusal(directory, "collide", "none.csv"), "");
  EXPECT_THAT(refusal(directory, "info", "a.csv"), HasSubstr("a.csv there was written by kds collide --out"));
  directory.file("a.csv", "y");
  EXPECT_THAT(refusal(directory, "collide", "a.csv"), HasSubstr("has changed since kds collide --out"));
  EXPECT_THAT(refusal(directory, "info", "a.csv"), HasSubstr("a.csv there was not written by kds info"));
  directory.file("c.csv", "x");
  EXPECT_THAT(refusal(directory, "collide", "c.csv"), HasSubstr("was not written by kds collide --out"));
}

TEST(ResultManifest, ALaterResultTakesAwayWhatIsStaleAndUnchanged) {
  const ScratchDirectory directory;
  write_result(directory, {"a.csv", "b.csv", "c.csv"});
  directory.file("b.csv", "edited");
  write_result(directory, {"c.csv"}, "new");
  EXPECT_FALSE(fs::exists(directory / "a.csv"));
  EXPECT_EQ(content_of(directory / "b.csv"), "edited");
  EXPECT_EQ(content_of(directory / "c.csv"), "new");
  EXPECT_THROW(write_result(directory, {"b.csv"}), InputError);
  EXPECT_EQ(content_of(directory / "c.csv"), "new");
}

// A program that is killed while files are moved to their places leaves a manifest that covers both results.
TEST(ResultManifest, ListsTwoVersionsOfAFile) {
  const ScratchDirectory directory;
  write_result(directory, {"a.csv"}, "old");
  const std::string old = ResultManifest(directory.path(), "collide", "--out").lines();
  write_result(directory, {"a.csv"}, "new");
  std::ofstream(ResultManifest(directory.path(), "collide", "--out").path(), std::ios::app) << old;
  EXPECT_EQ(refusal(directory, "collide", "a.csv"), "");
  directory.file("a.csv", "old");
  EXPECT_EQ(refusal(directory, "collide", "a.csv"), "");
  directory.file("a.csv", "other");
  EXPECT_NE(refusal(directory, "collide", "a.csv"), "");
}

TEST(ResultManifest, AnotherFileInItsPlaceIsRefused) {
  const ScratchDirectory directory;
  directory.file(".kds-collide-out.files", "notes\n");
  EXPECT_THROW(write_result(directory, {"a.csv"}), InputError);
  EXPECT_EQ(content_of(directory / ".kds-collide-out.files"), "notes\n");
  EXPECT_EQ(directory.entries(), 1U);
}

TEST(Spool, GivesBackAllInOrder) {
  Spool spool;
  EXPECT_TRUE(spool.empty());
  std::string expected, found;
  for (int k = 0; k < 30000; ++k) {
    spool.add(std::to_string(k));
    expected += std::to_string(k);
  }
  const auto read = [&] {
    found.clear();
    spool.read([&](std::string_view text) { found += text; });
    return found;
  };
  EXPECT_EQ(read(), expected);
  spool.add("end");
  EXPECT_EQ(read(), expected + "end");
}

TEST(JsonItems, AreWrittenAsTheArrayInMemoryIs) {
  for (const int count : {0, 1, 5}) {
    Json object{
        {"rows", {{"frames", Json::array()}}}, {"text", "a\n  \"frames\": []"}, {"frames", Json::array()}};
    const Json without = object;
    object["last"] = 1;
    Json last = without;
    last["last"] = 1;
    JsonItems items;
    for (int k = 0; k < count; ++k) {
      const Json item{{"k", k}, {"of", std::vector<int>{k, k}}, {"none", Json::array()}};
      object["frames"].push_back(item);
      items.add(item);
    }
    std::string text;
    items.write_within(last, "frames", [&](std::string_view part) { text += part; });
    EXPECT_EQ(text, text_of(object));
  }
}

}  // namespace
}  // namespace kds::result_manifest_test
