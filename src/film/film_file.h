#pragma once
// A film as a file, half-way or done: everything that is needed to go on with it to the same bits, or to join it with others.
//
// Little-endian, without gaps:
//   8 bytes    "arcusflm"
//   4 bytes    format, an unsigned number: 2
//   4 bytes    length H of the header, an unsigned number
//   32 bytes   XXH3 with 128 bits of the header, as hexadecimal digits
//   H bytes    the header, JSON: what the film belongs to, picture, box, sums a pixel, hashes of the three arrays, and what its writer
//              has to say about it
//   arrays     FilmSums: values (64-bit floats), samples and tried (32-bit unsigned numbers)
// So every byte stands under a hash or is compared with the only value it may have.

#include <string>

#include "src/film/film.h"

namespace arcus::render {

/// What a film file says of itself.
struct FilmFacts {
  std::string belongs_to;  ///< what must be equal for the film to be used, the hash of a scene
  std::string version;     ///< of the program that wrote it
  std::string about;       ///< whatever its writer added; may be empty
  int width_px = 0, height_px = 0;  ///< of the whole picture
  PixelBox box;                     ///< of the film in it
  double samples = 0;               ///< of all pixels together, refused ones included
  double refused = 0;               ///< of those, samples that were not finite
};

/// Writes the film as a whole file. Throws cannot() where it cannot be written.
void write_film(const std::string& path, const Film& film, const std::string& belongs_to, const std::string& about = "");

/// The header alone: verified, and whether the file has the length that it says. Throws Fault::incomplete where the file is damaged,
/// cut off, too long or no film, and cannot() where it cannot be read.
FilmFacts read_film_facts(const std::string& path);

/// The same, with the arrays verified.
FilmFacts verify_film(const std::string& path);

/// Reads the file into a film of the same size, place and channels. Throws Fault::mismatch where the file belongs to something else
/// and Fault::incomplete where it is damaged; the film is then unchanged.
FilmFacts read_film(const std::string& path, const std::string& belongs_to, Film& film);

}  // namespace arcus::render
