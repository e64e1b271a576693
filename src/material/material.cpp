#include "src/material/material.h"

#include "phase/base/error.h"
#include "phase/settings/number_text.h"
#include "phase/settings/toml_text.h"

namespace arcus::render {
namespace {

void list_colour(Keys& keys, std::string_view name, std::vector<double>& colour, std::string_view meaning) {
  keys.numbers(name, colour, between(0, 1), 1, 3, std::string(meaning) + ": one number, or linear Rec.709 [R, G, B]");
  if (colour.size() == 2) keys.refuse(name, "2 numbers", "must have 1 or 3");
}

}  // namespace

void list_index_key(Keys& keys, MaterialSettings& material) {
  keys.word_or_table("index", material.index, material.index_constant,
                     "refractive index: water, ice, a file of wavelength in nm, n and k, or { n, k } relative to the surroundings");
}

void list_filter_keys(Keys& keys, MaterialSettings& material) {
  list_colour(keys, "filter", material.filter, "what is left of the light after filter_m metres inside");
  keys.number("filter_m", material.filter_m, above(0), "the way that `filter` refers to [m]");
}

void list_keys(Keys& keys, MaterialSettings& material) {
  const std::string before = material.type;
  keys.choice("type", material.type, {"matte", "mirror", "transparent", "dielectric", "sea"},
              "matte: the same in all directions; mirror; transparent: shares that do not depend on the angle; dielectric: Fresnel's, with polarisation; "
              "sea: waves by the wind, for volume_path and path");
  if (material.type != before) material.albedo = {material.type == "mirror" ? 1 : 0.2};
  const bool is_matte = material.type == "matte", is_transparent = material.type == "transparent";
  if (keys.only_if(is_matte || material.type == "mirror", "matte, mirror"))
    list_colour(keys, "albedo", material.albedo, "share of the light that is reflected");
  if (keys.only_if(is_matte, "matte")) {
    keys.text("albedo_file", material.albedo_file, "measured spectrum instead of albedo, relative to the scene file, two columns: wavelength in nm, share from 0 to 1");
    keys.choice("pattern", material.pattern, {"plain", "checker", "image"},
                "checker: cubes of two colours by turns, with a corner at the origin; image: the colours of a picture, laid out on the ground");
    if (!keys.documents() && !material.albedo_file.empty() && material.pattern != "plain")
      keys.refuse("albedo_file", "a file and a pattern of the kind " + material.pattern, "must be left out where there is a pattern");
    if (keys.only_if(material.pattern == "checker", "pattern = checker")) {
      list_colour(keys, "other_albedo", material.other_albedo, "of the other cubes");
      keys.number("pattern_m", material.pattern_m, above(0), "edge of a cube [m]");
    }
    if (keys.only_if(material.pattern == "image", "pattern = image")) {
      keys.text("image", material.image, "picture of colours, north at its top, repeated without end, relative to the scene file: whole numbers are sRGB, floating-point ones linear Rec.709 from 0 to 1");
      if (material.image.empty() && !keys.documents()) keys.refuse("image", "nothing", "the name of a picture expected");
      keys.numbers("image_size_m", material.image_size_m, above(0), 2, 2, "of one copy of the picture, from west to east and from south to north");
      keys.numbers("image_centre_m", material.image_centre_m, any(), 2, 2, "x and y of the middle of a copy: those of centre_m and size_m lay it on a terrain");
    }
  }
  if (keys.only_if(is_transparent, "transparent")) {
    keys.number("reflectance", material.reflectance, between(0, 1), "share that is reflected at every meeting");
    keys.number("transmittance", material.transmittance, between(0, 1), "share that passes at every meeting");
    if (!keys.documents() && material.reflectance + material.transmittance > 1)
      keys.refuse("transmittance", number_text(material.transmittance),
                  "must be at most 1 - reflectance = " + number_text(1 - material.reflectance));
  }
  const bool is_body = is_transparent || material.type == "dielectric", is_sea = material.type == "sea";
  if (keys.only_if(is_sea, "sea")) {
    keys.number("wind_m_per_s", material.wind_m_per_s, between(0, 30), "12.5 m above the sea: how steep the waves are (Cox and Munk 1954, measured up to 14)");
    keys.choice("slopes", material.slopes, {"anisotropic", "isotropic"}, "anisotropic: steeper along the wind than across it");
    if (keys.only_if(material.slopes == "anisotropic", "slopes = anisotropic"))
      keys.number("wind_from_deg", material.wind_from_deg, any(), "compass azimuth from which the wind blows");
    keys.numbers("water_albedo", material.water_albedo, between(0, 0.5), 1, 3,
                 "share of the light below the surface that comes back up: one number, or linear Rec.709 [R, G, B]; the default is clear ocean, coasts have more green");
    if (material.water_albedo.size() == 2) keys.refuse("water_albedo", "2 numbers", "must have 1 or 3");
    keys.flag("whitecaps", material.whitecaps, "foam, by the wind: 0.09 % of the sea at 5 m/s, 1 % at 10, 4 % at 15");
  }
  if (keys.only_if(is_body || is_sea, "transparent, dielectric, sea")) list_index_key(keys, material);
  if (keys.only_if(is_body, "transparent, dielectric")) list_filter_keys(keys, material);
}

Turns Material::turns(const Vec3& incoming, const Vec3& normal, bool from_inside, const Wavelengths& wavelengths,
                      const PolarisedRay& light) const {
  const auto relative_index = [&](const ClearBody& body) {
    const double n = body.index(wavelengths[0]);
    return from_inside ? 1 / n : n;
  };
  if (const auto* dielectric = std::get_if<Dielectric>(&kind_)) return fresnel_turns(incoming, normal, relative_index(dielectric->body), light);
  if (const auto* transparent = std::get_if<Transparent>(&kind_))
    return transparent_turns(incoming, normal, relative_index(transparent->body), transparent->reflectance, transparent->transmittance);
  return mirror_turns(incoming, normal, std::get<Mirror>(kind_).reflectance.at(wavelengths), light);
}

namespace {

std::shared_ptr<const ColourMap> read_map(const MaterialSettings& settings, const std::string& folder, const SurfaceInputs& inputs, const std::string& where) {
  const std::string path = path_from(folder, settings.image);
  Raster rgb = inputs.colours(path, where);
  for (std::size_t i = 0; i < rgb.values.size(); ++i)
    if (const float value = rgb.values[i]; value < 0 || value > 1) {
      const auto width = static_cast<std::size_t>(rgb.width);
      throw bad_input(where + ": " + path, number_text(static_cast<double>(value)) + " in column " + std::to_string(i / 3 % width) + ", row " + std::to_string(i / 3 / width),
                      "shares of the light from 0 to 1 expected");
    }
  return std::make_shared<const ColourMap>(std::move(rgb), inputs.basis(),
                                           ColourMapPlace{settings.image_centre_m[0], settings.image_centre_m[1], settings.image_size_m[0], settings.image_size_m[1]});
}

std::shared_ptr<const Curve> read_albedo(const std::string& path) {
  Columns table = read_columns_file(path);
  if (table.columns.size() != 2) throw bad_input(path, std::to_string(table.columns.size()) + " columns", "two expected: wavelength [nm] and share of the light from 0 to 1");
  for (const double share : table.columns[1])
    if (!(share >= 0 && share <= 1)) throw bad_input(path, "a share of " + number_text(share), "shares of the light from 0 to 1 expected");
  return std::make_shared<const Curve>(std::move(table.columns[0]), std::move(table.columns[1]), path);
}

}  // namespace

Material make_material(const MaterialSettings& settings, const std::string& folder, const SurfaceInputs& inputs, const std::string& where) {
  const ColourToSpectrum& colour = inputs.colour;
  if (settings.type == "matte") {
    if (settings.pattern == "image") return Material(Matte(read_map(settings, folder, inputs, where)));
    if (!settings.albedo_file.empty()) return Material(Matte(read_albedo(path_from(folder, settings.albedo_file))));
    if (settings.pattern == "checker") return Material(Matte(colour(settings.albedo), colour(settings.other_albedo), settings.pattern_m));
    return Material(Matte(colour(settings.albedo)));
  }
  if (settings.type == "mirror") return Material(Mirror{colour(settings.albedo)});
  const auto index = [&] {
    if (settings.index.empty()) return phase::RefractiveIndex::constant(settings.index_constant);
    return phase::RefractiveIndex::named(phase::RefractiveIndex::is_built_in(settings.index) ? settings.index : path_from(folder, settings.index));
  }();
  if (settings.type == "sea")
    return Material(Sea(ClearBody(index, 1, 1), cox_munk_slopes(settings.wind_m_per_s, settings.slopes == "isotropic"), settings.wind_from_deg,
                        colour(settings.water_albedo), settings.whitecaps ? foam_cover(settings.wind_m_per_s) : 0));
  const ClearBody body(index, colour(settings.filter), settings.filter_m, settings.enlargement);
  if (settings.type == "transparent") return Material(Transparent{body, settings.reflectance, settings.transmittance});
  return Material(Dielectric{body});
}

}  // namespace arcus::render
