#include "src/material/material.h"

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
    keys.choice("pattern", material.pattern, {"plain", "checker"}, "checker: cubes of two colours by turns, with a corner at the origin");
    if (keys.only_if(material.pattern == "checker", "pattern = checker")) {
      list_colour(keys, "other_albedo", material.other_albedo, "of the other cubes");
      keys.number("pattern_m", material.pattern_m, above(0), "edge of a cube [m]");
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

Material make_material(const MaterialSettings& settings, const std::string& folder, const ColourToSpectrum& colour) {
  if (settings.type == "matte") {
    if (settings.pattern == "checker") return Material(Matte(colour(settings.albedo), colour(settings.other_albedo), settings.pattern_m));
    return Material(Matte(colour(settings.albedo)));
  }
  if (settings.type == "mirror") return Material(Mirror{colour(settings.albedo)});
  const auto index = [&] {
    if (settings.index.empty()) return phase::RefractiveIndex::constant(settings.index_constant);
    const bool is_known = settings.index == "water" || settings.index == "ice";
    return phase::RefractiveIndex::named(is_known ? settings.index : path_from(folder, settings.index));
  }();
  if (settings.type == "sea")
    return Material(Sea(ClearBody(index, 1, 1), cox_munk_slopes(settings.wind_m_per_s, settings.slopes == "isotropic"), settings.wind_from_deg,
                        colour(settings.water_albedo), settings.whitecaps ? foam_cover(settings.wind_m_per_s) : 0));
  const ClearBody body(index, colour(settings.filter), settings.filter_m, settings.enlargement);
  if (settings.type == "transparent") return Material(Transparent{body, settings.reflectance, settings.transmittance});
  return Material(Dielectric{body});
}

}  // namespace arcus::render
