#pragma once
// An OpenVDB file opened for reading: which grids it holds, and each of them on demand. A file cut short or damaged is
// an error at the first number that is missing, never a read beyond the end.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "media/grid/vdb_grid.h"

namespace arcus::media {

/// One grid as the file's table of contents names it.
struct VdbEntry {
  std::string name;         ///< as its author gave it; not unique
  int index = 0;            ///< among the grids of that name, in the order of the file
  bool is_unique = true;    ///< the only one of that name
  std::string type;         ///< "float", "double", "vec3s", "bool", "points", ...; OpenVDB's full name for unusual trees
  bool saved_as_half = false;

  /// What picks it, fit for a terminal: the name, or name[index] where it is empty or not unique; control characters become '?'.
  std::string label() const;
};

class VdbReader {
 public:
  /// Reads the table of contents. Throws bad_input where the file is missing, not OpenVDB's, cut short or damaged.
  explicit VdbReader(const std::string& path);
  VdbReader(const VdbReader&) = delete;
  VdbReader& operator=(const VdbReader&) = delete;
  ~VdbReader();

  const std::string& path() const;
  const std::vector<VdbEntry>& entries() const;

  /// "FILE: grid 'label'", for messages.
  std::string where(std::size_t entry) const;
  /// A grid's metadata and transform, without values. Nothing where OpenVDB does not know the type.
  std::optional<VdbGrid> read_header(std::size_t entry);
  /// The whole grid; only where read_header gives something. Throws bad_input as above.
  VdbGrid read(std::size_t entry);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace arcus::media
