#include "services/plot/drawing.h"

#include <cairo/cairo-svg.h>
#include <cairo/cairo.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>

#include "services/base/text_file.h"

namespace trailcast::plot {
namespace {

using image::Color;
using image::PixelPoint;

constexpr double kDash_px = 8.0;
constexpr const char* kFont = "sans-serif";
constexpr double kTrialSize = 100.0;

struct DestroySurface {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct DestroyContext {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using SurfacePtr = std::unique_ptr<cairo_surface_t, DestroySurface>;
using ContextPtr = std::unique_ptr<cairo_t, DestroyContext>;

SurfacePtr NewPixels(int width, int height) {
  return SurfacePtr(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height));
}

cairo_text_extents_t ExtentsOf(const std::string& text, double size) {
  const SurfacePtr pixels = NewPixels(1, 1);
  const ContextPtr context(cairo_create(pixels.get()));
  cairo_select_font_face(context.get(), kFont, CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context.get(), size);
  cairo_text_extents_t extents{};
  cairo_text_extents(context.get(), text.c_str(), &extents);
  return extents;
}

// Returns the size of the font whose capitals are that high.
double SizeOf(double height_px) {
  static const double capital = ExtentsOf("H", kTrialSize).height / kTrialSize;
  return capital > 0.0 ? height_px / capital : height_px;
}

void SetColor(cairo_t* context, Color color) {
  cairo_set_source_rgb(context, color[0] / 255.0, color[1] / 255.0, color[2] / 255.0);
}

SurfacePtr PixelsOf(const image::RgbImage& picture) {
  SurfacePtr pixels = NewPixels(picture.width, picture.height);
  cairo_surface_flush(pixels.get());
  unsigned char* const data = cairo_image_surface_get_data(pixels.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(pixels.get()));
  for (int y = 0; y < picture.height; ++y) {
    auto* const row = reinterpret_cast<std::uint32_t*>(data + static_cast<std::size_t>(y) * stride);
    for (int x = 0; x < picture.width; ++x) {
      const std::size_t i = 3 * image::PixelIndex(x, y, picture.width);
      row[x] = static_cast<std::uint32_t>(picture.pixels[i]) << 16U |
               static_cast<std::uint32_t>(picture.pixels[i + 1]) << 8U | picture.pixels[i + 2];
    }
  }
  cairo_surface_mark_dirty(pixels.get());
  return pixels;
}

cairo_status_t Append(void* text, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

Result<void> Fault(cairo_status_t status, const std::filesystem::path& file) {
  if (status == CAIRO_STATUS_SUCCESS) return {};
  return Fail(ErrorCode::kUnavailable,
              "cannot write the picture {}: {}; does its folder exist, and is there room?",
              file.string(), cairo_status_to_string(status));
}

}  // namespace

Drawing::Drawing(int width, int height, Color background)
    : width_(std::max(1, width)), height_(std::max(1, height)) {
  strokes_.push_back([background](cairo_t* context) {
    SetColor(context, background);
    cairo_paint(context);
    cairo_translate(context, 0.5, 0.5);
    cairo_select_font_face(context, kFont, CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  });
}

void Drawing::Line(std::vector<PixelPoint> points, Color color, double width_px, bool dashed) {
  strokes_.push_back([points = std::move(points), color, width_px, dashed](cairo_t* context) {
    SetColor(context, color);
    cairo_set_line_width(context, width_px);
    cairo_set_dash(context, &kDash_px, dashed ? 1 : 0, 0.0);
    for (const PixelPoint& point : points) cairo_line_to(context, point.x, point.y);
    cairo_stroke(context);
  });
}

void Drawing::FillPolygon(std::vector<PixelPoint> corners, Color color) {
  strokes_.push_back([corners = std::move(corners), color](cairo_t* context) {
    SetColor(context, color);
    for (const PixelPoint& corner : corners) cairo_line_to(context, corner.x, corner.y);
    cairo_fill(context);
  });
}

void Drawing::FillBox(PixelPoint from, PixelPoint to, Color color) {
  FillPolygon({from, {to.x, from.y}, to, {from.x, to.y}}, color);
}

void Drawing::OutlineBox(PixelPoint from, PixelPoint to, Color color, double width_px) {
  Line({from, {to.x, from.y}, to, {from.x, to.y}, from}, color, width_px);
}

void Drawing::Disc(PixelPoint center, double radius_px, Color color) {
  strokes_.push_back([center, radius_px, color](cairo_t* context) {
    SetColor(context, color);
    cairo_arc(context, center.x, center.y, radius_px, 0.0, 2.0 * std::numbers::pi);
    cairo_fill(context);
  });
}

void Drawing::Cross(PixelPoint center, double radius_px, Color color, double width_px) {
  const auto [x, y] = center;
  Line({{x - radius_px, y - radius_px}, {x + radius_px, y + radius_px}}, color, width_px);
  Line({{x - radius_px, y + radius_px}, {x + radius_px, y - radius_px}}, color, width_px);
}

void Drawing::Text(const std::string& text, PixelPoint at, double height_px, Color color) {
  strokes_.push_back([text, at, height_px, color](cairo_t* context) {
    SetColor(context, color);
    cairo_set_font_size(context, SizeOf(height_px));
    cairo_move_to(context, at.x, at.y);
    cairo_show_text(context, text.c_str());
    cairo_new_path(context);
  });
}

double Drawing::TextWidth(const std::string& text, double height_px) {
  return ExtentsOf(text, SizeOf(height_px)).x_advance;
}

void Drawing::Paste(const image::RgbImage& picture, double x, double y, double width,
                    double height) {
  if (picture.empty() || width <= 0.0 || height <= 0.0) return;
  strokes_.push_back([picture, x, y, width, height](cairo_t* context) {
    const SurfacePtr pixels = PixelsOf(picture);
    cairo_save(context);
    cairo_translate(context, x - 0.5, y - 0.5);
    cairo_scale(context, width / picture.width, height / picture.height);
    cairo_set_source_surface(context, pixels.get(), 0.0, 0.0);
    cairo_pattern_set_extend(cairo_get_source(context), CAIRO_EXTEND_PAD);
    cairo_rectangle(context, 0.0, 0.0, picture.width, picture.height);
    cairo_fill(context);
    cairo_restore(context);
  });
}

// Draws on a page of any kind.
void Drawing::Draw(cairo_surface_t* page) const {
  const ContextPtr context(cairo_create(page));
  for (const Stroke& stroke : strokes_) stroke(context.get());
  cairo_surface_flush(page);
}

image::RgbImage Drawing::Render() const {
  const SurfacePtr pixels = NewPixels(width_, height_);
  Draw(pixels.get());
  const unsigned char* const data = cairo_image_surface_get_data(pixels.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(pixels.get()));
  image::RgbImage picture;
  picture.width = width_;
  picture.height = height_;
  picture.pixels.reserve(3 * image::PixelIndex(0, height_, width_));
  for (int y = 0; y < height_; ++y) {
    const auto* const row =
        reinterpret_cast<const std::uint32_t*>(data + static_cast<std::size_t>(y) * stride);
    for (int x = 0; x < width_; ++x) {
      for (const unsigned shift : {16U, 8U, 0U}) {
        picture.pixels.push_back(static_cast<std::uint8_t>(row[x] >> shift));
      }
    }
  }
  return picture;
}

Result<void> Drawing::Write(const std::filesystem::path& file) const {
  if (file.extension() == ".svg") {
    std::string text;
    const SurfacePtr page(cairo_svg_surface_create_for_stream(&Append, &text, width_, height_));
    Draw(page.get());
    cairo_surface_finish(page.get());
    return WriteTextFile(file, text);
  }
  const SurfacePtr pixels = NewPixels(width_, height_);
  Draw(pixels.get());
  return Fault(cairo_surface_write_to_png(pixels.get(), file.c_str()), file);
}

}  // namespace trailcast::plot
