#pragma once
// Pictures in files. EXR: every channel and all metadata, 32-bit float, lossless. PNG: 8 bits.

#include <string>
#include <string_view>

#include "src/film/image.h"
#include "src/film/tone.h"

namespace arcus::render {

/// Loads what reads and writes pictures, which otherwise happens with the first one. Throws cannot() where it is missing, so that
/// a long computation fails before it begins.
void load_image_files();

/// Writes a picture as EXR: one part, all channels as 32-bit float without loss (ZIP), metadata as
/// attributes, the box as data window in the picture's display window. Whole or not at all. Equal
/// pictures give equal bytes. Throws cannot() where the file cannot be written.
void write_exr(const std::string& path, const Image& image);

/// Reads an EXR file (half and float channels alike; the first part of several). Throws bad_input
/// where it is missing, damaged, cut off or no such picture.
Image read_exr(const std::string& path);

/// Writes a display picture as 8-bit sRGB PNG, whole or not at all. Throws cannot() where it cannot
/// be written.
void write_png(const std::string& path, const DisplayPicture& picture);

/// The same as the bytes of a PNG file. `has_few_colours`: packs maps of a few dozen colours much
/// better, pictures worse.
std::string png_bytes(const DisplayPicture& picture, bool has_few_colours = false);

}  // namespace arcus::render
