#pragma once
// JSON for results and logs, and the provenance that every result states. Only the source file of this header
// includes the JSON library, which takes long to compile.

#include <concepts>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace kds {

/// Returns release and commit, as in 0.1.0+1a2b3c4d5e6f.
[[nodiscard]] std::string program_version();

struct Machine {
  std::string cpu;
  unsigned cores = 0;
  std::string os;
  std::string compiler;
};

/// Returns the description of this machine. A property that cannot be determined is "unknown".
[[nodiscard]] Machine this_machine();

/// A JSON value. The members of an object keep their order. {{"name", value}, ...} is an object, a vector is
/// an array.
class Json {
 public:
  using Items = std::vector<Json>;
  using Members = std::vector<std::pair<std::string, Json>>;

  Json();  ///< null
  // Not inline, because copying and moving nine kinds of values takes long to compile.
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
  Json(const std::optional<Value>& value) {  // null if there is no value
    if (value) *this = Json(*value);
  }
  template <class Value>
  Json(const std::vector<Value>& values) : value_(Items(values.begin(), values.end())) {}
  Json(std::initializer_list<std::pair<std::string_view, Json>> members);
  [[nodiscard]] static Json array() { return Json(Items()); }
  [[nodiscard]] static Json object() { return Json(Members()); }

  /// Returns the member of an object. Adds a null member if it is missing. A null value first becomes an
  /// object.
  Json& operator[](std::string_view name);
  /// Appends to an array.
  void push_back(Json item) { std::get<Items>(value_).push_back(std::move(item)); }

  // Each function returns the content if the value has that type, else null.
  [[nodiscard]] const std::string* text() const { return std::get_if<std::string>(&value_); }
  [[nodiscard]] const Items* items() const { return std::get_if<Items>(&value_); }
  [[nodiscard]] const Members* members() const { return std::get_if<Members>(&value_); }
  [[nodiscard]] const std::uint64_t* whole_number() const { return std::get_if<std::uint64_t>(&value_); }
  [[nodiscard]] const bool* truth() const { return std::get_if<bool>(&value_); }
  /// Returns a number of any type as a double, or nothing if the value is not a number.
  [[nodiscard]] std::optional<double> number() const;
  [[nodiscard]] bool is_null() const { return std::holds_alternative<std::monostate>(value_); }
  /// Returns the member of an object, or null if the value is not an object or has no such member.
  [[nodiscard]] const Json* find(std::string_view name) const;

 private:
  friend struct JsonTree;
  explicit Json(Items items) : value_(std::move(items)) {}
  explicit Json(Members members) : value_(std::move(members)) {}

  std::variant<std::monostate, bool, std::int64_t, std::uint64_t, double, std::string, Items, Members> value_;
};

/// Adds provenance to an object, as every result has it: `command`, the command line, as the first member,
/// and `version` and `machine` as the last members.
void add_provenance(Json& json, std::string command);

/// Returns indented text that ends with a newline. File names need not be UTF-8 but JSON must be, so invalid
/// bytes are replaced.
[[nodiscard]] std::string text_of(const Json& json);

/// Receives a text piece by piece.
using TextSink = std::function<void(std::string_view)>;

/// A long array inside an object. The items of the array wait in an unnamed temporary file, so that memory
/// does not grow with them.
class JsonItems {
 public:
  /// Throws OutputError if the system provides no temporary file.
  JsonItems();
  /// Throws OutputError if the disk is full.
  void add(const Json& item);
  /// Writes the text of `object`, as text_of does, with this array as its member `name`.
  void write_within(const Json& object, std::string_view name, const TextSink& sink) const;

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> file_;
  bool empty_ = true;
};

/// Returns one line without blanks, or nothing if a string is not UTF-8.
[[nodiscard]] std::optional<std::string> line_of(const Json& json);

/// Returns null if the text is not JSON or is nested deeper than 64 levels.
[[nodiscard]] Json parse_json(std::string_view text);

/// Returns the JSON of a file that people write. Throws InputError with `subject`, line and column if the
/// text is not JSON, with the key if an object has a key twice, and with the number if it overflows.
[[nodiscard]] Json read_json(std::string_view text, const std::string& subject);

}  // namespace kds
