#pragma once
// The frame of a command whose result is a table: destinations, progress bar, warnings, and results as
// NAME.json, NAME.csv and report.html in --out, as --json and on standard output.
//
//   TableCommand command("update", arguments, options, "round");
//   command.check_destinations(taken);          // before anything is read
//   const auto rows = measure(command.warn(), command.progress());
//   Json json{{"settings", ...}, {"rows", ...}, {"warnings", command.warnings()}};
//   command.deliver(json, csv, table, [&](Page page) { return update_page(rows, page); });

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/output/destinations.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/result_json.h"
#include "experiments/program/command_line.h"
#include "experiments/program/progress_bar.h"
#include "experiments/program/taken_paths.h"
#include "experiments/program/warnings.h"

namespace kds {

class TableCommand {
 public:
  using Progress = std::function<void(std::size_t done, std::size_t total)>;
  using Warn = HeldWarnings::Warn;
  using PageOf = std::function<std::string(Page)>;

  /// `counted` names what the progress bar counts.
  TableCommand(std::string name, const Arguments& arguments, Destinations destinations,
               std::string_view counted);

  /// Throws InputError if a result could not be written later, or would replace another result or a file that
  /// is taken. --out gets NAME.json, NAME.csv and report.html.
  void check_destinations(TakenPaths taken = {}) const;
  /// The same for a command that reads these inputs. Throws InputError also if one does not exist.
  void check_inputs_and_destinations(const InputOptions& inputs) const;
  /// The same as check_destinations for a command that writes `files` into --out. Checks that report.html, if
  /// it is among them, can be made.
  void check_destinations(TakenPaths taken, const std::vector<std::string>& files) const;

  [[nodiscard]] ProgressBar& bar() { return bar_; }
  [[nodiscard]] Progress progress() {
    return [this](std::size_t done, std::size_t total) { bar_.update(done, total); };
  }
  /// Takes a warning and keeps it, since the input may yet be refused.
  [[nodiscard]] Warn warn() { return held_.hold(); }
  /// Prints the warnings that were kept, and returns them.
  [[nodiscard]] std::vector<std::string> warnings();

  /// The command with its arguments, quoted for a shell.
  [[nodiscard]] const std::string& command_line() const { return command_line_; }
  /// A page that is yet to be filled: how it was made, and which data files lie beside it.
  [[nodiscard]] Page page(Json settings, std::vector<std::string> data = {}) const;

  /// Adds command, version and machine to `json`, whose member `settings` the page shows too, and writes all
  /// results. The files of --out appear together. The table is printed unless --quiet is given or the JSON
  /// goes to standard output.
  void deliver(Json json, const std::string& csv, const std::string& table, const PageOf& page_of = {}) const;

  /// The same for several CSV files, each by its name.
  using Csvs = std::vector<std::pair<std::string, std::string>>;
  void deliver(Json json, const Csvs& csvs, const std::string& table, const PageOf& page_of = {}) const;
  /// The same where the JSON is text already.
  void deliver_text(const std::string& json, const Json& settings, const Csvs& csvs, const std::string& table,
                    const PageOf& page_of) const;

 private:
  std::string name_, command_line_;
  Destinations destinations_;
  ProgressBar bar_;
  HeldWarnings held_;
};

}  // namespace kds
