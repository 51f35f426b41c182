#include "daemon/cloud_files/mesh_reader.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/core.h>

#include <algorithm>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <exception>
#include <iterator>

#include "core/geometry/mesh_sampling.h"
#include "daemon/cloud_files/text_tokens.h"
#include "daemon/cloud_files/unseen_points.h"

namespace instep {
namespace {

/// Knows no files. A mesh may name others, of materials and pictures: nothing of them is wanted,
/// they may be damaged, and opening one that is a pipe would wait for ever.
class NoOtherFiles final : public Assimp::IOSystem {
 public:
  bool Exists(const char*) const override { return false; }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char*, const char*) override { return nullptr; }
  void Close(Assimp::IOStream*) override {}
};

/// The parts of a scene after each other. Triangles that name corners that are not there are told
/// by `false`.
bool append_part(const aiMesh& part, TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (unsigned i = 0; i < part.mNumVertices; ++i) {
    const auto& corner = part.mVertices[i];
    mesh.positions.emplace_back(corner.x, corner.y, corner.z);
  }
  for (unsigned i = 0; i < part.mNumFaces; ++i) {
    const auto& face = part.mFaces[i];
    if (face.mNumIndices != 3) continue;  // a point or a line
    for (unsigned corner = 0; corner < 3; ++corner) {
      if (face.mIndices[corner] >= part.mNumVertices) return false;
    }
    mesh.triangles.push_back(
        {first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]});
  }
  return true;
}

Result<RawCloud> import(std::string_view bytes, const char* kind, const std::string& file) {
  TriangleMesh mesh;
  try {
    Assimp::Importer importer;
    importer.SetIOHandler(new NoOtherFiles);  // which the importer then owns
    const aiScene* scene =
        importer.ReadFileFromMemory(bytes.data(), bytes.size(), aiProcess_Triangulate, kind);
    if (scene == nullptr) return damaged_file(file, "it is no sound mesh file");
    for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
      if (!append_part(*scene->mMeshes[i], mesh)) {
        return damaged_file(file, "a face names a point that is not there");
      }
    }
  } catch (const std::exception&) {
    return damaged_file(file, "it is no sound mesh file");
  }
  RawCloud raw;
  raw.cloud.positions = std::move(mesh.positions);
  raw.triangles = std::move(mesh.triangles);
  // Here already: ordering the corners, for welding, needs numbers.
  if (auto good = leave_out_unseen(raw, file); !good) return tl::make_unexpected(good.error());
  mesh = welded({std::move(raw.cloud.positions), std::move(raw.triangles)});
  raw.cloud.positions = std::move(mesh.positions);
  raw.triangles = std::move(mesh.triangles);
  return raw;
}

/// The bytes up to the last triangle. A binary STL says how many follow: assimp believes it, so it
/// is compared with the file's size first; and it takes a file of any other size for text.
Result<std::string_view> whole_binary_stl(std::string_view bytes, const std::string& file) {
  constexpr std::size_t kHeader_bytes = 84;
  constexpr std::size_t kTriangle_bytes = 50;
  if (bytes.size() < kHeader_bytes) return damaged_file(file, "it ends within its STL header");
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + 80, sizeof(count));
  if ((bytes.size() - kHeader_bytes) / kTriangle_bytes < count) {
    return damaged_file(file, "it is too short for the triangles that its STL header promises");
  }
  return bytes.substr(0, kHeader_bytes + kTriangle_bytes * count);
}

/// Text STL begins with "solid"; some binary ones do too, but have zeros or other bytes no text
/// has.
bool is_text_stl(std::string_view bytes) {
  const std::string start = lower_case(bytes.substr(0, 512));
  return start.starts_with("solid") && start.find("facet") != start.npos &&
         start.find('\0') == start.npos;
}

Result<RawCloud> read_text_stl(std::string_view bytes, const std::string& file) {
  const std::string text = lower_case(bytes);  // assimp knows its words in small letters only
  // assimp takes a text that ends anywhere; a whole one has its last word.
  if (text.rfind("endsolid") == text.npos) return damaged_file(file, "it has no endsolid");
  auto raw = import(text, "stl", file);
  if (raw) raw->format = "STL, text";
  return raw;
}

Result<RawCloud> read_binary_stl(std::string_view bytes, const std::string& file) {
  const auto whole = whole_binary_stl(bytes, file);
  if (!whole) return tl::make_unexpected(whole.error());
  auto raw = import(*whole, "stl", file);
  if (!raw) return raw;
  raw->format = "STL, binary";
  raw->surplus_bytes = without_blanks_at_end(bytes.substr(whole->size())).size();
  return raw;
}

/// What of an OBJ file tells its shape, said as plainly as it can be: on what else one may hold
/// (materials, groups, normals, curves) assimp stumbles where it is damaged, and crashes.
class PlainObj {
 public:
  /// False for a corner that is no point.
  bool add_corner(std::string_view words) {
    Eigen::Vector3d corner;
    text_ += "v";
    for (double& part : corner) {
      const auto number = number_in(take_word(words));
      if (!number) return false;
      part = *number;
      fmt::format_to(std::back_inserter(text_), " {}", part);
    }
    text_ += "\n";
    corners_.push_back(corner);
    return true;
  }

  /// False for a face that cannot be of these corners. Each may be followed by its place in a
  /// picture and its normal, as in 3/1/2; below 0 it is counted back from the last one.
  bool add_face(std::string_view words) {
    text_ += "f";
    for (auto word = take_word(words); !word.empty(); word = take_word(words)) {
      word = word.substr(0, word.find('/'));
      const auto corner = number_in(word);
      if (!corner || *corner == 0.0 || *corner != std::trunc(*corner)) return false;
      const std::size_t most = *corner > 0.0 ? kMostFilePoints : corners_.size();
      if (std::abs(*corner) > static_cast<double>(most)) return false;
      last_of_faces_ = std::max(last_of_faces_, *corner);
      fmt::format_to(std::back_inserter(text_), " {}", std::lround(*corner));
    }
    text_ += "\n";
    has_faces_ = true;
    return true;
  }

  bool has_faces() const { return has_faces_; }
  bool has_all_corners() const { return last_of_faces_ <= static_cast<double>(corners_.size()); }
  const std::vector<Eigen::Vector3d>& corners() const { return corners_; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::vector<Eigen::Vector3d> corners_;
  bool has_faces_ = false;
  double last_of_faces_ = 0.0;
};

constexpr const char* kNoPoint = "a corner (v) of it is no point";
constexpr const char* kNoCorner = "a face (f) of it names a point that is not there";

Result<PlainObj> plain_obj(std::string_view bytes, const std::string& file) {
  PlainObj obj;
  std::string whole;  // a line that ends with a backslash goes on in the next, but no comment does
  TextLines lines(bytes);
  while (const auto line = lines.next()) {
    whole += *line;
    if (whole.ends_with('\\') && !whole.starts_with('#')) {
      whole.back() = ' ';
      if (!lines.rest().empty()) continue;
    }
    std::string_view words = whole;
    const std::string_view kind = take_word(words);
    if (kind == "v" && !obj.add_corner(words)) return damaged_file(file, kNoPoint);
    if (kind == "f" && !obj.add_face(words)) return damaged_file(file, kNoCorner);
    whole.clear();
  }
  if (!obj.has_all_corners()) return damaged_file(file, kNoCorner);
  return obj;
}

}  // namespace

Result<RawCloud> read_obj(std::string_view bytes, const std::string& file) {
  const auto obj = plain_obj(bytes, file);
  if (!obj) return tl::make_unexpected(obj.error());
  Result<RawCloud> raw;
  if (obj->has_faces()) {
    raw = import(obj->text(), "obj", file);
  } else {
    raw->cloud.positions = obj->corners();  // assimp refuses points alone
  }
  if (raw) raw->format = "OBJ";
  return raw;
}

Result<RawCloud> read_stl(std::string_view bytes, const std::string& file) {
  return is_text_stl(bytes) ? read_text_stl(bytes, file) : read_binary_stl(bytes, file);
}

}  // namespace instep
