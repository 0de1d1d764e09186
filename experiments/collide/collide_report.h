#pragma once
// What `kds collide` found, for programs and for people.

#include <string>

#include "experiments/collide/compare_detectors.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/result_json.h"

namespace kds {

[[nodiscard]] Json collide_rows_json(const CollideReport& report);
/// Frame by frame what all methods agree on.
[[nodiscard]] Json collide_frames_json(const CollideReport& report);
/// A header and one line a row.
[[nodiscard]] std::string collide_csv(const CollideReport& report);
/// A header and one line a frame.
[[nodiscard]] std::string collide_frames_csv(const CollideReport& report);
[[nodiscard]] std::string collide_table(const CollideReport& report);
/// `map`: of contacts, empty where there are none; `page` says how it was made.
[[nodiscard]] std::string collide_page(const CollideReport& report, const std::string& input,
                                       const std::string& map, Page page);

}  // namespace kds
