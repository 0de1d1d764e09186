#include "experiments/run/event_log_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>

#include "experiments/output/result_json.h"
#include "experiments/run/run_options.h"
#include "motions/base/input_error.h"
#include "motions/numbers/exact_number.h"

namespace kds {

namespace {

constexpr std::string_view first_line = "kds event log 2", first_line_before = "kds event log 1",
                           first_line_with_edits = "kds event log 3";
constexpr std::array<std::string_view, 3> edit_names{"insert", "erase", "change"};  // as Edit::Kind
constexpr std::string_view time_names[] = {"at", "before"};

std::string text_of(const Dyadic& time) {
  return fmt::format("0x{}p-{}", time.numerator().get_str(16), time.exponent());
}

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
    if (result.ec != std::errc() || result.ptr != text.data() + text.size()) refuse(expected, text);
    return value;
  }

  /// Reads one of the names and returns its index.
  std::size_t choice(std::span<const std::string_view> names) {
    const std::string expected = fmt::format("one of {}", fmt::join(names, ", "));
    const std::string_view text = word(expected);
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) refuse(expected, text);
    return static_cast<std::size_t>(found - names.begin());
  }
  /// Reads a time in a step, as text_of writes it.
  Dyadic time() {
    constexpr std::string_view expected = "a time from 0 to below 1 such as 0x3p-2";
    constexpr unsigned most = 1'000'000;  // bits
    const std::string_view text = word(expected);
    const std::size_t p = std::min(text.find("p-"), text.size());
    const std::string_view power = text.substr(std::min(p + 2, text.size()));
    Integer numerator;
    unsigned exponent = 0;
    const auto result = std::from_chars(power.data(), power.data() + power.size(), exponent);
    if (numerator.set_str(std::string(text.substr(0, p)), 0) != 0 || result.ec != std::errc() ||
        result.ptr != power.data() + power.size() || exponent > most)
      refuse(expected, text);
    const Dyadic time(numerator, exponent);
    if (time < Dyadic(0.0) || !(time < Dyadic(1.0)) || text_of(time) != text) refuse(expected, text);
    return time;
  }
  [[noreturn]] void refuse(std::string_view expected, std::string_view found) const {
    throw InputError(
        fmt::format("{}:{}: expected {}, found '{}'", lines_.name(), lines_.number(), expected, found));
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
                               const Scene& scene, const std::vector<KineticStructure*>& structures,
                               bool edits)
    : stream_(file_.open(path)) {
  for (const KineticStructure* const structure : structures) structures_.push_back(structure->name());
  const std::optional<std::string> header = line_of({{"version", program_version()},
                                                     {"arguments", repeating_arguments(options)},
                                                     {"beads", scene.bead_count()},
                                                     {"steps", scene.step_count()}});
  if (!header)
    throw InputError("--log: a name among the arguments is not UTF-8, so it cannot be written to a log");
  stream_ << (edits ? first_line_with_edits : first_line) << '\n' << *header << '\n';
}

void EventLogWriter::on_event(const Event& event) {
  const Change& change = event.change;
  begin(event.step);
  add(fmt::format("{} {} {} {} {} {}", event.step, event.structure, event.kind.name, event.lower, event.upper,
                  fmt::join(change.ids.begin(), change.ids.begin() + change.size, " ")));
  ++events_;
  ++step_events_;
}

void EventLogWriter::on_edit(const Edit& edit) {
  begin(edit.step);
  const std::string line = fmt::format("edit {} {} {} {}", edit.step, time_names[edit.after_failure ? 1 : 0],
                                       text_of(edit.time), edit_names[static_cast<std::size_t>(edit.kind)]);
  if (edit.kind != Edit::Kind::change)
    return add(fmt::format("{} {} {}", line, structures_[edit.structure], edit.beads[0]));
  add(fmt::format("{} {}", line, edit.beads.size()));
  for (std::size_t i = 0; i < edit.beads.size(); ++i) {
    const std::size_t numbers = edit.coordinates.size() / edit.beads.size();
    std::string curve = fmt::format("curve {}", edit.beads[i]);
    for (std::size_t k = 0; k < numbers; ++k) curve += fmt::format(" {}", edit.coordinates[i * numbers + k]);
    add(curve);
  }
}

void EventLogWriter::begin(std::size_t step) {
  if (step != step_) end_step();
  step_ = step;
  in_step_ = true;
}

void EventLogWriter::add(const std::string& line) {
  add_line(step_hash_, line);
  stream_ << line << '\n';
  file_.check();
}

void EventLogWriter::end_step() {
  if (in_step_) stream_ << fmt::format("step {} {} {:016x}\n", step_, step_events_, step_hash_.value());
  in_step_ = false;
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
  header_.has_edits = there && line == first_line_with_edits;
  if (there && line != first_line && !header_.has_edits && line.starts_with("kds event log "))
    throw InputError(fmt::format("{}:1: this version of event logs is not known; expected '{}' or '{}'",
                                 lines_.name(), first_line, first_line_with_edits));
  if (!there || (line != first_line && !header_.has_edits))
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
      const bool is_edit = header_.has_edits && line.starts_with("edit ");
      is_edit ? read_edit(line) : read_event(line);
      return &entry_;
    }
    read_step_end(line);
  }
  throw InputError(
      fmt::format("{}: ends without its last line: the run that wrote it was cut off", lines_.name()));
}

void EventLogReader::begin_entry(std::size_t step) {
  entry_.line = lines_.number();
  if (in_step_ ? step != entry_.step : step < first_free_step_)
    throw InputError(fmt::format("{}: a line of step {} among or after those of another", where(), step));
  entry_.step = step;
  entry_.edit.reset();
  if (step >= header_.steps) throw InputError(fmt::format("{}: step {} of {}", where(), step, header_.steps));
  in_step_ = true;
}

void EventLogReader::read_edit(std::string_view line) {
  Fields fields(line, lines_);
  fields.word("edit");
  begin_entry(fields.number<std::size_t>("a step"));
  Edit& edit = entry_.edit.emplace();
  edit.step = entry_.step;
  edit.where = where();
  edit.after_failure = fields.choice(time_names) == 1;
  edit.time = fields.time();
  edit.kind = static_cast<Edit::Kind>(fields.choice(edit_names));
  std::size_t curves = 0;
  if (edit.kind == Edit::Kind::change) {
    curves = fields.number<std::size_t>("the number of beads");
    if (curves == 0) fields.refuse("one bead or more", "0");
  } else {
    entry_.structure = fields.word("a structure");
    add_bead(edit, fields.number<BeadId>("a bead"));
  }
  if (!fields.at_end()) throw InputError(fmt::format("{}: expected the line's end", where()));
  add_line(step_hash_, line);
  while (edit.beads.size() < curves) read_curve(edit);
}

void EventLogReader::read_curve(Edit& edit) {
  std::string_view line;
  if (!lines_.next(line) || !line.starts_with("curve "))
    throw InputError(fmt::format("{}: expected 'curve', a bead and its control points", where()));
  Fields fields(line, lines_);
  fields.word("curve");
  add_bead(edit, fields.number<BeadId>("a bead"));
  const std::size_t before = edit.coordinates.size();
  while (!fields.at_end()) edit.coordinates.push_back(fields.number<double>("a coordinate"));
  if (before != (edit.coordinates.size() - before) * (edit.beads.size() - 1))
    throw InputError(fmt::format("{}: has more or fewer coordinates than the curve before", where()));
  add_line(step_hash_, line);
}

void EventLogReader::add_bead(Edit& edit, BeadId bead) const {
  if (bead >= header_.beads) throw InputError(fmt::format("{}: bead {} of {}", where(), bead, header_.beads));
  edit.beads.push_back(bead);
}

void EventLogReader::read_event(std::string_view line) {
  Fields fields(line, lines_);
  begin_entry(fields.number<std::size_t>("a step"));
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
  if (!in_step_ || step != entry_.step || events != step_events_ || hash != step_hash_.value())
    throw InputError(fmt::format("{}: the lines of step {} are not those that the run wrote", where(), step));
  first_free_step_ = step + 1;
  in_step_ = false;
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
  if (in_step_)
    throw InputError(fmt::format("{}: the events of step {} end without their hash", where(), entry_.step));
  if (std::string_view rest; lines_.next(rest))
    throw InputError(fmt::format("{}: expected the file's end", where()));
  ended_ = true;
}

}  // namespace kds
