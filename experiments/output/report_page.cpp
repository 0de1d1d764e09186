#include "experiments/output/report_page.h"

#include <fmt/format.h>

#include "experiments/output/page_data.h"
#include "experiments/output/page_templates.h"
#include "experiments/output/result_json.h"

namespace kds {

namespace {

// Returns a relative URL. All bytes but those that every URL may contain are escaped.
std::string url_of(const std::filesystem::path& path) {
  std::string url;
  for (const char c : path.generic_string()) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("-._~/").find(c) != std::string_view::npos;
    url += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return url;
}

}  // namespace

void write_report(AtomicFiles& files, const std::filesystem::path& file, std::string_view json,
                  const ReportLinks& links) {
  std::string page;
  for (const std::string_view piece : report_template()) page += piece;
  const Json meta{{"format", "kds-report"},
                  {"version", 1},
                  {"replay", links.replay.empty() ? Json() : Json(url_of(links.replay))},
                  {"data", links.data},
                  {"size", json.size()}};
  page.replace(page.find(page_data_mark), page_data_mark.size(),
               fmt::format("<script type=\"application/json\" id=\"kds-report\">{}</script>\n"
                           "<script type=\"text/plain\" id=\"kds-result\">{}</script>",
                           without_tags(text_of(meta)), base64(compressed(json))));
  files.write(file, page);
}

std::filesystem::path replay_beside(const std::filesystem::path& directory,
                                    const std::optional<std::filesystem::path>& replay) {
  return replay ? place_of(*replay).lexically_relative(place_of(directory)) : std::filesystem::path();
}

void print_report_path(const std::filesystem::path& directory) {
  print_to_stdout("report " + (directory / report_name).string() + "\n");
}

}  // namespace kds
