#pragma once
// Files as other programs write them.

#include <openvdb/openvdb.h>

#include <filesystem>
#include <string>

namespace arcus::media::kit {

/// A folder of the running test that is empty at its start.
inline std::string folder() {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  const auto path = std::filesystem::temp_directory_path() /
                    ("arcus_test_" + std::string(info->test_suite_name()) + "_" + info->name() + "_" +
                     std::to_string(::getpid()));
  std::filesystem::remove_all(path);
  std::filesystem::create_directories(path);
  return path.string();
}

inline std::string save(const std::string& path, const openvdb::GridPtrVec& grids) {
  openvdb::io::File file(path);
  file.write(grids);
  file.close();
  return path;
}

/// A cube of n³ voxels of a value, from (1, 2, 3) on.
template <class Grid = openvdb::FloatGrid>
typename Grid::Ptr cube(const std::string& name, double value, int n = 12) {
  openvdb::initialize();
  const auto grid = Grid::create();
  grid->setName(name);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  auto accessor = grid->getAccessor();
  for (int x = 0; x < n; ++x)
    for (int y = 0; y < n; ++y)
      for (int z = 0; z < n; ++z)
        accessor.setValue({x + 1, y + 2, z + 3}, static_cast<typename Grid::ValueType>(value));
  return grid;
}

}  // namespace arcus::media::kit
