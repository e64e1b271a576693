#include "src/render/photon_file.h"

#include <array>
#include <fstream>

#include <nlohmann/json.hpp>

#include "phase/base/content_hash.h"
#include "phase/base/error.h"
#include "phase/base/version.h"
#include "src/film/headed_file.h"

namespace arcus::render {
namespace {

constexpr HeadedKind photon_files{"arcuspho", 1, "files of photons"};

/// What the header says of the arrays of a stretch: on surfaces, in media.
struct Arrays {
  std::array<std::uint64_t, 2> counts;
  std::array<std::string, 2> hashes;
};

std::array<std::string, 2> hashes_of(const LandedPhotons& landed) {
  return {content_hash(bytes_of(landed.on_surfaces)), content_hash(bytes_of(landed.in_media))};
}

std::string header_of(const StoredPhotons& stored) {
  nlohmann::json stretches = nlohmann::json::array();
  for (std::size_t i = 0; i < stored.landed.size(); ++i) {
    const PhotonStretch& stretch = stored.facts.stretches[i];
    const LandedPhotons& landed = stored.landed[i];
    stretches.push_back({{"pass", stretch.pass},
                         {"is_aimed", stretch.is_aimed},
                         {"numbers", {stretch.first, stretch.last}},
                         {"landed", {landed.on_surfaces.size(), landed.in_media.size()}},
                         {"hashes", hashes_of(landed)}});
  }
  return nlohmann::json{{"version", version},
                        {"belongs_to", stored.facts.belongs_to},
                        {"about", stored.facts.about},
                        {"is_relaxed", stored.facts.is_relaxed},
                        {"number", stored.facts.number},
                        {"count", stored.facts.count},
                        {"iterations", stored.facts.relaxed.iterations},
                        {"last_move", stored.facts.relaxed.last_move},
                        {"stretches", stretches}}
      .dump();
}

/// A file whose header has been read and whose arrays come next.
struct OpenPhotons {
  HeadedFile file;
  PhotonFacts facts;
  std::vector<Arrays> arrays;
};

/// Fills facts and arrays; false where the header is none of photons.
bool read_header(OpenPhotons& photons) {
  try {
    const nlohmann::json header = nlohmann::json::parse(photons.file.header);
    PhotonFacts& facts = photons.facts;
    header.at("belongs_to").get_to(facts.belongs_to);
    header.at("about").get_to(facts.about);
    header.at("is_relaxed").get_to(facts.is_relaxed);
    header.at("number").get_to(facts.number);
    header.at("count").get_to(facts.count);
    header.at("iterations").get_to(facts.relaxed.iterations);
    header.at("last_move").get_to(facts.relaxed.last_move);
    for (const nlohmann::json& one : header.at("stretches")) {
      const nlohmann::json& numbers = one.at("numbers");
      facts.stretches.push_back({one.at("pass"), one.at("is_aimed"), numbers.at(0), numbers.at(1)});
      const Arrays arrays{one.at("landed"), one.at("hashes")};
      for (const std::uint64_t count : arrays.counts) facts.photons += static_cast<double>(count);
      photons.arrays.push_back(arrays);
    }
  } catch (const nlohmann::json::exception&) {
    return false;
  }
  return photons.facts.number < photons.facts.count;
}

OpenPhotons open_photons(const std::string& path) {
  OpenPhotons photons{open_headed(path, photon_files), {}, {}};
  if (!read_header(photons)) throw damaged_file(path, "its header is not that of photons");
  photons.file.expect_bytes(photons.facts.photons * sizeof(Photon));
  return photons;
}

}  // namespace

void write_photons(const std::string& path, const StoredPhotons& stored) {
  std::ofstream out(path, std::ios::binary);
  write_header(out, photon_files, header_of(stored));
  for (const LandedPhotons& landed : stored.landed) out << bytes_of(landed.on_surfaces) << bytes_of(landed.in_media);
  out.close();
  if (!out) throw cannot(path, "the photons could not be written; is the disk full?");
}

PhotonFacts read_photon_facts(const std::string& path) { return open_photons(path).facts; }

StoredPhotons read_photons(const std::string& path) {
  OpenPhotons photons = open_photons(path);
  StoredPhotons stored{photons.facts, {}};
  for (const Arrays& arrays : photons.arrays) {
    LandedPhotons landed;
    read_values(photons.file, static_cast<std::size_t>(arrays.counts[0]), landed.on_surfaces);
    read_values(photons.file, static_cast<std::size_t>(arrays.counts[1]), landed.in_media);
    if (!photons.file.in) throw ended_file(photons.file);
    if (hashes_of(landed) != arrays.hashes) throw damaged_file(path, "its photons do not fit their hashes");
    stored.landed.push_back(std::move(landed));
  }
  return stored;
}

}  // namespace arcus::render
