#pragma once
// Checks that a page is well formed and self-contained, and stays a valid page for any file names.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace kds::test {

inline std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t times = 0;
  for (std::size_t place = 0; (place = text.find(word, place)) != std::string::npos; place += word.size())
    ++times;
  return times;
}

// Every tag is closed in order. Apart from <meta> and the declaration, the page is written like XML.
inline void expect_nested(const std::string& html) {
  std::vector<std::string> open;
  for (std::size_t start = 0; (start = html.find('<', start)) != std::string::npos;) {
    const std::size_t end = html.find_first_of("<>", start + 1);
    ASSERT_TRUE(end != std::string::npos && html[end] == '>') << html.substr(start, 60);
    const std::string tag = html.substr(start + 1, end - start - 1);
    start = end;
    const bool closes = tag.starts_with('/');
    const std::size_t skip = closes ? 1 : 0;
    const std::string name = tag.substr(skip, tag.find_first_of(" \n\t/", 1) - skip);
    if (name == "!DOCTYPE" || name == "meta" || tag.ends_with('/')) continue;
    if (!closes) {
      open.push_back(name);
    } else {
      ASSERT_FALSE(open.empty()) << tag;
      ASSERT_EQ(open.back(), name);
      open.pop_back();
    }
  }
  EXPECT_TRUE(open.empty());
}

inline void expect_no_network(const std::string& html) {
  for (const char* word : {"http://", "https://", "src=", "@import", "<script", "<link"})
    EXPECT_THAT(html, testing::Not(testing::HasSubstr(word)));
}

/// Makes all of these checks, and checks the parts that every report has.
inline void expect_sound(const std::string& html) {
  expect_nested(html);
  expect_no_network(html);
  for (const char* part : {"prefers-color-scheme: dark", "name=\"viewport\"", "How it was made"})
    EXPECT_THAT(html, testing::HasSubstr(part));
  // Each plot exists for wide and for narrow pages.
  EXPECT_EQ(count_of(html, "<svg class=\"wide\""), count_of(html, "<svg class=\"narrow\""));
  EXPECT_EQ(count_of(html, "<svg"), 2 * count_of(html, "<svg class=\"wide\""));
}

}  // namespace kds::test
