#include "experiments/impacts/query_file.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/output/text.h"
#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/numbers/exact_number.h"

namespace kds {

namespace {

std::optional<Integer> whole_number(std::string_view field) {
  const std::string text(trimmed(field));
  const std::size_t digits = text.starts_with('-') ? 1 : 0;
  if (text.size() == digits || text.find_first_not_of("0123456789", digits) != std::string::npos)
    return std::nullopt;
  return Integer(text);
}

}  // namespace

void QueryFile::fail(std::string_view expected, std::string_view found) const {
  throw InputError(fmt::format("{}:{}: expected {}, found {}", lines_.name(), lines_.number(), expected,
                               in_quotes(found)));
}

std::optional<bool> QueryFile::parse(std::string_view line, double* point) const {
  constexpr std::string_view six =
      "the numerators and denominators of x, y and z, and 0 or 1 if the answer is known";
  const std::vector<std::string> fields = split(std::string(line), ',');
  if (fields.size() != 6 && fields.size() != 7) fail(six, line);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto numerator = whole_number(fields[2 * axis]), denominator = whole_number(fields[2 * axis + 1]);
    if (!numerator || !denominator) fail(six, line);
    if (*denominator <= 0) fail("a denominator above 0", fields[2 * axis + 1]);
    const Rational exact = fraction(*numerator, *denominator);
    point[axis] = exact.get_d();
    if (!std::isfinite(point[axis]) || Rational(point[axis]) != exact)
      fail("a fraction that is a double", fmt::format("{}/{}", fields[2 * axis], fields[2 * axis + 1]));
  }
  if (fields.size() == 6) return std::nullopt;
  const std::string_view answer = trimmed(fields[6]);
  if (answer != "0" && answer != "1") fail("the answer 0 or 1", answer);
  return answer == "1";
}

bool QueryFile::next(ImpactQuery& query) {
  constexpr std::size_t lines = 8, points = 4, per_point = 6;
  std::string_view line;
  for (std::size_t k = 0; k < lines; ++k) {
    do {
      if (lines_.next(line)) continue;
      if (k == 0) return false;
      throw InputError(
          fmt::format("{}: ends after {} of a query; expected {}", lines_.name(), counted(k, "line"), lines));
    } while (trimmed(line).empty());
    const std::optional<bool> answer = parse(line, &query.points[k % points * per_point + k / points * 3]);
    if (k > 0 && answer != query.answer) fail("the answer of the query's first line", line);
    query.answer = answer;
  }
  return true;
}

}  // namespace kds
