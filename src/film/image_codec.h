#pragma once
// What needs OpenImageIO. Its libraries take a third of a second to load, with all that they load (OpenCV, GDAL, codecs of films), so
// they stand behind a module of their own, which image_file loads when the first picture is read or written.

#include <memory>
#include <string>
#include <vector>

#include "phase/base/raster.h"
#include "src/film/image.h"

namespace arcus::render {

/// A picture on its way into a file, from top to bottom. Where it is not closed, what it has written is no picture.
class ImageOutput {
 public:
  virtual ~ImageOutput() = default;
  /// The next rows; values as in Image or DisplayPicture.
  virtual void append(const void* values, int rows) = 0;
  /// After the last row.
  virtual void close() = 0;
};

/// What a file has in its first channels, and how.
struct StoredRaster {
  Raster raster;           ///< whole numbers over the largest that their type can hold
  bool is_whole = false;   ///< whole numbers
};

struct ImageCodec {
  /// Writes to `temporary_path`; messages speak of `path`.
  std::unique_ptr<ImageOutput> (*exr_output)(const std::string& path, const std::string& temporary_path, const ImageHeader& header);
  Image (*read_exr)(const std::string& path);
  /// Writes to the end of `bytes`, which outlives the output.
  std::unique_ptr<ImageOutput> (*png_output)(int width_px, int height_px, bool has_few_colours, std::vector<unsigned char>& bytes);
  /// With 1 channel or 3; messages begin with `where`.
  StoredRaster (*read_raster)(const std::string& path, const std::string& where, int channels);
};

}  // namespace arcus::render

/// The only name that the module gives away.
extern "C" const arcus::render::ImageCodec arcus_image_codec;
