#pragma once
// Pictures in files. EXR: every channel and all metadata, 32-bit float, lossless. PNG: 8 bits.

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "phase/base/raster.h"
#include "phase/base/whole_file.h"
#include "src/film/image.h"
#include "src/film/tone.h"

namespace arcus::render {

/// Loads what reads and writes pictures, which otherwise happens with the first one. Throws cannot() where it is missing, so that
/// a long computation fails before it begins.
void load_image_files();

class ImageOutput;

/// An EXR that is written from top to bottom, so that a picture need not be in memory as a whole: one part, all channels as 32-bit
/// float without loss (ZIP, and from 256 MiB on PIZ), metadata as attributes, the box as data window in the picture's display window.
/// Equal pictures give equal bytes, in whatever pieces they come. All throw cannot() where the file cannot be written.
class ExrWriter {
 public:
  ExrWriter(const std::string& path, const ImageHeader& header);
  ~ExrWriter();
  /// The next rows of the box, as in Image::values().
  void append(std::span<const float> rows);
  /// After the last row; a file that is not committed leaves nothing.
  void commit();

 private:
  WholeFile file_;
  std::unique_ptr<ImageOutput> output_;
  std::size_t row_values_;
};

/// The whole picture at once.
void write_exr(const std::string& path, const Image& image);

/// Reads an EXR file (half and float channels alike; the first part of several). Throws bad_input
/// where it is missing, damaged, cut off or no such picture.
Image read_exr(const std::string& path);

/// R, G and B of a picture of any kind that OpenImageIO reads, linear: whole numbers are decoded from sRGB (IEC 61966-2-1), 1 being the
/// largest; floating-point numbers are linear already. Grey pictures have three equal values. Opacity is ignored. Throws bad_input,
/// beginning with `where`: missing, damaged, more than 2^26 pixels, values that are not finite.
Raster read_colours(const std::string& path, const std::string& where);

/// The first channel as it is, whole numbers over the largest that their type can hold (all 16 bits of a PNG count). Throws as read_colours.
Raster read_heights(const std::string& path, const std::string& where);

/// An 8-bit sRGB PNG that is written from top to bottom; the file itself when it is committed, whole or not at all. All throw cannot()
/// where it cannot be written.
class PngWriter {
 public:
  PngWriter(std::string path, int width_px, int height_px);
  ~PngWriter();
  /// The next rows, as in DisplayPicture::rgb.
  void append(std::span<const std::uint8_t> rows);
  void commit();

 private:
  std::string path_;
  std::vector<unsigned char> bytes_;  // in memory: OpenImageIO 2.4's PNG output does not notice a disk that is full
  std::unique_ptr<ImageOutput> output_;
  std::size_t row_values_;
};

/// The whole picture at once.
void write_png(const std::string& path, const DisplayPicture& picture);

/// The same as the bytes of a PNG file. `has_few_colours`: packs maps of a few dozen colours much
/// better, pictures worse.
std::string png_bytes(const DisplayPicture& picture, bool has_few_colours = false);

}  // namespace arcus::render
