// [[import]]: other files whose bodies, joints and all else become part of a TOML model.
#pragma once

#include <string>
#include <vector>

#include "model/read/import_attach.hpp"
#include "model/read/read.hpp"
#include "model/read/toml_repeat.hpp"
#include "model/read/toml_table.hpp"

namespace jourdain::model {

/// A file that was imported, and where it belongs.
struct Import {
  MergedRange range;
  std::string file, parent, prefix;
  Placement placement;
  SourceRange where, parent_where;
  bool has_loop_options = false;  ///< the file has [loops]
};

/// Reads the files of all [[import]] tables, merges them into the mechanism and declares their parameters. What a file
/// is asked for that is not there, what it declares a second time, and all that is wrong in it becomes a diagnostic.
/// One that has not the form of its format is not among those returned and leaves the file's structure incomplete.
std::vector<Import> read_imports(TomlFile& file, const TomlTables& section, const ReadOptions& options,
                                 const ImportChain& chain, Mechanism& mechanism);

/// Puts them where they belong, once all bodies and frames are known.
void attach_imports(TomlFile& file, const std::vector<Import>& imports, Mechanism& mechanism);

}  // namespace jourdain::model
