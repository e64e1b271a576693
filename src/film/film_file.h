#pragma once
// A film half-way, as a file: everything that is needed to go on with it to the same bits. Layout: a line of JSON (format, what it
// belongs to, size, hashes of the arrays), then the arrays of the film, little-endian.

#include <string>

#include "src/film/film.h"

namespace arcus::render {

/// Writes the film as a whole file. `belongs_to`: what must be equal for the film to be used again, the hash of a scene.
/// Throws cannot() where it cannot be written.
void write_film(const std::string& path, const Film& film, const std::string& belongs_to);

/// Reads it into a film of the same size, place and channels. Throws Fault::mismatch where the file belongs to something else and
/// Fault::incomplete where it is damaged; the film is then unchanged.
void read_film(const std::string& path, const std::string& belongs_to, Film& film);

}  // namespace arcus::render
