#include "src/film/film_file.h"

#include <array>
#include <bit>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "phase/base/content_hash.h"
#include "phase/base/error.h"
#include "phase/base/version.h"
#include "phase/base/whole_file.h"

namespace arcus::render {
namespace {

static_assert(std::endian::native == std::endian::little, "film files are little-endian");

constexpr std::string_view magic = "arcusflm";
constexpr std::uint32_t format = 2;
constexpr std::uint32_t longest_header = 1 << 28;

/// What every film file begins with.
struct Preamble {
  std::array<char, 8> magic;
  std::uint32_t format, header_bytes;
  std::array<char, 32> header_hash;
};
static_assert(sizeof(Preamble) == 48, "written as it lies in memory");

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::array<std::string, 3> hashes_of(const FilmSums& sums) {
  return {content_hash(bytes_of(sums.values)), content_hash(bytes_of(sums.samples)), content_hash(bytes_of(sums.tried))};
}

std::size_t sums_a_pixel(const Film& film) { return film.sums().values.size() / film.sums().samples.size(); }

std::string header_of(const Film& film, const std::string& belongs_to, const std::string& about) {
  const FilmSums& sums = film.sums();
  const PixelBox& box = film.box();
  double samples = 0, refused = 0;
  for (std::size_t i = 0; i < sums.tried.size(); ++i) {
    samples += sums.tried[i];
    refused += sums.tried[i] - sums.samples[i];
  }
  return nlohmann::json{{"version", version},
                        {"belongs_to", belongs_to},
                        {"about", about},
                        {"picture", {film.width_px(), film.height_px()}},
                        {"box", {box.x0, box.y0, box.x1, box.y1}},
                        {"samples", samples},
                        {"refused", refused},
                        {"sums_a_pixel", sums_a_pixel(film)},
                        {"hashes", hashes_of(sums)}}
      .dump();
}

Error damaged(const std::string& path, const std::string& what) {
  return Error(Fault::incomplete, path + ": the file is damaged: " + what + ". Delete it to begin anew");
}

/// A disk or a server that fails says nothing about the file.
Error ended(const std::string& path, const std::istream& in) {
  return in.bad() ? cannot("cannot read " + path, std::strerror(errno)) : damaged(path, "it ends early");
}

/// A file whose header has been read and whose arrays come next.
struct OpenFilm {
  std::ifstream in;
  FilmFacts facts;
  std::size_t sums_a_pixel = 0;
  std::array<std::string, 3> hashes;
};

/// Fills facts, sums_a_pixel and hashes; false where the header is none of a film.
bool read_header(const std::string& text, OpenFilm& film) {
  try {
    const nlohmann::json header = nlohmann::json::parse(text);
    FilmFacts& facts = film.facts;
    header.at("belongs_to").get_to(facts.belongs_to);
    header.at("version").get_to(facts.version);
    header.at("about").get_to(facts.about);
    header.at("samples").get_to(facts.samples);
    header.at("refused").get_to(facts.refused);
    header.at("sums_a_pixel").get_to(film.sums_a_pixel);
    header.at("hashes").get_to(film.hashes);
    const auto picture = header.at("picture").get<std::array<int, 2>>();
    const auto box = header.at("box").get<std::array<int, 4>>();
    facts.width_px = picture[0];
    facts.height_px = picture[1];
    facts.box = {box[0], box[1], box[2], box[3]};
  } catch (const nlohmann::json::exception&) {
    return false;
  }
  const PixelBox& box = film.facts.box;
  return 0 <= box.x0 && box.x0 < box.x1 && box.x1 <= film.facts.width_px && 0 <= box.y0 && box.y0 < box.y1 &&
         box.y1 <= film.facts.height_px && film.sums_a_pixel > 0;
}

OpenFilm open_film(const std::string& path) {
  OpenFilm film;
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  film.in.open(path, std::ios::binary);
  if (error || !film.in) throw cannot("cannot read " + path, error ? error.message() : std::strerror(errno));
  Preamble preamble{};
  if (size < sizeof preamble || !film.in.read(reinterpret_cast<char*>(&preamble), sizeof preamble)) throw damaged(path, "it ends early");
  if (std::string_view(preamble.magic.data(), preamble.magic.size()) != magic) throw damaged(path, "it does not begin as films do");
  if (preamble.format != format)
    throw damaged(path, "its format is " + std::to_string(preamble.format) + ", not " + std::to_string(format));
  // Lengths are held against the file's before anything is allocated.
  if (preamble.header_bytes > longest_header || preamble.header_bytes > size - sizeof preamble) throw damaged(path, "it ends early");
  std::string header(preamble.header_bytes, '\0');
  film.in.read(header.data(), static_cast<std::streamsize>(header.size()));
  if (!film.in) throw ended(path, film.in);
  if (content_hash(header) != std::string_view(preamble.header_hash.data(), preamble.header_hash.size()))
    throw damaged(path, "its header does not fit its hash");
  if (!read_header(header, film)) throw damaged(path, "its header is not that of a film");
  const std::uintmax_t left = size - sizeof preamble - header.size();
  const std::uintmax_t pixels = film.facts.box.pixels();
  if (film.sums_a_pixel > left || pixels > left) throw damaged(path, "it ends early");
  const auto needed = static_cast<double>(pixels) * static_cast<double>(film.sums_a_pixel * sizeof(double) + 2 * sizeof(std::uint32_t));
  if (static_cast<double>(left) < needed) throw damaged(path, "it ends early");
  if (static_cast<double>(left) > needed) throw damaged(path, "it is longer than it says");
  return film;
}

template <class T>
void read_values(std::istream& in, std::size_t count, std::vector<T>& values) {
  values.resize(count);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
}

FilmSums read_sums(OpenFilm& film, const std::string& path) {
  FilmSums sums;
  const std::size_t pixels = film.facts.box.pixels();
  read_values(film.in, pixels * film.sums_a_pixel, sums.values);
  read_values(film.in, pixels, sums.samples);
  read_values(film.in, pixels, sums.tried);
  if (!film.in) throw ended(path, film.in);
  if (hashes_of(sums) != film.hashes) throw damaged(path, "its content does not fit its hashes");
  return sums;
}

}  // namespace

void write_film(const std::string& path, const Film& film, const std::string& belongs_to, const std::string& about) {
  const std::string header = header_of(film, belongs_to, about);
  const std::string hash = content_hash(header);
  Preamble preamble{{}, format, static_cast<std::uint32_t>(header.size()), {}};
  std::memcpy(preamble.magic.data(), magic.data(), preamble.magic.size());
  std::memcpy(preamble.header_hash.data(), hash.data(), preamble.header_hash.size());
  WholeFile file(path);
  {
    std::ofstream out(file.temporary_path(), std::ios::binary);
    out.write(reinterpret_cast<const char*>(&preamble), sizeof preamble);
    out << header << bytes_of(film.sums().values) << bytes_of(film.sums().samples) << bytes_of(film.sums().tried);
    out.close();
    if (!out) throw cannot(path, "the film could not be written; is the disk full?");
  }
  file.commit();
}

FilmFacts read_film_facts(const std::string& path) { return open_film(path).facts; }

FilmFacts verify_film(const std::string& path) {
  OpenFilm film = open_film(path);
  read_sums(film, path);
  return film.facts;
}

FilmFacts read_film(const std::string& path, const std::string& belongs_to, Film& film) {
  OpenFilm found = open_film(path);
  const auto require = [&](bool is_equal, const char* what) {
    if (!is_equal)
      throw Error(Fault::mismatch,
                  path + ": belongs to another picture (" + what + " differs). Delete it, or render the scene that it was made for");
  };
  require(found.facts.belongs_to == belongs_to, "belongs_to");
  require(found.facts.version == version, "version");
  require(found.facts.width_px == film.width_px() && found.facts.height_px == film.height_px(), "picture");
  require(found.facts.box == film.box(), "box");
  require(found.sums_a_pixel == sums_a_pixel(film), "sums_a_pixel");
  film.set_sums(read_sums(found, path));
  return found.facts;
}

}  // namespace arcus::render
