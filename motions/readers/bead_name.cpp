#include "motions/readers/bead_name.h"

#include <fmt/format.h>

namespace kds {

namespace {

constexpr std::string_view of = " of ", in_chain = " in chain ", no_chain = "' '";

}  // namespace

std::string text_of(const BeadName& name) {
  return fmt::format("{}{}{} {}{}{}", name.atom, of, name.residue, name.number, in_chain,
                     name.chain.empty() ? no_chain : name.chain);
}

std::string residue_text(const BeadName& name, bool with_chain) {
  std::string text = fmt::format("{} {}", name.residue, name.number);
  if (with_chain && !name.chain.empty()) text += fmt::format("{}{}", in_chain, name.chain);
  return text;
}

std::optional<BeadName> bead_name_of(std::string_view text) {
  const std::size_t residue = text.find(of);
  const std::size_t chain = text.rfind(in_chain);
  if (residue == std::string_view::npos || chain == std::string_view::npos || chain < residue + of.size())
    return std::nullopt;
  const std::string_view middle = text.substr(residue + of.size(), chain - residue - of.size());
  const std::size_t number = middle.rfind(' ');
  if (number == std::string_view::npos) return std::nullopt;
  const std::string_view chain_name = text.substr(chain + in_chain.size());
  return BeadName{std::string(text.substr(0, residue)), std::string(middle.substr(0, number)),
                  std::string(middle.substr(number + 1)),
                  std::string(chain_name == no_chain ? "" : chain_name)};
}

}  // namespace kds
