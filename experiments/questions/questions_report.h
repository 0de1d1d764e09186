#pragma once
// The results of `kds questions` as JSON, CSV, text and a page.

#include <span>
#include <string>

#include "experiments/output/page/html_page.h"
#include "experiments/output/result_json.h"
#include "experiments/questions/question.h"

namespace kds {

[[nodiscard]] Json question_rows_json(std::span<const Question> questions);
/// Of each question its title, fits and findings.
[[nodiscard]] Json questions_json(std::span<const Question> questions);
/// A header and a line a row; columns of other questions are empty.
[[nodiscard]] std::string questions_csv(std::span<const Question> questions);
[[nodiscard]] std::string questions_text(std::span<const Question> questions);
/// `page` says how it was made.
[[nodiscard]] std::string questions_page(std::span<const Question> questions, Page page);

}  // namespace kds
