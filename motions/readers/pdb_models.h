#pragma once
// Cuts a PDB file into its models while it is read, each with its atoms, checked.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "motions/base/line_reader.h"
#include "motions/frames/frame_selection.h"
#include "motions/frames/periodic.h"
#include "motions/readers/pdb_atom_line.h"

namespace kds {

struct PdbModel {
  std::vector<PdbAtom> atoms;     ///< each with its place in the model, from 0
  std::vector<std::size_t> ends;  ///< of chains: number of atoms before each TER, ascending
  CellRead cell;                  ///< of a simulation box: CRYST1 with space group P 1 (or none)
};

/// Lines of a file that hold atoms but belong to no model: how many, and the first of them, from 1.
struct LinesLeftOut {
  std::size_t count = 0, first = 0;

  void add(std::size_t line) {
    if (count++ == 0) first = line;
  }
};

/// A model begins at MODEL and ends at ENDMDL, END or the next MODEL. Atoms without a MODEL make a model too,
/// up to ENDMDL or END. Behind a model with MODEL they need ENDMDL at their end, otherwise they are left out.
class PdbModelReader {
 public:
  /// Throws InputError naming the file.
  explicit PdbModelReader(const std::filesystem::path& path) : lines_(path) {}

  /// Reads the next model; returns false behind the last one. Throws InputError naming file and line as
  /// read_atom_line does.
  [[nodiscard]] bool next(PdbModel& model) { return read(&model); }
  /// Leaves the next model unread, and unchecked.
  [[nodiscard]] bool skip() { return read(nullptr); }
  void rewind();
  /// The models read or skipped so far. The file ends inside a model if all but the last are closed by ENDMDL
  /// or END.
  [[nodiscard]] FramesHeld held() const;
  /// Atoms outside the models, in the part of the file read so far.
  [[nodiscard]] const LinesLeftOut& outside() const { return outside_; }
  /// Lines that look like atoms but are not valid records, likewise.
  [[nodiscard]] const LinesLeftOut& near_misses() const { return near_misses_; }

 private:
  struct Run;
  [[nodiscard]] bool read(PdbModel* model);
  void open(Run& run, bool with_record);
  [[nodiscard]] bool close(Run& run, bool is_model);
  void add_atom(std::string_view line, Run& run);

  LineReader lines_;
  bool opening_ = false;  ///< MODEL of the next model is read already
  CellRead cell_;
  std::size_t models_ = 0, closed_ = 0;
  bool has_model_records_ = false;
  bool ended_ = false;  ///< with the file, inside a model
  LinesLeftOut outside_, near_misses_;
};

}  // namespace kds
