#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "services/base/result.h"
#include "services/lab/sim/core/world.h"

namespace trailcast::sim {

enum class UpAxis { kY, kZ };

struct WorldFileOptions {
  std::filesystem::path file;
  UpAxis up = UpAxis::kZ;
  double scale = 1.0;  // metres per unit of the file
  GroundMode ground = GroundMode::kMesh;
};

// Reads a world in any format that Assimp knows (glTF, GLB, OBJ, ...), with its textures, embedded
// or beside the file. A missing texture becomes a warning, and the material's plain colour replaces
// it. Errors (missing, unreadable, no triangles, bad scale) name the file.
[[nodiscard]] Result<std::shared_ptr<const World>> LoadWorld(const WorldFileOptions& options);

// These parse the command line's words: up "y" or "z", ground "mesh" or "flat".
[[nodiscard]] Result<UpAxis> ParseUpAxis(const std::string& word);
[[nodiscard]] Result<GroundMode> ParseGroundMode(const std::string& word);

}  // namespace trailcast::sim
