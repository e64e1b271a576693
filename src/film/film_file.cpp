#include "src/film/film_file.h"

#include <array>
#include <fstream>

#include <nlohmann/json.hpp>

#include "phase/base/content_hash.h"
#include "phase/base/error.h"
#include "phase/base/version.h"
#include "phase/base/whole_file.h"
#include "src/film/headed_file.h"

namespace arcus::render {
namespace {

constexpr HeadedKind films{"arcusflm", 2, "films"};

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

/// A film's file whose header has been read and whose arrays come next.
struct OpenFilm {
  HeadedFile file;
  FilmFacts facts;
  std::size_t sums_a_pixel = 0;
  std::array<std::string, 3> hashes;
};

/// Fills facts, sums_a_pixel and hashes; false where the header is none of a film.
bool read_header(OpenFilm& film) {
  try {
    const nlohmann::json header = nlohmann::json::parse(film.file.header);
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
  OpenFilm film{open_headed(path, films), {}, 0, {}};
  if (!read_header(film)) throw damaged_file(path, "its header is not that of a film");
  const std::uintmax_t left = film.file.bytes_left;
  const std::uintmax_t pixels = film.facts.box.pixels();
  if (film.sums_a_pixel > left || pixels > left) throw damaged_file(path, "it ends early");
  film.file.expect_bytes(static_cast<double>(pixels) * static_cast<double>(film.sums_a_pixel * sizeof(double) + 2 * sizeof(std::uint32_t)));
  return film;
}

FilmSums read_sums(OpenFilm& film) {
  FilmSums sums;
  const std::size_t pixels = film.facts.box.pixels();
  read_values(film.file, pixels * film.sums_a_pixel, sums.values);
  read_values(film.file, pixels, sums.samples);
  read_values(film.file, pixels, sums.tried);
  if (!film.file.in) throw ended_file(film.file);
  if (hashes_of(sums) != film.hashes) throw damaged_file(film.file.path, "its content does not fit its hashes");
  return sums;
}

}  // namespace

void write_film(const std::string& path, const Film& film, const std::string& belongs_to, const std::string& about) {
  const std::string header = header_of(film, belongs_to, about);
  WholeFile file(path);
  {
    std::ofstream out(file.temporary_path(), std::ios::binary);
    write_header(out, films, header);
    out << bytes_of(film.sums().values) << bytes_of(film.sums().samples) << bytes_of(film.sums().tried);
    out.close();
    if (!out) throw cannot(path, "the film could not be written; is the disk full?");
  }
  file.commit();
}

FilmFacts read_film_facts(const std::string& path) { return open_film(path).facts; }

FilmFacts verify_film(const std::string& path) {
  OpenFilm film = open_film(path);
  read_sums(film);
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
  film.set_sums(read_sums(found));
  return found.facts;
}

}  // namespace arcus::render
