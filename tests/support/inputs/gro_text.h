#pragma once
// Writes GRO files line by line, after GROMACS's manual.

#include <fmt/format.h>

#include <string>
#include <vector>

namespace kds::test {

/// An atom of a GRO file; lengths in nanometres.
struct GroAtom {
  int residue = 1;
  std::string residue_name = "ALA", name = "CA";
  double x = 0, y = 0, z = 0;
};

inline std::string gro_line(const GroAtom& atom, std::size_t serial, int decimals = 3,
                            bool velocity = false) {
  std::string line = fmt::format("{:>5}{:<5}{:>5}{:>5}", atom.residue % 100000, atom.residue_name, atom.name,
                                 serial % 100000);
  for (const double x : {atom.x, atom.y, atom.z}) line += fmt::format("{:{}.{}f}", x, decimals + 5, decimals);
  for (int axis = 0; velocity && axis < 3; ++axis)
    line += fmt::format("{:{}.{}f}", 0.1 * axis, decimals + 5, decimals + 1);
  return line + "\n";
}

struct GroText {
  std::string title = "made by a test";
  std::vector<GroAtom> atoms = {};
  std::string box = "   3.00000   4.00000   5.00000";
  int decimals = 3;
  bool velocities = false;

  /// Adds a residue of these atoms, each 0.15 nm after the one before.
  GroText& residue(int number, const std::string& name = "ALA",
                   const std::vector<std::string>& names = {"N", "CA", "C"}) {
    for (const std::string& atom : names)
      atoms.push_back({number, name, atom, 0.15 * static_cast<double>(atoms.size())});
    return *this;
  }
  GroText& residues(int first, int last, const std::string& name = "ALA",
                    const std::vector<std::string>& names = {"N", "CA", "C"}) {
    for (int number = first; number <= last; ++number) residue(number, name, names);
    return *this;
  }
  std::string text() const {
    std::string text = fmt::format("{}\n{:>5}\n", title, atoms.size());
    for (std::size_t i = 0; i < atoms.size(); ++i) text += gro_line(atoms[i], i + 1, decimals, velocities);
    return text + box + "\n";
  }
};

/// Returns a frame of two residues for each of these times, which stand in the titles.
inline std::string gro_with_times(const std::vector<double>& times) {
  std::string text;
  for (const double time : times) {
    GroText frame;
    frame.title = fmt::format("x t= {}", time);
    text += frame.residues(1, 2).text();
  }
  return text;
}

}  // namespace kds::test
