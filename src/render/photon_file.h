#pragma once
// Photons as a file: what one process has sent or relaxed, for all others that need the same map.
//
// As src/film/headed_file.h says, with the mark "arcuspho" and format 1. The header: what the photons belong to, whether they are sent or
// relaxed, which range or pass of how many, and of each stretch in it pass, way, numbers, how many photons landed on surfaces and in media,
// and the hashes of these two arrays. The arrays: for each stretch photons on surfaces, then in media; 96 bytes each, as struct Photon lies
// in memory, little-endian.

#include <string>
#include <vector>

#include "src/integrator/photon_sending.h"

namespace arcus::render {

/// What a file of photons says of itself.
struct PhotonFacts {
  std::string belongs_to;  ///< what must be equal for the photons to be used
  std::string about;       ///< whatever its writer added; may be empty
  bool is_relaxed = false; ///< the caustics on surfaces of a pass, relaxed; otherwise a range as it landed
  std::size_t number = 0, count = 0;  ///< of the range among all, or of the pass
  std::vector<PhotonStretch> stretches;
  Relaxed relaxed;         ///< how far
  double photons = 0;      ///< that have landed
};

struct StoredPhotons {
  PhotonFacts facts;
  std::vector<LandedPhotons> landed;  ///< of each stretch
};

/// Writes to the path itself: a WholeFile is the caller's. Throws cannot() where it cannot be written.
void write_photons(const std::string& path, const StoredPhotons& stored);

/// The header alone: verified, and whether the file has the length that it says. Throws Fault::incomplete where the file is damaged, cut
/// off, too long or none of photons, and cannot() where it cannot be read.
PhotonFacts read_photon_facts(const std::string& path);

/// All of it, verified; throws the same.
StoredPhotons read_photons(const std::string& path);

}  // namespace arcus::render
