#include "services/lab/sim/places/place_change.h"

#include <memory>
#include <vector>

#include "services/lab/sim/core/random.h"
#include "services/lab/sim/places/indoor_world.h"

namespace trailcast::sim {

void ChangeTextures(double share, std::uint64_t seed, Scene& scene) {
  std::vector<Material*> textured;
  std::vector<std::shared_ptr<const Texture>> textures;
  for (Material& material : scene.materials) {
    if (!material.texture) continue;
    textured.push_back(&material);
    textures.push_back(material.texture);
  }
  if (textured.size() < 2) return;
  Random random(seed, "textures");
  for (std::size_t i = 0; i < textured.size(); ++i) {
    const bool changes = random.Uniform() < share;
    const int further = random.Integer(1, static_cast<int>(textured.size()) - 1);
    if (changes) {
      textured[i]->texture = textures[(i + static_cast<std::size_t>(further)) % textures.size()];
    }
  }
}

Result<Place> OpenChangedPlace(const std::string& name, const PlaceChange& change) {
  if (name == "indoor") return MakeIndoorWorld(change);
  return Fail(ErrorCode::kInvalidArgument,
              "the place {} knows no change of its looks; that which does: indoor", name);
}

}  // namespace trailcast::sim
