// One declaration of columns gives JSON, CSV, text and HTML.

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
    {"cost.time", "time", [](const Row& r) { return Field(r.time); }, with_decimals(2), Shown::in_text},
    {.key = "cost.long", .value = [](const Row& r) { return Field(r.time ? Field(*r.time > 1) : Field()); }},
    {.heading = "page", .value = [](const Row&) { return Field("<b>"); }, .shown = Shown::on_pages},
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

TEST(Table, PagesEscapeAndLeaveOutColumnsOfTheTerminal) {
  const std::string html = table.html(rows);
  EXPECT_THAT(html, HasSubstr("&lt;b&gt;"));
  EXPECT_THAT(html, Not(HasSubstr("time")));
  EXPECT_THAT(html, HasSubstr("12,345"));
}

TEST(Table, WithoutRowsHasAHeaderOnly) {
  EXPECT_EQ(table.csv({}), "name,count,time,long\n");
  EXPECT_EQ(table.text({}), "name  count  time\n");
  EXPECT_EQ(text_of(table.json({})), "[]\n");
}

}  // namespace
}  // namespace kds::table_test
