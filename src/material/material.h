#pragma once
// What a surface does with light. A closed set of kinds: matte, mirror, simple transparency, dielectric, sea.

#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "phase/base/raster.h"
#include "phase/optics/refractive_index.h"
#include "phase/settings/keys.h"
#include "src/material/clear_body.h"
#include "src/material/matte.h"
#include "src/material/sea.h"
#include "src/material/smooth_turns.h"

namespace arcus::render {

struct MaterialSettings {
  std::string type = "matte";           ///< matte | mirror | transparent | dielectric | sea
  std::vector<double> albedo{0.2};      ///< one number or linear R, G, B: matte and mirror
  std::string pattern = "plain";        ///< plain | checker | image (matte)
  std::vector<double> other_albedo{0.05};
  double pattern_m = 1;                 ///< edge of the squares
  std::string image;                    ///< a picture of colours, relative to the scene file
  std::vector<double> image_size_m{1000, 1000};  ///< of one copy of it, from west to east and from south to north
  std::vector<double> image_centre_m{0, 0};      ///< x, y
  std::string albedo_file;              ///< matte: two columns: nm (vacuum), share from 0 to 1; empty: albedo
  std::string index = "water";          ///< water | ice | mineral | a file | empty: index_constant (transparent, dielectric, sea)
  phase::ConstantIndexSettings index_constant;
  double reflectance = 0.1, transmittance = 0.9;  ///< transparent: shares at every meeting
  std::vector<double> filter{1};        ///< left of the light after filter_m inside; one number or linear R, G, B
  double filter_m = 1;
  double wind_m_per_s = 5;              ///< sea
  std::string slopes = "anisotropic";   ///< anisotropic | isotropic
  double wind_from_deg = 270;           ///< compass azimuth
  std::vector<double> water_albedo{0.002, 0.011, 0.05};  ///< of the light below the surface, what comes back; one number or linear R, G, B
  bool whitecaps = true;
  double enlargement = 1;               ///< of a body that stands for a smaller one; not a key
};
void list_keys(Keys& keys, MaterialSettings& material);
/// The keys of a transparent body's inside alone.
void list_index_key(Keys& keys, MaterialSettings& material);
void list_filter_keys(Keys& keys, MaterialSettings& material);

struct Mirror {
  SmoothSpectrum reflectance;
};
struct Transparent {
  ClearBody body;
  double reflectance, transmittance;
};
struct Dielectric {
  ClearBody body;
};

class Material {
 public:
  using Kinds = std::variant<Matte, Mirror, Transparent, Dielectric, Sea>;
  explicit Material(Kinds kind) : kind_(std::move(kind)) {}

  /// The matte surface, where it is one.
  const Matte* matte() const { return std::get_if<Matte>(&kind_); }
  /// The sea, where it is one.
  const Sea* sea() const { return std::get_if<Sea>(&kind_); }
  /// Whether it is smooth: light goes on one way or two, see turns().
  bool is_smooth() const { return !matte() && !sea(); }
  /// The transparent body behind the surface, where there is one.
  const ClearBody* body() const {
    if (const auto* dielectric = std::get_if<Dielectric>(&kind_)) return &dielectric->body;
    if (const auto* transparent = std::get_if<Transparent>(&kind_)) return &transparent->body;
    return nullptr;
  }
  /// Whether wavelengths part here.
  bool is_dispersive() const { return body() && body()->is_dispersive(); }
  /// The ways on from a smooth surface, as the first wavelength goes. The normal is on the side that light comes from, which is within
  /// the body where `from_inside`. For smooth surfaces alone.
  Turns turns(const Vec3& incoming, const Vec3& normal, bool from_inside, const Wavelengths& wavelengths, const PolarisedRay& light) const;

 private:
  Kinds kind_;
};

/// A spectrum between 0 and 1 for one number or linear R, G, B.
using ColourToSpectrum = std::function<SmoothSpectrum(const std::vector<double>& colour)>;

/// What materials and shapes get from the rooms that know colours and pictures.
struct SurfaceInputs {
  ColourToSpectrum colour;
  RasterReader colours;   ///< linear R, G, B
  RasterReader heights;   ///< one channel
  std::function<std::shared_ptr<const ThreeSpectra>()> basis;  ///< of reflectances
};

/// `folder`: where a file's relative path starts; `where` begins messages about pictures. Throws bad_input.
Material make_material(const MaterialSettings& settings, const std::string& folder, const SurfaceInputs& inputs, const std::string& where);

}  // namespace arcus::render
