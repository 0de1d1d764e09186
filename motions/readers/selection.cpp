#include "motions/readers/selection.h"

#include <algorithm>

#include "motions/base/text_input.h"
#include "motions/readers/atom_filter.h"

namespace kds {

std::optional<Selection> Selection::parse(std::string_view text, std::string_view option) {
  const auto* const name = std::find(selection_names.begin() + 1, selection_names.end(), lower_case(text));
  if (name != selection_names.end()) return Selection(static_cast<Kind>(name - selection_names.begin()));
  const bool starts_with_number =
      !text.empty() && std::string_view("0123456789.-").find(text[0]) != std::string_view::npos;
  if (!starts_with_number && text.find_first_of("/([:;") == std::string_view::npos) return std::nullopt;
  static_cast<void>(AtomFilter(std::string(text), option));
  Selection selection(atoms);
  selection.atoms_ = text;
  return selection;
}

std::string Selection::text() const {
  return kind_ == atoms ? atoms_ : std::string(selection_names[static_cast<std::size_t>(kind_)]);
}

}  // namespace kds
