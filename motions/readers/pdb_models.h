#pragma once
// Cuts a PDB file into its models while it is read, each with the lines that name and place atoms, checked.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "motions/base/line_reader.h"
#include "motions/frames/frame_selection.h"
#include "motions/frames/periodic.h"

namespace kds {

struct PdbModel {
  /// ATOM, HETATM and TER, with an atom's place in the model (from 0) for its serial number.
  std::string atom_lines;
  std::optional<Cell> cell;  ///< of a simulation box: CRYST1 with space group P 1 (or none)
};

/// Models begin at MODEL and end at ENDMDL, END or the next MODEL; atoms before any MODEL make one too.
class PdbModelReader {
 public:
  /// Throws InputError naming the file.
  explicit PdbModelReader(const std::filesystem::path& path) : lines_(path) {}

  /// The next model; false behind the last one. Throws InputError naming file and line if a line is too short
  /// or a coordinate is no number.
  [[nodiscard]] bool next(PdbModel& model) { return read(&model); }
  /// Leaves the next model unread, and unchecked.
  [[nodiscard]] bool skip() { return read(nullptr); }
  void rewind();
  /// Of the models read or left out so far. The file ends inside a model if all but the last are closed by
  /// ENDMDL or END.
  [[nodiscard]] FramesHeld held() const;

 private:
  [[nodiscard]] bool read(PdbModel* model);
  void add_line(std::string_view line, std::size_t atoms, std::string& atom_lines) const;

  LineReader lines_;
  std::string opening_;  ///< MODEL, read already, of the next model; empty: none
  std::optional<Cell> cell_;
  std::size_t models_ = 0, closed_ = 0;
  bool ended_ = false;  ///< with the file, inside a model
};

}  // namespace kds
