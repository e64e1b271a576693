#include "media/grid/vdb_reader.h"

#include <openvdb/io/Archive.h>
#include <openvdb/io/io.h>
#include <openvdb/openvdb.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <functional>
#include <map>
#include <set>

#include "phase/base/error.h"

namespace arcus::media {
namespace {

constexpr std::string_view half_suffix = "_HalfFloat";  // of a type's name, as GridDescriptor writes it

/// "Tree_float_5_4_3" is everybody's float grid.
std::string plain_type(const std::string& type) {
  const std::string_view prefix = "Tree_", suffix = "_5_4_3";
  if (!type.starts_with(prefix) || !type.ends_with(suffix)) return type;
  const std::string value = type.substr(prefix.size(), type.size() - prefix.size() - suffix.size());
  if (value.starts_with("ptdataidx")) return "points";
  if (value.starts_with("ptidx")) return "point indices";
  return value;
}

}  // namespace

std::string VdbEntry::label() const {
  std::string text = is_unique && !name.empty() ? name : name + "[" + std::to_string(index) + "]";
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return text;
}

// openvdb::io::File checks its stream here and there only, so that a truncated file can leave sizes unread and crash it.
// This reads through the same Archive, but from a stream that throws at the first byte that is not there.
class VdbReader::Implementation : public openvdb::io::Archive {
 public:
  explicit Implementation(const std::string& path) : path_(path) {
    openvdb::initialize();
    stream_.open(path, std::ios::binary);
    if (!stream_) throw bad_input(path, std::strerror(errno), "an OpenVDB file that can be read");
    stream_.seekg(0, std::ios::end);
    size_ = stream_.tellg();
    stream_.seekg(0);
    if (size_ < 0) throw bad_input(path, "something that is not a file", "an OpenVDB file");
    guarded([&] { read_contents(); });
  }

  std::shared_ptr<void> read(std::size_t entry, bool whole) {
    openvdb::GridBase::Ptr grid;
    guarded([&] { grid = grid_of(entry, whole); });
    return grid;
  }

  std::string path_;
  std::vector<VdbEntry> entries_;

 private:
  /// Turns whatever OpenVDB throws about a file into bad_input.
  void guarded(const std::function<void()>& work) {
    try {
      stream_.clear();
      stream_.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
      work();
      stream_.exceptions(std::ios::goodbit);
    } catch (const Error&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::ios_base::failure&) {
      throw damaged("the end of the file too early");
    } catch (const std::exception& error) {  // OpenVDB's own, or a length that no string can have
      throw damaged(std::string("damage (") + error.what() + ")");
    }
  }
  Error damaged(const std::string& found) const {
    return bad_input(path_, found, "a whole OpenVDB file expected", "It may have been cut short on its way: copy it again");
  }

  void read_contents() {
    char magic[8];
    if (size_ < static_cast<std::streamoff>(sizeof magic)) throw not_vdb();
    stream_.read(magic, sizeof magic);
    std::int64_t number;
    std::memcpy(&number, magic, sizeof number);
    if (number != openvdb::OPENVDB_MAGIC) throw not_vdb();
    stream_.seekg(0);
    openvdb::io::setStreamMetadataPtr(stream_, tags_);
    readHeader(stream_);
    openvdb::io::setVersion(stream_, libraryVersion(), fileVersion());
    openvdb::io::setDataCompression(stream_, compression());
    openvdb::MetaMap metadata;
    metadata.readMeta(stream_);
    if (!inputHasGridOffsets())
      throw bad_input(path_, "a stream without a table of contents", "an OpenVDB file saved to disk expected",
                      "vdb_view or OpenVDB's python module can save it as a file");
    const std::int32_t count = readGridCount(stream_);
    std::map<std::string, int> named;
    for (std::int32_t i = 0; i < count; ++i) read_descriptor(named);
    for (VdbEntry& entry : entries_) entry.is_unique = named[entry.name] == 1;
  }
  Error not_vdb() const { return bad_input(path_, "something else than an OpenVDB file", "a .vdb file expected"); }

  /// GridDescriptor::read refuses types that OpenVDB does not know; here they are skipped.
  void read_descriptor(std::map<std::string, int>& named) {
    const std::string unique = openvdb::readString(stream_);
    std::string type = openvdb::readString(stream_);
    const bool half = type.ends_with(half_suffix);
    if (half) type.resize(type.size() - half_suffix.size());
    std::string parent;
    if (fileVersion() >= openvdb::OPENVDB_FILE_VERSION_GRID_INSTANCING) parent = openvdb::readString(stream_);
    std::int64_t places[3];
    stream_.read(reinterpret_cast<char*>(places), sizeof places);
    for (const std::int64_t place : places)
      if (place < 0 || place > size_) throw damaged("the end of the file too early");
    openvdb::io::GridDescriptor descriptor(unique, type, half);
    descriptor.setInstanceParentName(parent);
    descriptor.setGridPos(places[0]);
    descriptor.setBlockPos(places[1]);
    descriptor.setEndPos(places[2]);
    const std::string name = descriptor.gridName();
    entries_.push_back({name, named[name]++, true, plain_type(type), half});
    descriptors_.push_back(descriptor);
    if (places[2] < stream_.tellg()) throw damaged("a table of contents that points backwards");
    stream_.seekg(places[2]);
  }

  openvdb::GridBase::Ptr grid_of(std::size_t entry, bool whole) {
    const openvdb::io::GridDescriptor& descriptor = descriptors_[entry];
    if (!openvdb::GridBase::isRegistered(descriptor.gridType())) return nullptr;
    const openvdb::GridBase::Ptr grid = openvdb::GridBase::createGrid(descriptor.gridType());
    grid->setSaveFloatAsHalf(descriptor.saveFloatAsHalf());
    grid->setName(descriptor.gridName());
    descriptor.seekToGrid(stream_);
    const bool transform_first = fileVersion() >= openvdb::OPENVDB_FILE_VERSION_GRID_INSTANCING;
    if (!whole && transform_first) {
      readGridCompression(stream_);
      grid->readMeta(stream_);
      grid->readTransform(stream_);
      return grid;
    }
    readGrid(grid, descriptor, stream_);
    if (descriptor.isInstance()) {  // its tree is another grid's
      for (std::size_t other = 0; other < descriptors_.size(); ++other)
        if (other != entry && !descriptors_[other].isInstance() &&
            descriptors_[other].uniqueName() == descriptor.instanceParentName()) {
          const openvdb::GridBase::Ptr parent = grid_of(other, true);
          if (!parent || parent->type() != grid->type()) break;
          grid->setTree(parent->baseTreePtr());
          return grid;
        }
      throw damaged("a grid that refers to another one that is not there");
    }
    return grid;
  }

  /// Versions and compression, for OpenVDB's readers: the stream keeps the address of this very pointer.
  std::shared_ptr<openvdb::io::StreamMetadata> tags_ = std::make_shared<openvdb::io::StreamMetadata>();
  std::ifstream stream_;
  std::streamoff size_ = 0;
  std::vector<openvdb::io::GridDescriptor> descriptors_;
};

VdbReader::VdbReader(const std::string& path) : implementation_(std::make_unique<Implementation>(path)) {}
VdbReader::~VdbReader() = default;
const std::string& VdbReader::path() const { return implementation_->path_; }
const std::vector<VdbEntry>& VdbReader::entries() const { return implementation_->entries_; }
std::string VdbReader::where(std::size_t entry) const {
  return path() + ": grid '" + entries()[entry].label() + "'";
}
std::optional<VdbGrid> VdbReader::read_header(std::size_t entry) {
  auto grid = implementation_->read(entry, false);
  return grid ? std::optional(VdbGrid(std::move(grid), where(entry))) : std::nullopt;
}
VdbGrid VdbReader::read(std::size_t entry) { return {implementation_->read(entry, true), where(entry)}; }

}  // namespace arcus::media
