#include "motions/readers/cif_syntax.h"

#include <fmt/format.h>

#include <algorithm>
#include <gemmi/cifdoc.hpp>

#include "motions/base/input_error.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

enum class Kind { end, data, loop, stop, other_keyword, tag, value };

struct Token {
  Kind kind = Kind::end;
  std::string_view text;  // of a value with its quotes, as gemmi keeps it
  std::size_t line = 0;
};

class Tokens {
 public:
  Tokens(const std::string& file, std::string_view text) : file_(file), text_(text) { advance(); }

  const Token& peek() const { return token_; }

  Token take() {
    const Token token = token_;
    advance();
    return token;
  }

  [[noreturn]] void fail(std::size_t line, const std::string& message) const {
    throw InputError(fmt::format("{}:{}: {}", file_, line, message));
  }

 private:
  bool at_line_start() const { return place_ == 0 || text_[place_ - 1] == '\n'; }

  void skip_blanks_and_comments() {
    for (; place_ < text_.size(); ++place_) {
      if (text_[place_] == '#') place_ = std::min(text_.find('\n', place_), text_.size());
      if (place_ == text_.size()) return;
      if (!is_blank(text_[place_])) return;
      if (text_[place_] == '\n') ++line_;
    }
  }

  void advance() {
    skip_blanks_and_comments();
    token_ = {Kind::end, {}, line_};
    if (place_ == text_.size()) return;
    const char first = text_[place_];
    std::size_t end = 0;
    if (first == ';' && at_line_start()) {
      end = text_.find("\n;", place_);
      if (end == std::string_view::npos) fail(line_, "this text field, begun with ';', has no end");
      end += 2;
      token_.kind = Kind::value;
    } else if (first == '\'' || first == '"') {
      end = end_of_quoted(first);
      token_.kind = Kind::value;
    } else {
      end = place_;
      while (end < text_.size() && !is_blank(text_[end])) ++end;
      token_.kind = kind_of(text_.substr(place_, end - place_));
    }
    token_.text = text_.substr(place_, end - place_);
    line_ += static_cast<std::size_t>(std::count(token_.text.begin(), token_.text.end(), '\n'));
    place_ = end;
  }

  // A quote ends the string only before a blank.
  std::size_t end_of_quoted(char quote) const {
    for (std::size_t i = place_ + 1; i < text_.size() && text_[i] != '\n'; ++i)
      if (text_[i] == quote && (i + 1 == text_.size() || is_blank(text_[i + 1]))) return i + 1;
    fail(line_, fmt::format("this quoted string has no end: {}", in_quotes(text_.substr(place_, 40))));
  }

  static Kind kind_of(std::string_view word) {
    std::string lower(word.substr(0, 7));
    for (char& c : lower)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (word[0] == '_') return Kind::tag;
    if (lower.compare(0, 5, "data_") == 0) return Kind::data;
    if (lower == "loop_") return Kind::loop;
    if (lower == "stop_") return Kind::stop;
    if (lower.compare(0, 5, "save_") == 0 || lower == "global_") return Kind::other_keyword;
    return Kind::value;
  }

  const std::string& file_;
  std::string_view text_;
  std::size_t place_ = 0;
  std::size_t line_ = 1;
  Token token_;
};

class CifReader {
 public:
  CifReader(const std::string& file, std::string_view text, const std::vector<std::string>& categories)
      : tokens_(file, text), categories_(categories) {}

  gemmi::cif::Document read() {
    if (tokens_.peek().kind != Kind::data)
      tokens_.fail(tokens_.peek().line,
                   fmt::format("expected data_ at the start of an mmCIF file, found {}",
                               tokens_.peek().kind == Kind::end ? "the end of the file"
                                                                : in_quotes(tokens_.peek().text)));
    gemmi::cif::Document document;
    while (tokens_.peek().kind != Kind::end) {
      const Token token = tokens_.take();
      if (token.kind == Kind::data) {
        document.blocks.emplace_back(std::string(token.text.substr(5)));
      } else if (token.kind == Kind::tag) {
        read_pair(document.blocks.back(), token);
      } else if (token.kind == Kind::loop) {
        read_loop(document.blocks.back(), token);
      } else {
        tokens_.fail(token.line, fmt::format("expected a tag or loop_, found {}", in_quotes(token.text)));
      }
    }
    return document;
  }

 private:
  bool wanted(std::string_view tag) const {
    return std::any_of(categories_.begin(), categories_.end(), [&](std::string_view category) {
      return gemmi::istarts_with(std::string(tag.substr(0, category.size())), std::string(category));
    });
  }

  void read_pair(gemmi::cif::Block& block, const Token& tag) {
    const Token value = tokens_.take();
    if (value.kind != Kind::value)
      tokens_.fail(tag.line, fmt::format("{} has no value", in_quotes(tag.text)));
    if (!wanted(tag.text)) return;
    block.items.emplace_back(std::string(tag.text), std::string(value.text));
    block.items.back().line_number = static_cast<int>(tag.line);
  }

  void read_loop(gemmi::cif::Block& block, const Token& start) {
    gemmi::cif::Item item{gemmi::cif::LoopArg{}};
    item.line_number = static_cast<int>(start.line);
    gemmi::cif::Loop& loop = item.loop;
    while (tokens_.peek().kind == Kind::tag) loop.tags.emplace_back(tokens_.take().text);
    if (loop.tags.empty()) tokens_.fail(start.line, "expected tags after loop_");
    const bool keep = wanted(loop.tags.front());
    std::size_t values = 0;
    for (; tokens_.peek().kind == Kind::value; ++values) {
      const Token value = tokens_.take();
      if (keep) loop.values.emplace_back(value.text);
    }
    if (values % loop.tags.size() != 0)
      tokens_.fail(tokens_.peek().line,
                   fmt::format("the loop of {} ends inside a row ({}, {} a row)",
                               in_quotes(loop.tags.front()), counted(values, "value"), loop.tags.size()));
    if (tokens_.peek().kind == Kind::stop) (void)tokens_.take();
    if (keep) block.items.push_back(std::move(item));
  }

  Tokens tokens_;
  const std::vector<std::string>& categories_;
};

}  // namespace

gemmi::cif::Document read_cif(const std::string& file, std::string_view text,
                              const std::vector<std::string>& categories) {
  return CifReader(file, text, categories).read();
}

}  // namespace kds
