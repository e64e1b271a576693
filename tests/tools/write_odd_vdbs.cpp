// Writes VDB files as other programs may leave them into a folder, for tests of the command line. Usage: write_odd_vdbs FOLDER

#include <openvdb/openvdb.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>

namespace {

using openvdb::FloatGrid;
using openvdb::GridPtrVec;

/// A cube of 12³ voxels of 1 from (-6, -6, -6) on, so that the origin is in its middle.
template <class Grid = FloatGrid>
typename Grid::Ptr cube(const std::string& name, double value = 1) {
  const auto grid = Grid::create();
  grid->setName(name);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  auto accessor = grid->getAccessor();
  for (int x = -6; x < 6; ++x)
    for (int y = -6; y < 6; ++y)
      for (int z = -6; z < 6; ++z) accessor.setValue({x, y, z}, static_cast<typename Grid::ValueType>(value));
  return grid;
}

FloatGrid::Ptr placed(const openvdb::math::Mat4d& matrix) {
  const auto grid = cube("density");
  grid->setTransform(openvdb::math::Transform::createLinearTransform(matrix));
  return grid;
}
openvdb::math::Mat4d diagonal(double x, double y, double z) {
  openvdb::math::Mat4d m = openvdb::math::Mat4d::identity();
  m(0, 0) = x;
  m(1, 1) = y;
  m(2, 2) = z;
  return m;
}

std::string folder;
constexpr std::uint32_t usual = openvdb::io::COMPRESS_ACTIVE_MASK | openvdb::io::COMPRESS_ZIP;
void save(const std::string& name, const GridPtrVec& grids, std::uint32_t compression = usual, const openvdb::MetaMap& metadata = {}) {
  openvdb::io::File file(folder + "/" + name + ".vdb");
  file.setCompression(compression);
  file.write(grids, metadata);
  file.close();
}

/// Replaces all doubles of one value in a file.
void replace(const std::string& name, double before, double after) {
  const std::string path = folder + "/" + name + ".vdb";
  std::ifstream in(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  for (std::size_t i = 0; i + sizeof before <= bytes.size(); ++i)
    if (std::memcmp(&bytes[i], &before, sizeof before) == 0) std::memcpy(&bytes[i], &after, sizeof after);
  std::ofstream(path, std::ios::binary) << bytes;
}

void write_types() {
  const auto half = cube("density", 0.999);
  half->setSaveFloatAsHalf(true);
  save("half", {half});
  save("double", {cube<openvdb::DoubleGrid>("density")});
  const auto half_double = cube<openvdb::DoubleGrid>("density");
  half_double->setSaveFloatAsHalf(true);
  save("half_double", {half_double});
  save("int", {cube<openvdb::Int32Grid>("density")});
  save("long", {cube<openvdb::Int64Grid>("density")});
  save("bool", {cube<openvdb::BoolGrid>("density")});
  save("vector", {cube<openvdb::Vec3SGrid>("density")});
  const auto mask = openvdb::GridBase::createGrid(openvdb::MaskGrid::gridType());
  mask->setName("density");
  save("mask", {mask});
  const auto points = openvdb::GridBase::createGrid("Tree_ptdataidx32_5_4_3");
  points->setName("density");
  save("points", {points});
  const auto level_set = cube("density", -1);
  level_set->setGridClass(openvdb::GRID_LEVEL_SET);
  save("level_set", {level_set});
}

void write_names() {
  save("empty_name", {cube("")});
  save("empty_names", {cube(""), cube("smoke")});
  save("two_empty_names", {cube(""), cube("")});
  save("spaces", {cube("smoke density "), cube("heat")});
  save("unicode", {cube("Dichte ρ雲"), cube("heat")});
  save("brackets", {cube("density[1]"), cube("density"), cube("density")});
  save("twins", {cube("density"), cube("density", 2)});
  save("absent", {cube("smoke"), cube("heat"), cube<openvdb::Vec3SGrid>("velocity")});
  save("escape", {cube("red\x1b[31mpaint\nline"), cube("heat")});
}

void write_values() {
  for (const auto& [name, value] : {std::pair<const char*, float>{"negative", -0.5f},
                                    {"nan", std::nanf("")},
                                    {"infinite", std::numeric_limits<float>::infinity()}}) {
    const auto grid = cube("density");
    grid->tree().setValue({1, 2, 3}, value);
    save(name, {grid});
  }
  const auto beyond = cube<openvdb::DoubleGrid>("density");
  beyond->tree().setValue({1, 2, 3}, 1e300);
  save("beyond_float", {beyond});
  const auto faint = cube<openvdb::DoubleGrid>("density");  // nothing as a float
  faint->tree().setValue({1, 2, 3}, 1e-300);
  save("below_float", {faint});
  save("denormal", {cube("density", 1e-42)});
  const auto none = FloatGrid::create();
  none->setName("density");
  save("no_voxels", {none});
  const auto tile = FloatGrid::create();
  tile->setName("density");
  tile->tree().addTile(1, {0, 0, 0}, 1.f, true);
  tile->tree().addTile(1, {-8, 0, 0}, 1.f, true);
  tile->tree().addTile(2, {0, -128, -128}, 1.f, true);
  save("tiles", {tile});
  const auto root = FloatGrid::create();
  root->setName("density");
  root->tree().addTile(3, {0, 0, 0}, 1.f, true);
  save("root_tile", {root});
  save("metadata", {}, usual, [] {
    openvdb::MetaMap metadata;
    metadata.insertMeta("author", openvdb::StringMetadata("somebody"));
    return metadata;
  }());
  save("plain", {cube("density")}, openvdb::io::COMPRESS_NONE);
  save("zip", {cube("density")}, openvdb::io::COMPRESS_ZIP);
  if (openvdb::io::Archive::hasBloscCompression()) save("blosc", {cube("density")}, openvdb::io::COMPRESS_BLOSC | openvdb::io::COMPRESS_ACTIVE_MASK);
}

void write_transforms() {
  save("huge", {placed(diagonal(1e6, 1e6, 1e6))});
  const auto small = cube("density");
  small->setTransform(openvdb::math::Transform::createLinearTransform(2e-5));  // OpenVDB makes none of less than about 1.5e-5 ...
  save("tiny", {small});
  save("nano", {small});
  replace("nano", 2e-5, 1e-9);  // ... but a file may have it
  save("mirrored", {placed(diagonal(-1, 1, 1))});
  save("upside_down", {placed(diagonal(-1, -1, -1))});
  save("flattened", {placed(diagonal(100, 100, 1e-3))});
  auto shear = openvdb::math::Mat4d::identity();
  shear(0, 1) = 0.7;
  shear(2, 0) = -0.4;
  save("shear", {placed(shear)});
  auto far = openvdb::math::Mat4d::identity();
  far(3, 0) = 1e7;
  save("far", {placed(far)});
  const auto frustum = cube("density");
  frustum->setTransform(openvdb::math::Transform::createFrustumTransform(openvdb::BBoxd({-6, -6, -6}, {6, 6, 6}), 0.5, 10));
  save("frustum", {frustum});
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 2) return std::fprintf(stderr, "usage: write_odd_vdbs FOLDER\n"), 2;
  folder = arguments[1];
  openvdb::initialize();
  write_types();
  write_names();
  write_values();
  write_transforms();
}
