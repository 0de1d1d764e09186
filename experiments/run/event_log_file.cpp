#include "experiments/run/event_log_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "experiments/output/provenance.h"
#include "experiments/output/result_json.h"
#include "experiments/run/run_settings.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr std::string_view first_line = "kds event log 1";

// Reads a line's fields one by one; a field that does not fit is an InputError.
class Fields {
 public:
  Fields(std::string_view line, std::string where) : rest_(line), where_(std::move(where)) {}

  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  std::string_view word(std::string_view expected) {
    const std::size_t space = rest_.find(' ');
    const std::string_view word = rest_.substr(0, space);
    rest_ = space == std::string_view::npos ? std::string_view() : rest_.substr(space + 1);
    if (word.empty()) throw InputError(fmt::format("{}: expected {}", where_, expected));
    return word;
  }
  template <class Number>
  Number number(std::string_view expected, int base = 10) {
    const std::string_view text = word(expected);
    Number value{};
    std::from_chars_result result{};
    if constexpr (std::is_floating_point_v<Number>) {
      result = std::from_chars(text.data(), text.data() + text.size(), value);
    } else {
      result = std::from_chars(text.data(), text.data() + text.size(), value, base);
    }
    if (result.ec != std::errc() || result.ptr != text.data() + text.size()) {
      throw InputError(fmt::format("{}: expected {}, found '{}'", where_, expected, text));
    }
    return value;
  }

 private:
  std::string_view rest_;
  std::string where_;
};

// The second line: what the run was asked to do, and what it ran on.
bool read_header(const Json& header, EventLog& log) {
  const Json* arguments = header.find("arguments");
  const Json* beads = header.find("beads");
  const Json* steps = header.find("steps");
  if (!arguments || !arguments->items() || !beads || !beads->whole_number() || !steps ||
      !steps->whole_number())
    return false;
  for (const Json& argument : *arguments->items()) {
    if (!argument.text()) return false;
    log.arguments.push_back(*argument.text());
  }
  log.beads = *beads->whole_number();
  log.steps = *steps->whole_number();
  return true;
}

}  // namespace

EventLogWriter::EventLogWriter(const std::filesystem::path& path, const RunOptions& options,
                               const Scene& scene)
    : file_(path) {
  const std::optional<std::string> header = line_of({{"version", program_version()},
                                                     {"arguments", option_arguments(options)},
                                                     {"beads", scene.bead_count()},
                                                     {"steps", scene.step_count()}});
  if (!header)
    throw InputError("--log: a name among the arguments is not UTF-8, so that no log can tell of it");
  file_.stream() << first_line << '\n' << *header << '\n';
}

void EventLogWriter::on_event(const KineticStructure& structure, const LoggedEvent& event) {
  const Change& change = event.change;
  file_.stream() << fmt::format("{} {} {} {} {} {}\n", event.step, structure.name(),
                                structure.kinds()[change.kind].name, event.lower, event.upper,
                                fmt::join(change.ids.begin(), change.ids.begin() + change.size, " "));
  file_.check();
  ++events_;
}

void EventLogWriter::commit(std::uint64_t fingerprint) {
  file_.stream() << fmt::format("end {} {:016x}\n", events_, fingerprint);
  file_.commit();
}

EventLog read_event_log(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw InputError(fmt::format("{}: cannot be read", path.string()));
  std::string line;
  if (!std::getline(in, line) || line != first_line) {
    throw InputError(fmt::format("{}:1: expected '{}': this is no event log", path.string(), first_line));
  }
  EventLog log;
  std::getline(in, line);
  if (!read_header(parse_json(line), log))
    throw InputError(
        fmt::format("{}:2: expected the run's arguments, beads and steps as JSON", path.string()));
  for (std::size_t number = 3; std::getline(in, line); ++number) {
    const std::string where = fmt::format("{}:{}", path.string(), number);
    Fields fields(line, where);
    if (line.starts_with("end ")) {
      fields.word("end");
      const auto events = fields.number<std::size_t>("the number of events");
      if (line.size() - line.rfind(' ') != 17) {
        throw InputError(fmt::format("{}: expected 16 digits of the fingerprint at the line's end", where));
      }
      log.fingerprint = fields.number<std::uint64_t>("the fingerprint", 16);
      if (events != log.entries.size()) {
        throw InputError(
            fmt::format("{}: the log ends after {} events, but holds {}", where, events, log.entries.size()));
      }
      if (std::getline(in, line))
        throw InputError(fmt::format("{}:{}: expected the file's end", path.string(), number + 1));
      return log;
    }
    EventLog::Entry entry;
    entry.line = number;
    entry.step = fields.number<std::size_t>("a step");
    entry.structure = fields.word("a structure");
    entry.kind = fields.word("a kind of event");
    entry.lower = fields.number<double>("a time");
    entry.upper = fields.number<double>("a time");
    while (!fields.at_end()) entry.ids.push_back(fields.number<BeadId>("a bead"));
    if (!(0 <= entry.lower && entry.lower <= entry.upper && entry.upper <= 1)) {
      throw InputError(fmt::format("{}: expected times in order between 0 and 1", where));
    }
    log.entries.push_back(std::move(entry));
  }
  throw InputError(
      fmt::format("{}: ends without its last line: the run that wrote it was cut off", path.string()));
}

}  // namespace kds
