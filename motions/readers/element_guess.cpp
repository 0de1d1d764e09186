#include "motions/readers/element_guess.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "motions/base/text_input.h"
#include "motions/readers/residue_kind.h"

namespace kds {

namespace {

using gemmi::El;

// Returns the letters before the first other character that follows a letter.
std::string_view letters_of(std::string_view name) {
  const auto is_letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); };
  while (!name.empty() && !is_letter(name.front())) name.remove_prefix(1);
  return name.substr(
      0, static_cast<std::size_t>(std::find_if_not(name.begin(), name.end(), is_letter) - name.begin()));
}

El ion_of(std::string_view letters) {
  constexpr std::array<std::pair<std::string_view, El>, 9> charmm{{{"SOD", El::Na},
                                                                   {"CLA", El::Cl},
                                                                   {"POT", El::K},
                                                                   {"CAL", El::Ca},
                                                                   {"CES", El::Cs},
                                                                   {"LIT", El::Li},
                                                                   {"RUB", El::Rb},
                                                                   {"BAR", El::Ba},
                                                                   {"CAD", El::Cd}}};
  for (const auto& [name, element] : charmm)
    if (letters == name) return element;
  return letters.size() > 2 ? El::X : gemmi::Element(std::string(letters)).elem;
}

bool is_ion(const StructureResidue& residue) {
  return residue.atoms.size() == 1 && !is_tabulated_monomer(residue.name) && !is_water(residue.name);
}

El element_by_name(const StructureResidue& residue, const std::string& name) {
  const std::string_view letters = letters_of(name);
  if (letters.empty() || names_site(residue, name)) return El::X;
  if (is_ion(residue))
    if (const El ion = ion_of(letters); ion != El::X) return ion;
  if (!is_tabulated_monomer(residue.name)) {
    constexpr std::array<std::string_view, 9> others{"CL", "BR", "FE", "ZN", "MG", "MN", "CU", "NI", "SE"};
    const std::string_view two = letters.substr(0, 2);
    if (letters.size() == 2 && std::find(others.begin(), others.end(), two) != others.end())
      return gemmi::Element(std::string(two)).elem;
  }
  if (letters == "SE") return El::Se;
  return gemmi::Element(std::string(letters.substr(0, 1))).elem;
}

char capital(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

// Returns the element of this mass, or X.
El element_by_mass(double mass) {
  constexpr double tolerance = 0.2, deuterium = 2.014;
  if (std::abs(mass - deuterium) < 0.01) return El::D;
  El nearest = El::X;
  double least = tolerance;
  for (int number = 1; number < static_cast<int>(El::Cf); ++number) {
    const gemmi::Element element(number);
    const double difference = std::abs(element.weight() - mass);
    if (difference < least) {
      least = difference;
      nearest = element.elem;
    }
  }
  return nearest;
}

// Returns whether the name may be that of an atom of this element.
bool suits(const std::string& name, El element) {
  const std::string_view letters = letters_of(name);
  if (letters.empty()) return false;
  const char first = capital(letters[0]);
  return first == gemmi::Element(element).name()[0] || (element == El::D && first == 'H');
}

}  // namespace

void guess_elements_by_name(StructureResidue& residue) {
  const bool has_no_elements = is_martini(residue);
  for (StructureAtom& atom : residue.atoms) {
    atom.element = has_no_elements ? El::X : element_by_name(residue, atom.name);
    atom.element_is_given = true;  // the file has no better information
  }
}

std::optional<std::string> set_elements_by_mass(std::vector<StructureResidue>& residues,
                                                const std::vector<double>& masses) {
  constexpr double least_of_nuclei = 0.9;
  const bool any_mass = std::any_of(masses.begin(), masses.end(), [](double mass) { return mass != 0; });
  std::size_t guessed = 0;
  std::string first;
  for (StructureResidue& residue : residues) {
    if (is_martini(residue)) {
      guess_elements_by_name(residue);
      continue;
    }
    for (StructureAtom& atom : residue.atoms) {
      if (atom.element_is_given) continue;
      const double mass = masses[atom.index];
      atom.is_massless = any_mass && mass < least_of_nuclei;
      atom.element = any_mass ? element_by_mass(mass) : element_by_name(residue, atom.name);
      // Hydrogens whose mass is repartitioned weigh up to 4.032. Helium bonds to no atom.
      if (atom.element == El::He && residue.atoms.size() > 1) atom.element = El::H;
      atom.element_is_given = true;
      if (!any_mass || atom.is_massless ||
          (atom.element != El::X && (suits(atom.name, atom.element.elem) || is_ion(residue))))
        continue;
      atom.element = element_by_name(residue, atom.name);
      if (guessed++ == 0)
        first = fmt::format("{} of {} {}, {}", atom.name, residue.name, residue.number, mass);
    }
  }
  if (!any_mass) return "all masses are 0: the names of atoms give their elements";
  if (guessed == 0) return std::nullopt;
  return fmt::format(
      "the mass of {} suits no element of its name, which gives the element instead (first: {})",
      counted(guessed, "atom"), first);
}

}  // namespace kds
