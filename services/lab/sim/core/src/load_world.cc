#include "services/lab/sim/core/load_world.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <map>
#include <span>
#include <system_error>
#include <utility>

#include "services/image/files.h"

namespace trailcast::sim {
namespace {

namespace fs = std::filesystem;

// Converts a texture that Assimp hands over decoded, with 32-bit texels.
image::RgbImage FromTexels(const aiTexture& texture) {
  image::RgbImage picture{static_cast<int>(texture.mWidth), static_cast<int>(texture.mHeight), {}};
  const std::span<const aiTexel> texels(texture.pcData,
                                        static_cast<std::size_t>(texture.mWidth) * texture.mHeight);
  picture.pixels.reserve(3 * texels.size());
  for (const aiTexel& texel : texels) {
    picture.pixels.insert(picture.pixels.end(), {texel.r, texel.g, texel.b});
  }
  return picture;
}

class SceneReader {
 public:
  SceneReader(const aiScene& source, const WorldFileOptions& options)
      : source_(source), options_(options) {}

  Scene Read() {
    scene_.name = options_.file.stem().string();
    scene_.ground = options_.ground;
    for (unsigned i = 0; i < source_.mNumMaterials; ++i) {
      scene_.materials.push_back(ReadMaterial(*source_.mMaterials[i]));
    }
    if (source_.mRootNode != nullptr) ReadNode(*source_.mRootNode, aiMatrix4x4());
    return std::move(scene_);
  }

 private:
  Material ReadMaterial(const aiMaterial& source) {
    Material material;
    material.name = source.GetName().C_Str();
    aiString reference;
    const bool textured =
        source.GetTexture(aiTextureType_BASE_COLOR, 0, &reference) == AI_SUCCESS ||
        source.GetTexture(aiTextureType_DIFFUSE, 0, &reference) == AI_SUCCESS;
    if (textured) material.texture = FindTexture(reference.C_Str(), material.name);
    aiColor4D color(0.7F, 0.7F, 0.7F, 1.0F);
    if (source.Get(AI_MATKEY_BASE_COLOR, color) != AI_SUCCESS) {
      source.Get(AI_MATKEY_COLOR_DIFFUSE, color);
    }
    const Eigen::Vector3f rgb = 255.0F * Eigen::Vector3f(color.r, color.g, color.b);
    material.color = rgb.cwiseMax(0.0F).cwiseMin(255.0F);
    // Exporters often leave the colour black beside a texture.
    if (material.texture && material.color.maxCoeff() <= 0.0F) material.color.setConstant(255.0F);
    return material;
  }

  std::shared_ptr<const Texture> FindTexture(const std::string& reference,
                                             const std::string& material) {
    const auto known = textures_.find(reference);
    if (known != textures_.end()) return known->second;
    auto picture = ReadTexture(reference);
    std::shared_ptr<const Texture> texture;
    if (picture) {
      texture = std::make_shared<Texture>(*picture);
    } else {
      scene_.warnings.push_back(fmt::format("material {} is drawn in plain colour: {}", material,
                                            picture.error().message));
    }
    textures_[reference] = texture;
    return texture;
  }

  Result<image::RgbImage> ReadTexture(const std::string& reference) const {
    if (const aiTexture* embedded = source_.GetEmbeddedTexture(reference.c_str())) {
      if (embedded->mHeight != 0) return FromTexels(*embedded);
      const auto* bytes = reinterpret_cast<const std::uint8_t*>(embedded->pcData);
      return image::DecodeRgb({bytes, embedded->mWidth},
                              fmt::format("{} in {}", reference, options_.file.string()));
    }
    std::string relative = reference;
    std::replace(relative.begin(), relative.end(), '\\', '/');
    const fs::path folder = options_.file.parent_path();
    std::error_code error;
    const fs::path beside = folder / fs::path(relative).filename();
    const fs::path named = folder / relative;
    return image::ReadRgb(!fs::exists(named, error) && fs::exists(beside, error) ? beside : named);
  }

  void ReadNode(const aiNode& node, const aiMatrix4x4& parent) {
    const aiMatrix4x4 transform = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      ReadMesh(*source_.mMeshes[node.mMeshes[i]], transform);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) ReadNode(*node.mChildren[i], transform);
  }

  void ReadMesh(const aiMesh& source, const aiMatrix4x4& transform) {
    Mesh mesh;
    mesh.material = source.mMaterialIndex;
    for (unsigned i = 0; i < source.mNumVertices; ++i) {
      mesh.positions.push_back(ToWorld(transform * source.mVertices[i]));
      if (source.HasTextureCoords(0)) {
        // Assimp counts v from the picture's lower edge, and textures here count from the upper
        // one.
        const aiVector3D& uv = source.mTextureCoords[0][i];
        mesh.uvs.emplace_back(uv.x, 1.0F - uv.y);
      }
      if (source.HasVertexColors(0)) {
        const aiColor4D& color = source.mColors[0][i];
        // `shade` scales light, of which brightness is the square root (see ViewTracer).
        const float brightness = 0.30F * color.r + 0.59F * color.g + 0.11F * color.b;
        mesh.shade.push_back(brightness * brightness);
      }
    }
    for (unsigned i = 0; i < source.mNumFaces; ++i) {
      const aiFace& face = source.mFaces[i];
      if (face.mNumIndices != 3) continue;
      mesh.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
    }
    if (!mesh.triangles.empty()) scene_.meshes.push_back(std::move(mesh));
  }

  Eigen::Vector3f ToWorld(const aiVector3D& p) const {
    const auto scale = static_cast<float>(options_.scale);
    if (options_.up == UpAxis::kY) return scale * Eigen::Vector3f(p.x, -p.z, p.y);
    return scale * Eigen::Vector3f(p.x, p.y, p.z);
  }

  const aiScene& source_;
  const WorldFileOptions& options_;
  Scene scene_;
  std::map<std::string, std::shared_ptr<const Texture>> textures_;
};

}  // namespace

Result<std::shared_ptr<const World>> LoadWorld(const WorldFileOptions& options) {
  const std::string file = options.file.string();
  std::error_code error;
  if (!fs::exists(options.file, error)) {
    return Fail(ErrorCode::kNotFound, "no world {}: the file does not exist", file);
  }
  if (!(options.scale > 0.0) || !std::isfinite(options.scale)) {
    return Fail(ErrorCode::kInvalidArgument,
                "scale {} for the world {} is no size: expected metres per unit, above 0",
                options.scale, file);
  }
  Assimp::Importer importer;
  const aiScene* source = importer.ReadFile(
      file, aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_TransformUVCoords);
  if (source == nullptr) {
    return Fail(ErrorCode::kCorrupt,
                "cannot read the world {}: {}; expected glTF, GLB, OBJ or another format of Assimp",
                file, importer.GetErrorString());
  }
  auto world = World::Build(SceneReader(*source, options).Read());
  if (!world) return Wrap(world.error(), "loading " + file);
  return world;
}

Result<UpAxis> ParseUpAxis(const std::string& word) {
  if (word == "y") return UpAxis::kY;
  if (word == "z") return UpAxis::kZ;
  return Fail(ErrorCode::kInvalidArgument, "up axis \"{}\" is unknown: expected y or z", word);
}

Result<GroundMode> ParseGroundMode(const std::string& word) {
  if (word == "mesh") return GroundMode::kMesh;
  if (word == "flat") return GroundMode::kFlat;
  return Fail(ErrorCode::kInvalidArgument, "ground \"{}\" is unknown: expected mesh or flat", word);
}

}  // namespace trailcast::sim
