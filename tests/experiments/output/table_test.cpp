// One declaration of columns gives JSON, CSV and text.

#include "experiments/output/table.h"

#include <gmock/gmock.h>

#include <array>
#include <limits>
#include <nlohmann/json.hpp>

namespace kds::table_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

struct Row {
  std::string name;
  std::size_t count = 0;
  std::optional<double> time;
};

const Table<Row> table{{
    {"name", "name", [](const Row& r) { return Field(r.name); }},
    {"count", "count", [](const Row& r) { return Field(r.count); }},
    {"cost.time", "time", [](const Row& r) { return Field(r.time); }, with_decimals(2)},
    {.key = "cost.long", .value = [](const Row& r) { return Field(r.time ? Field(*r.time > 1) : Field()); }},
}};
const std::array<Row, 3> rows{Row{"a,b", 12345, 1.0 / 3}, Row{"c", 7, std::nullopt},
                              Row{"d", 0, std::numeric_limits<double>::infinity()}};

TEST(Table, JsonNestsMembersAndOmitsWhatHasNoKey) {
  const auto json = nlohmann::json::parse(text_of(table.json(rows)));
  const auto expected = nlohmann::json::parse(R"([
    {"name": "a,b", "count": 12345, "cost": {"time": 0.3333333333333333, "long": false}},
    {"name": "c", "count": 7, "cost": null},
    {"name": "d", "count": 0, "cost": {"time": null, "long": true}}])");
  EXPECT_EQ(json, expected);
}

TEST(Table, CsvReadsBack) {
  EXPECT_EQ(table.csv(rows),
            "name,count,time,long\n\"a,b\",12345,0.3333333333333333,false\nc,7,,\nd,0,inf,true\n");
}

TEST(Table, TextAlignsNumbersAtTheRight) {
  EXPECT_EQ(table.text(rows, "  "),
            "  name   count  time\n"
            "  a,b   12,345  0.33\n"
            "  c          7     -\n"
            "  d          0   inf\n");
}

TEST(Table, WithoutRowsHasAHeaderOnly) {
  EXPECT_EQ(table.csv({}), "name,count,time,long\n");
  EXPECT_EQ(table.text({}), "name  count  time\n");
  EXPECT_EQ(text_of(table.json(std::span<const Row>())), "[]\n");
}

const Table<Row> extended =
    Table<Row>{
        {
            {.key = "name", .heading = "name", .value = [](const Row& r) { return text_or_nothing(r.name); }},
            {.key = "list",
             .json =
                 [](const Row& r) {
                   return Json(std::vector{r.count, r.count});
                 }},
        }}
        .add({
            {.key = "time", .value = [](const Row& r) { return Field(r.time); }, .optional = true},
            {.key = "many",
             .heading = "many",
             .value = [](const Row& r) { return Field(r.count > 10); },
             .words = [](const Row& r) { return r.name + "!\n"; }},
        });

TEST(Table, JsonHasListsAndLeavesOutOptionalMembers) {
  EXPECT_EQ(nlohmann::json::parse(text_of(extended.json(rows[1]))),
            nlohmann::json::parse(R"({"name": "c", "list": [7, 7], "many": false})"));
  EXPECT_EQ(extended.csv_header() + extended.csv_line(rows[1]) + extended.csv_line({}),
            "name,time,many\nc,,false\n,,false\n");
}

TEST(Table, WordsReplaceTheFormatAndStayOneLine) {
  EXPECT_EQ(extended.lines(rows),
            (std::vector<std::string>{"name  many", "a,b   a,b!", "c     c!", "d     d!"}));
}

}  // namespace
}  // namespace kds::table_test
