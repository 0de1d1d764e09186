#pragma once
// Reads the data of report.html, without the code that writes them.

#include <zlib.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "tests/experiments/replay_data.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test {

struct ReportData {
  nlohmann::json links, result;

  explicit ReportData(const std::string& file) {
    const std::string page = content_of(file);
    links = nlohmann::json::parse(text_of_script(page, "kds-report"));
    const std::string packed = from_base64(text_of_script(page, "kds-result"));
    std::string bytes(links.at("size").get<std::size_t>(), '\0');
    uLongf size = bytes.size();
    const int code = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                                reinterpret_cast<const Bytef*>(packed.data()), packed.size());
    if (code != Z_OK || size != bytes.size()) throw std::runtime_error(file + ": no result in the page");
    result = nlohmann::json::parse(bytes);
  }

 private:
  static std::string text_of_script(const std::string& page, const std::string& id) {
    const std::size_t tag = page.find("id=\"" + id + "\">");
    if (tag == std::string::npos) throw std::runtime_error("the page has no " + id);
    const std::size_t begin = page.find('>', tag) + 1;
    return page.substr(begin, page.find("</script>", begin) - begin);
  }
};

}  // namespace kds::test
