#include "src/analysis/canvas.h"

#include <cairo.h>

#include <cmath>
#include <cstring>
#include <new>

#include "phase/base/error.h"
#include "phase/base/units.h"

namespace arcus::render {
namespace {

constexpr double pixels_a_point = 2;

void set_font(cairo_t* pen, const TextStyle& style) {
  cairo_select_font_face(pen, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.is_bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(pen, style.size);
}

void set_ink(cairo_t* pen, const Ink& ink, double opacity) {
  cairo_set_source_rgba(pen, ink.r, ink.g, ink.b, opacity);
}

void stroke(cairo_t* pen, const LineStyle& style) {
  set_ink(pen, style.ink, style.opacity);
  cairo_set_line_width(pen, style.width);
  cairo_set_line_join(pen, CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(pen, style.is_dashed ? CAIRO_LINE_CAP_BUTT : CAIRO_LINE_CAP_ROUND);
  const double dashes[] = {5, 3};
  cairo_set_dash(pen, dashes, style.is_dashed ? 2 : 0, 0);
  cairo_stroke(pen);
}

void trace(cairo_t* pen, std::span<const Point> points) {
  cairo_new_path(pen);
  for (const Point& p : points) cairo_line_to(pen, p.x, p.y);
}

}  // namespace

struct Canvas::Sheet {
  cairo_surface_t* surface = nullptr;
  cairo_t* pen = nullptr;

  Sheet(double width, double height)
      : surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24,
                                           static_cast<int>(std::ceil(width * pixels_a_point)),
                                           static_cast<int>(std::ceil(height * pixels_a_point)))),
        pen(cairo_create(surface)) {
    if (cairo_status(pen) != CAIRO_STATUS_SUCCESS)
      throw cannot("cannot draw a chart", cairo_status_to_string(cairo_status(pen)));
    cairo_scale(pen, pixels_a_point, pixels_a_point);
    set_ink(pen, {1, 1, 1}, 1);
    cairo_paint(pen);
  }
  ~Sheet() {
    cairo_destroy(pen);
    cairo_surface_destroy(surface);
  }
};

Canvas::Canvas(double width, double height) : sheet_(std::make_unique<Sheet>(width, height)) {}

Canvas::~Canvas() = default;

void Canvas::line(std::span<const Point> points, const LineStyle& style) {
  trace(sheet_->pen, points);
  stroke(sheet_->pen, style);
}

void Canvas::area(std::span<const Point> points, const Ink& ink, double opacity) {
  trace(sheet_->pen, points);
  cairo_close_path(sheet_->pen);
  set_ink(sheet_->pen, ink, opacity);
  cairo_fill(sheet_->pen);
}

void Canvas::circle(Point centre, double radius, const LineStyle& style) {
  cairo_new_path(sheet_->pen);
  cairo_arc(sheet_->pen, centre.x, centre.y, radius, 0, 2 * pi);
  stroke(sheet_->pen, style);
}

void Canvas::text(std::string_view text, Point at, const TextStyle& style) {
  cairo_t* pen = sheet_->pen;
  const std::string words(text);
  const double width = text_width(text, style);
  cairo_save(pen);
  cairo_translate(pen, at.x, at.y);
  cairo_rotate(pen, -radians(style.turned_deg));
  set_font(pen, style);
  cairo_move_to(pen, -style.across * width, 0);
  if (style.has_halo) {
    cairo_text_path(pen, words.c_str());
    stroke(pen, {style.halo, 3.5, 0.9, false});
    cairo_move_to(pen, -style.across * width, 0);
  }
  set_ink(pen, style.ink, 1);
  cairo_show_text(pen, words.c_str());
  cairo_restore(pen);
}

void Canvas::picture(Point at, double width, double height, std::span<const std::uint8_t> rgb, int width_px, int height_px) {
  cairo_t* pen = sheet_->pen;
  cairo_surface_t* image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_px, height_px);
  if (cairo_surface_status(image) != CAIRO_STATUS_SUCCESS) {
    const cairo_status_t status = cairo_surface_status(image);
    cairo_surface_destroy(image);
    throw cannot("cannot draw a picture", cairo_status_to_string(status));
  }
  unsigned char* data = cairo_image_surface_get_data(image);
  const int stride = cairo_image_surface_get_stride(image);
  for (int row = 0; row < height_px; ++row)
    for (int column = 0; column < width_px; ++column) {
      const std::uint8_t* from = &rgb[3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width_px) + static_cast<std::size_t>(column))];
      const std::uint32_t pixel = static_cast<std::uint32_t>(from[0]) << 16 | static_cast<std::uint32_t>(from[1]) << 8 | from[2];
      std::memcpy(data + static_cast<std::ptrdiff_t>(row) * stride + 4 * column, &pixel, 4);
    }
  cairo_surface_mark_dirty(image);
  cairo_save(pen);
  cairo_translate(pen, at.x, at.y);
  cairo_scale(pen, width / width_px, height / height_px);
  cairo_set_source_surface(pen, image, 0, 0);
  cairo_pattern_set_filter(cairo_get_source(pen), CAIRO_FILTER_BILINEAR);
  cairo_paint(pen);
  cairo_restore(pen);
  cairo_surface_destroy(image);
}

double Canvas::text_width(std::string_view text, const TextStyle& style) const {
  set_font(sheet_->pen, style);
  cairo_text_extents_t extents;
  cairo_text_extents(sheet_->pen, std::string(text).c_str(), &extents);
  return extents.x_advance;
}

void Canvas::clip(Point low, Point high) {
  cairo_save(sheet_->pen);
  cairo_rectangle(sheet_->pen, low.x, low.y, high.x - low.x, high.y - low.y);
  cairo_clip(sheet_->pen);
}

void Canvas::unclip() { cairo_restore(sheet_->pen); }

std::string Canvas::png() const {
  std::string bytes;
  const auto append = [](void* target, const unsigned char* data, unsigned int length) {
    try {
      static_cast<std::string*>(target)->append(reinterpret_cast<const char*>(data), length);
    } catch (const std::bad_alloc&) {
      return CAIRO_STATUS_NO_MEMORY;
    }
    return CAIRO_STATUS_SUCCESS;
  };
  cairo_surface_flush(sheet_->surface);
  const cairo_status_t status = cairo_surface_write_to_png_stream(sheet_->surface, append, &bytes);
  if (status != CAIRO_STATUS_SUCCESS)
    throw cannot("cannot draw a chart", cairo_status_to_string(status));
  return bytes;
}

}  // namespace arcus::render
