#include "experiments/run/event_log_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "experiments/output/result_json.h"
#include "experiments/run/run_options.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr std::string_view first_line = "kds event log 2", first_line_before = "kds event log 1";

// Reads the fields of a line one by one. Throws InputError if a field does not fit.
class Fields {
 public:
  Fields(std::string_view line, const LineReader& lines) : rest_(line), lines_(lines) {}

  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  std::string_view word(std::string_view expected) {
    const std::size_t space = rest_.find(' ');
    const std::string_view word = rest_.substr(0, space);
    rest_ = space == std::string_view::npos ? std::string_view() : rest_.substr(space + 1);
    if (word.empty())
      throw InputError(fmt::format("{}:{}: expected {}", lines_.name(), lines_.number(), expected));
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
      throw InputError(
          fmt::format("{}:{}: expected {}, found '{}'", lines_.name(), lines_.number(), expected, text));
    }
    return value;
  }

 private:
  std::string_view rest_;
  const LineReader& lines_;
};

// Reads the second line of the log, which says what the run was asked to do and on which input.
bool read_header(const Json& json, EventLogHeader& header) {
  const Json* version = json.find("version");
  const Json* arguments = json.find("arguments");
  const Json* beads = json.find("beads");
  const Json* steps = json.find("steps");
  if (!arguments || !arguments->items() || !beads || !beads->whole_number() || !steps ||
      !steps->whole_number())
    return false;
  for (const Json& argument : *arguments->items()) {
    if (!argument.text()) return false;
    header.arguments.push_back(*argument.text());
  }
  if (version && version->text()) header.version = *version->text();
  header.beads = *beads->whole_number();
  header.steps = *steps->whole_number();
  return true;
}

void add_line(WordHash& hash, std::string_view line) {
  for (const char c : line) hash.add(static_cast<std::uint32_t>(static_cast<unsigned char>(c)));
  hash.add('\n');
}

constexpr std::size_t hash_digits = 16;

std::uint64_t read_hash(Fields& fields, std::string_view line, std::string_view what,
                        const std::string& where) {
  if (line.size() - line.rfind(' ') != hash_digits + 1)
    throw InputError(fmt::format("{}: expected {} digits of {} at the line's end", where, hash_digits, what));
  return fields.number<std::uint64_t>(what, 16);
}

}  // namespace

EventLogWriter::EventLogWriter(const std::filesystem::path& path, const RunOptions& options,
                               const Scene& scene)
    : stream_(file_.open(path)) {
  const std::optional<std::string> header = line_of({{"version", program_version()},
                                                     {"arguments", repeating_arguments(options)},
                                                     {"beads", scene.bead_count()},
                                                     {"steps", scene.step_count()}});
  if (!header)
    throw InputError("--log: a name among the arguments is not UTF-8, so it cannot be written to a log");
  stream_ << first_line << '\n' << *header << '\n';
}

void EventLogWriter::on_event(const Event& event) {
  if (event.step != step_) end_step();
  step_ = event.step;
  const Change& change = event.change;
  const std::string line =
      fmt::format("{} {} {} {} {} {}", event.step, event.structure, event.kind.name, event.lower, event.upper,
                  fmt::join(change.ids.begin(), change.ids.begin() + change.size, " "));
  add_line(step_hash_, line);
  stream_ << line << '\n';
  file_.check();
  ++events_;
  ++step_events_;
}

void EventLogWriter::end_step() {
  if (step_events_ > 0)
    stream_ << fmt::format("step {} {} {:016x}\n", step_, step_events_, step_hash_.value());
  step_events_ = 0;
  step_hash_ = {};
}

void EventLogWriter::end(std::uint64_t fingerprint) {
  end_step();
  stream_ << fmt::format("end {} {:016x}\n", events_, fingerprint);
}

EventLogReader::EventLogReader(const std::filesystem::path& path) : lines_(path) {
  std::string_view line;
  const bool there = lines_.next(line);
  if (there && line == first_line_before)
    throw InputError(
        fmt::format("{}:1: this log has version 1, without the hashes that prove its times; run again with "
                    "--log to write version 2",
                    lines_.name()));
  if (!there || line != first_line)
    throw InputError(fmt::format("{}:1: expected '{}': this is no event log", lines_.name(), first_line));
  if (!lines_.next(line) || !read_header(parse_json(line), header_))
    throw InputError(
        fmt::format("{}:2: expected the run's arguments, beads and steps as JSON", lines_.name()));
}

std::string EventLogReader::where() const { return fmt::format("{}:{}", lines_.name(), lines_.number()); }

const EventLogReader::Entry* EventLogReader::next() {
  if (ended_) return nullptr;
  for (std::string_view line; lines_.next(line);) {
    if (lines_.cut()) break;  // even the last line must be complete
    if (line.starts_with("end ")) {
      read_end(line);
      return nullptr;
    }
    if (!line.starts_with("step ")) {
      read_event(line);
      return &entry_;
    }
    read_step_end(line);
  }
  throw InputError(
      fmt::format("{}: ends without its last line: the run that wrote it was cut off", lines_.name()));
}

void EventLogReader::read_event(std::string_view line) {
  Fields fields(line, lines_);
  entry_.line = lines_.number();
  const auto step = fields.number<std::size_t>("a step");
  if (step_events_ > 0 ? step != entry_.step : step < first_free_step_)
    throw InputError(fmt::format("{}: an event of step {} among or after those of another", where(), step));
  entry_.step = step;
  if (step >= header_.steps) throw InputError(fmt::format("{}: step {} of {}", where(), step, header_.steps));
  entry_.structure = fields.word("a structure");
  entry_.kind = fields.word("a kind of event");
  entry_.lower = fields.number<double>("a time");
  entry_.upper = fields.number<double>("a time");
  entry_.ids.clear();
  while (!fields.at_end()) entry_.ids.push_back(fields.number<BeadId>("a bead"));
  if (!(0 <= entry_.lower && entry_.lower <= entry_.upper && entry_.upper <= 1))
    throw InputError(fmt::format("{}: expected times in order between 0 and 1", where()));
  add_line(step_hash_, line);
  ++events_;
  ++step_events_;
}

void EventLogReader::read_step_end(std::string_view line) {
  Fields fields(line, lines_);
  fields.word("step");
  const auto step = fields.number<std::size_t>("a step");
  const auto events = fields.number<std::uint64_t>("the number of events");
  const std::uint64_t hash = read_hash(fields, line, "the hash", where());
  if (step_events_ == 0 || step != entry_.step || events != step_events_ || hash != step_hash_.value())
    throw InputError(fmt::format("{}: the lines of step {} are not those that the run wrote", where(), step));
  first_free_step_ = step + 1;
  step_events_ = 0;
  step_hash_ = {};
}

void EventLogReader::read_end(std::string_view line) {
  Fields fields(line, lines_);
  fields.word("end");
  const auto events = fields.number<std::uint64_t>("the number of events");
  fingerprint_ = read_hash(fields, line, "the fingerprint", where());
  if (events != events_)
    throw InputError(fmt::format("{}: the log ends after {} events, but holds {}", where(), events, events_));
  if (step_events_ > 0)
    throw InputError(fmt::format("{}: the events of step {} end without their hash", where(), entry_.step));
  if (std::string_view rest; lines_.next(rest))
    throw InputError(fmt::format("{}: expected the file's end", where()));
  ended_ = true;
}

}  // namespace kds
