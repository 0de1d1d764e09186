#include "experiments/program/table_command.h"

#include <algorithm>
#include <optional>

#include "experiments/output/output_files.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/text.h"

namespace kds {

namespace {

constexpr std::string_view kReport = "report.html";

}  // namespace

TableCommand::TableCommand(std::string name, const Arguments& arguments, Destinations destinations,
                           std::string_view counted)
    : name_(std::move(name)),
      command_line_("kds " + name_ + " " + shell_words(arguments)),
      destinations_(std::move(destinations)),
      bar_(!destinations_.quiet, counted) {}

void TableCommand::check_destinations(TakenPaths taken) const {
  check_destinations(std::move(taken), {name_ + ".json", name_ + ".csv", std::string(kReport)});
}

void TableCommand::check_destinations(TakenPaths taken, const std::vector<std::string>& files) const {
  const auto& [out, json, quiet] = destinations_;
  if (out) {
    taken.write_into("--out", *out);
    for (const std::string& file : files) taken.write("--out", *out / file);
  }
  if (json) taken.write_json(*json);

  if (json && *json != "-") ensure_writable_file(*json, "--json");
  if (!out) return;
  for (const std::string& file : files)
    if (file != kReport) check_directory(*out, name_, "--out", {file});
  if (std::ranges::find(files, kReport) != files.end()) check_page(*out, name_);
}

void TableCommand::check_inputs_and_destinations(const InputOptions& inputs) const {
  check_inputs_exist(inputs);
  TakenPaths taken;
  taken.read(inputs);
  check_destinations(std::move(taken));
}

std::vector<std::string> TableCommand::warnings() {
  bar_.erase();
  std::vector<std::string> warnings;
  held_.release([&](const std::string& warning) {
    warnings.push_back(warning);
    print_warning(bar_, warning);
  });
  return warnings;
}

Page TableCommand::page(Json settings, std::vector<std::string> data) const {
  Page page;
  page.command_line = command_line_;
  page.settings = std::move(settings);
  page.data = std::move(data);
  return page;
}

void TableCommand::deliver(Json json, const std::string& csv, const std::string& table,
                           const PageOf& page_of) const {
  deliver(std::move(json), Csvs{{name_ + ".csv", csv}}, table, page_of);
}

void TableCommand::deliver(Json json, const Csvs& csvs, const std::string& table,
                           const PageOf& page_of) const {
  add_provenance(json, command_line_);
  deliver_text(text_of(json), json["settings"], csvs, table, page_of);
}

void TableCommand::deliver_text(const std::string& json, const Json& settings, const Csvs& csvs,
                                const std::string& table, const PageOf& page_of) const {
  const auto& [out, json_path, quiet] = destinations_;
  const bool json_on_stdout = json_path == "-";
  std::optional<AtomicFiles> files;
  if (out) {
    std::vector<std::string> data{name_ + ".json"};
    files.emplace(*out, name_, "--out");
    files->write(data.front(), json);
    for (const auto& [name, csv] : csvs) {
      files->write(name, csv);
      data.push_back(name);
    }
    if (page_of) files->write(std::string(kReport), page_of(page(settings, std::move(data))));
  }
  AtomicFiles json_file;
  if (json_path && !json_on_stdout) json_file.write(*json_path, json);
  commit_together({files ? &*files : nullptr, &json_file});
  if (json_on_stdout) print_to_stdout(json);
  if (!quiet && !json_on_stdout) print_to_stdout(table);
}

}  // namespace kds
