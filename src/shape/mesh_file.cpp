#include "src/shape/mesh_file.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "phase/base/error.h"
#include "src/shape/ply_length.h"

namespace arcus::render {

std::vector<Triangle> read_mesh(const std::string& path, const std::string& where) {
  std::string kind = std::filesystem::path(path).extension().string();
  for (char& c : kind) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (kind != ".ply" && kind != ".obj") throw bad_input(where, "'" + path + "'", "a .ply or .obj file expected");
  if (!std::filesystem::is_regular_file(path)) throw bad_input(where + ": " + path, "no file", "a .ply or .obj file expected", "Check the name and the folder");
  if (kind == ".ply") check_ply_length(path, where + ": " + path);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate | aiProcess_PreTransformVertices);
  // Assimp reads points without faces, and fails when it finds nothing left of them.
  if (!scene && std::string_view(importer.GetErrorString()).find("No output meshes") != std::string_view::npos)
    throw bad_input(where + ": " + path, "no face", "a mesh of triangles or polygons expected");
  if (!scene) throw bad_input(where + ": " + path, "no readable mesh (" + std::string(importer.GetErrorString()) + ")", "PLY or OBJ expected");
  std::vector<Triangle> triangles;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines
      const auto corner = [&](unsigned i) {
        const aiVector3D& v = mesh.mVertices[face.mIndices[i]];
        return Vec3(v.x, v.y, v.z);
      };
      const Triangle t{corner(0), corner(1), corner(2)};
      const double area2 = squared_length(cross(t.b_m - t.a_m, t.c_m - t.a_m));
      if (!std::isfinite(area2)) throw bad_input(where + ": " + path, "a corner that is not finite in face " + std::to_string(f), "finite coordinates expected");
      if (area2 > 0) triangles.push_back(t);
    }
  }
  if (triangles.empty()) throw bad_input(where + ": " + path, "no face", "a mesh of triangles or polygons expected");
  return triangles;
}

}  // namespace arcus::render
