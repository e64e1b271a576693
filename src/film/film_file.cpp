#include "src/film/film_file.h"

#include <bit>
#include <fstream>

#include <nlohmann/json.hpp>

#include "phase/base/content_hash.h"
#include "phase/base/error.h"
#include "phase/base/version.h"
#include "phase/base/whole_file.h"

namespace arcus::render {
namespace {

static_assert(std::endian::native == std::endian::little, "film files are little-endian");

constexpr int format = 1;

template <class T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

nlohmann::json header_of(const Film& film, const FilmSums& sums, const std::string& belongs_to) {
  const PixelBox& box = film.box();
  return {{"arcus_film", format},
          {"version", version},
          {"belongs_to", belongs_to},
          {"picture", {film.width_px(), film.height_px()}},
          {"box", {box.x0, box.y0, box.x1, box.y1}},
          {"sums_a_pixel", sums.values.size() / sums.samples.size()},
          {"hashes", {content_hash(bytes_of(sums.values)), content_hash(bytes_of(sums.samples)), content_hash(bytes_of(sums.tried))}}};
}

Error damaged(const std::string& path, const std::string& what) {
  return Error(Fault::incomplete, path + ": the file is damaged: " + what + ". Delete it to begin anew");
}

template <class T>
void read_values(std::istream& in, std::size_t count, std::vector<T>& values) {
  values.resize(count);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(count * sizeof(T)));
}

}  // namespace

void write_film(const std::string& path, const Film& film, const std::string& belongs_to) {
  const FilmSums& sums = film.sums();
  WholeFile file(path);
  {
    std::ofstream out(file.temporary_path(), std::ios::binary);
    out << header_of(film, sums, belongs_to).dump() << '\n'
        << bytes_of(sums.values) << bytes_of(sums.samples) << bytes_of(sums.tried);
    out.close();
    if (!out) throw cannot(path, "the film could not be written; is the disk full?");
  }
  file.commit();
}

void read_film(const std::string& path, const std::string& belongs_to, Film& film) {
  std::ifstream in(path, std::ios::binary);
  std::string line;
  if (!std::getline(in, line)) throw damaged(path, "it is empty or cannot be read");
  const nlohmann::json found = nlohmann::json::parse(line, nullptr, false);
  if (!found.is_object() || found.value("arcus_film", 0) != format) throw damaged(path, "its first line is not that of a film");
  nlohmann::json expected = header_of(film, film.sums(), belongs_to);
  for (const char* key : {"belongs_to", "version", "picture", "box", "sums_a_pixel"})
    if (!found.contains(key) || found[key] != expected[key])
      throw Error(Fault::mismatch, path + ": belongs to another picture (" + key +
                                       " differs). Delete it, or render the scene that it was made for");
  FilmSums sums;
  read_values(in, film.sums().values.size(), sums.values);
  read_values(in, film.sums().samples.size(), sums.samples);
  read_values(in, film.sums().tried.size(), sums.tried);
  if (!in) throw damaged(path, "it ends early");
  if (found["hashes"] != header_of(film, sums, belongs_to)["hashes"]) throw damaged(path, "its content does not fit its hashes");
  film.set_sums(std::move(sums));
}

}  // namespace arcus::render
