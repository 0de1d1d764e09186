#pragma once
// Splits a PDB file into its models while reading it. The atoms of each model are checked.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "motions/base/input_file.h"
#include "motions/frames/frame_selection.h"
#include "motions/frames/periodic.h"
#include "motions/readers/pdb_atom_line.h"

namespace kds {

struct PdbModel {
  std::vector<PdbAtom> atoms;     ///< each with its index in the model, from 0
  std::vector<std::size_t> ends;  ///< chain ends: the number of atoms before each TER, ascending
  CellRead cell;  ///< the cell of a simulation box: CRYST1 with space group P 1 (or without one)
};

/// Lines of a file that hold atoms but belong to no model: their number, and the first of them, counted
/// from 1.
struct LinesLeftOut {
  std::size_t count = 0, first = 0;

  void add(std::size_t line) {
    if (count++ == 0) first = line;
  }
};

/// Reads models. A model begins at MODEL and ends at ENDMDL, END or the next MODEL. Atoms without a MODEL
/// also make a model, up to ENDMDL or END. After a model with MODEL, such atoms need ENDMDL at their end,
/// otherwise they are left out.
class PdbModelReader {
 public:
  /// Opens the file. Throws InputError naming the file.
  explicit PdbModelReader(const std::filesystem::path& path) : lines_(path) {}

  /// Reads the next model. Returns false after the last model. Throws InputError naming file and line, as
  /// read_atom_line does.
  [[nodiscard]] bool next(PdbModel& model) { return read(&model); }
  /// Skips the next model without reading or checking it. Returns false after the last model.
  [[nodiscard]] bool skip() { return read(nullptr); }
  void rewind();
  /// Returns the models read or skipped so far. The last model counts as truncated if the file ends inside it
  /// and all models before it are closed by ENDMDL or END, or if the file ends inside one of its lines. The
  /// file ends inside its last line if that line has no line end and is an atom shorter than the atoms before
  /// it, or no whole record.
  [[nodiscard]] FramesHeld held() const;
  /// Returns the atoms outside of models in the part of the file read so far.
  [[nodiscard]] const LinesLeftOut& outside() const { return outside_; }
  /// Returns whether the last model read begins with MODEL and the file ends without ENDMDL or END after it.
  [[nodiscard]] bool lacks_end() const { return ended_ && ended_with_record_; }
  /// Returns the largest number of models that a record NUMMDL announces, 0 if there is none.
  [[nodiscard]] std::size_t announced() const { return announced_; }
  /// Returns the lines read so far that look like atoms but are not valid records.
  [[nodiscard]] const LinesLeftOut& near_misses() const { return near_misses_; }
  /// Whether a cell that is used was read so far, also before a rewind.
  [[nodiscard]] bool has_met_cell() const { return has_met_cell_; }

 private:
  struct Run;
  [[nodiscard]] bool read(PdbModel* model);
  void open(Run& run, bool with_record);
  [[nodiscard]] bool close(Run& run, bool is_model);
  void add_atom(std::string_view line, Run& run);
  [[nodiscard]] bool is_cut_off(std::string_view line, const Run& run) const;

  LineReader lines_;
  bool opening_ = false;  ///< the MODEL record of the next model has been read
  CellRead cell_;
  bool has_met_cell_ = false;
  std::size_t models_ = 0, closed_ = 0;
  bool has_model_records_ = false;
  bool ended_ = false;              ///< the file ended inside a model
  bool ended_with_record_ = false;  ///< that model began with MODEL
  bool ends_inside_line_ = false;   ///< the file ended inside a line of a model
  std::size_t announced_ = 0;
  LinesLeftOut outside_, near_misses_;
};

}  // namespace kds
