#include "experiments/program/contact_options.h"

#include <fmt/format.h>

#include "experiments/output/text.h"
#include "experiments/program/option_values.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

std::vector<double> parse_cutoff(const std::string& text, char separator) {
  const RealRange range{0, 1e9};
  if (separator == ',') return parse_reals("--cutoff", text, range);
  const std::vector<std::string> parts = split(text, separator);
  if (parts.size() > 2)
    throw InputError(
        "--cutoff", fmt::format("'{}' has {} lengths; expected one, or two as in 4.5:6", text, parts.size()));
  const double inner = parse_real("--cutoff", parts.front(), range);
  const double outer = parse_real("--cutoff", parts.back(), range);
  if (outer < inner)
    throw InputError("--cutoff",
                     fmt::format("'{}' ends contacts within the distance at which they begin; expected the "
                                 "smaller length first, {}:{}",
                                 text, parts.back(), parts.front()));
  return inner < outer ? std::vector{inner, outer} : std::vector{inner};
}

}  // namespace

void ContactDistances::check() const {
  if (lengths.empty() && between_surfaces)
    throw InputError("--surface", fmt::format("measures {} between surfaces; expected {} LENGTH as well",
                                              "--cutoff"_arg, "--cutoff"_arg));
  if (!lengths.empty() && lengths.front() == 0 && !between_surfaces)
    throw InputError("--cutoff",
                     fmt::format("centres that coincide are no contact; expected a length above 0, or {}",
                                 "--surface"_arg));
}

OptionList<ContactDistances> contact_options(const std::string& help, char separator) {
  using D = ContactDistances;
  auto cutoff = only_for({"contacts"},
                         list_option({"--cutoff", separator == ',' ? "LIST" : "LENGTH", help}, &D::lengths,
                                     [=](const std::string& text) { return parse_cutoff(text, separator); }));
  if (separator != ',') {
    cutoff.text = [](const D& d) { return fmt::format("{}", fmt::join(d.lengths, ":")); };
    cutoff.json = nullptr;
  }
  return {
      {cutoff, flag_option("--surface", "measure the cutoff between the surfaces of beads (default: centres)",
                           &D::between_surfaces)}};
}

}  // namespace kds
