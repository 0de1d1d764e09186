#pragma once
// Reports the results of `kds questions` as JSON, CSV, text and a page.

#include <span>
#include <string>

#include "experiments/output/page/html_page.h"
#include "experiments/output/result_json.h"
#include "experiments/questions/question.h"

namespace kds {

[[nodiscard]] Json question_rows_json(std::span<const Question> questions);
/// Returns the title, fits and findings of each question.
[[nodiscard]] Json questions_json(std::span<const Question> questions);
/// Returns a header and a line per row. Columns of other questions are empty.
[[nodiscard]] std::string questions_csv(std::span<const Question> questions);
[[nodiscard]] std::string questions_text(std::span<const Question> questions);
/// `page` says how the results were made.
[[nodiscard]] std::string questions_page(std::span<const Question> questions, Page page);

}  // namespace kds
