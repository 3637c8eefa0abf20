// Camera files, and with them the TOML of every configuration.
#include "services/lab/simulated/camera_file.h"

#include "tests/fuzz/fuzz.h"

using trailcast::fuzz::Require;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto camera =
      trailcast::agent::ReadCameraFile(trailcast::fuzz::AsFile({data, size}, "camera.toml"));
  if (!camera) return 0;
  Require(trailcast::sim::Validate(*camera).has_value(), "a camera that was read is valid");
  const trailcast::sim::Lens lens(*camera);
  const auto ahead = lens.Direction({camera->width / 2.0, camera->height / 3.0});
  Require(!ahead || ahead->allFinite(), "its pixels look somewhere");
  return 0;
}
