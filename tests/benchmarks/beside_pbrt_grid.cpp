// A grid of a VDB file as NanoVDB, for beside_pbrt.sh: beside_pbrt_grid IN.vdb GRID OUT.nvdb
// writes it under the name "density".

#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <openvdb/openvdb.h>

#include <exception>
#include <iostream>

int main(int count, char** words) {
  if (count != 4) {
    std::cerr << "usage: beside_pbrt_grid IN.vdb GRID OUT.nvdb\n";
    return 1;
  }
  try {
    openvdb::initialize();
    openvdb::io::File file(words[1]);
    file.open();
    const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid(words[2]));
    grid->setName("density");
    nanovdb::io::writeGrid(words[3], nanovdb::openToNanoVDB(*grid), nanovdb::io::Codec::NONE);
  } catch (const std::exception& error) {
    std::cerr << "beside_pbrt_grid: " << error.what() << '\n';
    return 1;
  }
}
