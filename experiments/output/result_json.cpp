#include "experiments/output/result_json.h"

#include <sys/utsname.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "experiments/output/output_files.h"
#include "motions/base/input_error.h"
#include "version.h"

namespace kds {

namespace {

// Returns the value of the first line `key<separator>value`, without quotes and blanks around it.
std::string look_up(const char* file, const std::string& key, char separator) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t offset = line.find(separator);
    const std::size_t first =
        line.find_first_not_of(" \t\"", offset == std::string::npos ? offset : offset + 1);
    if (first == std::string::npos) continue;
    return line.substr(first, line.find_last_not_of(" \t\"\r") + 1 - first);
  }
  return {};
}

std::string operating_system() {
  utsname names{};
  if (::uname(&names) != 0) return "unknown";
  const std::string kernel = std::string(names.sysname) + " " + names.release + " " + names.machine;
  const std::string distribution = look_up("/etc/os-release", "PRETTY_NAME", '=');
  return distribution.empty() ? kernel : distribution + ", " + kernel;
}

std::string compiler() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#elif defined(__GNUC__)
  return "GCC " __VERSION__;
#else
  return "unknown";
#endif
}

}  // namespace

std::string program_version() { return KDS_VERSION "+" KDS_COMMIT; }

Machine this_machine() {
  const std::string cpu = look_up("/proc/cpuinfo", "model name", ':');
  return {cpu.empty() ? "unknown" : cpu, std::thread::hardware_concurrency(), operating_system(), compiler()};
}

/// Converts Json to the library's values and back.
struct JsonTree {
  using Tree = nlohmann::ordered_json;

  static Tree tree(const Json& json) {
    return std::visit(
        [](const auto& value) -> Tree {
          using Value = std::decay_t<decltype(value)>;
          if constexpr (std::same_as<Value, std::monostate>) {
            return nullptr;
          } else if constexpr (std::same_as<Value, Json::Items>) {
            Tree items = Tree::array();
            for (const Json& item : value) items.push_back(tree(item));
            return items;
          } else if constexpr (std::same_as<Value, Json::Members>) {
            Tree members = Tree::object();
            for (const auto& [name, member] : value) members[name] = tree(member);
            return members;
          } else {
            return value;
          }
        },
        json.value_);
  }

  // The limit of 64 levels protects the stack. No JSON of kds is nested deeper.
  static Json json(const Tree& tree, int depth = 0) {
    if (depth > 64) return nullptr;
    switch (tree.type()) {
      case Tree::value_t::boolean:
        return tree.get<bool>();
      case Tree::value_t::number_integer:
        return tree.get<std::int64_t>();
      case Tree::value_t::number_unsigned:
        return tree.get<std::uint64_t>();
      case Tree::value_t::number_float:
        return tree.get<double>();
      case Tree::value_t::string:
        return tree.get_ref<const std::string&>();
      case Tree::value_t::array: {
        Json items = Json::array();
        for (const Tree& item : tree) items.push_back(json(item, depth + 1));
        return items;
      }
      case Tree::value_t::object: {
        Json members = Json::object();
        for (const auto& [name, member] : tree.items()) members[name] = json(member, depth + 1);
        return members;
      }
      default:
        return nullptr;
    }
  }
};

Json::Json() = default;
Json::Json(const Json& other) = default;
Json::Json(Json&& other) noexcept = default;
Json& Json::operator=(const Json& other) = default;
Json& Json::operator=(Json&& other) noexcept = default;
Json::~Json() = default;

Json::Json(std::initializer_list<std::pair<std::string_view, Json>> members)
    : value_(Members(members.begin(), members.end())) {}

std::optional<double> Json::number() const {
  if (const auto* whole = std::get_if<std::uint64_t>(&value_)) return static_cast<double>(*whole);
  if (const auto* whole = std::get_if<std::int64_t>(&value_)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&value_)) return *real;
  return std::nullopt;
}

Json& Json::operator[](std::string_view name) {
  if (is_null()) value_ = Members();
  auto& members = std::get<Members>(value_);
  for (auto& [own, value] : members)
    if (own == name) return value;
  return members.emplace_back(name, Json()).second;
}

const Json* Json::find(std::string_view name) const {
  if (members() != nullptr)
    for (const auto& [own, value] : *members())
      if (own == name) return &value;
  return nullptr;
}

void add_provenance(Json& json, std::string command) {
  Json whole{{"command", std::move(command)}};
  if (const Json::Members* members = json.members())
    for (const auto& [name, value] : *members) whole[name] = value;
  whole["version"] = program_version();
  const Machine machine = this_machine();
  whole["machine"] = {
      {"cpu", machine.cpu}, {"cores", machine.cores}, {"os", machine.os}, {"compiler", machine.compiler}};
  json = std::move(whole);
}

std::string text_of(const Json& json) {
  return JsonTree::tree(json).dump(2, ' ', false, JsonTree::Tree::error_handler_t::replace) + "\n";
}

std::optional<std::string> line_of(const Json& json) {
  try {
    return JsonTree::tree(json).dump();
  } catch (const JsonTree::Tree::type_error&) {
    return std::nullopt;
  }
}

Json parse_json(std::string_view text) {
  const JsonTree::Tree tree = JsonTree::Tree::parse(text, nullptr, false);
  return JsonTree::json(tree);
}

Json read_json(std::string_view text, const std::string& subject) {
  using Tree = JsonTree::Tree;
  std::vector<std::set<std::string>> keys;
  const auto refuse_second_key = [&](int, Tree::parse_event_t event, Tree& found) {
    if (event == Tree::parse_event_t::object_start) keys.emplace_back();
    if (event == Tree::parse_event_t::object_end) keys.pop_back();
    if (event == Tree::parse_event_t::key && !keys.back().insert(found.get<std::string>()).second)
      throw InputError(subject + ": key '" + found.get<std::string>() + "' stands twice in one object");
    return true;
  };
  try {
    return JsonTree::json(Tree::parse(text, refuse_second_key));
  } catch (const Tree::parse_error& error) {
    const std::size_t bytes = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
    const std::string_view before = text.substr(0, bytes);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t start = before.rfind('\n');
    const std::size_t column = bytes - (start == std::string_view::npos ? 0 : start + 1) + 1;
    throw InputError(subject + ": is not JSON at line " + std::to_string(line) + ", column " +
                     std::to_string(column) + "; a comma, quote or bracket may be missing or too many");
  } catch (const Tree::out_of_range& error) {
    const std::string_view message(error.what());
    const std::size_t number = std::min(message.find('\''), message.size());
    throw InputError(subject + ": number " + std::string(message.substr(number)) +
                     " is too large, expected one that a double can hold");
  }
}

namespace {

[[noreturn]] void fail_with_temporary_file() { fail_to_write("a temporary file: cannot write", errno); }

}  // namespace

JsonItems::JsonItems() : file_(std::tmpfile()) {
  if (!file_) fail_with_temporary_file();
}

void JsonItems::add(const Json& item) {
  const std::string text = text_of(item);
  std::string_view left(text);
  left.remove_suffix(1);  // removes the newline
  std::string lines = empty_ ? "" : ",\n";
  while (!left.empty()) {
    const std::size_t end = std::min(left.find('\n'), left.size());
    lines.append("    ").append(left.substr(0, end));
    left.remove_prefix(std::min(end + 1, left.size()));
    if (!left.empty()) lines += '\n';
  }
  empty_ = false;
  if (std::fwrite(lines.data(), 1, lines.size(), file_.get()) != lines.size()) fail_with_temporary_file();
}

void JsonItems::write_within(const Json& object, std::string_view name, const TextSink& sink) const {
  Json whole = object;
  whole[name] = Json::array();
  const std::string text = text_of(whole);
  if (empty_) return sink(text);
  // No JSON string contains a newline, and nested members are indented further, so the first match is the
  // member itself.
  const std::string empty = "\n  \"" + std::string(name) + "\": []";
  const std::size_t at = text.find(empty) + empty.size() - 1;
  sink(std::string_view(text).substr(0, at));
  sink("\n");
  if (std::fflush(file_.get()) != 0) fail_with_temporary_file();
  std::rewind(file_.get());
  std::array<char, 1 << 16> bytes;
  for (std::size_t count = 0; (count = std::fread(bytes.data(), 1, bytes.size(), file_.get())) > 0;)
    sink({bytes.data(), count});
  if (std::ferror(file_.get()) != 0) throw OutputError("a temporary file: cannot read");
  sink("\n  ");
  sink(std::string_view(text).substr(at));
}

}  // namespace kds
