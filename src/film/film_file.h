#pragma once
// A film as a file, half-way or done: everything that is needed to go on with it to the same bits, or to join it with others.
//
// As src/film/headed_file.h says, with the mark "arcusflm" and format 2. The header: what the film belongs to, picture, box, sums a pixel,
// hashes of the three arrays, and what its writer has to say about it. The arrays, little-endian: FilmSums, values (64-bit floats), samples
// and tried (32-bit unsigned numbers).

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
