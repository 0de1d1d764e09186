#include "experiments/program/table_command.h"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "experiments/output/output_files.h"
#include "experiments/output/report_page.h"
#include "experiments/output/text.h"
#include "motions/base/input_error.h"

namespace kds {

namespace fs = std::filesystem;

namespace {

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  return fs::equivalent(a, b, error) || place_of(a) == place_of(b);
}

// Returns the place of a result and its PLACE.part.
std::array<fs::path, 2> places_of(const fs::path& place) {
  return {place, place_of(place).string() + ".part"};
}

}  // namespace

void TakenPaths::read(const InputOptions& options) {
  for (const fs::path& input : options.inputs) add("an input", input);
  if (options.reading.topology) add("--topology"_arg, *options.reading.topology);
  for (const fs::path& topology : options.topologies)
    if (!topology.empty()) add("--topology"_arg, topology);
  if (options.obstacle) add("--obstacle"_arg, *options.obstacle);
  constexpr std::string_view file = "file:";
  if (options.radius.starts_with(file)) add("--radius"_arg, options.radius.substr(file.size()));
}

void TakenPaths::write_json(const std::string& destination) {
  if (destination == "-") return write("--json -", "/dev/stdout");
  write("--json", destination);
}

void TakenPaths::write(const std::string& option, const fs::path& path) {
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) return;
  for (const fs::path& place : places_of(path)) {
    for (const auto& [owner, other] : taken_)
      if (same_file(place, other))
        throw InputError(fmt::format("{} {}: is the file of {}", option, place.string(), owner));
    for (const auto& [owner, directory] : directories_) {
      if (leads_to(place, directory))
        throw InputError(
            fmt::format("{} {}: is to be a directory, for {} {}, expected another place for the file", option,
                        place.string(), owner, directory.string()));
      if (leads_to(directory, place))
        throw InputError(
            fmt::format("{} {}: lies in the directory of {}, which appears as a whole, expected "
                        "another place for the file",
                        option, place.string(), owner));
    }
  }
  for (const fs::path& place : places_of(path)) add(option, place);
}

void TakenPaths::write_into(const std::string& option, const fs::path& directory) {
  for (const fs::path& place : places_of(directory)) {
    for (const auto& [owner, file] : taken_) {
      if (leads_to(file, place))
        throw InputError(fmt::format("{} {}: {} is the file of {}, expected a directory", option,
                                     place.string(), file.string(), owner));
      if (leads_to(place, file))
        throw InputError(
            fmt::format("{} {}: {} lies there, which is the file of {}; expected another directory", option,
                        place.string(), file.string(), owner));
    }
    for (const auto& [owner, other] : directories_)
      if (leads_to(place, other) || leads_to(other, place))
        throw InputError(fmt::format("{} {}: is in the way of {} {}, expected another directory", option,
                                     place.string(), owner, other.string()));
  }
  for (const fs::path& place : places_of(directory)) directories_.emplace_back(option, place);
}

void TakenPaths::write_page(const fs::path& page, const Destinations& destinations) {
  if (!destinations.out || !lies_in(page, *destinations.out)) {
    write("--view", page);
    return ensure_writable_file(page, "--view");
  }
  constexpr std::size_t longest = 255;  // of a name, on most file systems
  const std::string name = page.filename().string();
  if (page.extension() != ".html" || name == report_name || name.size() > longest ||
      name.find('\n') != std::string::npos)
    throw InputError(fmt::format(
        "--view {}: expected a name of at most {} bytes that ends in .html and is not {}, such as {}",
        one_line(page.string()), longest, report_name, (*destinations.out / "replay.html").string()));
}

void TakenPaths::require_directory(bool replace) const {
  if (replace && directories_.empty())
    throw InputError("--replace: replaces a directory of results, expected --out DIR as well");
}

void TakenPaths::write(const Destinations& destinations) {
  if (destinations.out) write_into("--out", *destinations.out);
  if (destinations.json) write_json(*destinations.json);
}

TableCommand::TableCommand(std::string name, const Arguments& arguments, Destinations destinations,
                           std::string_view counted)
    : name_(std::move(name)),
      command_line_("kds " + name_ + " " + shell_words(arguments)),
      destinations_(std::move(destinations)),
      bar_(!destinations_.quiet, counted) {}

void TableCommand::check_destinations(TakenPaths taken) {
  taken.write(destinations_);
  taken.require_directory(destinations_.replace);
  const auto& [out, json, quiet, replace] = destinations_;
  if (json && *json != "-") ensure_writable_file(*json, "--json");
  if (out) files_ = std::make_unique<AtomicFiles>(*out, "--out", replace);
}

void TableCommand::check_inputs_and_destinations(const InputOptions& inputs) {
  check_inputs_exist(inputs);
  TakenPaths taken;
  taken.read(inputs);
  check_destinations(std::move(taken));
}

std::vector<std::string> TableCommand::warnings() {
  bar_.erase();
  held_.release([&](const std::string& warning) {
    warnings_.push_back(warning);
    print_warning(bar_, warning);
  });
  return warnings_;
}

AtomicFiles& TableCommand::add_replay(const std::filesystem::path& page) {
  replay_ = page;
  if (destinations_.out && lies_in(page, *destinations_.out)) return *files_;
  replay_files_ = std::make_unique<AtomicFiles>();
  return *replay_files_;
}

void TableCommand::deliver(Json json, const std::string& csv, const std::string& table) const {
  deliver(std::move(json), Csvs{{name_ + ".csv", csv}}, table);
}

void TableCommand::write_out(const std::string& json, const Csvs& csvs, const fs::path& replay) const {
  ReportLinks links{{name_ + ".json"}, replay};
  files_->write(links.data.front(), json);
  for (const auto& [name, csv] : csvs) {
    csv.write(files_->open(name));
    links.data.push_back(name);
  }
  files_->check();
  write_report(*files_, report_name, json, links);
}

std::optional<std::string> TableCommand::deliver_so_far(Json json, const Csvs& csvs) const {
  add_provenance(json, command_line_);
  write_out(text_of(json), csvs, {});
  return files_->commit_and_begin_anew();
}

void TableCommand::deliver(Json json, const Csvs& csvs, const std::string& table) const {
  add_provenance(json, command_line_);
  const std::string text = text_of(json);
  const auto& [out, json_path, quiet, replace] = destinations_;
  const bool json_on_stdout = json_path == "-";
  if (files_) write_out(text, csvs, replay_beside(*out, replay_));
  AtomicFiles json_file;
  if (json_path && !json_on_stdout) json_file.write(*json_path, text);
  commit_together({files_.get(), replay_files_.get(), &json_file});
  if (json_on_stdout) print_to_stdout(text);
  if (quiet || json_on_stdout) return;
  print_to_stdout(table);
  if (out) print_report_path(*out);
  if (replay_) print_to_stdout("replay " + replay_->string() + "\n");
}

}  // namespace kds
