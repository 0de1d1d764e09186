#pragma once
// The common part of every command whose result is a table: destinations, progress bar, warnings and output.
// The command writes results as NAME.json, NAME.csv and report.html in --out, to --json and to standard
// output.
//
//   TableCommand command("update", arguments, options, "round");
//   command.check_destinations(taken);          // before any input is read
//   const auto rows = measure(command.warn(), command.progress());
//   Json json{{"settings", ...}, {"rows", ...}, {"warnings", command.warnings()}};
//   command.deliver(json, csv, table);

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/output/output_files.h"
#include "experiments/output/result_json.h"
#include "experiments/program/command_line.h"
#include "experiments/program/input_options.h"
#include "experiments/program/progress_bar.h"

namespace kds {

/// Refuses outputs that would replace an input or another output of the same command.
class TakenPaths {
 public:
  /// Registers a file that is read, or that another part of the program writes. `owner` names it in messages.
  void add(std::string owner, const std::filesystem::path& path) {
    taken_.emplace_back(std::move(owner), path);
  }
  /// Registers the files that are read.
  void read(const InputOptions& options);
  /// Registers the destination of --json: a file, as `write` does, or - for standard output, which may itself
  /// be redirected to a file.
  void write_json(const std::string& destination);
  /// Registers a file that will be written, and its PLACE.part (output_files.h). Throws InputError if one of
  /// them is already registered, or is or lies in a directory of another result. Devices may be shared.
  void write(const std::string& option, const std::filesystem::path& path);
  /// Registers a directory that will be written as a whole, and its PLACE.part. Throws InputError if one of
  /// them or of their parents is registered as a file, or if a registered file or directory lies in them.
  void write_into(const std::string& option, const std::filesystem::path& directory);
  /// Registers a page of --view and checks that it can be written. A page directly in --out is one of its
  /// files. Throws InputError if its name could be that of another.
  void write_page(const std::filesystem::path& page, const Destinations& destinations);
  /// Registers the destinations --out and --json.
  void write(const Destinations& destinations);
  /// Throws InputError if --replace is given (`replace`) and no directory is registered.
  void require_directory(bool replace) const;

 private:
  std::vector<std::pair<std::string, std::filesystem::path>> taken_, directories_;
};

/// The content of a CSV file: a text, or a function that writes it piece by piece.
class CsvContent {
 public:
  using Write = std::function<void(std::ostream&)>;

  CsvContent(std::string text) : write_([text = std::move(text)](std::ostream& stream) { stream << text; }) {}
  CsvContent(Write write) : write_(std::move(write)) {}
  void write(std::ostream& stream) const { write_(stream); }

 private:
  Write write_;
};

class TableCommand {
 public:
  using Progress = std::function<void(std::size_t done, std::size_t total)>;
  using Warn = HeldWarnings::Warn;

  /// `counted` names the unit that the progress bar counts.
  TableCommand(std::string name, const Arguments& arguments, Destinations destinations,
               std::string_view counted);

  /// Throws InputError if a result could not be written later, or would replace another result or a file in
  /// `taken`. The files in --out are NAME.json, NAME.csv and report.html.
  void check_destinations(TakenPaths taken = {});
  /// Checks the destinations of a command that reads these inputs. Throws InputError also if an input does
  /// not exist.
  void check_inputs_and_destinations(const InputOptions& inputs);
  /// Returns the files of --out, which `deliver` otherwise writes. They hold their place since the check.
  [[nodiscard]] std::unique_ptr<AtomicFiles> take_files() { return std::move(files_); }

  [[nodiscard]] ProgressBar& bar() { return bar_; }
  [[nodiscard]] Progress progress() {
    return [this](std::size_t done, std::size_t total) { bar_.update(done, total); };
  }
  /// Returns a function that keeps warnings back, because the input may still be refused.
  [[nodiscard]] Warn warn() { return held_.hold(); }
  /// Prints the warnings that were kept back, and returns these and all earlier ones.
  [[nodiscard]] std::vector<std::string> warnings();

  /// The command with its arguments, quoted for a shell.
  [[nodiscard]] const std::string& command_line() const { return command_line_; }
  /// Returns the files of a replay page at `page`, those of --out if it lies there, which `deliver` then
  /// links and writes with the results.
  [[nodiscard]] AtomicFiles& add_replay(const std::filesystem::path& page);

  /// Adds command, version and machine to `json` and writes all results, which appear together. The table is
  /// printed unless --quiet is given or the JSON goes to standard output.
  void deliver(Json json, const std::string& csv, const std::string& table) const;
  /// Delivers several CSV files, given as pairs of name and content.
  using Csvs = std::vector<std::pair<std::string, CsvContent>>;
  void deliver(Json json, const Csvs& csvs, const std::string& table) const;
  /// Writes the files of --out while the command goes on, in place of those of the last call. Returns the
  /// reason if the directory cannot be replaced.
  [[nodiscard]] std::optional<std::string> deliver_so_far(Json json, const Csvs& csvs) const;

 private:
  void write_out(const std::string& json, const Csvs& csvs, const std::filesystem::path& replay) const;

  std::string name_, command_line_;
  Destinations destinations_;
  ProgressBar bar_;
  HeldWarnings held_;
  std::vector<std::string> warnings_;  // printed ones
  std::optional<std::filesystem::path> replay_;
  std::unique_ptr<AtomicFiles> files_, replay_files_;
};

}  // namespace kds
