#include "structures/contacts/contact_elements.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "motions/base/input_error.h"
#include "motions/readers/bead_name.h"

namespace kds {

namespace {

/// Returns the chain's name in the file, or the number of the necklace if the file has no name or uses it
/// twice.
std::vector<std::string> names_of_chains(const Scene& scene) {
  std::vector<std::string> names;
  for (const BeadRange& necklace : scene.necklaces()) {
    const std::optional<BeadName> bead = bead_name_of(scene.bead_name(necklace.first));
    names.push_back(bead && !bead->chain.empty() ? "chain " + bead->chain : "");
  }
  const std::vector<std::string> given = names;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (given[k].empty() || std::count(given.begin(), given.end(), given[k]) > 1)
      names[k] = fmt::format("necklace {}", k);
  return names;
}

}  // namespace

ContactElements elements_of(const Scene& scene, ContactElement kind) {
  ContactElements elements;
  const bool several = scene.necklaces().size() > 1;
  std::vector<std::string> chains;
  if (kind == ContactElement::chain) chains = names_of_chains(scene);
  for (std::size_t k = 0; k < scene.necklaces().size(); ++k) {
    std::optional<BeadName> last;
    for (BeadId bead = scene.necklaces()[k].first; bead <= scene.necklaces()[k].last; ++bead) {
      const std::string& text = scene.bead_name(bead);
      const bool is_first = bead == scene.necklaces()[k].first;
      std::optional<BeadName> name = bead_name_of(text);
      if (kind == ContactElement::residue && !name)
        throw InputError(
            fmt::format("bead {} has no residue; contacts by residue need a file that names residues, "
                        "expected contacts by bead or a topology",
                        bead));
      bool is_new = kind == ContactElement::bead || is_first;
      if (kind == ContactElement::residue && !is_first)
        is_new = name->residue != last->residue || name->number != last->number || name->chain != last->chain;
      if (is_new) {
        elements.chains.push_back(static_cast<std::uint32_t>(k));
        elements.names.push_back(kind == ContactElement::chain     ? chains[k]
                                 : kind == ContactElement::residue ? residue_text(*name, several)
                                 : text.empty()                    ? fmt::format("bead {}", bead)
                                                                   : text);
      }
      elements.of_bead.push_back(static_cast<std::uint32_t>(elements.names.size() - 1));
      last = std::move(name);
    }
  }
  return elements;
}

}  // namespace kds
