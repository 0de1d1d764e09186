#pragma once
// JSON of results and logs. Only the source file of this header knows the library behind it, which is long to
// compile.

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "experiments/output/spool.h"

namespace kds {

/// A value of JSON. Members of objects keep their order. {{"name", value}, ...} is an object, a vector an
/// array.
class Json {
 public:
  using Items = std::vector<Json>;
  using Members = std::vector<std::pair<std::string, Json>>;

  Json();  ///< null
  // Not inlined: what becomes of nine kinds of values is long to compile.
  Json(const Json& other);
  Json(Json&& other) noexcept;
  Json& operator=(const Json& other);
  Json& operator=(Json&& other) noexcept;
  ~Json();
  Json(std::nullptr_t) {}
  Json(double value) : value_(value) {}
  Json(const char* text) : value_(std::string(text)) {}
  Json(std::string_view text) : value_(std::string(text)) {}
  Json(std::string text) : value_(std::move(text)) {}
  template <std::integral Value>
  Json(Value value) {
    if constexpr (std::same_as<Value, bool>) {
      value_ = value;
    } else if constexpr (std::signed_integral<Value>) {
      value_ = std::int64_t{value};
    } else {
      value_ = std::uint64_t{value};
    }
  }
  template <class Value>
  Json(const std::optional<Value>& value) {  // null where there is none
    if (value) *this = Json(*value);
  }
  template <class Value>
  Json(const std::vector<Value>& values) : value_(Items(values.begin(), values.end())) {}
  Json(std::initializer_list<std::pair<std::string_view, Json>> members);
  [[nodiscard]] static Json array() { return Json(Items()); }
  [[nodiscard]] static Json object() { return Json(Members()); }

  /// Of an object, or of null, which becomes one. A member that is not there is added, as null.
  Json& operator[](std::string_view name);
  /// To an array.
  void push_back(Json item) { std::get<Items>(value_).push_back(std::move(item)); }

  // What the value is; null where it is something else.
  [[nodiscard]] const std::string* text() const { return std::get_if<std::string>(&value_); }
  [[nodiscard]] const Items* items() const { return std::get_if<Items>(&value_); }
  [[nodiscard]] const Members* members() const { return std::get_if<Members>(&value_); }
  [[nodiscard]] const std::uint64_t* whole_number() const { return std::get_if<std::uint64_t>(&value_); }
  [[nodiscard]] bool is_null() const { return std::holds_alternative<std::monostate>(value_); }
  /// The member of an object; null where there is none, or no object.
  [[nodiscard]] const Json* find(std::string_view name) const;

 private:
  friend struct JsonTree;
  explicit Json(Items items) : value_(std::move(items)) {}
  explicit Json(Members members) : value_(std::move(members)) {}

  std::variant<std::monostate, bool, std::int64_t, std::uint64_t, double, std::string, Items, Members> value_;
};

/// To an object: first `command`, the command line, last `version` and `machine`, as every result has them.
void add_provenance(Json& json, std::string command);

/// Indented, ends with a newline. File names need not be UTF-8, JSON must be: wrong bytes are replaced.
[[nodiscard]] std::string text_of(const Json& json);

/// A long array of an object, whose items wait on disk as text.
class JsonItems {
 public:
  void add(const Json& item);
  /// Writes the text of `object` as text_of does, with this array as its member `name`.
  void write_within(const Json& object, std::string_view name, const TextSink& sink) const;

 private:
  Spool items_;
};

/// Without blanks and newlines; none where a text is not UTF-8.
[[nodiscard]] std::optional<std::string> line_of(const Json& json);

/// Null where the text is no JSON, and for what is nested deeper than 64 levels.
[[nodiscard]] Json parse_json(std::string_view text);

}  // namespace kds
