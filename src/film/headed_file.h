#pragma once
// How our binary files begin, so that what follows can be trusted: a mark, and a header of text under a hash.
//
// Little-endian, without gaps:
//   8 bytes    the mark
//   4 bytes    format, an unsigned number
//   4 bytes    length H of the header, an unsigned number
//   32 bytes   XXH3 with 128 bits of the header, as hexadecimal digits
//   H bytes    the header, JSON, which holds the hashes of the arrays that follow
// So every byte stands under a hash or is compared with the only value it may have.

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "phase/base/error.h"

namespace arcus::render {

struct HeadedKind {
  std::string_view mark;  ///< 8 characters
  std::uint32_t format;
  std::string_view plural;  ///< what such files are called in messages
};

/// A file whose header has been read and whose arrays come next.
struct HeadedFile {
  std::string path;
  std::ifstream in;
  std::string header;
  std::uintmax_t bytes_left = 0;  ///< of the arrays

  /// Throws Fault::incomplete unless so many bytes are left.
  void expect_bytes(double needed) const;
};

/// Opens a file and verifies its header. Throws Fault::incomplete where it is damaged, cut off or of another kind, and cannot() where it
/// cannot be read.
HeadedFile open_headed(const std::string& path, const HeadedKind& kind);

void write_header(std::ostream& out, const HeadedKind& kind, const std::string& header);

/// The error where a file is damaged.
Error damaged_file(const std::string& path, const std::string& what);
/// The error where reading has failed; a disk or a server that fails says nothing about the file.
Error ended_file(const HeadedFile& file);

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

/// The next values of the file; whether they could be read is to be asked of `in`.
template <class T>
void read_values(HeadedFile& file, std::size_t count, std::vector<T>& values) {
  values.resize(count);
  file.in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
}

}  // namespace arcus::render
