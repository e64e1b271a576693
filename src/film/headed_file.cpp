#include "src/film/headed_file.h"

#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "phase/base/content_hash.h"

namespace arcus::render {
namespace {

static_assert(std::endian::native == std::endian::little, "these files are little-endian");

constexpr std::uint32_t longest_header = 1 << 28;

struct Preamble {
  std::array<char, 8> mark;
  std::uint32_t format, header_bytes;
  std::array<char, 32> header_hash;
};
static_assert(sizeof(Preamble) == 48, "written as it lies in memory");

}  // namespace

void HeadedFile::expect_bytes(double needed) const {
  if (static_cast<double>(bytes_left) < needed) throw damaged_file(path, "it ends early");
  if (static_cast<double>(bytes_left) > needed) throw damaged_file(path, "it is longer than it says");
}

HeadedFile open_headed(const std::string& path, const HeadedKind& kind) {
  HeadedFile file;
  file.path = path;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  file.in.open(path, std::ios::binary);
  if (error || !file.in) throw cannot("cannot read " + path, error ? error.message() : std::strerror(errno));
  Preamble preamble{};
  if (size < sizeof preamble || !file.in.read(reinterpret_cast<char*>(&preamble), sizeof preamble)) throw damaged_file(path, "it ends early");
  if (std::string_view(preamble.mark.data(), preamble.mark.size()) != kind.mark)
    throw damaged_file(path, "it does not begin as " + std::string(kind.plural) + " do");
  if (preamble.format != kind.format)
    throw damaged_file(path, "its format is " + std::to_string(preamble.format) + ", not " + std::to_string(kind.format));
  // Lengths are held against the file's before anything is allocated.
  if (preamble.header_bytes > longest_header || preamble.header_bytes > size - sizeof preamble) throw damaged_file(path, "it ends early");
  file.header.resize(preamble.header_bytes);
  file.in.read(file.header.data(), static_cast<std::streamsize>(file.header.size()));
  if (!file.in) throw ended_file(file);
  if (content_hash(file.header) != std::string_view(preamble.header_hash.data(), preamble.header_hash.size()))
    throw damaged_file(path, "its header does not fit its hash");
  file.bytes_left = size - sizeof preamble - file.header.size();
  return file;
}

void write_header(std::ostream& out, const HeadedKind& kind, const std::string& header) {
  const std::string hash = content_hash(header);
  Preamble preamble{{}, kind.format, static_cast<std::uint32_t>(header.size()), {}};
  std::memcpy(preamble.mark.data(), kind.mark.data(), preamble.mark.size());
  std::memcpy(preamble.header_hash.data(), hash.data(), preamble.header_hash.size());
  out.write(reinterpret_cast<const char*>(&preamble), sizeof preamble);
  out << header;
}

Error damaged_file(const std::string& path, const std::string& what) {
  return Error(Fault::incomplete, path + ": the file is damaged: " + what + ". Delete it to begin anew");
}

Error ended_file(const HeadedFile& file) {
  return file.in.bad() ? cannot("cannot read " + file.path, std::strerror(errno)) : damaged_file(file.path, "it ends early");
}

}  // namespace arcus::render
